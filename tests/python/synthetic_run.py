# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Writes the output directory of a run that never took place: a triangle of liquid that falls."""

import struct

PARAMETERS = """# all parameters
set Dimension      = {dim}
set Frame interval = 0.5
subsection Domain
  set Lower corner = {lower}
  set Upper corner = {upper}   # in m
end
subsection Solid 1
  set Shape  = box
  set Invert = true
  set Lower corner = 0.5; 1.5
end
subsection Material
  set Viscosity = 1 + \\
    x
end
"""
STATISTICS = """# 1: Time step number
# 2: Time (s)
# 3: Liquid maximum y (m)
0 0.0 0.75
1 0.25 0.5
2 0.5 nan
"""
FACETS = {2: ((0, 1), (1, 2), (2, 0)), 3: ((0, 1, 2),)}


def write_surface(path, dim, height):
    """Vertices (0, h, 0), (1, h, 0), (0, h + 1, 0) with the velocity (0, -3, 4)."""
    facets = FACETS[dim]
    element = (f"edge {len(facets)}\nproperty int vertex1\nproperty int vertex2\n" if dim == 2 else
               f"face {len(facets)}\nproperty list uchar int vertex_indices\n")
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
              + "".join(f"property float {name}\n" for name in ("x", "y", "z", "vx", "vy", "vz"))
              + f"element {element}end_header\n")
    vertices = ((0, height, 0), (1, height, 0), (0, height + 1, 0))
    body = b"".join(struct.pack("<6f", *vertex, 0, -3, 4) for vertex in vertices)
    for facet in facets:
        body += (b"\x03" if dim == 3 else b"") + struct.pack(f"<{dim}i", *facet)
    path.write_bytes(header.encode() + body)


def write_run(directory, dim=2):
    """Three frames: 0, 1 and 3; mesh.pvd knows the times of the first two."""
    frames = directory / "frames"
    frames.mkdir(parents=True)
    (directory / "statistics").write_text(STATISTICS)
    (directory / "parameters.prm").write_text(PARAMETERS.format(
        dim=dim, lower=", ".join(["0"] * dim), upper=", ".join(["2"] * dim)))
    for frame in 0, 1, 3:
        write_surface(frames / f"surface_{frame:05d}.ply", dim, 0.25 * frame)
    (frames / "mesh.pvd").write_text(
        '<VTKFile><Collection><DataSet timestep="0" file="mesh_00000.pvtu"/>'
        '<DataSet timestep="0.125" file="mesh_00001.pvtu"/></Collection></VTKFile>')
