# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Measures cases at several resolutions, some of them at a time."""

import re
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor

from treacle.verification import report, results
from treacle.verification.cases import Program
from treacle.verification.results import CASES
from treacle.verification.runs import Failed, run_case, run_program, stopped


def measure(name, n_levels, settings, in_time):
    """The result of a case; "failed" says why it is not complete."""
    case, result = CASES[name], {"settings": {**CASES[name].settings, **settings}}
    levels = range(case.first_level, case.first_level + min(n_levels, case.n_levels))
    try:
        if isinstance(case, Program):
            run_program(case, levels, settings, result)
        else:
            run_case(case, levels, settings, in_time, result)
    except Exception as error:  # whatever it is: the other cases go on
        prefix = "" if isinstance(error, Failed) else f"{type(error).__name__}: "
        text = re.sub(tempfile.gettempdir() + r"/\w+/", "", str(error))
        result["failed"] = (prefix + " ".join(text.split()))[:300]
    return results.rounded(result)


def measure_all(names, n_levels, settings, write, n_jobs):
    """Whether all could be measured."""
    lock, failed = threading.Lock(), []

    def one(name):
        result = measure(name, n_levels, settings, write)
        with lock:
            if stopped.is_set():
                return
            if write:
                results.store(name, result)
            print(report.terminal_table(name, result), flush=True)
            if "failed" in result:
                failed.append(name)
                print(f"verify: {name}: {result['failed']}", file=sys.stderr, flush=True)

    with ThreadPoolExecutor(n_jobs) as pool:
        try:
            list(pool.map(one, names))
        except KeyboardInterrupt:
            stopped.set()
            pool.shutdown(cancel_futures=True)
    return not failed and not stopped.is_set()
