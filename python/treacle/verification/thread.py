# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""A viscous thread that falls from a nozzle, by slender theory."""

import numpy

N_INTERVALS = 400


def thread_speed(z, start, length, nu, gravity=9.81):
    """Its speed U (m/s) at the distances z (m) below the nozzle, where it is start:
    U U' = g + 3 nu U (U'/U)' (Trouton 1906), with U U' = g in the end (z = length), where viscosity matters no more.

    Central differences, Newton's method."""
    x = numpy.linspace(0, length, N_INTERVALS + 1)
    h = x[1]
    u = numpy.sqrt(start ** 2 + 2 * gravity * x)
    for _ in range(100):
        curvature = (numpy.log(u[2:]) - 2 * numpy.log(u[1:-1]) + numpy.log(u[:-2])) / h ** 2
        slope = (u[2:] - u[:-2]) / (2 * h)
        residual = numpy.concatenate([[u[0] - start], u[1:-1] * slope - gravity - 3 * nu * u[1:-1] * curvature,
                                      [(u[-1] ** 2 - u[-2] ** 2) / (2 * h) - gravity]])
        jacobian = numpy.zeros((N_INTERVALS + 1, N_INTERVALS + 1))
        inner = numpy.arange(1, N_INTERVALS)
        viscous = 3 * nu * u[1:-1] / h ** 2
        jacobian[inner, inner] = slope - 3 * nu * curvature + 2 * viscous / u[1:-1]
        for side in (-1, 1):
            jacobian[inner, inner + side] = side * u[1:-1] / (2 * h) - viscous / u[inner + side]
        jacobian[0, 0] = 1
        jacobian[-1, -2:] = numpy.array([-u[-2], u[-1]]) / h
        change = numpy.linalg.solve(jacobian, residual)
        u -= change
        if abs(change).max() < 1e-12 * u.max():
            return numpy.interp(z, x, u)
    raise ArithmeticError("Newton's method does not converge")
