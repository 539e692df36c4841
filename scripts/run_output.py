# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What a run leaves in its output directory: parameters, frames, surfaces."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy

PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2",
             "int": "i4", "uint": "u4", "float": "f4", "double": "f8",
             "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
             "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}


class DataError(Exception):
    """The data is missing or cannot be used; the message is one line."""


class Surface:
    """Points (n x 3, m), facets (m x dim point indices; the liquid is on the left
    of an edge, behind a counter-clockwise triangle) and velocity (n x 3, m/s)."""

    def __init__(self, points, facets, velocity):
        self.points, self.facets, self.velocity = points, facets, velocity

    @property
    def speed(self):
        return numpy.linalg.norm(self.velocity, axis=1)


class Run:
    def __init__(self, directory):
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise DataError(f"there is no directory '{directory}'")
        self.parameters = read_parameters(self.directory / "parameters.prm")
        self.dim = int(self.get("Dimension"))
        self.lower = self.numbers("Domain/Lower corner")
        self.upper = self.numbers("Domain/Upper corner")
        if len(self.lower) != self.dim or len(self.upper) != self.dim:
            raise DataError(f"{self.directory}/parameters.prm: a corner of the domain "
                            f"does not have {self.dim} components")
        files = (self.directory / "frames").glob("surface_*.ply")
        self.frames = sorted(int(f.stem.split("_")[1]) for f in files)
        if not self.frames:
            raise DataError(f"there are no surfaces {self.directory}/frames/surface_*.ply")
        self._times = self._read_times()

    @property
    def has_mesh_file(self):
        return self.parameters.get("Mesh/Type") == "file"

    def get(self, name):
        if name not in self.parameters:
            raise DataError(f"{self.directory}/parameters.prm does not set '{name}'")
        return self.parameters[name]

    def numbers(self, name):
        return numpy.array([float(x) for x in re.split(r"[,;]", self.get(name))])

    def time(self, frame):
        """Time of a frame in s, from mesh.pvd, else from the frame interval."""
        return self._times.get(frame, frame * float(self.get("Frame interval")))

    def surface(self, frame):
        return read_ply(self.directory / "frames" / f"surface_{frame:05d}.ply")

    def mesh(self, frame):
        """The file of a frame's mesh."""
        for suffix in "pvtu", "vtu":
            path = self.directory / "frames" / f"mesh_{frame:05d}.{suffix}"
            if path.exists():
                return path
        raise DataError(f"there is no mesh {path.with_suffix('.pvtu')}: "
                        "it needs 'Mesh format = vtu'")

    def solids(self):
        """The solids as (shape, function from a parameter's name to its
        numbers, inside out)."""
        for k in range(1, 100):
            block = f"Solid {k}/"
            if not any(name.startswith(block) for name in self.parameters):
                return
            yield (self.parameters.get(block + "Shape", "sphere"),
                   lambda name, block=block: self.numbers(block + name),
                   self.parameters.get(block + "Invert") == "true")

    def _read_times(self):
        path = self.directory / "frames" / "mesh.pvd"
        try:
            sets = ElementTree.parse(path).iter("DataSet")
            return {int(re.search(r"_(\d+)\.", s.get("file"))[1]): float(s.get("timestep"))
                    for s in sets}
        except (OSError, ElementTree.ParseError, TypeError):
            return {}


def read_parameters(path):
    """A deal.II parameter file as a dictionary 'Section/Name' -> text."""
    if not path.exists():
        raise DataError(f"there is no file '{path}'")
    result, sections = {}, []
    for line in path.read_text().replace("\\\n", " ").splitlines():
        line = line.split("#")[0].strip()
        if line.startswith("subsection "):
            sections.append(line.split(None, 1)[1])
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set ") and "=" in line:
            name, value = line[4:].split("=", 1)
            result["/".join(sections + [name.strip()])] = value.strip()
    return result


def read_ply(path):
    """A triangle mesh (element `face`) or a line mesh (element `edge`), with
    the velocity vx, vy, vz per vertex where there is one (else zero)."""
    if not path.exists():
        raise DataError(f"there is no surface '{path}'")
    data = path.read_bytes()
    header, _, body = data.partition(b"end_header\n")
    if not header.startswith(b"ply") or not _:
        raise DataError(f"'{path}' is not a complete PLY file")
    try:
        elements = _ply_elements(header.decode(), body)
        vertex = elements["vertex"]
        points, velocity = (numpy.stack([vertex[n].astype(float) if n in vertex.dtype.names
                                         else numpy.zeros(len(vertex)) for n in names], axis=1)
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
        raise DataError(f"'{path}' is damaged or not a triangle or line mesh: {error}")
    return Surface(points, facets.astype(int), velocity)


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
