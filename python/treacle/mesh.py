# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Meshes of frames: VTU or PVTU files of triangles or tetrahedra."""

from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from treacle.errors import DataError


class Mesh:
    """The mesh at one time, with what lives on it.

    points:      (n, 3), m; pieces of several ranks each have their own copy of a point
    cells:       (m, dim + 1), indices of points
    point_data:  arrays by name: phi (n,), the level set in m, negative in the liquid;
                 velocity (n, 3), m/s
    cell_data:   arrays (m,) by name: pressure (Pa), viscosity (Pa s), liquid_fraction, rank"""

    def __init__(self, points, cells, point_data, cell_data):
        self.points, self.cells = points, cells
        self.point_data, self.cell_data = point_data, cell_data

    def leaf_edges(self):
        """Edge (m) of the leaf on which a whole cell of the lattice has the volume of each cell, (m,)."""
        corners = self.points[self.cells]
        dim = corners.shape[1] - 1
        edges = (corners[:, 1:] - corners[:, :1])[:, :, :dim]
        volume = abs(numpy.linalg.det(edges)) / (2 if dim == 2 else 6)
        return (4 * volume)**0.5 if dim == 2 else (12 * volume)**(1 / 3)

    def levels(self, largest):
        """By how many levels the leaf of each cell is finer than leaves with an edge (m), (m,): cells beside
        finer leaves have a half or a quarter of the volume of the others on their leaf."""
        return level_of(self.leaf_edges(), largest)


def level_of(edge, largest):
    """By how many levels a leaf is finer, see Mesh.levels()."""
    return numpy.floor(numpy.log2(largest / edge) + 0.1)


def read_mesh(path):
    """The Mesh in a file. Raises DataError if it cannot be read or does not hold phi."""
    path = Path(path)
    if not path.exists():
        raise DataError(f"there is no mesh '{path}'")
    parallel = path.suffix == ".pvtu"
    reader = vtk.vtkXMLPUnstructuredGridReader() if parallel else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        raise DataError(f"'{path}' has no cells or cannot be read")
    sizes = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    width = sizes[1] - sizes[0]
    if width not in (3, 4) or ((sizes[1:] - sizes[:-1]) != width).any():
        raise DataError(f"'{path}' holds other cells than triangles or tetrahedra")
    mesh = Mesh(vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
                vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, width),
                _arrays(grid.GetPointData()), _arrays(grid.GetCellData()))
    if "phi" not in mesh.point_data:
        raise DataError(f"'{path}' does not hold 'phi'")
    return mesh


def _arrays(data):
    arrays = (data.GetArray(k) for k in range(data.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array).astype(float) for array in arrays if array}
