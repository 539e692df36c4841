#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What a time step costs: seconds a step in flight and in contact, by part, and memory, as tables in
markdown. Several programs, as one of an older commit, are run in turn, for machines are noisy.

    benchmarks/steps.py [--scenes bowl armadillo] [--levels 5 6] [--ranks 1 2] [--programs PATH ...]
                        [--repeat N]

On one rank that nothing disturbs, seconds of wall time are those of the CPU. The Armadillo's mesh is
unpacked by scripts/run.
"""

import argparse
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from treacle import read_timing  # noqa: E402

# file, first and last time (s) of the windows of steps that are compared
SCENES = {
    "bowl": ("prm/benchmarks/bowl.prm", 0.3, {"flight": (0, 0.03), "contact": (0.25, 0.3)}),
    "armadillo": ("prm/figures/armadillo.prm", 0.32, {"landing": (0.24, 0.32)}),
}
PARTS = ["coupled", "surface", "advection", "mesh", "reconstruction", "extrapolation", "pressure",
         "markers", "liquid domain"]
STEP = re.compile(r"step +\d+  t (\S+) s .*? (\d+) cells( \(new\))?.* ([0-9.]+) s$")


def run(program, scene, level, ranks):
    """Steps (time, cells, is the mesh new, seconds), seconds of each part, CPU s of all, MiB."""
    file, end, _ = SCENES[scene]
    with tempfile.TemporaryDirectory() as directory:
        line = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        line += [program, ROOT / file]
        for setting in (f"Output directory={directory}", f"Mesh/Surface level={level}",
                        f"End time={end}", "Output/Surface format=none", "Output/Mesh format=none",
                        "Checkpoint/Interval=0"):
            line += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(line, capture_output=True, text=True, cwd=ROOT)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"steps: {done.stderr.strip()}")
        steps = [(float(m[1]), int(m[2]), bool(m[3]), float(m[4]))
                 for m in map(STEP.search, done.stdout.splitlines()) if m]
        parts, memory = read_timing(directory)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return steps, parts, cpu, memory


def row(name, level, ranks, scene, runs):
    """Of repeated runs of one program."""
    steps, parts, cpu, memory = runs[0]
    n = len(steps)
    cells = sum(s[1] for s in steps) / n
    words = [name, f"{level}", f"{ranks}", f"{cells / 1e3:.0f}k"]
    for first, last in SCENES[scene][2].values():
        seconds = [s[3] for of_run in runs for s in of_run[0] if first < s[0] <= last + 1e-9]
        words.append(f"{median(seconds):.2f} ({min(seconds):.2f}, {max(seconds):.2f})")
    step = median(sum(s[3] for s in of_run[0]) / n for of_run in runs)
    words += [f"{step:.2f}", f"{1e6 * step * ranks / cells:.1f}"]
    words += [f"{parts.get(part, 0) / n:.2f}" for part in PARTS]
    set_up = parts["Total"] - sum(s[3] for s in steps)
    words += [f"{1e6 * set_up * ranks / steps[0][1]:.1f}", f"{sum(s[2] for s in steps)} of {n}",
              f"{cpu:.0f}", f"{memory}"]
    return "| " + " | ".join(words) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=["bowl"], choices=list(SCENES))
    parser.add_argument("--levels", nargs="+", type=int, default=[5, 6])
    parser.add_argument("--ranks", nargs="+", type=int, default=[1])
    parser.add_argument("--programs", nargs="+", default=[str(ROOT / "build/release/treacle")])
    parser.add_argument("--repeat", type=int, default=1)
    arguments = parser.parse_args()
    for scene in arguments.scenes:
        head = ["program", "level", "ranks", "cells", *(f"{w} s a step: median (min, max)"
                                                        for w in SCENES[scene][2]),
                "mean of all", "µs a cell", *PARTS, "set-up µs a cell", "new meshes", "CPU s", "MiB"]
        print(f"\n{scene}\n\n| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
        for level in arguments.levels:
            for ranks in arguments.ranks:
                runs = [[run(program, scene, level, ranks) for program in arguments.programs]
                        for _ in range(arguments.repeat)]
                for k, program in enumerate(arguments.programs):
                    print(row(Path(program).resolve().parents[2].name if len(arguments.programs) > 1
                              else "treacle", level, ranks, scene, [r[k] for r in runs]), flush=True)


if __name__ == "__main__":
    main()
