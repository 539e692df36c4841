#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Draws the outlines of several two-dimensional runs over one another, and the
liquid's height against time; prints height, width and area.

    scripts/outlines.py OUT.png LABEL=DIRECTORY[:FRAME] ...     (default: the last frame)
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.outline import area, liquid_loops
from render_2d import draw_box
from treacle import DataError, Run
from treacle.statistics import read_statistics

TIME, HEIGHT = "Time (s)", "Liquid maximum y (m)"


def draw(path, arguments):
    figure, (left, right) = plt.subplots(1, 2, figsize=(13, 5), dpi=120, layout="constrained",
                                         gridspec_kw={"width_ratios": [3, 2]})
    print(f"{'run':<24} {'time s':>10} {'height m':>10} {'width m':>10} {'area m^2':>10}")
    for k, argument in enumerate(arguments):
        label, directory, frame = parse(argument)
        run = Run(directory)
        if run.dim != 2:
            raise DataError(f"'{directory}' is a run in {run.dim} dimensions, not 2")
        if k == 0:
            draw_box(left, run)
        frame = run.frames[-1] if frame is None else frame
        surface, colour = run.surface(frame), f"C{k}"
        points = surface.points[:, :2]
        loops = liquid_loops(points, surface.facets, run.lower, run.upper)
        for n, loop in enumerate(loops):
            loop = numpy.vstack([loop, loop[:1]])
            left.plot(*loop.T, color=colour, linewidth=1.6, label=None if n else label)
        cloud = numpy.concatenate(loops) if loops else numpy.zeros((1, 2))
        width, height = cloud.max(axis=0) - cloud.min(axis=0)
        print(f"{label:<24} {run.time(frame):10.4f} {height:10.5f} {width:10.5f} "
              f"{sum(map(area, loops)):10.6f}")
        draw_height(right, directory, label, colour)
    left.set(xlabel="x (m)", ylabel="y (m)")
    left.legend(frameon=False, ncol=4, loc="lower right", bbox_to_anchor=(1, 1))
    right.set(xlabel="time (s)", ylabel="liquid height (m)")
    right.grid(alpha=0.3)
    for side in "top", "right":
        right.spines[side].set_visible(False)
    figure.savefig(path)


def draw_height(axes, directory, label, colour):
    try:
        table = read_statistics(directory)
        axes.plot(table[TIME], table[HEIGHT], color=colour, linewidth=1.6, label=label)
    except FileNotFoundError:
        print(f"outlines: there is no '{directory}/statistics'", file=sys.stderr)
    except KeyError as column:
        print(f"outlines: '{directory}/statistics' has no column {column}", file=sys.stderr)


def parse(argument):
    label, _, place = argument.partition("=")
    directory, colon, frame = place.rpartition(":")
    if not label or not place or (colon and not frame.isdigit()):
        raise DataError(f"'{argument}' is not LABEL=DIRECTORY[:FRAME]")
    return (label, directory, int(frame)) if colon else (label, place, None)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        draw(sys.argv[1], sys.argv[2:])
    except DataError as error:
        sys.exit(f"outlines: {error}")
