#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Errors of exact cases over cells and seconds, by what asks for fine leaves; a table in markdown.

    benchmarks/adaptivity.py [--levels N] [--set NAME=VALUE]... [CASE ...]

everywhere: liquid and surface have leaves of one level, and the air of the next. interior: both are two levels coarser.
velocity: they are three levels coarser, and `Mesh/Velocity error` asks. surface: leaves along the surface too,
two levels coarser where it allows. Cells are the mean over the steps, seconds those of the processor in the whole run.
"""

import argparse
import resource
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from treacle.verification.free_surface_cases import FREE_SURFACE_CASES  # noqa: E402
from treacle.verification.runs import run  # noqa: E402

CASES = ["C3 k pi, h 0.5, nu 1", "C5", "C7", "C9", "C9b", "C9d"]


def settings(mode, level):
    def inside(n):
        return {f"Mesh/{kind} level": max(level - n, 1) for kind in ("Interior", "Air")}

    velocity = {**inside(3), "Mesh/Velocity error": "0.03"}
    return {"everywhere": {}, "interior": inside(2), "velocity": velocity,
            "surface": {**velocity, "Mesh/Coarsest surface level": max(level - 2, 1)}}[mode]


def processor_seconds():
    """Of the programs that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", default=CASES)
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", dest="more")
    arguments = parser.parse_args()
    more = dict(pair.split("=", 1) for pair in arguments.more)
    print("| case | level | leaves | cells | s | errors |")
    print("|---" * 6 + "|")
    for name in arguments.cases:
        case = FREE_SURFACE_CASES[name]
        for k in range(arguments.levels):
            level = case.first_level + k
            for mode in ("everywhere", "interior", "velocity", "surface"):
                start = processor_seconds()
                done = run(case, level, case.time_step * 0.5 ** k, {**settings(mode, level), **more})
                errors = ", ".join(f"{100 * error:+.2g}" for error in done["errors"].values())
                print(f"| {name} | {level} | {mode} | {done['cells']:.0f} | {processor_seconds() - start:.1f} | {errors} % |",
                      flush=True)


if __name__ == "__main__":
    main()
