# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Solids for VTK."""

from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from treacle.bodies import distance, extent, placement
from treacle.errors import DataError
from treacle.render.poly_data import poly_data, with_normals

LEAVES = 96  # of the longest side, for what is found by its distance
READERS = {".obj": vtk.vtkOBJReader, ".ply": vtk.vtkPLYReader, ".stl": vtk.vtkSTLReader}


def body(solid, run):
    """The poly data of a solid where it was at t = 0. DataError where nothing here can."""
    if solid.shape == "triangle mesh":
        return with_normals(placed(triangles(Path(solid.text("File"))), solid), split=True)
    if solid.shape in ("sphere", "cylinder", "box"):
        source = plain(solid)
        source.Update()
        return placed(source.GetOutput(), solid)
    return contour(solid, *extent(solid, run.lower, run.upper))


def plain(solid):
    """What makes a sphere, cylinder or box before it is placed."""
    number = solid.numbers
    if solid.shape == "sphere":
        source = vtk.vtkSphereSource()
        source.SetCenter(*number("Centre"))
        source.SetRadius(number("Radius")[0])
        source.SetThetaResolution(96)
        source.SetPhiResolution(96)
        return source
    if solid.shape == "cylinder":
        half = number("Length")[0] / 2 * number("Axis") / numpy.linalg.norm(number("Axis"))
        line, tube = vtk.vtkLineSource(), vtk.vtkTubeFilter()
        line.SetPoint1(*(number("Centre") - half))
        line.SetPoint2(*(number("Centre") + half))
        tube.SetInputConnection(line.GetOutputPort())
        tube.SetRadius(number("Radius")[0])
        tube.SetNumberOfSides(96)
        tube.CappingOn()
        return tube
    return cube(number("Lower corner"), number("Upper corner"))


def cube(lower, upper):
    box = vtk.vtkCubeSource()
    box.SetBounds(*numpy.stack([lower, upper], axis=1).ravel())
    return box


def half_space(solid, run, matrix, shift):
    """Of a half space that has moved, what is in the box."""
    plane, planes, part = vtk.vtkPlane(), vtk.vtkPlaneCollection(), vtk.vtkClipClosedSurface()
    box = cube(run.lower, run.upper)  # by name: its port does not keep it alive
    turn, offset = placement(solid)
    plane.SetOrigin(*(matrix @ (turn @ solid.numbers("Centre") + offset) + shift))
    plane.SetNormal(*-(matrix @ turn @ solid.numbers("Normal")))
    planes.AddItem(plane)
    part.SetInputConnection(box.GetOutputPort())
    part.SetClippingPlanes(planes)
    return part


def contour(solid, lower, upper):
    """The surface of what lies between two corners, closed there."""
    size = (upper - lower).max() / LEAVES
    n = numpy.ceil((upper - lower) / size).astype(int) + 3
    axes = [numpy.linspace(a - size, b + size, k) for a, b, k in zip(lower, upper, n)]
    z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
    values = distance(solid, numpy.stack([x, y, z], axis=-1).reshape(-1, 3)).reshape(x.shape)
    values = values.clip(-2 * size, 2 * size)
    for axis in range(3):
        for side in 0, -1:
            values.swapaxes(0, axis)[side] = 2 * size
    image, surface = vtk.vtkImageData(), vtk.vtkFlyingEdges3D()
    image.SetDimensions(*n)
    image.SetOrigin(*(axis[0] for axis in axes))
    image.SetSpacing(*(axis[1] - axis[0] for axis in axes))
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    surface.ComputeScalarsOff()
    surface.SetInputData(image)
    surface.SetValue(0, 0)
    surface.Update()
    return surface.GetOutput()


def triangles(path):
    """The poly data of an OFF, OBJ, PLY or STL file."""
    if not path.is_file():
        raise DataError(f"there is no file {path}")
    if path.suffix.lower() in READERS:
        reader = READERS[path.suffix.lower()]()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()
    words = [line.split("#")[0] for line in path.read_text().splitlines()]
    try:
        head, *numbers = " ".join(words).split()
        n, m = int(numbers[0]), int(numbers[1])
        points = numpy.array(numbers[3:3 + 3 * n], dtype=float).reshape(-1, 3)
        facets = numpy.array(numbers[3 + 3 * n:3 + 3 * n + 4 * m], dtype=int).reshape(-1, 4)
        if head != "OFF" or len(points) != n or len(facets) != m or (facets[:, 0] != 3).any():
            raise ValueError
    except (ValueError, IndexError):
        raise DataError(f"pictures do not understand the file {path}") from None
    return poly_data(points, facets[:, 1:])


def placed(data, solid):
    """Poly data of a body where the parameters put it."""
    transform, result = vtk.vtkTransform(), vtk.vtkTransformPolyDataFilter()
    turn, shift = placement(solid)
    if solid.shape == "triangle mesh" and solid.text("Centre at origin") == "true":
        shift = shift - turn @ data.GetCenter()
    transform.SetMatrix([*numpy.hstack([turn, shift[:, None]]).ravel(), 0, 0, 0, 1])
    result.SetTransform(transform)
    result.SetInputData(data)
    result.Update()
    return result.GetOutput()
