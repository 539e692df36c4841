#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What a time step costs: seconds a step in flight and in contact, by part, what was done in it, and memory,
as tables in markdown. Several programs, as one of an older commit, are run in turn, for machines are noisy.

    benchmarks/steps.py [--scenes bowl armadillo] [--leaves 32 48 64 96] [--ranks 1 2] [--programs PATH ...]
                        [--repeat N] [--uniform] [--end TIME]

Leaves are those along the box's shortest edge, a power of two times 1, 3, 5, ...; --uniform: as fine everywhere,
to compare with. On one rank that nothing disturbs, seconds of wall time are those of the CPU. The Armadillo's
mesh is unpacked by scripts/run.
"""

import argparse
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import NamedTuple

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
STEP = re.compile(r"step +\d+  t (\S+) s .*? (\d+) cells( \(new\))?.* viscosity +(\d+) .* ([0-9.]+) s$")
WORK = ["points located", "facets tried", "products with matrices", "preconditionings", "MiB allocated"]


class Step(NamedTuple):
    """A line of the log."""

    time: float
    cells: int
    is_new: bool  # the mesh
    iterations: int
    seconds: float


def mesh_settings(leaves, uniform):
    """Settings of the mesh with so many finest leaves along the shortest edge."""
    level = (leaves & -leaves).bit_length() - 1
    levels = [level, level, level] if uniform else [level, level - 2, level - 3]
    return [f"Mesh/Root cells={leaves >> level}", f"Mesh/Surface level={level}",
            f"Mesh/Interior level={levels[1]}", f"Mesh/Air level={levels[2]}"]


def run(program, scene, leaves, ranks, arguments):
    """Steps, the timing, and CPU s of all."""
    file, end, _ = SCENES[scene]
    with tempfile.TemporaryDirectory() as directory:
        line = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        line += [program, ROOT / file]
        for setting in (*mesh_settings(leaves, arguments.uniform), f"Output directory={directory}",
                        f"End time={arguments.end or end}", "Output/Surface format=none",
                        "Output/Mesh format=none", "Checkpoint/Interval=0"):
            line += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(line, capture_output=True, text=True, cwd=ROOT)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"steps: {done.stderr.strip()}")
        steps = [Step(float(m[1]), int(m[2]), bool(m[3]), int(m[4]), float(m[5]))
                 for m in map(STEP.search, done.stdout.splitlines()) if m]
        timing = read_timing(directory)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return steps, timing, cpu


def median_of(values):
    """With the least and the largest."""
    return f"{median(values):.2f} ({min(values):.2f}, {max(values):.2f})" if values else "-"


def row(name, leaves, ranks, scene, runs):
    """Of repeated runs of one program."""
    steps, timing, cpu = runs[0]
    n = len(steps)
    cells = sum(s.cells for s in steps) / n
    words = [name, f"{leaves}", f"{ranks}", f"{cells / 1e3:.0f}k"]
    for first, last in SCENES[scene][2].values():
        words.append(median_of([s.seconds for r in runs for s in r[0] if first < s.time <= last + 1e-9]))
    step = median(sum(s.seconds for s in r[0]) / n for r in runs)
    words += [f"{step:.2f}", f"{1e6 * step * ranks / cells:.1f}"]
    words += [f"{timing.seconds.get(part, 0) / n:.2f}" for part in PARTS]
    rebuilt = sum(s.cells for s in steps if s.is_new)
    set_up = timing.seconds["Total"] - sum(s.seconds for s in steps)
    words += [f"{1e6 * set_up * ranks / steps[0].cells:.1f}", f"{sum(s.is_new for s in steps)} of {n}",
              f"{1e6 * timing.seconds['mesh'] * ranks / rebuilt:.1f}" if rebuilt else "-",
              f"{sum(s.iterations for s in steps) / n:.0f}"]
    words += [f"{timing.work[what] / n:.3g}" if timing.work else "-" for what in WORK]
    words += [f"{cpu:.0f}", f"{timing.memory}", f"{1024 * timing.memory / cells:.2f}"]
    return "| " + " | ".join(words) + " |"


def head_of(scene):
    """The names of the columns."""
    return ["program", "leaves", "ranks", "cells", *(f"{w} s a step: median (min, max)" for w in SCENES[scene][2]),
            "mean of all", "µs a cell", *PARTS, "set-up µs a cell", "new meshes", "µs a cell of a new mesh",
            "iterations", *WORK, "CPU s", "MiB", "KiB a cell"]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=["bowl"], choices=list(SCENES))
    parser.add_argument("--leaves", nargs="+", type=int, default=[32, 64])
    parser.add_argument("--ranks", nargs="+", type=int, default=[1])
    parser.add_argument("--programs", nargs="+", default=[str(ROOT / "build/release/treacle")])
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--uniform", action="store_true")
    parser.add_argument("--end", type=float, help="end time (s)")
    arguments = parser.parse_args()
    for scene in arguments.scenes:
        head = head_of(scene)
        print(f"\n{scene}\n\n| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
        for leaves in arguments.leaves:
            for ranks in arguments.ranks:
                runs = [[run(program, scene, leaves, ranks, arguments) for program in arguments.programs]
                        for _ in range(arguments.repeat)]
                for k, program in enumerate(arguments.programs):
                    print(row(Path(program).resolve().parents[2].name if len(arguments.programs) > 1
                              else "treacle", leaves, ranks, scene, [r[k] for r in runs]), flush=True)


if __name__ == "__main__":
    main()
