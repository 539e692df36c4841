#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Iterations and seconds of the couplings of viscosity and pressure, by viscosity and mesh:
five steps of prm/benchmarks/coupling.prm (in 2D coupling_2d.prm) each, tables in markdown.

    benchmarks/coupling.py [--dimension 2|3] [--levels 4 5 ...] [--viscosities 1 1e2 ...] [--ranks N]

Iterations are those of viscosity (or the coupled solve) and of pressure, the largest of a step; seconds
are those of viscosity, pressure and coupled solve in a step, in parts of the step.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from treacle import read_statistics, read_timing  # noqa: E402

COUPLINGS = ["split", "split with first projection", "coupled"]
SCENES = {2: "coupling_2d", 3: "coupling"}


def measure(dimension, settings, ranks):
    """Cells, iterations of viscosity and of pressure, seconds of a solve and of a step, fallbacks."""
    with tempfile.TemporaryDirectory() as directory:
        line = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        line += [ROOT / "build/release/treacle", ROOT / f"prm/benchmarks/{SCENES[dimension]}.prm"]
        for name, value in {**settings, "Output directory": directory}.items():
            line += ["--set", f"{name}={value}"]
        done = subprocess.run(line, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"coupling: {done.stderr.strip()}")
        table, seconds = read_statistics(directory), read_timing(directory).seconds
        n_steps = len(table["Time (s)"]) - 1
        solve = sum(seconds.get(name, 0) for name in ("viscosity", "pressure", "coupled"))
        return (int(table["Cells"][-1]), int(max(table["Viscosity iterations"])),
                int(max(table["Pressure iterations"])), solve / n_steps,
                seconds["Total"] / n_steps, int(sum(table["Fallbacks"])))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dimension", type=int, default=3, choices=(2, 3))
    parser.add_argument("--levels", nargs="+", type=int, default=[4, 5])
    parser.add_argument("--viscosities", nargs="+", default=["1", "1e2", "1e4", "1e6", "1e8"])
    parser.add_argument("--ranks", type=int, default=1)
    arguments = parser.parse_args()
    print("| level, cells | viscosity | " + " | ".join(COUPLINGS) + " | coupled / first projection |")
    print("|---" * (3 + len(COUPLINGS)) + "|")
    for level in arguments.levels:
        for viscosity in arguments.viscosities:
            row, solves = [], []
            for coupling in COUPLINGS:
                cells, of_viscosity, of_pressure, solve, step, fallbacks = measure(arguments.dimension, {
                    "Mesh/Surface level": level, "Mesh/Interior level": level - 1,
                    "Mesh/Air level": level - 3, "Material/Viscosity": viscosity,
                    "Viscosity/Pressure coupling": coupling}, arguments.ranks)
                solves.append(solve)
                row.append(f"{of_viscosity} + {of_pressure}, {solve:.2f} of {step:.2f} s" +
                           (f", {fallbacks} fallbacks" if fallbacks else ""))
            print(f"| {level}, {cells} | {viscosity} | " + " | ".join(row) +
                  f" | {solves[2] / solves[1]:.1f} |", flush=True)


if __name__ == "__main__":
    main()
