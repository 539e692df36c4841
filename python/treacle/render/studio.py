# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""A lit box on a light floor, seen by a camera slightly from above."""

import numpy
import vtk
from scipy.ndimage import gaussian_filter
from vtk.util.numpy_support import numpy_to_vtk

FLOOR, SOLID, DARK = 0.955, (0.45, 0.47, 0.50), (0.24, 0.25, 0.27)
FLOOR_PIXELS = 512
SAMPLES = 2  # per pixel and direction


class Studio:
    """The box [lower, upper]; view: azimuth (0 looks along +y) and elevation in
    degrees, zoom; size: of the pictures, in pixels."""

    def __init__(self, lower, upper, view, size):
        self.lower, self.upper, self.size = lower, upper, size
        self.zoom = view[2]
        azimuth, elevation = numpy.radians([view[0], numpy.clip(view[1], -89, 89)])
        self.toward_camera = numpy.array([numpy.cos(elevation) * numpy.sin(azimuth),
                                          -numpy.cos(elevation) * numpy.cos(azimuth),
                                          numpy.sin(elevation)])
        self.renderer, self.window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(*(SAMPLES * n for n in size))
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)
        self._surroundings()
        self._floor()
        self._outline()
        self.title = self._title()

    def add(self, source):
        """An actor for poly data or for an algorithm that makes them."""
        mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
        if isinstance(source, vtk.vtkPolyData):
            mapper.SetInputData(source)
        else:
            mapper.SetInputConnection(source.GetOutputPort())
        actor.SetMapper(mapper)
        self.renderer.AddActor(actor)
        return actor

    def remove(self, actor):
        self.renderer.RemoveActor(actor)

    def light(self, intensity, position):
        """A light fixed to the camera, which sits at (0, 0, 1) and looks at 0."""
        light = vtk.vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetIntensity(intensity)
        self.renderer.AddLight(light)

    def look_at(self, lower, upper, width=1.0):
        """The nearest camera that sees all of a box in this part of the picture's width."""
        camera = self.renderer.GetActiveCamera()
        toward = self.toward_camera
        right = numpy.cross([0, 0, 1], toward)
        right /= numpy.linalg.norm(right)
        up = numpy.cross(toward, right)
        focus, distance = 0.5 * (lower + upper), 0
        corners = numpy.array(numpy.meshgrid(*zip(lower, upper))).reshape(3, -1).T - focus
        depth = corners @ toward
        tangent = 0.93 * numpy.tan(numpy.radians(0.5 * camera.GetViewAngle()))
        aspect = self.size[0] / self.size[1]
        for axis, slope in (up, tangent), (right, width * aspect * tangent):
            high = max(corners @ axis + depth * slope)
            low = min(corners @ axis - depth * slope)
            focus = focus + 0.5 * (high + low) * axis
            distance = max(distance, 0.5 * (high - low) / slope)
        camera.SetFocalPoint(*focus)
        camera.SetPosition(*(focus + distance * toward))
        camera.SetViewUp(0, 0, 1)
        camera.Zoom(self.zoom)

    def paint_floor(self, points, facets):
        """The background's grey, the box's bottom a little darker, and the shadow of
        the triangles, the softer the higher what casts it."""
        n = FLOOR_PIXELS
        low, high = self.lower[:2] - self.reach, self.upper[:2] + self.reach
        pixel = (high - low) / n
        first, last = (numpy.rint((corner[:2] - low) / pixel).astype(int)
                       for corner in (self.lower, self.upper))
        floor = numpy.full((n, n, 3), FLOOR)
        floor[first[1]:last[1], first[0]:last[0]] -= 0.03
        if len(facets):
            corners = points[facets]
            normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            cover = abs(normal @ [0.2, 0.2, 1]) / 4 / numpy.prod(pixel)
            centre = corners.mean(axis=1)
            height = numpy.clip(centre[:, 2] - self.lower[2], 0, None)
            right = numpy.cross([0, 0, 1], self.toward_camera)
            centre += height[:, None] * (0.55 * right + 0.12 * self.toward_camera)
            layer = numpy.minimum(8 * height / (self.upper - self.lower)[2], 7).astype(int)
            light = numpy.ones((n, n))
            for k in numpy.unique(layer):
                here = layer == k
                shade = numpy.histogram2d(centre[here, 1], centre[here, 0], bins=n,
                                          weights=cover[here],
                                          range=[(low[1], high[1]), (low[0], high[0])])[0]
                light *= numpy.exp(-1.1 * gaussian_filter(shade, n * (0.012 + 0.005 * k)))
            floor *= 1 - (1 - light[..., None]) * [0.34, 0.42, 0.55]  # what passes is amber
        self.floor_texture.SetInputData(
            image_data((255 * floor).round().astype(numpy.uint8)))

    def colour_bar(self, colours, title):
        bar = vtk.vtkScalarBarActor()
        bar.SetLookupTable(colours)
        bar.SetTitle(title + "\n ")
        bar.SetNumberOfLabels(5)
        bar.SetLabelFormat("%.3g")
        bar.UnconstrainedFontSizeOn()
        bar.SetPosition(0.89, 0.25)
        bar.SetWidth(0.1)
        bar.SetHeight(0.5)
        bar.SetBarRatio(0.25)
        for text in bar.GetTitleTextProperty(), bar.GetLabelTextProperty():
            text.SetColor(*DARK)
            text.SetFontSize(SAMPLES * max(9, self.size[1] // 48))
            text.ShadowOff()
            text.BoldOff()
            text.ItalicOff()
        self.renderer.AddActor2D(bar)

    def save(self, path):
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        picture = vtk.vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        mean = vtk.vtkImageShrink3D()
        mean.SetInputConnection(picture.GetOutputPort())
        mean.SetShrinkFactors(SAMPLES, SAMPLES, 1)
        mean.MeanOn()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(str(path))
        writer.SetInputConnection(mean.GetOutputPort())
        writer.Write()

    def _surroundings(self):
        self.renderer.SetBackground(FLOOR, FLOOR, FLOOR)
        self.renderer.UseImageBasedLightingOn()
        self.renderer.SetEnvironmentUp(0, 0, 1)
        self.renderer.SetEnvironmentRight(1, 0, 0)
        texture = vtk.vtkTexture()
        texture.SetColorModeToDirectScalars()
        texture.MipmapOn()
        texture.InterpolateOn()
        texture.SetInputData(image_data(bright_room()))
        self.renderer.SetEnvironmentTexture(texture)
        self.renderer.AutomaticLightCreationOff()
        self.light(0.9, (-0.8, 1.0, 0.5))
        self.renderer.GetActiveCamera().SetViewAngle(26)

    def _floor(self):
        """A plane at the bottom of the box, wider than it, of the background's grey."""
        extent = self.upper - self.lower
        self.reach = 0.6 * extent.max()
        low, high = self.lower - self.reach, self.upper + self.reach
        z = self.lower[2] - 3e-3 * extent.max()
        plane = vtk.vtkPlaneSource()
        plane.SetOrigin(low[0], low[1], z)
        plane.SetPoint1(high[0], low[1], z)
        plane.SetPoint2(low[0], high[1], z)
        self.floor_texture = vtk.vtkTexture()
        self.floor_texture.InterpolateOn()
        actor = self.add(plane)
        actor.SetTexture(self.floor_texture)
        actor.GetProperty().LightingOff()

    def _outline(self):
        outline = vtk.vtkOutlineSource()
        outline.SetBounds(*numpy.stack([self.lower, self.upper], axis=1).ravel())
        self.outline = self.add(outline)
        material = self.outline.GetProperty()
        material.SetColor(*SOLID)
        material.LightingOff()
        material.SetLineWidth(1.2 * SAMPLES)

    def _title(self):
        text = vtk.vtkTextActor()
        text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        text.SetPosition(0.02, 0.95)
        text.GetTextProperty().SetFontSize(SAMPLES * max(10, self.size[1] // 36))
        text.GetTextProperty().SetColor(*DARK)
        self.renderer.AddActor2D(text)
        return text


def bright_room():
    """What the liquid mirrors: a room with soft lamps, over elevation and azimuth."""
    elevation = numpy.linspace(-90, 90, 128)[:, None]
    azimuth = numpy.linspace(-180, 180, 256)[None, :]

    def lamp(strength, azimuth_0, elevation_0, half_width, half_height):
        def inside(distance, half):
            return 1 / (1 + numpy.exp((abs(distance) - half) / 1.5))
        return (strength * inside(azimuth - azimuth_0, half_width)
                * inside(elevation - elevation_0, half_height))

    room = (0.55 + 0.30 * numpy.clip(elevation / 60, -0.6, 1)
            + lamp(5, -60, 40, 25, 18) + lamp(2.5, 90, 30, 14, 24) + lamp(2, 170, 50, 30, 12))
    return numpy.repeat(room[..., None], 3, axis=2).astype(numpy.float32)


def image_data(pixels):
    """Pixels (height x width x 3), the lowest row first."""
    image = vtk.vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
    return image
