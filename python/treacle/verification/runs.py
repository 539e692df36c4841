# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Runs exact cases: parameter files with the program, and programs of tests/."""

import os
import re
import signal
import subprocess
import tempfile
import threading
import time
from pathlib import Path

import numpy

from treacle.repository import ROOT
from treacle.verification.cases import Program
from treacle.verification.measures import Results

BUILD = ROOT / "build/release"
ERROR = "treacle: error: "
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}
stopped = threading.Event()  # by Ctrl-C: then nothing more is run or kept


class Failed(Exception):
    """A run failed; the message is one line."""


def execute(line, **options):
    """What a command prints."""
    try:
        done = subprocess.run(list(map(str, line)), capture_output=True, text=True, env=ENVIRONMENT,
                              **options)
    except OSError as error:
        raise Failed(f"{error.strerror}: {Path(line[0]).name} (scripts/verify --build)")
    if done.returncode == -signal.SIGINT:
        stopped.set()
    if done.returncode < 0:
        raise Failed(signal.strsignal(-done.returncode))
    if done.returncode > 0:
        said = [text for text in done.stderr.splitlines() if text.strip(" -*")]
        own = [text.removeprefix(ERROR) for text in said if text.startswith(ERROR)]
        raise Failed([f"exit code {done.returncode}", *said[-1:], *own[:1]][-1])
    return done.stdout


def build(cases):
    """The program, and that of the tests if cases need it."""
    programs = ["treacle_tests"] if any(isinstance(case, Program) for case in cases) else []
    subprocess.run(["ninja", "-C", BUILD, "treacle", *programs], check=True)


def run(case, level, time_step, settings, program=BUILD / "treacle", ranks=1):
    """Errors of the quantities of a run, its energy gain, volume drift, and so on."""
    with tempfile.TemporaryDirectory() as directory:
        line = [*(("mpirun", "-np", ranks) if ranks > 1 else ()), program, ROOT / case.path]
        for name, value in {"Output directory": directory, "Maximum time step": time_step,
                            **{f"Mesh/{kind} level": level for kind in ("Surface", "Interior")},
                            "Mesh/Air level": level - 1, **case.settings, **settings}.items():
            line += ["--set", f"{name}={value}"]
        start = time.monotonic()
        execute(line)
        seconds = time.monotonic() - start
        found = Results(directory)
        values = {name: (value(found) / exact - 1 if exact else value(found))
                  for name, (value, exact) in case.exact.items()}
        return {"errors": values, "h": found.leaf_size(level), "dt": time_step,
                "seconds": seconds, "cells": float(numpy.mean(found["Cells"])),
                "energy gain": found.energy_gain(),
                "volume drift": found.volume_drift(), "fallbacks": found.fallbacks()}


def append(result, one):
    """One run to the lists of a result."""
    for name, value in one.items():
        if name == "errors":
            for quantity, error in value.items():
                result.setdefault("errors", {}).setdefault(quantity, []).append(error)
        else:
            result.setdefault(name, []).append(value)


def run_case(case, levels, settings, in_time, result):
    runs = {}
    for level in levels:
        step = case.time_step * 0.5 ** (level - case.first_level)
        runs[level, step] = run(case, level, step, settings)
        result.setdefault("levels", []).append(level)
        append(result, runs[level, step])
    level = case.first_level + 1
    for more in case.in_time if in_time else ():
        study = {"level": level, "settings": more}
        for step in (case.time_step * 0.5 ** k for k in range(3)):
            done = None if more else runs.get((level, step))
            done = done or run(case, level, step, {**settings, **more})
            append(study, {name: done[name] for name in ("dt", "errors", "seconds")})
        result.setdefault("in time", []).append(study)


def run_program(case, levels, settings, result):
    result["levels"], result["h"] = list(levels), [0.5 ** level for level in levels]
    start = time.monotonic()
    program = [BUILD / "tests/treacle_tests", case.file]
    errors = result["errors"] = {}
    with tempfile.TemporaryDirectory() as directory:
        (Path(directory) / "results").symlink_to(ROOT / "results")
        if "{level}" in case.arguments:
            for level in levels:
                text = execute([*program, *(argument.format(level=level) for argument in case.arguments)],
                               cwd=directory)
                for quantity in case.tolerances:
                    value = float(re.search(rf"\b{quantity} ([-+.e\d]+)", text)[1])
                    errors.setdefault(quantity, []).append(value)
        else:
            settings = {**case.settings, **settings}
            execute([*program, *case.arguments, *levels,
                     *(f"{name}={value}" for name, value in settings.items())], cwd=directory)
            errors.update(errors_in((Path(directory) / "output").read_text(), case))
    result["seconds"] = [time.monotonic() - start]


def errors_in(text, program):
    """Lists of errors, one a level, by mapping and quantity."""
    errors = {}
    for mapping, values in re.findall(r"level \d+, ([\w ]+): (.*)", text):
        named = re.findall(r"(\w+) ([-+.e\d]+) \(([-+.e\d]+)\)", values)
        for quantity, error in ([(quantity, float(value) / float(exact) - 1)
                                 for quantity, value, exact in named]
                                or zip(program.tolerances, map(float, values.split(", ")))):
            errors.setdefault(f"{mapping}: {quantity}", []).append(error)
    return errors
