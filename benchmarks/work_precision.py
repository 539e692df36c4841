#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Error over cost: the drop in a bowl of prm/benchmarks/bowl.prm by mesh, step and coupling, as a table in
markdown and a picture.

    benchmarks/work_precision.py [--leaves 16 32 64] [--steps 0.01 0.005] [--couplings coupled ...]
                                 [--others FILE] [--picture FILE]

Errors: how far the centre of mass has fallen at t = 0.05 and 0.1 s, where it falls freely (exact), and
its height, the top and the half width along x at 0.3 s against the first coupling's finest mesh and
shortest step. Seconds are those of the steps until 0.3 s on one core, without set-up. --others: figures of
another program to set beside these, lines of `name;leaves;step;seconds;fall at 0.05 s;fall at 0.1 s;centre;
top;half width` (m), whose errors in the last three are against its own last line.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from steps import mesh_settings  # noqa: E402
from treacle import read_statistics  # noqa: E402

GRAVITY = 9.81
QUANTITIES = ["fall, 0.05 s", "fall, 0.1 s", "centre, 0.3 s", "top, 0.3 s", "half width, 0.3 s"]


class Point(NamedTuple):
    """A run: what it cost, and what came out (m), in the order of QUANTITIES."""

    name: str
    leaves: int
    step: float
    seconds: float
    values: tuple


def measure(program, leaves, step, coupling):
    with tempfile.TemporaryDirectory() as directory:
        line = [program, ROOT / "prm/benchmarks/bowl.prm"]
        for setting in (*mesh_settings(leaves, uniform=False), f"Maximum time step={step}", "Frame interval=0.05",
                        f"Viscosity/Pressure coupling={coupling}", f"Output directory={directory}"):
            line += ["--set", setting]
        done = subprocess.run(line, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"work_precision: {done.stderr.strip()}")
        table = read_statistics(directory)
    times = [round(t, 9) for t in table["Time (s)"]]
    z = table["Centre of mass z (m)"]
    falls = [z[0] - z[times.index(t)] for t in (0.05, 0.1)]
    return Point(coupling, leaves, step, float(sum(table["Wall time (s)"])),
                 (*falls, z[-1], table["Liquid maximum z (m)"][-1], table["Liquid maximum x (m)"][-1] - 0.5))


def read_others(path):
    points = []
    for line in Path(path).read_text().splitlines():
        name, leaves, step, seconds, *values = line.split(";")
        points.append(Point(name, int(leaves), float(step), float(seconds), tuple(map(float, values))))
    return points


def errors(point, finest):
    """Relative ones of the falls, and of lengths in parts of the drop's radius (%)."""
    exact = [0.5 * GRAVITY * t * t for t in (0.05, 0.1)]
    result = [100 * (value / fall - 1) for value, fall in zip(point.values, exact)]
    return result + [100 * (a - b) / 0.2 for a, b in zip(point.values[2:], finest.values[2:])]


def draw(groups, path):
    """`groups`: points and the finest one by name."""
    figure = Figure(figsize=(9, 4), layout="constrained")
    for axes, k in zip(figure.subplots(1, 2, sharey=True), (1, 2)):
        for name, (points, finest) in groups.items():
            shown = [(p.seconds, abs(errors(p, finest)[k])) for p in points if errors(p, finest)[k] != 0]
            axes.loglog(*zip(*sorted(shown)), "o", label=name)
            for p in points:
                if errors(p, finest)[k] != 0:
                    axes.annotate(f" {p.leaves}, {1e3 * p.step:g} ms",
                                  (p.seconds, abs(errors(p, finest)[k])), fontsize=7)
        axes.set(xlabel="CPU s to 0.3 s", title=QUANTITIES[k])
        axes.grid(alpha=0.3)
    figure.axes[0].set_ylabel("error (%)")
    figure.axes[0].legend()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--leaves", nargs="+", type=int, default=[16, 32, 64])
    parser.add_argument("--steps", nargs="+", type=float, default=[0.01, 0.005])
    parser.add_argument("--couplings", nargs="+", default=["coupled"])
    parser.add_argument("--program", default=str(ROOT / "build/release/treacle"))
    parser.add_argument("--others")
    parser.add_argument("--picture")
    arguments = parser.parse_args()
    head = ["", "leaves", "step (s)", "CPU s", *(f"{name} (%)" for name in QUANTITIES)]
    points = [measure(arguments.program, leaves, step, coupling) for coupling in arguments.couplings
              for leaves in arguments.leaves for step in arguments.steps]
    finest = min((p for p in points if p.name == points[0].name), key=lambda p: (-p.leaves, p.step))
    groups = {name: ([p for p in points if p.name == name], finest) for name in arguments.couplings}
    for p in read_others(arguments.others) if arguments.others else []:
        groups.setdefault(p.name, ([], None))[0].append(p)
        groups[p.name] = (groups[p.name][0], p)
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for members, reference in groups.values():
        for p in members:
            cells = [p.name, p.leaves, f"{p.step:g}", f"{p.seconds:.3g}",
                     *(f"{e:+.3g}" for e in errors(p, reference))]
            print("| " + " | ".join(map(str, cells)) + " |")
    if arguments.picture:
        draw(groups, arguments.picture)


if __name__ == "__main__":
    main()
