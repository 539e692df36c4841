# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""How a falling stream moves at some height: a rope coils, a sheet folds."""

import math
from typing import NamedTuple

import numpy

from treacle.errors import DataError


def cut(surface, height):
    """Where the plane z = height (m) cuts the triangles of a Surface: segments, as (x, y) of their ends (m, n x 2 each)."""
    corners = surface.points[surface.facets]
    above = corners[:, :, 2] >= height
    corners, above = (a[above.any(axis=1) != above.all(axis=1)] for a in (corners, above))
    ends = []
    for i in range(3):  # the corner alone on its side of the plane
        alone = (above[:, i] != above[:, i - 1]) & (above[:, i] != above[:, i - 2])
        a, b, c = (corners[alone][:, i - k] for k in range(3))
        ends.append([(a + ((height - a[:, 2]) / (other[:, 2] - a[:, 2]))[:, None] * (other - a))[:, :2]
                     for other in (b, c)])
    return tuple(numpy.concatenate(side) for side in zip(*ends))


def centre_of_cut(surface, height):
    """Of the curve in which the plane z = height (m) cuts a Surface: the mean (x, y) by length, in m, or None
    where there is no cut."""
    a, b = cut(surface, height)
    lengths = numpy.linalg.norm(b - a, axis=1)
    return lengths @ (a + b) / 2 / lengths.sum() if lengths.any() else None


def area_of_cut(surface, height):
    """Inside that curve (m^2), of which all can be seen from its centre; 0 where there is no cut."""
    centre = centre_of_cut(surface, height)
    if centre is None:
        return 0.
    a, b = (end - centre for end in cut(surface, height))
    return abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2


def track(run, height, start=0, end=math.inf):
    """Times (n,) in s of the frames between start and end that the plane z = height (m) cuts,
    and the centres (n, 2) of these cuts in m.

    Raises DataError if the run is not in three dimensions or n is less than 3."""
    if run.dim != 3:
        raise DataError("the run is not in three dimensions")
    times, centres = [], []
    for frame in run.frames:
        if start <= run.time(frame) <= end:
            centre = centre_of_cut(run.surface(frame), height)
            if centre is not None:
                times.append(run.time(frame))
                centres.append(centre)
    if len(times) < 3:
        raise DataError(f"fewer than 3 frames have a surface at z = {height} m")
    return numpy.array(times), numpy.array(centres)


class Coiling(NamedTuple):
    revolutions: float  # about the mean centre, counter-clockwise positive
    frequency: float    # 1/s, of revolutions
    radius: float       # m, the mean one


def coiling(times, centres):
    """The Coiling of centres (n, 2) at times (n,)."""
    arms = centres - centres.mean(axis=0)
    angles = numpy.unwrap(numpy.arctan2(arms[:, 1], arms[:, 0]))
    revolutions = (angles[-1] - angles[0]) / (2 * numpy.pi)
    return Coiling(revolutions, abs(revolutions) / (times[-1] - times[0]),
                   numpy.linalg.norm(arms, axis=1).mean())


class Folding(NamedTuple):
    n_reversals: int  # of x about its mean
    frequency: float  # 1/s, of folds to and fro
    amplitude: float  # m, the largest distance in x from the mean


def folding(times, centres):
    """The Folding of centres (n, 2) at times (n,), or None with fewer than 3 reversals."""
    x = centres[:, 0] - centres[:, 0].mean()
    before = numpy.flatnonzero(x[1:] * x[:-1] < 0)
    at = times[before] + (times[before + 1] - times[before]) * x[before] / (
        x[before] - x[before + 1])
    if len(at) < 3:
        return None
    period = 2 * (at[-1] - at[0]) / (len(at) - 1)
    return Folding(len(at), 1 / period, numpy.abs(x).max())


def plot(path, times, centres):
    """A picture of centres (n, 2) against times (n,), and from above."""
    from matplotlib.figure import Figure
    figure = Figure((10, 4))
    left, right = figure.subplots(1, 2)
    left.plot(times, centres - centres.mean(axis=0), marker=".")
    left.set(xlabel="t (s)", ylabel="from the mean centre (m)")
    left.legend(["x", "y"])
    right.plot(*centres.T, marker=".")
    right.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    figure.tight_layout()
    figure.savefig(path, dpi=120)
