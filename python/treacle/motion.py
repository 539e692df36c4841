# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where a moving solid is, by the formulas of its parameters."""

import math
import re

import numpy

from treacle.errors import DataError
from treacle.formula import formula

STEP = 1 / 128  # s, at most, of what is integrated


def rotation(turn):
    """The matrix of a turn by an angle, (1,), or about a vector by its length, (3,), in rad."""
    angle = numpy.linalg.norm(turn)
    if len(turn) == 1:
        c, s = math.cos(turn[0]), math.sin(turn[0])
        return numpy.array([[c, -s], [s, c]])
    if angle == 0:
        return numpy.eye(3)
    x, y, z = turn / angle
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


class Motion:
    """Of a solid with these parameters, by name ('Displacement', ...), in dim dimensions. DataError where a formula
    is not understood."""

    def __init__(self, parameters, dim):
        def formulas(name, n):
            texts = parameters.get(name, "0").split(";")
            return [formula(text, "t") for text in (texts if len(texts) == n else texts[:1] * n)]

        def moves(*names):
            return any(re.search(r"[1-9A-Za-z]", parameters.get(name, "0")) for name in names)

        n_turns = 1 if dim == 2 else 3
        self.by_velocity = moves("Velocity", "Angular velocity")
        self.is_moving = self.by_velocity or moves("Displacement", "Rotation")
        shift, turn = (("Velocity", "Angular velocity") if self.by_velocity else ("Displacement", "Rotation"))
        self.shifts, self.turns = formulas(shift, dim), formulas(turn, n_turns)
        centre = parameters.get("Centre of rotation", "0")
        self.start = numpy.array([float(x) for x in re.split(r"[,;]", centre)]) * numpy.ones(dim)

    def pose(self, t):
        """A matrix (dim, dim) and a vector (dim,), m: what was at x is at matrix @ x + vector at the time t (s). DataError where
        a formula has no value, or none in Python, which wants both branches of an if to have one."""
        def at(functions, time):
            try:
                return numpy.array([f(time) for f in functions])
            except (ArithmeticError, TypeError, ValueError):
                raise DataError(f"pictures find no value of the formulas of a solid at t = {time} s") from None

        if not self.by_velocity:
            shift, matrix = at(self.shifts, t), rotation(at(self.turns, t))
        else:
            n = max(400, math.ceil(t / STEP))
            shift, matrix = numpy.zeros(len(self.shifts)), numpy.eye(len(self.shifts))
            for k in range(n):  # the midpoint rule
                middle = (k + 0.5) * t / n
                shift = shift + t / n * at(self.shifts, middle)
                matrix = rotation(t / n * at(self.turns, middle)) @ matrix
        return matrix, self.start + shift - matrix @ self.start
