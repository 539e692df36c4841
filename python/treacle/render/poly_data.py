# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""VTK's poly data and colours of arrays."""

import numpy
import vtk
from scipy.sparse import coo_matrix, identity
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy


def poly_data(points, facets, **point_data):
    data, vertices, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    vertices.SetData(numpy_to_vtk(numpy.ascontiguousarray(points, dtype=float), deep=True))
    offsets = numpy.arange(0, facets.size + 1, 3)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(facets.astype(numpy.int64).ravel(), deep=True))
    data.SetPoints(vertices)
    data.SetPolys(cells)
    for name, values in point_data.items():
        add_point_data(data, name, values)
    return data


def add_point_data(data, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.GetPointData().AddArray(array)


def polygons(loops):
    """Triangles of the polygons of one plane, holes left open."""
    data, vertices, lines = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    for loop in loops:
        ids = [vertices.InsertNextPoint(*x) for x in loop]
        lines.InsertNextCell(len(ids) + 1)
        for i in ids + ids[:1]:
            lines.InsertCellPoint(i)
    data.SetPoints(vertices)
    data.SetLines(lines)
    triangles = vtk.vtkContourTriangulator()
    triangles.SetInputData(data)
    triangles.Update()
    return with_normals(triangles.GetOutput())


def with_smooth_normals(data, facets):
    """Normals averaged over neighbours three times: facets of cut tetrahedra differ much
    in shape, and their own normals show it."""
    data = with_normals(data)
    normals = vtk_to_numpy(data.GetPointData().GetNormals()).astype(float)
    edges = numpy.concatenate([facets[:, [0, 1]], facets[:, [1, 2]], facets[:, [2, 0]]])
    n = len(normals)
    near = coo_matrix((numpy.ones(len(edges)), edges.T), shape=(n, n)).tocsr()
    near = near + near.T + identity(n)
    for _ in range(3):
        normals = near @ normals
        normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-12)[:, None]
    array = numpy_to_vtk(normals.astype(numpy.float32), deep=True)
    array.SetName("Normals")
    data.GetPointData().SetNormals(array)
    return data


def with_normals(data, split=False):
    """split: edges stay sharp."""
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetSplitting(split)
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def colour_table(colours, low, high):
    table = vtk.vtkColorTransferFunction()
    for x, colour in zip(numpy.linspace(low, high, len(colours)), colours):
        table.AddRGBPoint(x, *colour)
    return table
