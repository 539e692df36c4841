#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Writes a mesh of triangles for a symmetric container in 2D as Gmsh's .msh (version 2.2).

    scripts/make_mesh.py OUT.msh PROFILE SIZE

PROFILE: half widths at heights, from the bottom up, with straight walls between them:
height:half_width,height:half_width,...; SIZE: of the triangles' edges. A bottle:

    scripts/make_mesh.py bottle.msh 0:0.5,0.1:0.5,0.7:0.12,1:0.12 0.03
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def profile(text):
    return [tuple(map(float, pair.split(":"))) for pair in text.split(",")]


def main():
    parser = new_parser(__doc__)
    parser.add_argument("mesh", metavar="OUT.msh")
    parser.add_argument("profile", metavar="PROFILE", type=profile)
    parser.add_argument("size", metavar="SIZE", type=float)
    arguments = parser.parse_args()
    from treacle.containers import mesh_of, write
    points, cells = mesh_of(arguments.profile, arguments.size)
    write(arguments.mesh, points, cells)
    print(f"{arguments.mesh}: {len(points)} points, {len(cells)} triangles")


if __name__ == "__main__":
    run_command(main)
