# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What the exact cases measure: numbers from the statistics and the surfaces of a run."""

import math

import numpy

from treacle import Run
from treacle.stream import area_of_cut, centre_of_cut

TIME = "Time (s)"
# of solids
MOTIONS = {"Displacement", "Rotation", "Velocity", "Angular velocity"}


class Results:
    """A run that has ended: columns of its statistics by name, and its surfaces."""

    def __init__(self, directory):
        self.run = Run(directory)

    def __getitem__(self, column):
        return self.run.statistics[column]

    def surface(self, time):
        """Of the frame of this time."""
        interval = float(self.run.get("Frame interval"))
        frame = round(time / interval)
        if abs(frame * interval - time) > 1e-9:
            raise ValueError(f"there is no frame at t = {time}")
        return self.run.surface(frame)

    def points(self, time):
        """The vertices (n x 2) of the surface in the frame of this time, by x."""
        points = self.surface(time).points[:, :2]
        return points[numpy.argsort(points[:, 0], kind="stable")]

    def energy(self):
        """By the velocity of nodes, which moves the liquid."""
        return self["Nodal kinetic energy (J)"] + self["Potential energy (J)"]

    def energy_gain(self):
        """The largest rise of the total energy above what it was before, over the
        largest kinetic energy plus the range of the potential one; 0 where the surface
        is kept, for then gravity goes on working, where an emitter or a solid that moves works, and where nothing moves."""
        emitted = (numpy.any(values) for name, values in self.run.statistics.items()
                   if "Emitted" in name)
        moved = (value.strip("0; ") for name, value in self.run.parameters.items()
                 if name.startswith("Solid ") and name.rpartition("/")[2] in MOTIONS)
        if self.run.parameters.get("Steps/Surface") == "false" or any(emitted) or any(moved):
            return 0.
        energy, potential = self.energy(), self["Potential energy (J)"]
        rise = numpy.max(energy - numpy.minimum.accumulate(energy))
        scale = numpy.max(self["Nodal kinetic energy (J)"]) + numpy.ptp(potential)
        return rise / scale if scale > 1e-10 * numpy.max(abs(energy)) else 0.

    def leaf_size(self, level):
        """The edge (m) of a leaf."""
        edge = numpy.min(self.run.upper - self.run.lower)
        return edge / (int(self.run.get("Mesh/Root cells")) * 2 ** level)

    def fallbacks(self):
        """Coupled solves that were taken by the split."""
        return int(numpy.sum(self["Fallbacks"]))

    def volume_drift(self):
        """Where it is largest in size."""
        drift = self["Volume drift"]
        return drift[numpy.argmax(abs(drift))]


def at(column, time, factor=1):
    """The value of a column at a time at which a step ends, times a factor."""
    def value(results):
        k = int(numpy.argmin(abs(results[TIME] - time)))
        if abs(results[TIME][k] - time) > 1e-9:
            raise ValueError(f"no step ends at t = {time}")
        return results[column][k] * factor
    return value


def last(column):
    """The last value of a column."""
    return lambda results: results[column][-1]


def interpolated(column, time, factor=1):
    """The value of a column at any time, times a factor."""
    return lambda results: numpy.interp(time, results[TIME], results[column]) * factor


def rate(column, power=1, start=-math.inf):
    """The decay rate of what is the power-th power of an amplitude: the slope of a line
    through the logarithms after start."""
    def value(results):
        late = results[TIME] > start
        return -numpy.polyfit(results[TIME][late], numpy.log(results[column][late]), 1)[0] / power
    return value


def amplitude(points, k):
    """Of cos(k x) in the height of a surface that spans half waves."""
    x, y = points.T
    mean = numpy.trapz(y, x) / numpy.ptp(x)
    return 2 * numpy.trapz((y - mean) * numpy.cos(k * x), x) / numpy.ptp(x)


def amplitudes(results, k, start=0, end=math.inf):
    """Times and amplitudes of the frames between start and end."""
    interval = float(results.run.get("Frame interval"))
    times = numpy.array([frame * interval for frame in results.run.frames])
    times = times[(times >= start - 1e-9) & (times <= end + 1e-9)]
    return times, numpy.array([amplitude(results.points(t), k) for t in times])


def decay_rate(times, a):
    """The slope of a line through the logarithms of amplitudes."""
    return -numpy.polyfit(times, numpy.log(abs(a)), 1)[0]


def surface_rate(k, start=0, end=math.inf):
    """The decay rate of the mode cos(k x) of the surface."""
    return lambda results: decay_rate(*amplitudes(results, k, start, end))


def decay_and_frequency(times, a, lag=0.6):
    """Of a wave's amplitudes: a real pair of roots fits a(t + d) + p a(t) + q a(t - d) = 0 best, for a
    d that resolves the wave, as long as the lag (s)."""
    d = max(1, round(lag / (times[1] - times[0])))
    known = numpy.stack([a[d:-d], a[:-2 * d]], axis=1)
    p, q = numpy.linalg.lstsq(known, -a[2 * d:], rcond=None)[0]
    root = numpy.log(numpy.roots([1, p, q]).astype(complex)[0]) / (d * (times[1] - times[0]))
    return -root.real, abs(root.imag)


def wave(k, start=0, end=math.inf):
    """Decay rate and angular frequency of the mode cos(k x)."""
    def fit(results):
        return decay_and_frequency(*amplitudes(results, k, start, end))
    return lambda results: fit(results)[0], lambda results: fit(results)[1]


def swinging(column, middle):
    """Decay rate and angular frequency of what swings about a middle, in steps of one size."""
    def fit(results):
        times = numpy.linspace(0, results[TIME][-1], len(results[TIME]))
        return decay_and_frequency(times, numpy.interp(times, results[TIME], results[column]) - middle, 0.3)
    return lambda results: fit(results)[0], lambda results: fit(results)[1]


def height(time, x=0):
    """Of the surface at x: the highest crossing."""
    def value(results):
        surface = results.surface(time)
        a, b = (surface.points[surface.facets[:, i], :2] for i in (0, 1))
        tolerance = 1e-6
        crossed = (numpy.minimum(a[:, 0], b[:, 0]) <= x + tolerance) & (
            numpy.maximum(a[:, 0], b[:, 0]) >= x - tolerance)
        a, b = a[crossed], b[crossed]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            s = numpy.where(a[:, 0] == b[:, 0], 0, (x - a[:, 0]) / (b[:, 0] - a[:, 0]))
        return numpy.max(a[:, 1] + numpy.clip(s, 0, 1) * (b[:, 1] - a[:, 1]))
    return value


def thread_radius(time, z):
    """Of what a plane cuts, if it were round."""
    return lambda results: math.sqrt(area_of_cut(results.surface(time), z) / math.pi)


def front(time, y=0):
    """The largest x of the surface at this height."""
    def value(results):
        points = results.points(time)
        return numpy.max(points[abs(points[:, 1] - y) < 1e-6, 0])
    return value


def turning(axis, z, start, end=math.inf):
    """The angular frequency at which the rope that passes the height z goes round a vertical axis."""
    def value(results):
        run = results.run
        frames = [frame for frame in run.frames if start - 1e-9 <= run.time(frame) <= end + 1e-9]
        centres = [centre_of_cut(run.surface(frame), z) for frame in frames]
        if any(centre is None for centre in centres):
            raise ValueError(f"the rope does not always pass z = {z}")
        arms = numpy.array(centres) - axis
        angles = numpy.unwrap(numpy.arctan2(arms[:, 1], arms[:, 0]))
        times = [run.time(frame) for frame in frames]
        return abs(numpy.polyfit(times, angles, 1)[0])
    return value


def coil_radius(rope, time):
    """From the axis of the coil to that of the rope: half the mean extent of the liquid less the rope's radius."""
    def value(results):
        extents = [interpolated(f"Liquid maximum {axis} (m)", time)(results) -
                   interpolated(f"Liquid minimum {axis} (m)", time)(results) for axis in "xy"]
        return numpy.mean(extents) / 2 - rope
    return value
