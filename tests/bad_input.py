# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What a user gets wrong gives one clear message, exit code 1, and no half-written
file, on one rank and on two. Usage: bad_input.py path/to/treacle"""

import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

GOOD = {
    "Dimension": "2", "End time": "0.02", "Maximum time step": "0.01",
    "Frame interval": "0.02", "Output directory": "run",
    "Mesh/Surface level": "4", "Mesh/Interior level": "2", "Mesh/Air level": "2",
    "Liquid 1/Shape": "sphere", "Liquid 1/Radius": "0.2",
}

# name, changes, what the message must hold
CASES = [
    ("unknown parameter", {"Mesh/Surfce level": "4"}, r"Surfce level"),
    ("value outside its pattern", {"Mesh/Surface level": "many"}, r"Surface level"),
    ("step that time cannot take", {"Maximum time step": "1e-13"}, r"Maximum time step must be 0 or at least"),
    ("no such choice", {"Viscosity/Mapping": "node FLAP"}, r"Mapping"),
    ("wrong number of components", {"Liquid 1/Velocity": "1; 2; 3"}, r"Liquid 1/Velocity"),
    ("syntax of an expression", {"Material/Viscosity": "1 +"}, r"Material/Viscosity"),
    ("missing triangle mesh", {"Dimension": "3", "Liquid 1/Shape": "triangle mesh",
                               "Liquid 1/File": "nowhere.off"}, r"nowhere\.off"),
    ("open triangle mesh", {"Dimension": "3", "Liquid 1/Shape": "triangle mesh",
                            "Liquid 1/File": "open.off"}, r"open\.off.*closed"),
    ("box that cubes cannot tile", {"Domain/Upper corner": "1, 1.3"}, r"cubes cannot tile.*Root cells"),
    ("size that is not a number", {"Mesh/Size": "sqrt(x - 2)"}, r"Mesh/Size is -?nan at x = "),
    ("few cells of one size", {"Mesh/Maximum cells": "1000"}, r"Maximum cells needs a Mesh/Coarsest surface level"),
    ("liquid outside the box", {"Liquid 1/Centre": "3, 3"}, r"Liquid 1 lies outside the box"),
    ("liquid inside a solid", {"Solid 1/Shape": "sphere", "Solid 1/Radius": "0.4"},
     r"Liquid 1 lies inside a solid"),
    ("emitter inside a solid", {"Emitter 1/Shape": "sphere", "Emitter 1/Radius": "0.1",
                                "Emitter 1/Centre": "0.2, 0.2", "Solid 1/Shape": "sphere",
                                "Solid 1/Radius": "0.15", "Solid 1/Centre": "0.2, 0.2"},
     r"Emitter 1 lies inside a solid"),
    ("emitter outside the box", {"Emitter 1/Shape": "sphere", "Emitter 1/Centre": "0.5, 7"},
     r"Emitter 1 lies outside the box"),
    ("vent that hardly reaches into the box", {
        "Emitter 1/Shape": "box", "Emitter 1/Lower corner": "0.3, -1", "Emitter 1/Upper corner": "0.7, 0.01"},
     r"Emitter 1 is too thin.*0\.0625 m.*into the box.*Mesh/Surface level"),
    ("emitter thinner than a leaf", {
        "Emitter 1/Shape": "sphere", "Emitter 1/Centre": "0.5, 0.8", "Emitter 1/Radius": "0.02"},
     r"Emitter 1 is too thin"),
    ("emitter that stops before it starts", {"Emitter 1/Start time": "1", "Emitter 1/Stop time": "0.5"},
     r"Emitter 1/Stop time"),
    ("two motions of a solid", {"Solid 1/Velocity": "1; 0", "Solid 1/Displacement": "t; 0",
                                "Solid 1/Radius": "0.05"}, r"Solid 1 has two motions"),
    ("material of a liquid that stays behind", {"Liquid 1/Viscosity": "3"},
     r"Liquid 1 has a material of its own.*Transport = advected"),
    ("viscosity that is not a number", {"Material/Viscosity": "sqrt(0.01 - t)"},
     r"Material/Viscosity is -?nan"),
    ("negative viscosity", {"Material/Viscosity": "-1"}, r"Material/Viscosity is -1"),
    ("viscosity that becomes negative", {"Material/Viscosity": "1 - 80 * t"},
     r"Material/Viscosity is -.* at x = .* t = "),
    ("density that is not positive somewhere", {"Material/Density": "x - 0.5"},
     r"Material/Density is .* at x = "),
    ("solver that does not converge",
     {"Linear solvers/Pressure/Maximum iterations": "1", "Linear solvers/Pressure/Preconditioner": "none",
      "Viscosity/Pressure coupling": "split", "Domain/Upper corner": "1, 1", "Liquid 1/Centre": "0.5, 0.1"},
     r"Linear solvers/Pressure.*Maximum iterations"),
    ("markers lost", {"Domain/Upper corner": "8, 8", "Mesh/Surface level": "7", "Liquid 1/Centre": "4, 4",
                      "Liquid 1/Velocity": "20*sin(40*y); 20*cos(37*x)", "Maximum CFL number": "100",
                      "Maximum time step": "0.1", "Frame interval": "0.2", "End time": "0.2"},
     r"Surface tracking: \d+ of \d+ markers.*at t = .*Maximum CFL number"),
    ("coupling that has another mapping", {"Viscosity/Mapping": "node PIC"},
     r"Viscosity/Mapping = node PIC does not go with Pressure coupling = coupled"),
    ("probe outside the box", {"Probe 1/Position": "0.5, 1.5"}, r"Probe 1/Position lies outside the box"),
    ("probe outside the mesh", {"Mesh/Type": "file", "Mesh/File": "pair.msh", "Probe 1/Position": "0.9, 1.1"},
     r"Probe 1/Position lies outside the mesh"),
    ("surface that moves without its velocity", {"Steps/Advection": "false"},
     r"Steps/Advection is false.*Steps/Surface = false"),
    ("emitter that starts while the surface stays", {
        "Steps/Surface": "false", "Emitter 1/Radius": "0.1", "Emitter 1/Start time": "0.01"},
     r"Emitter 1/Start time.*Steps/Surface"),
    ("emitter in one full container of two", {
        "Liquid 1/Shape": "expression", "Liquid 1/Expression": "min(x - 0.7, y - 0.2)",
        "Solid 1/Shape": "box", "Solid 1/Lower corner": "0.6, -1", "Solid 1/Upper corner": "0.8, 2",
        "Emitter 1/Radius": "0.1", "Emitter 1/Centre": "0.3, 1", "Emitter 1/Velocity": "0; -1"},
     r"Emitter: it pours .* full of liquid.*Stop time"),
    ("mesh without a file", {"Mesh/Type": "file"}, r"Mesh/File.*needs the name"),
    ("missing mesh", {"Mesh/Type": "file", "Mesh/File": "nowhere.msh"}, r"nowhere\.msh.*cannot be opened"),
    ("mesh that is none", {"Mesh/Type": "file", "Mesh/File": "open.off"}, r"no mesh of triangles.*open\.off"),
    ("mesh of squares", {"Mesh/Type": "file", "Mesh/File": "square.msh"}, r"square\.msh.*Quad.*triangles"),
    ("mesh of another dimension", {"Dimension": "3", "Mesh/Type": "file", "Mesh/File": "pair.msh",
                                   "Liquid 1/Velocity": "0; 0; 0"}, r"no mesh of tetrahedra.*pair\.msh"),
    ("hanging node", {"Mesh/Type": "file", "Mesh/File": "hanging.msh"}, r"hanging\.msh.*hanging node"),
    ("two pieces", {"Mesh/Type": "file", "Mesh/File": "pieces.msh"}, r"pieces\.msh.*share no face"),
    ("overlapping cells", {"Mesh/Type": "file", "Mesh/File": "folded.msh"}, r"folded\.msh.*overlap"),
    ("flat cell", {"Mesh/Type": "file", "Mesh/File": "flat.msh"}, r"flat\.msh.*no volume"),
    ("oblique wall that slips", {"Mesh/Type": "file", "Mesh/File": "pair.msh",
                                 "Domain/Wall condition": "free slip"}, r"Wall condition.*normal to an axis"),
    ("resume without a checkpoint", {"--resume": ""}, r"checkpoint"),
]


CORNERS = ["0 0", "1 0", "1 1", "0 1.2"]

# name, vertices, cells as (Gmsh's number of the kind, vertices)
MESHES = [
    ("pair", CORNERS, [(2, "1 2 3"), (2, "1 3 4")]),
    ("square", CORNERS, [(3, "1 2 3 4")]),
    ("hanging", CORNERS + ["0.5 0.5"], [(2, "1 2 3"), (2, "1 5 4"), (2, "5 3 4")]),
    ("pieces", CORNERS + ["3 0", "4 0", "4 1"], [(2, "1 2 3"), (2, "1 3 4"), (2, "5 6 7")]),
    ("folded", CORNERS + ["0.9 0.3"], [(2, "1 2 3"), (2, "1 3 5")]),
    ("flat", CORNERS + ["2 2"], [(2, "1 2 3"), (2, "1 3 5")]),
]


def write_meshes(path):
    for name, vertices, cells in MESHES:
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(vertices))]
        lines += [f"{k} {x} 0" for k, x in enumerate(vertices, 1)]
        lines += ["$EndNodes", "$Elements", str(len(cells))]
        lines += [f"{k} {kind} 2 0 1 {cell}" for k, (kind, cell) in enumerate(cells, 1)]
        (path / f"{name}.msh").write_text("\n".join(lines + ["$EndElements", ""]))


def on_three_ranks(program, changes, of_last):
    """The command line; where the last rank has settings of its own, it runs in the directory
    "last"."""
    if not of_last:
        return command(program, 3, changes)
    first, last = (command(program, 1, {**changes, **more}) for more in ({}, of_last))
    return ["mpirun", "-np", "2", *first, ":", "-np", "1", "-wdir", "last", *last]


# What goes wrong on one rank of three alone, or is only seen there, must end all:
# name, changes, those of the last rank, files in its directory, what the message must hold
DAMAGED_LIST = '<DataSet timestep="none" group="" part="0" file="mesh_00000.abc"/>\n'
ON_ONE_RANK = [
    ("gravity that is infinite for some", {"Gravity/Acceleration": "0; if(x > 0.6, 1/0, -9.81)"},
     {}, r"error: Gravity/Acceleration is inf at x = .* t = 0 s"),
    ("motion that ends where some have markers", {
        "Liquid 1/Centre": "0.2, 0.2", "Liquid 1/Radius": "0.1", "Solid 1/Radius": "0.05",
        "Solid 1/Centre": "0.8, 0.8", "Solid 1/Displacement": "sqrt(0.015 - t); 0",
        "Surface tracking/Volume correction": "false"}, {},
     r"error: Solid 1/Displacement is not finite at t = "),
    ("an option of the last rank", {}, {"--no-such-option": ""},
     r"error: on rank 2: .*--no-such-option"),
    ("internal error on the first rank", {"Output/Mesh format": "vtu"}, {},
     r"error: on rank 0: internal error"),
    ("triangle mesh that the first rank cannot read", {
        "Dimension": "3", "Liquid 1/Shape": "triangle mesh", "Liquid 1/File": "nowhere.off"},
     {"Liquid 1/File": "tetrahedron.off"}, r"error: Liquid 1/File: .*nowhere\.off. does not exist"),
]
TIME_LIMIT = 60  # s, for them to end; they take a few


def failures_of_one_rank(program):
    for name, changes, of_last, message in ON_ONE_RANK:
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory)
            (path / "last").mkdir()
            for place in (path, path / "last"):
                (place / "empty.prm").write_text("")
            (path / "last" / "tetrahedron.off").write_text(
                "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
            if "internal" in name:
                (path / "run" / "frames").mkdir(parents=True)
                (path / "run" / "frames" / "mesh.pvd").write_text(DAMAGED_LIST)
            try:
                run = subprocess.run(on_three_ranks(program, changes, of_last), cwd=path,
                                     capture_output=True, text=True, timeout=TIME_LIMIT)
            except subprocess.TimeoutExpired:
                yield f"{name}: does not end"
                continue
            if run.returncode == 0 or not re.search(message, run.stderr, re.S):
                yield f"{name}: exit code {run.returncode}\n{run.stderr}"
            elif run.stderr.count("treacle: error: ") != 1:
                yield f"{name}: not one message\n{run.stderr}"


def command(program, ranks, changes):
    """The command line, with every parameter by --set on an empty file."""
    line = [] if ranks == 1 else ["mpirun", "-np", str(ranks)]
    line += [program, "empty.prm"]
    for name, value in {**GOOD, **changes}.items():
        line += [name] if name.startswith("--") else ["--set", f"{name}={value}"]
    return line


def failures_of(program, ranks, name, changes, message):
    with tempfile.TemporaryDirectory() as directory:
        path = pathlib.Path(directory)
        (path / "empty.prm").write_text("")
        (path / "open.off").write_text(
            "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
        write_meshes(path)
        run = subprocess.run(command(program, ranks, changes), cwd=path,
                             capture_output=True, text=True, timeout=300)
        errors = [l for l in run.stderr.splitlines() if l.startswith("treacle: error: ")]
        problem = None
        if run.returncode != 1:
            problem = f"exit code {run.returncode}"
        elif len(errors) != 1:
            problem = f"{len(errors)} messages"
        elif not re.search(message, run.stderr, re.S):
            problem = "another message"
        elif any(p.name.endswith((".new", ".tmp", ".part")) for p in path.rglob("*")):
            problem = "half-written files"
        if problem:
            yield f"{name} on {ranks} ranks: {problem}\n{run.stderr}"


def failures(program):
    """Of all cases; a process waits most of its time, so several run at once."""
    jobs = [(program, ranks, *case) for ranks in (1, 2) for case in CASES]
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda job: list(failures_of(*job)), jobs):
            yield from found


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    found = [*failures_of_one_rank(program), *failures(program)]
    print("\n".join(found) or f"{2 * len(CASES) + len(ON_ONE_RANK)} cases: each one message, "
          "exit code 1")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
