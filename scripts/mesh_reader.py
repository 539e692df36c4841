# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Reads a frame's mesh: VTU or PVTU of triangles or tetrahedra."""

import vtk
from vtk.util.numpy_support import vtk_to_numpy

from run_output import DataError


def read_mesh(path):
    """Points (n x 3), cells (m x (dim+1) point indices), level set at the points."""
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
    phi = grid.GetPointData().GetArray("phi")
    if phi is None:
        raise DataError(f"'{path}' does not hold 'phi'")
    return (vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
            vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, width),
            vtk_to_numpy(phi).astype(float))
