# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Exact solution of a small wave on a viscous liquid that begins at rest (linear theory, no slip on the floor)."""

import numpy
from numpy.polynomial import legendre

N_FUNCTIONS = 24


def wave_from_rest(k, depth, nu, times, gravity=1.):
    """Amplitudes at the times (s) of a wave cos(k x) of the surface that is 1 at t = 0, when nothing moves.

    The motion is more than one decaying mode: shear of the first moment spreads from surface and floor, and what is
    measured early has a part of it (a rate or frequency up to 1.3 % off that of the mode in cases C3 and C4).

    With v cos(k x) the velocity upwards and -v'/k sin(k x) the one along x, v = v' = 0 on the floor, the momentum
    equation in its weak form, whose natural conditions are those of a free surface under its own weight:
    (v, w) + (v', w') / k^2 is the mass, nu times 4 (v', w') + (v''/k + k v, w''/k + k w) what viscosity takes, and
    gravity * amplitude * w(depth) the weight. Polynomials in y (Galerkin), for sqrt(nu t) of a hundredth of the depth
    and more; time by eigenvectors."""
    y, weights = legendre.leggauss(2 * N_FUNCTIONS)

    def functions(s):
        """y^2 P_n(2 y / depth - 1) and two derivatives, at y = depth (1 + s) / 2 ([derivative][point, function])."""
        height = depth * (1 + s)[:, None] / 2
        p, dp, ddp = (
            legendre.legvander(s, N_FUNCTIONS - 1) @ derivative * (2 / depth) ** order
            for order in range(3)
            for derivative in [numpy.vstack([legendre.legder(numpy.eye(N_FUNCTIONS), order),
                                             numpy.zeros((order, N_FUNCTIONS))])])
        return height ** 2 * p, 2 * height * p + height ** 2 * dp, 2 * p + 4 * height * dp + height ** 2 * ddp

    def products(f):
        return (f.T * weights * depth / 2) @ f

    v, dv, ddv = functions(y)
    mass = products(v) + products(dv) / k ** 2
    friction = nu * (4 * products(dv) + products(ddv / k + k * v))
    top = functions(numpy.ones(1))[0][0]
    # of the coefficients of v, and of the amplitude
    matrix = numpy.zeros((N_FUNCTIONS + 1, N_FUNCTIONS + 1))
    matrix[:-1, :-1] = -numpy.linalg.solve(mass, friction)
    matrix[:-1, -1] = -numpy.linalg.solve(mass, gravity * top)
    matrix[-1, :-1] = top
    rates, modes = numpy.linalg.eig(matrix)
    start = numpy.linalg.solve(modes, numpy.eye(N_FUNCTIONS + 1)[:, -1])
    return (modes[-1] * start @ numpy.exp(numpy.outer(rates, times))).real
