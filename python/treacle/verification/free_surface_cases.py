# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The cases with a free surface (section C), for scripts/verify. Where nothing else is said the
error on the finest mesh is held to 3 %."""

from math import cos, exp, pi, sin, sqrt

import numpy

from treacle.verification.cases import EULER, FIRST_PROJECTION, SPLIT, Case, Program
from treacle.verification.measures import (at, coil_radius, decay_and_frequency, decay_rate, front, height,
                                           interpolated, last, surface_rate, swinging, thread_radius, turning, wave)
from treacle.verification.small_waves import wave_from_rest
from treacle.verification.thread import thread_speed

RIGHT = "Liquid maximum x (m)"
SHALLOW = {"Domain/Upper corner": "1, 1", "Mesh/Root cells": "2",
           "Liquid 1/Expression": "y - 0.5 - 0.005 * cos(pi * x)"}
SHORT = {"Domain/Upper corner": "0.5, 1", "Mesh/Root cells": "1", "Material/Viscosity": "0.1",
         "Liquid 1/Expression": "y - 0.5 - 0.005 * cos(2 * pi * x)", "End time": "2",
         "Frame interval": "0.1"}
STILL = {"Mesh/Interior level": 2, "Mesh/Air level": 2}
GRADED = {"Mesh/Interior level": 3, "Mesh/Air level": 2}
COARSE_AIR = {"Mesh/Air level": 0}
ROPE = {"Mesh/Interior level": 3, "Mesh/Air level": 1}
THIN = {"Material/Viscosity": "0.005", "End time": "8"}
LAYERS = {"Material/Viscosity": "if(y < 0.53, 1e6, 1e4)", "End time": "4e4", "Frame interval": "2e3"}


def exact_amplitudes(k, depth, nu, start, end, interval):
    """Times of frames and the amplitudes then."""
    times = start + interval * numpy.arange(round((end - start) / interval) + 1)
    return times, wave_from_rest(k, depth, nu, times)


def relaxing(k, depth, nu, start, end, interval):
    """What is measured in these frames, and the same of the exact amplitudes."""
    return {"rate": (surface_rate(k, start, end), decay_rate(*exact_amplitudes(k, depth, nu, start, end, interval)))}


def waving(nu, start, end):
    exact = decay_and_frequency(*exact_amplitudes(pi, 1, nu, start, end, 0.1))
    return dict(zip(("rate", "frequency"), zip(wave(pi, start, end), exact)))


def sloshing(eigenvalue):
    """Of liquid without viscosity in a half full circle or ball of radius 0.4."""
    exact = sqrt(eigenvalue * 9.81 / 0.4)
    decay, frequency = swinging("Centre of mass x (m)", 0.5)
    return {"frequency": (frequency, exact),
            "amplitude after a period": (lambda results: exp(-2 * pi / exact * decay(results)), 1)}


def kept(column):
    """The last value over the first."""
    return lambda results: results[column][-1] / results[column][0]


def change(column):
    return lambda results: results[column][-1] - results[column][0]


def half_axis(column, time):
    """Half of an extent of the liquid."""
    low, high = (interpolated(f"Liquid {which} {column} (m)", time) for which in ("minimum", "maximum"))
    return lambda results: (high(results) - low(results)) / 2


def turned_drop(degrees):
    """C5 turned against the mesh, longer: its extents and energy."""
    angle = pi * degrees / 180
    exact = {"kinetic energy": (kept("Nodal kinetic energy (J)"), 1)}
    for t, minor, major in ((1, 0.439460768, 2.27551598), (2, 0.271814077, 3.67898532)):
        exact[f"x, t = {t}"] = half_axis("x", t), sqrt((minor * cos(angle)) ** 2 + (major * sin(angle)) ** 2)
        exact[f"y, t = {t}"] = half_axis("y", t), sqrt((minor * sin(angle)) ** 2 + (major * cos(angle)) ** 2)
    along, across = cos(2 * angle), sin(2 * angle)
    settings = {"Domain/Lower corner": "-4, -4", "Domain/Upper corner": "4, 4", "Mesh/Root cells": "8",
                "Mesh/Air level": "1", "End time": "2",
                "Liquid 1/Velocity": f"-({along}*x + {across}*y); {along}*y - {across}*x"}
    return case("stretched_drop", 2, 0.04, exact, settings, in_time=({},))


def widths(data):
    """Of half a drop: its other half is behind the mirror plane."""
    return {f"width, t = {t}": (interpolated(RIGHT, t, 2), exact) for t, exact in data}


def flux(results):
    """Boole's rule."""
    u = [0] + [results[f"Probe {k} velocity x (m/s)"][-1] for k in (1, 2, 3, 4)]
    return numpy.dot([7, 32, 12, 32, 7], u) / 90


AXES = [(0.08, 0.923272807, 1.08310349), (0.38, 0.694821252, 1.43921907),
        (0.76, 0.514266474, 1.94451719), (1, 0.439460768, 2.27551598)]
# by doc/verification/drop_impact.py
IMPACT_3D = [(1.5, 1.0689), (1.8, 1.3023), (2, 1.3451), (2.5, 1.3727), (3, 1.3879)]
IMPACT = [(1.5, 1.1738), (1.8, 1.5163), (2, 1.6026), (2.5, 1.6806), (3, 1.7138)]
DAM = [(0.41, 1.11), (0.84, 1.23), (1.19, 1.44), (1.63, 1.89), (1.97, 2.33), (2.5, 3), (2.96, 3.67)]
SLIP = [(1, 0.89888, 1.16232), (2, 0.79707, 1.34746), (5, 0.60635, 1.83486)]
HELD = [(1, 1.0887, 0.9432), (3, 1.2761, 0.8423), (5, 1.4354, 0.7730), (10, 1.7327, 0.6716),
        (15, 1.9406, 0.6143)]

FALL, FALL_3D = ({"fall": (change(f"Centre of mass {axis} (m)"), -9.81 * 0.1 ** 2 / 2)}
                 for axis in "yz")
KEPT, KEPT_3D = ({"angular momentum": (kept(f"Angular momentum {axis}(kg m^2/s)"), 1),
                  "kinetic energy": (kept("Kinetic energy (J)"), 1)} for axis in ("", "z "))
FLIGHT = {"front": (last(RIGHT), 2.2), "kinetic energy": (kept("Kinetic energy (J)"), 1)}
AT_REST = {"speed at the end (m/s)": (last("Maximum speed (m/s)"), 0)}
WAVE, THIN_WAVE = waving(0.05, 1, 6), waving(0.005, 1, 8)
DROP = {f"{name}, t = {t}": (half_axis(axis, t), exact[i]) for t, *exact in AXES
        for i, (name, axis) in enumerate((("minor", "x"), ("major", "y")))}
PULL = {"force": (last("Walls force y (N)"), 4 * 10 * 0.6 * exp(-0.08))}
PULL_3D = {"force": (last("Walls force z (N)"), 3 * 10 * pi * 0.3 ** 2 * exp(-0.08))}
COLUMN, COLUMN_3D = ({f"h, T = {t / 40}": (at(f"Liquid maximum {axis} (m)", t), exact)
                      for t, exact in ((20, 0.810930216), (40, 0.693147181), (80, 0.549306144))}
                     for axis in "yz")
COIL = {"frequency": (turning((0.402, 0.399), 0.6, 2, 3.1), 4),
        "radius": (coil_radius(0.05, 3.1), 0.25)}
FILM = {"u at the surface": (last("Probe 4 velocity x (m/s)"), 0.5), "flux": (flux, 1 / 3)}
CURRENT = {"front, T = 30": (at(RIGHT, 270), 2.7909), "h(0)": (height(270), 0.4258)}
SLUMP_SLIP = {f"{name}, t = {t}": (measure(t), exact[i]) for t, *exact in SLIP
              for i, (name, measure) in enumerate((("h(0)", height), ("front", front)))}
SLUMP = {f"{name}, t = {t}": (measure, exact) for t, x, h in HELD
         for name, measure, exact in (("x", at(RIGHT, t), x), ("h(0)", height(t), h))}
DAM_FRONT = {f"front, t sqrt(2 g / a) = {t}": (interpolated(RIGHT, t / sqrt(2)), exact)
             for t, exact in DAM}
BUCKET = {"angular momentum": KEPT_3D["angular momentum"],
          "kinetic energy": (kept("Nodal kinetic energy (J)"), 1),
          "top": (last("Liquid maximum z (m)"), 0.45 + 16 / 19.62 * 0.08)}
BELOW = numpy.array([0.1, 0.2, 0.3, 0.4])  # the nozzle
THREAD = {f"radius, {z} below": (thread_radius(0.5, 0.92 - z), 0.04 / sqrt(speed))
          for z, speed in zip(BELOW, thread_speed(BELOW, 1, 0.9, 0.05))}
SWELL = {"width": (height(1.2, 1), 1.19 * 0.125)}
TWIST = {"torque": (last("Solid 1 torque x (N m)"), pi * 1e4 * 0.01 * 0.125 ** 4 / (2 * 0.394))}
CARRIED = {"volume": 0.005, "shape": 0.03}


def case(file, level, time_step, exact, settings=None, tolerance=0.03, **more):
    return Case(file, level, time_step, exact, settings or {}, tolerance, **more)


def carried(body, dim, level, n_levels):
    """One period with a prescribed velocity and a CFL number of 2; no correction of the volume."""
    return Program("surface/markers", (body, str(dim), "{level}", "2", "marker level set"), level,
                   CARRIED, n_levels=n_levels)


FREE_SURFACE_CASES = {
    "C1 flat": case("still_flat", 4, 0.01, AT_REST, STILL, 1e-8, order=None, n_levels=2),
    "C1 tilted": case("still_tilted", 4, 0.01, AT_REST, STILL, 1e-8, order=None, n_levels=2),
    "C2 fall": case("free_fall_2d", 4, 0.02, FALL, in_time=({},)),
    "C2 fall 3D": case("free_fall", 4, 0.02, FALL_3D, GRADED, n_levels=2),
    "C2 flight": case("flight_2d", 4, 0.1875, FLIGHT, order=None),
    "C2 rotation": case("rigid_rotation_2d", 4, 0.02, KEPT, in_time=({},)),
    "C2 rotation 3D": case("rigid_rotation", 4, 0.02, KEPT_3D, GRADED, n_levels=2),
    "C3 k pi, h 1, nu 1": case("relaxation", 2, 0.1, relaxing(pi, 1, 1, 1, 4, 0.2), in_time=({},)),
    "C3 k pi, h 0.5, nu 1": case("relaxation", 2, 0.1, relaxing(pi, 0.5, 1, 1, 4, 0.2), SHALLOW,
                                 in_time=({}, EULER)),
    "C3 k 2 pi, h 0.5, nu 0.1": case("relaxation", 2, 0.05, relaxing(2 * pi, 0.5, 0.1, 0.5, 2, 0.1), SHORT,
                                     in_time=({},)),
    "C3 layers": case("relaxation", 3, 2000, {"rate": (surface_rate(pi, 4000), 0.0711855776e-4)}, LAYERS),
    "C4 nu 0.05": case("wave", 2, 0.1, WAVE, in_time=({}, EULER)),
    "C4 nu 0.005": case("wave", 2, 0.1, THIN_WAVE, THIN, in_time=({},)),
    "C5": case("stretched_drop", 2, 0.04, DROP, in_time=({},)),
    **{f"C5 turned by {degrees}": turned_drop(degrees) for degrees in (0, 15, 30, 45)},
    "C6": case("stretching_2d", 4, 0.02, PULL, in_time=({}, FIRST_PROJECTION, SPLIT)),
    "C6 3D": case("stretching_3d", 3, 0.02, PULL_3D, n_levels=2),
    "C7": case("sagging_column", 3, 1, COLUMN, in_time=({},)),
    "C7 3D": case("sagging_column_3d", 3, 1, COLUMN_3D, n_levels=2),
    "C8": case("film", 1, 0.1, FILM),
    "C9": case("gravity_current", 1, 2, CURRENT, tolerance=0.05),  # lubrication: thin, not that thin
    "C9b": case("slump_slip", 1, 0.2, SLUMP_SLIP, in_time=({},)),
    "C9c": case("slump", 1, 0.2, SLUMP),
    "C9d": case("drop_impact", 2, 0.04, widths(IMPACT), tolerance=0.01),
    "C9d 3D": case("drop_impact_3d", 2, 0.04, widths(IMPACT_3D), COARSE_AIR, 0.01, order=None, n_levels=2),
    "C9e": case("dam_break", 2, 0.04, DAM_FRONT, tolerance=0.1),  # as the measurement
    "C11": case("coil_viscous", 4, 0.04, COIL, ROPE, 0.15, order=None, n_levels=1),
    "C13": case("bucket", 4, 0.02, BUCKET, GRADED, n_levels=2),
    "C14": case("falling_thread", 4, 0.02, THREAD, GRADED, order=None, n_levels=2),
    "C15": case("sloshing", 4, 0.04, sloshing(1.355728), {"Mesh/Air level": 3}),
    "C15 3D": case("sloshing_3d", 4, 0.04, sloshing(1.560158), GRADED, n_levels=2),
    "C16": case("die_swell", 3, 0.02, SWELL),
    "C17": case("torsion", 4, 0.01, TWIST),
    "C10 notched disc": carried("notched", 2, 5, 3),
    "C10 disc in a vortex": carried("vortex", 2, 5, 3),
    "C10 sphere in a vortex": carried("vortex", 3, 4, 2),
    "C10 deformed sphere": carried("deformation", 3, 4, 3),
}
