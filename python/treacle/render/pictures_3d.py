# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Pictures of three-dimensional runs: the liquid's surface, or a cut through the mesh."""

import sys
from functools import cached_property

import numpy
from matplotlib import colormaps
from vtk import vtkMatrix4x4
from vtk.util.numpy_support import vtk_to_numpy

from treacle.errors import DataError
from treacle.outline import merge, wall_caps
from treacle.render.bodies import body, half_space
from treacle.render.cells import boundary_faces
from treacle.render.pictures import mesh_colours
from treacle.render.poly_data import (add_point_data, colour_table, poly_data, polygons,
                                      with_smooth_normals)
from treacle.render.studio import SAMPLES, SOLID, Studio

HONEY_DEEP, HONEY_THIN = numpy.array([0.66, 0.24, 0.0]), numpy.array([1.0, 0.60, 0.10])
LEVEL_SET = [(0.72, 0.42, 0.0), (0.94, 0.71, 0.24), (0.98, 0.91, 0.72),
             (0.91, 0.94, 0.96), (0.73, 0.79, 0.86), (0.50, 0.61, 0.71)]
VIRIDIS = [colormaps["viridis"](x)[:3] for x in numpy.linspace(0, 1, 17)]


class Pictures3D:
    """The studio is built once; draw() exchanges the liquid, or the mesh, and the solids."""

    def __init__(self, run, frames, options):
        self.run, self.mesh = run, options.mesh
        self.studio = Studio(run.lower, run.upper, options.view, options.size)
        self.actors, self.colours = [], None
        if options.mesh:
            self.values, limits, name = mesh_colours(run, frames, options)
            self.colours = colour_table(VIRIDIS if options.colour == "level" else LEVEL_SET, *limits)
            self.studio.colour_bar(self.colours, name)
        elif options.colour == "speed":
            fastest = max(run.surface(k).speed.max(initial=0) for k in frames)
            self.colours = colour_table(VIRIDIS, 0, fastest or 1)
            self.studio.colour_bar(self.colours, "speed (m/s)")
        if self.colours is not None:
            self.studio.light(0.75, (0, 0, 1))
        lower, upper = run.lower, run.upper
        if options.focus == "liquid":
            clouds = [run.surface(k).points for k in frames]
            cloud = numpy.concatenate([c for c in clouds if len(c)] or [[lower, upper]])
            lower, upper = cloud.min(axis=0), cloud.max(axis=0)
        self.studio.look_at(lower, upper, 1.0 if self.colours is None else 0.82)

    def draw(self, frame, path):
        self.clear()
        surface = self.run.surface(frame)
        if self.mesh:
            self._mesh(frame)
            surface.facets = surface.facets[:0]
        elif len(surface.facets):
            self._liquid(surface)
        if not self.mesh:
            self._solids(self.run.time(frame))
        self.studio.paint_floor(surface.points, surface.facets)
        self.studio.title.SetInput(f"t = {self.run.time(frame):.3f} s")
        self.studio.save(path)

    def clear(self):
        while self.actors:
            self.studio.remove(self.actors.pop())

    def _liquid(self, surface):
        lower, upper = self.run.lower, self.run.upper
        facets, _ = merge(surface.points, surface.facets, 1e-7 * (upper - lower).max())
        parts = [with_smooth_normals(poly_data(surface.points, facets, speed=surface.speed),
                                     facets)]
        parts += [polygons(loops) for loops in wall_caps(surface.points, facets, lower, upper)]
        for part in parts:
            actor = self.studio.add(part)
            material, mapper = actor.GetProperty(), actor.GetMapper()
            if self.colours is None:
                add_point_data(part, "honey", self._honey(part))
                mapper.SetColorModeToDirectScalars()
                material.SetInterpolationToPBR()
                material.SetRoughness(0.16)
            else:
                mapper.SetLookupTable(self.colours)
                material.SetColor(*SOLID)  # of the caps, which have no speed
                material.SetAmbient(0.25)
                material.SetSpecular(0.15)
                material.SetSpecularPower(30)
            mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray("honey" if self.colours is None else "speed")
            self.actors.append(actor)

    def _honey(self, part):
        """Colours that look translucent: lighter where the view grazes the surface."""
        normals = vtk_to_numpy(part.GetPointData().GetNormals())
        graze = 1 - abs(normals @ self.studio.toward_camera)[:, None]
        colour = HONEY_DEEP + graze**1.5 * (HONEY_THIN - HONEY_DEEP)
        return (255 * colour).clip(0, 255).astype(numpy.uint8)

    def _mesh(self, frame):
        """The cells behind the plane through the middle of the box that faces the camera."""
        mesh = self.run.mesh(frame)
        behind = self.is_behind(mesh)
        actor = self.add_cells(mesh.points, mesh.cells[behind], (0.13, 0.15, 0.17), 0.7,
                               self.values(mesh)[behind])
        mapper, material = actor.GetMapper(), actor.GetProperty()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("value")
        mapper.SetLookupTable(self.colours)
        material.SetAmbient(0.25)
        material.SetDiffuse(0.8)

    def is_behind(self, mesh):
        """Whether the camera sees a cell behind the plane through the middle of the box, (m,)."""
        toward = self.studio.toward_camera
        axis = int(numpy.argmax(abs(toward[:2])))
        middle = 0.5 * (self.run.lower + self.run.upper)[axis]
        return (mesh.points[mesh.cells].mean(axis=1)[:, axis] - middle) * toward[axis] < 0

    def add_cells(self, points, cells, edge_colour, line_width, values=None):
        """An actor of the faces that bound the cells, with the value of each cell, if any."""
        faces, cell = boundary_faces(points, cells)
        corners = points[faces].reshape(-1, 3)
        data = {} if values is None else {"value": numpy.repeat(values[cell], 3)}
        actor = self.studio.add(poly_data(corners, numpy.arange(len(corners)).reshape(-1, 3),
                                          **data))
        material = actor.GetProperty()
        material.SetInterpolationToFlat()
        material.EdgeVisibilityOn()
        material.SetEdgeColor(*edge_colour)
        material.SetLineWidth(line_width * SAMPLES)
        self.actors.append(actor)
        return actor

    @cached_property
    def _bodies(self):
        """Solids, and where they were at t = 0, None if they go on for ever."""
        result = []
        for solid in self.run.solids():
            try:
                result.append((solid, None if solid.shape == "half space" else body(solid, self.run)))
            except DataError as error:
                print(f"A solid is not in the pictures: {error}", file=sys.stderr)
        return result

    def _solids(self, time):
        for solid, at_start in self._bodies:
            place = solid.pose(time)
            if place is None:
                continue
            matrix, shift = place
            actor = self.studio.add(at_start or half_space(solid, self.run, matrix, shift))
            if at_start:
                actor.SetUserMatrix(vtkMatrix4x4())
                actor.GetUserMatrix().DeepCopy([*numpy.hstack([matrix, shift[:, None]]).ravel(), 0, 0, 0, 1])
            material = actor.GetProperty()
            material.SetColor(*SOLID)
            material.SetInterpolationToPBR()
            material.SetRoughness(0.6)
            if solid.is_inverted:
                material.SetOpacity(0.12)
            self.actors.append(actor)
