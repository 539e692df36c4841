# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Shapes of solids for VTK."""

import numpy
import vtk


def body(shape, value, run, matrix, shift):
    """What draws a body where it was at t = 0, or None where nothing here can; a half space where it is, within the box."""
    if shape == "sphere":
        source = vtk.vtkSphereSource()
        source.SetCenter(*value("Centre"))
        source.SetRadius(value("Radius")[0])
        source.SetThetaResolution(96)
        source.SetPhiResolution(96)
        return source
    if shape in ("cylinder", "capsule"):
        if shape == "capsule":
            start, end = value("Start"), value("End")
        else:
            axis = value("Axis") / numpy.linalg.norm(value("Axis"))
            start, end = (value("Centre") + s * value("Length")[0] * axis for s in (-0.5, 0.5))
        line, tube = vtk.vtkLineSource(), vtk.vtkTubeFilter()
        line.SetPoint1(*start)
        line.SetPoint2(*end)
        tube.SetInputConnection(line.GetOutputPort())
        tube.SetRadius(value("Radius")[0])
        tube.SetNumberOfSides(96)
        tube.CappingOn()
        return tube
    if shape not in ("box", "half space"):
        return None
    lower, upper = run.lower, run.upper
    if shape == "box":
        lower, upper = value("Lower corner"), value("Upper corner")
    box = vtk.vtkCubeSource()
    box.SetBounds(*numpy.stack([lower, upper], axis=1).ravel())
    if shape == "box":
        return box
    plane, planes, part = vtk.vtkPlane(), vtk.vtkPlaneCollection(), vtk.vtkClipClosedSurface()
    plane.SetOrigin(*(matrix @ value("Centre") + shift))
    plane.SetNormal(*-(matrix @ value("Normal")))
    planes.AddItem(plane)
    part.SetInputConnection(box.GetOutputPort())
    part.SetClippingPlanes(planes)
    return part
