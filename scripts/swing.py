#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors

"""Follow the centre of a falling stream at some height: how a rope coils and a
sheet folds.

usage: swing.py DIRECTORY HEIGHT [--from TIME] [--plot FILE.png]

Prints time and centre of each frame's cut (the mean over the surface's edges
that cross the height, by length), then what coiling and folding theory speak of:
revolutions about the mean centre, their frequency and mean radius, and reversals
of x with their frequency. HEIGHT in m; --from leaves out what came before."""

import argparse
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle import DataError, Run


def cut_centre(points, triangles, height):
    """Centre (x, y) of the curve where triangles (n, 3) cross z = height, or None."""
    above = points[triangles, 2] > height
    triangles = triangles[above.any(axis=1) & ~above.all(axis=1)]
    if len(triangles) == 0:
        return None
    ends = []
    corners = points[triangles]
    z = corners[:, :, 2] - height
    for i, j in (0, 1), (1, 2), (2, 0):
        crosses = (z[:, i] > 0) != (z[:, j] > 0)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = (z[:, i] / (z[:, i] - z[:, j]))[:, None]
        ends.append(numpy.where(crosses[:, None],
                                corners[:, i] + t * (corners[:, j] - corners[:, i]), 0))
    # each triangle has two ends and a third of zeros
    middle = sum(ends)[:, :2] / 2
    first = numpy.where((z[:, 0] > 0)[:, None] != (z[:, 1] > 0)[:, None], ends[0], ends[1])
    length = 2 * numpy.linalg.norm(middle - first[:, :2], axis=1)
    return (middle * length[:, None]).sum(axis=0) / length.sum()


def track(run, height, start):
    """Times and centres, shapes (n,) and (n, 2)."""
    times, centres = [], []
    if run.dim != 3:
        raise DataError("the run is not in three dimensions")
    for frame in run.frames:
        if run.time(frame) < start:
            continue
        surface = run.surface(frame)
        centre = cut_centre(surface.points, surface.facets, height)
        if centre is not None:
            times.append(run.time(frame))
            centres.append(centre)
    if len(times) < 3:
        raise DataError(f"fewer than 3 frames have a surface at z = {height} m")
    return numpy.array(times), numpy.array(centres)


def report(times, centres):
    arm = centres - centres.mean(axis=0)
    angle = numpy.unwrap(numpy.arctan2(arm[:, 1], arm[:, 0]))
    duration = times[-1] - times[0]
    turns = (angle[-1] - angle[0]) / (2 * numpy.pi)
    print(f"revolutions {turns:.2f} in {duration:.3f} s: frequency {abs(turns) / duration:.3f} 1/s, "
          f"angular {2 * numpy.pi * abs(turns) / duration:.2f} rad/s, "
          f"mean radius {numpy.linalg.norm(arm, axis=1).mean():.4g} m")
    x = arm[:, 0]
    crossings = numpy.flatnonzero(x[1:] * x[:-1] < 0)
    at = times[crossings] + (times[crossings + 1] - times[crossings]) * x[crossings] / (
        x[crossings] - x[crossings + 1])
    if len(at) > 2:
        period = 2 * (at[-1] - at[0]) / (len(at) - 1)
        print(f"reversals of x {len(at)}: folding frequency {1 / period:.3f} 1/s, "
              f"mean amplitude {numpy.abs(x).max():.4g} m")
    print(f"mean centre {centres[:, 0].mean():.4g}, {centres[:, 1].mean():.4g} m")


def plot(file, times, centres):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4))
    left.plot(times, centres - centres.mean(axis=0), marker=".")
    left.set(xlabel="t (s)", ylabel="from the mean centre (m)")
    left.legend(["x", "y"])
    right.plot(*centres.T, marker=".")
    right.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    figure.tight_layout()
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("height", type=float)
    parser.add_argument("--from", dest="start", type=float, default=0)
    parser.add_argument("--plot")
    options = parser.parse_args()
    times, centres = track(Run(options.directory), options.height, options.start)
    for t, (x, y) in zip(times, centres):
        print(f"{t:10.4f} {x:12.6f} {y:12.6f}")
    report(times, centres)
    if options.plot:
        plot(options.plot, times, centres)


if __name__ == "__main__":
    try:
        main()
    except DataError as error:
        sys.exit(f"swing: {error}")
