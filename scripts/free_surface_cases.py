# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The exact cases with a free surface (section C), for scripts/verify."""

from math import pi, sqrt

import numpy

from measures import at, front, height, interpolated, last, surface_rate, wave

LEFT, RIGHT, TOP = (f"Liquid {what} (m)" for what in ("minimum x", "maximum x", "maximum y"))
SHALLOW = {"Domain/Upper corner": "1, 1", "Mesh/Root cells": "2",
           "Liquid 1/Expression": "y - 0.5 - 0.005 * cos(pi * x)"}
SHORT = {"Domain/Upper corner": "0.5, 1", "Mesh/Root cells": "1", "Material/Viscosity": "0.1",
         "Liquid 1/Expression": "y - 0.5 - 0.005 * cos(2 * pi * x)", "End time": "2",
         "Frame interval": "0.1"}
THIN = {"Material/Viscosity": "0.005", "End time": "8"}


def wave_case(start, end, rate, frequency):
    decay, turning = wave(pi, start, end)
    return {"rate": (decay, rate), "frequency": (turning, frequency)}


def angular_momentum(results):
    return (results["Angular momentum (kg m^2/s)"][-1] / results["Angular momentum (kg m^2/s)"][0])


def kinetic_energy(results):
    return results["Kinetic energy (J)"][-1] / results["Kinetic energy (J)"][0]


def fall(results):
    y = results["Centre of mass y (m)"]
    return y[-1] - y[0]


def half_axis(column, time):
    """Half of an extent of the liquid."""
    low, high = (interpolated(f"Liquid {which} {column} (m)", time) for which in ("minimum", "maximum"))
    return lambda results: (high(results) - low(results)) / 2


def flux(results):
    """Boole's rule."""
    u = [0] + [results[f"Probe {k} velocity x (m/s)"][-1] for k in (1, 2, 3, 4)]
    return numpy.dot([7, 32, 12, 32, 7], u) / 90


AXES = [(0.08, 0.923272807, 1.08310349), (0.38, 0.694821252, 1.43921907),
        (0.76, 0.514266474, 1.94451719), (1, 0.439460768, 2.27551598)]
IMPACT = [(1.5, 1.185), (1.8, 1.598), (2, 1.721), (2.5, 1.844), (3, 1.892)]
DAM = [(0.41, 1.11), (0.84, 1.23), (1.19, 1.44), (1.63, 1.89), (1.97, 2.33), (2.5, 3), (2.96, 3.67)]
SLIP = [(1, 0.89888, 1.16232), (2, 0.79707, 1.34746), (5, 0.60635, 1.83486)]
HELD = [(1, 1.0887, 0.9432), (3, 1.2761, 0.8423), (5, 1.4354, 0.7730), (10, 1.7327, 0.6716),
        (15, 1.9406, 0.6143)]

# file, first level, time step there, exact values, settings
FREE_SURFACE_CASES = {
    "C2 fall": ("free_fall_2d", 4, 0.02, {"fall": (fall, -9.81 * 0.1 ** 2 / 2)}, {}),
    "C2 rotation": ("rigid_rotation_2d", 4, 0.02, {"angular momentum": (angular_momentum, 1),
                                                   "kinetic energy": (kinetic_energy, 1)}, {}),
    "C3 k pi, h 1, nu 1": ("relaxation", 2, 0.1, {"rate": (surface_rate(pi, 1), 0.145546628)}, {}),
    "C3 k pi, h 0.5, nu 1": ("relaxation", 2, 0.1, {"rate": (surface_rate(pi, 1), 0.076507535)},
                             SHALLOW),
    "C3 k 2 pi, h 0.5, nu 0.1": ("relaxation", 2, 0.05,
                                 {"rate": (surface_rate(2 * pi, 0.5), 0.828245658)}, SHORT),
    "C4 nu 0.05": ("wave", 2, 0.1, wave_case(1, 6, 0.575442182, 1.47245435), {}),
    "C4 nu 0.005": ("wave", 2, 0.1, wave_case(1, 8, 0.0879152071, 1.75697276), THIN),
    "C5": ("stretched_drop", 2, 0.04,
           {f"{name}, t = {t}": (half_axis(axis, t), exact[i]) for t, *exact in AXES
            for i, (name, axis) in enumerate((("minor", "x"), ("major", "y")))}, {}),
    "C7": ("sagging_column", 3, 1,
           {f"h, T = {t / 40}": (at(TOP, t), exact) for t, exact in
            ((20, 0.810930216), (40, 0.693147181), (80, 0.549306144))}, {}),
    "C8": ("film", 1, 0.1, {"u at the surface": (last("Probe 4 velocity x (m/s)"), 0.5),
                            "flux": (flux, 1 / 3)}, {}),
    "C9": ("gravity_current", 1, 2, {"front, T = 30": (at(RIGHT, 270), 2.7909),
                                     "h(0)": (height(270), 0.4258)}, {}),
    "C9b": ("slump_slip", 1, 0.2,
            {f"{name}, t = {t}": (measure(t), exact[i]) for t, *exact in SLIP
             for i, (name, measure) in enumerate((("h(0)", height), ("front", front)))}, {}),
    "C9c": ("slump", 1, 0.2,
            {f"{name}, t = {t}": (measure, exact) for t, x, h in HELD
             for name, measure, exact in (("x", at(RIGHT, t), x), ("h(0)", height(t), h))}, {}),
    "C9d": ("drop_impact", 2, 0.04, {f"width, t = {t}": (interpolated(RIGHT, t, 2), exact)
                                     for t, exact in IMPACT}, {}),
    "C9e": ("dam_break", 2, 0.04, {f"front, t sqrt(2 g / a) = {t}":
                                   (interpolated(RIGHT, t / sqrt(2)), exact)
                                   for t, exact in DAM}, {}),
}
