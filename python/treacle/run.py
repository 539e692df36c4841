# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What a run leaves in its output directory."""

import re
from functools import cached_property
from pathlib import Path
from typing import Callable, NamedTuple
from xml.etree import ElementTree

import numpy

from treacle.errors import DataError
from treacle.motion import Motion
from treacle.parameters import read_parameters
from treacle.statistics import read_statistics
from treacle.surface import read_surface


class Solid(NamedTuple):
    """A solid as the parameters describe it."""
    shape: str          # as in the parameter file
    text: Callable      # from a parameter's name to its value
    numbers: Callable   # from a parameter's name to an array of its numbers
    is_inverted: bool   # a container: solid outside the shape
    pose: Callable      # from a time (s) to treacle.motion.Motion.pose, or None where its formulas are not understood


class Run:
    """The output directory of a run, which may still be going on. Tables and lists are read
    when they are first asked for, and kept; surfaces and meshes are read each time.

    directory:     its pathlib.Path
    parameters:    dictionary from 'Section/Name' to text, of all parameters
    dim:           2 or 3
    lower, upper:  corners of the domain, (dim,), m

    The constructor raises DataError where there is no run, the other members where what they
    read is missing or damaged."""

    def __init__(self, directory):
        self.directory = Path(directory)
        path = self.directory / "parameters.prm"
        if not self.directory.is_dir():
            raise DataError(f"there is no directory '{directory}'")
        if not path.is_file():
            raise DataError(f"'{directory}' is not the output directory of a run: "
                            "it holds no parameters.prm")
        self.parameters = read_parameters(path)
        if self.get("Dimension") not in ("2", "3"):
            raise DataError(f"{path}: 'Dimension' is neither 2 nor 3")
        self.dim = int(self.get("Dimension"))
        self.lower = self.numbers("Domain/Lower corner")
        self.upper = self.numbers("Domain/Upper corner")
        if len(self.lower) != self.dim or len(self.upper) != self.dim:
            raise DataError(f"{path}: a corner of the domain does not have {self.dim} components")

    def get(self, name):
        """The text of a parameter."""
        if name not in self.parameters:
            raise DataError(f"{self.directory}/parameters.prm does not set '{name}'")
        return self.parameters[name]

    def numbers(self, name):
        """An array of the numbers of a parameter."""
        try:
            return numpy.array([float(x) for x in re.split(r"[,;]", self.get(name))])
        except ValueError:
            raise DataError(f"{self.directory}/parameters.prm: '{name}' is not made of "
                            f"numbers: {self.get(name)}") from None

    @property
    def has_mesh_file(self):
        """Whether the mesh came from a file, so that the domain need not be a box."""
        return self.parameters.get("Mesh/Type") == "file"

    def solids(self):
        """Yields each Solid."""
        for k in range(1, 100):
            block = f"Solid {k}/"
            if not any(name.startswith(block) for name in self.parameters):
                return
            yield Solid(self.parameters.get(block + "Shape", "sphere"),
                        lambda name, block=block: self.get(block + name),
                        lambda name, block=block: self.numbers(block + name),
                        self.parameters.get(block + "Invert") == "true",
                        lambda time, block=block: self._pose(block, time))

    def _pose(self, block, time):
        try:
            return Motion({name[len(block):]: value for name, value in self.parameters.items()
                           if name.startswith(block)}, self.dim).pose(time)
        except DataError:
            return None

    @cached_property
    def statistics(self):
        """The Statistics: arrays (n_steps,) by name of the column, as in "Time (s)"."""
        return read_statistics(self.directory)

    @cached_property
    def frames(self):
        """The numbers of the frames that have a surface, in order; there is at least one."""
        files = (self.directory / "frames").glob("surface_*.ply")
        frames = sorted(int(f.stem.split("_")[1]) for f in files)
        if not frames:
            raise DataError(f"there are no surfaces {self.directory}/frames/surface_*.ply")
        return frames

    def time(self, frame):
        """The time (s) of a frame: from mesh.pvd, else from the frame interval."""
        if frame in self._times:
            return self._times[frame]
        return frame * self.numbers("Frame interval")[0]

    def frame_at(self, time):
        """The frame that is nearest to a time (s)."""
        return min(self.frames, key=lambda frame: abs(self.time(frame) - time))

    def surface(self, frame):
        """The Surface in a frame."""
        return read_surface(self.directory / "frames" / f"surface_{frame:05d}.ply")

    def mesh(self, frame):
        """The treacle.mesh.Mesh of a frame."""
        from treacle.mesh import read_mesh  # needs VTK
        for suffix in "pvtu", "vtu":
            path = self.directory / "frames" / f"mesh_{frame:05d}.{suffix}"
            if path.exists():
                return read_mesh(path)
        raise DataError(f"there is no mesh {path.with_suffix('.pvtu')}: "
                        "it needs 'Mesh format = vtu'")

    @cached_property
    def _times(self):
        path = self.directory / "frames" / "mesh.pvd"
        try:
            sets = ElementTree.parse(path).iter("DataSet")
            return {int(re.search(r"_(\d+)\.", s.get("file"))[1]): float(s.get("timestep"))
                    for s in sets}
        except (OSError, ElementTree.ParseError, TypeError):
            return {}
