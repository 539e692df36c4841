#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Compares runs: a table of the liquid's height and width over time, and a plot of both;
for runs in two dimensions also their final outlines over one another.

    scripts/compare.py OUT.png LABEL=DIRECTORY ...
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.outline import liquid_loops
from outlines import parse
from render_2d import draw_box
from treacle import DataError, Run
from treacle.statistics import read_statistics

N_TIMES = 7  # of the table


class Extent:
    """Height and width (m) over time (s), from the run's statistics."""

    def __init__(self, directory, dim):
        try:
            table = read_statistics(directory)
            up = "xyz"[dim - 1]
            self.time = table["Time (s)"]
            self.height = table[f"Liquid maximum {up} (m)"]
            self.width = table["Liquid maximum x (m)"] - table["Liquid minimum x (m)"]
        except FileNotFoundError:
            raise DataError(f"there is no '{directory}/statistics'")
        except KeyError as column:
            raise DataError(f"'{directory}/statistics' has no column {column}")
        if len(self.time) == 0:
            raise DataError(f"'{directory}/statistics' has no rows")

    def at(self, times, values):
        """Interpolated; nan after the end of the run."""
        return numpy.interp(times, self.time, values, right=numpy.nan)


def print_table(extents):
    times = numpy.linspace(0, max(e.time[-1] for e in extents.values()), N_TIMES)
    for name in "height", "width":
        print(f"\n| {name} (m) | " + " | ".join(f"t = {t:.2f} s" for t in times) + " |")
        print("|---" * (N_TIMES + 1) + "|")
        for label, extent in extents.items():
            values = extent.at(times, getattr(extent, name))
            print(f"| {label} | " + " | ".join(f"{v:.4f}" for v in values) + " |")


def draw_outline(axes, run, colour, label):
    surface = run.surface(run.frames[-1])
    loops = liquid_loops(surface.points[:, :2], surface.facets, run.lower, run.upper)
    for k, loop in enumerate(loops):
        axes.plot(*numpy.vstack([loop, loop[:1]]).T, color=colour, linewidth=1.4,
                  label=None if k else label)


def compare(path, arguments):
    runs, extents = {}, {}
    for argument in arguments:
        label, directory, _ = parse(argument)
        runs[label] = Run(directory)
        extents[label] = Extent(directory, runs[label].dim)
    print_table(extents)

    is_flat = all(run.dim == 2 for run in runs.values())
    figure, axes = plt.subplots(1, 3 if is_flat else 2, dpi=110, layout="constrained",
                                figsize=(14 if is_flat else 9, 4))
    for k, (label, extent) in enumerate(extents.items()):
        axes[-2].plot(extent.time, extent.height, color=f"C{k}", linewidth=1.4, label=label)
        axes[-1].plot(extent.time, extent.width, color=f"C{k}", linewidth=1.4, label=label)
        if is_flat:
            draw_outline(axes[0], runs[label], f"C{k}", label)
    if is_flat:
        draw_box(axes[0], next(iter(runs.values())))
        axes[0].set(xlabel="x (m)", ylabel="y (m)", title="at the end")
        axes[0].set_ylim(top=axes[0].get_ylim()[0] + 0.6 * numpy.ptp(axes[0].get_xlim()))
    axes[-2].set(xlabel="time (s)", ylabel="height (m)")
    axes[-1].set(xlabel="time (s)", ylabel="width (m)")
    axes[-1].legend(frameon=False)
    for plot in axes:
        plot.grid(alpha=0.3)
        for side in "top", "right":
            plot.spines[side].set_visible(False)
    figure.savefig(path)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        compare(sys.argv[1], sys.argv[2:])
    except DataError as error:
        sys.exit(f"compare: {error}")
