# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where the bodies of parameter files are: distances, and boxes around them."""

import numpy

from treacle.errors import DataError
from treacle.formula import formula
from treacle.motion import rotation


def norm(x):
    return numpy.linalg.norm(x, axis=-1)


def to_box(beyond):
    """From what points are beyond the half widths of a box, (n, dim)."""
    return norm(numpy.maximum(beyond, 0)) + numpy.minimum(beyond.max(axis=-1), 0)


def along_and_across(x, axis):
    along = x @ (axis / norm(axis))
    return along, norm(x - along[:, None] * axis / norm(axis))


def to_capsule(x, start, end, radius):
    segment = end - start
    part = ((x - start) @ segment / max(segment @ segment, 1e-300)).clip(0, 1)
    return norm(x - start - part[:, None] * segment) - radius


def to_torus(x, axis, radius, minor_radius):
    along, across = along_and_across(x, axis) if x.shape[1] == 3 else (0, norm(x))
    return numpy.hypot(along, across - radius) - minor_radius


def to_expression(x, text):
    """Where the formula has no value there is no body."""
    value = formula(text, *"xyz"[:x.shape[1]])

    def at(point):
        try:
            return value(*point)
        except (ArithmeticError, TypeError, ValueError):
            return numpy.inf
    return numpy.array([at(point) for point in x.tolist()])


def placement(solid):
    """A matrix (dim, dim) and a vector (dim,), m: what the shape (as it is given, or centred at the origin) has at x is at matrix @ x +
    vector at t = 0."""
    shift, turn = solid.numbers("Translation"), numpy.radians(solid.numbers("Rotation angle"))
    if len(shift) == 3:
        turn = turn * solid.numbers("Rotation axis") / norm(solid.numbers("Rotation axis"))
    return solid.numbers("Scale")[0] * rotation(turn), shift


def distance(solid, x):
    """Of points x, (n, dim), to a treacle.run.Solid where it was at t = 0, (n,), negative inside its shape (m; an expression's is what its
    formula says). DataError where it is not known here."""
    matrix, shift = placement(solid)
    return solid.numbers("Scale")[0] * plain_distance(solid, numpy.linalg.solve(matrix, (x - shift).T).T)


def plain_distance(solid, x):
    """The same before it is placed."""
    number = solid.numbers
    if solid.shape == "sphere":
        return norm(x - number("Centre")) - number("Radius")
    if solid.shape == "box":
        lower, upper = number("Lower corner"), number("Upper corner")
        return to_box(abs(x - (lower + upper) / 2) - (upper - lower) / 2)
    if solid.shape == "cylinder":
        parts = numpy.stack(along_and_across(x - number("Centre"), number("Axis")), axis=1)
        return to_box(abs(parts) - numpy.append(number("Length") / 2, number("Radius")))
    if solid.shape == "capsule":
        return to_capsule(x, number("Start"), number("End"), number("Radius"))
    if solid.shape == "torus":
        axis = number("Axis") if x.shape[1] == 3 else None
        return to_torus(x - number("Centre"), axis, number("Radius"), number("Minor radius"))
    if solid.shape == "half space":
        return (x - number("Centre")) @ number("Normal") / norm(number("Normal"))
    if solid.shape == "expression":
        return to_expression(x, solid.text("Expression"))
    raise DataError(f"pictures know no distance to a {solid.shape}")


def extent(solid, lower, upper):
    """Corners of a box around a solid at t = 0; of what may go on for ever the part between lower and upper."""
    number = solid.numbers
    if solid.shape == "capsule":
        ends = numpy.stack([number("Start"), number("End")])
    elif solid.shape == "torus":
        ends = number("Centre")[None]
    else:
        return lower, upper
    matrix, shift = placement(solid)
    reach = number("Scale") * (number("Radius") + (number("Minor radius") if solid.shape == "torus" else 0))
    ends = ends @ matrix.T + shift
    return ends.min(axis=0) - reach, ends.max(axis=0) + reach
