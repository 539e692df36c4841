# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Surfaces of the liquid, and PLY files of them."""

import re
from pathlib import Path

import numpy

from treacle.errors import DataError

PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2",
             "int": "i4", "uint": "u4", "float": "f4", "double": "f8",
             "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
             "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}


class Surface:
    """The surface of the liquid at one time: lines in two dimensions, triangles in three.

    points:    (n, 3), m; z is 0 in two dimensions
    facets:    (m, dim), indices of points; the liquid is on the left of a line, behind a
               counter-clockwise triangle
    velocity:  (n, 3), m/s, at the points"""

    def __init__(self, points, facets, velocity):
        self.points, self.facets, self.velocity = points, facets, velocity

    @property
    def speed(self):
        """(n,), m/s."""
        return numpy.linalg.norm(self.velocity, axis=1)


def read_surface(path):
    """The Surface in a PLY file of triangles (element `face`) or lines (element `edge`), with
    the velocity vx, vy, vz of each vertex where there is one, else zero.

    Raises DataError if there is no such file, or something else in it."""
    try:
        data = Path(path).read_bytes()
    except FileNotFoundError:
        raise DataError(f"there is no surface '{path}'") from None
    header, end, body = data.partition(b"end_header\n")
    if not header.startswith(b"ply") or not end:
        raise DataError(f"'{path}' is not a complete PLY file")
    try:
        elements = _ply_elements(header.decode(), body)
        points, velocity = (_vectors(elements["vertex"], names)
                            for names in (("x", "y", "z"), ("vx", "vy", "vz")))
        if "edge" in elements:
            edge = elements["edge"]
            facets = numpy.stack([edge["vertex1"], edge["vertex2"]], axis=1)
        else:
            face = elements["face"]
            facets = face[face.dtype.names[0]]["items"].reshape(-1, 3)
        if len(facets) and not 0 <= facets.min() <= facets.max() < len(points):
            raise ValueError("a facet names a vertex that is not there")
    except (KeyError, ValueError, IndexError) as error:
        raise DataError(f"'{path}' is damaged or not a triangle or line mesh: {error}") from None
    return Surface(points, facets.astype(int), velocity)


def _vectors(table, names):
    """(n, 3), with zero for columns that the table does not have."""
    return numpy.stack([table[name].astype(float) if name in table.dtype.names
                        else numpy.zeros(len(table)) for name in names], axis=1)


def _ply_elements(header, body):
    """The elements as structured arrays; all lists must have three items."""
    ascii_text = "format ascii" in header
    if not ascii_text and "format binary_little_endian" not in header:
        raise ValueError("only ASCII and binary little-endian PLY files can be read")
    elements, tokens, start = {}, body.split() if ascii_text else [], 0
    for block in re.split(r"^element ", header, flags=re.M)[1:]:
        name, count = block.split(None, 2)[:2]
        fields = []
        for words in re.findall(r"^property (.*)$", block, flags=re.M):
            *types, field = words.split()
            if types[0] == "list":
                count_type, type_ = PLY_TYPES[types[1]], PLY_TYPES[types[2]]
                fields.append((field, [("n", "<" + count_type), ("items", "<" + type_, 3)]))
            else:
                fields.append((field, "<" + PLY_TYPES[types[0]]))
        dtype, count = numpy.dtype(fields), int(count)
        if ascii_text:
            width = sum(4 if isinstance(f[1], list) else 1 for f in fields)
            table = numpy.array(tokens[start:start + width * count], dtype=float)
            start += width * count
            elements[name] = _structure(table.reshape(count, width), dtype)
        else:
            elements[name] = numpy.frombuffer(body, dtype, count, start)
            start += dtype.itemsize * count
        for field in dtype.names or ():
            if dtype[field].names and (elements[name][field]["n"] != 3).any():
                raise ValueError("a face is not a triangle")
    return elements


def _structure(table, dtype):
    result, column = numpy.zeros(len(table), dtype), 0
    for field in dtype.names or ():
        if dtype[field].names:
            result[field]["n"] = table[:, column]
            result[field]["items"] = table[:, column + 1:column + 4]
            column += 4
        else:
            result[field] = table[:, column]
            column += 1
    return result
