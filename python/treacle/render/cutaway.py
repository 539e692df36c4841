# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""A picture of the cells of the mesh, of liquid and of air."""

import numpy

from treacle.render.pictures_3d import Pictures3D


class Cutaway(Pictures3D):
    """All cells of the liquid, as honey, and of the air, pale, those behind a plane through
    the middle of the box."""

    LIQUID, AIR = (0.98, 0.62, 0.12), (0.86, 0.90, 0.94)

    def __init__(self, run, frames, options):
        super().__init__(run, frames, options)
        self.studio.light(0.6, (0.3, 0.2, 1))

    def draw(self, frame, path):
        self.clear()
        mesh = self.run.mesh(frame)
        is_liquid = mesh.point_data["phi"][mesh.cells].mean(axis=1) < 0
        is_pale = self.is_behind(mesh) & ~is_liquid
        self._cells(mesh.points, mesh.cells[is_liquid], self.LIQUID, (0.36, 0.17, 0.0))
        self._cells(mesh.points, mesh.cells[is_pale], self.AIR, (0.42, 0.49, 0.56))
        self._solids(self.run.time(frame))
        self.studio.paint_floor(mesh.points[:0], numpy.zeros((0, 3), int))
        self.studio.title.SetInput("")
        self.studio.save(path)

    def _cells(self, points, cells, colour, edge_colour):
        material = self.add_cells(points, cells, edge_colour, 0.5).GetProperty()
        material.SetColor(*colour)
        material.SetAmbient(0.40)
        material.SetDiffuse(0.62)
