# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Pictures of three-dimensional runs: the liquid's surface, or a cut through the mesh."""

import numpy
import vtk
from scipy.sparse import coo_matrix, identity
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from treacle.outline import liquid_loops, merge
from studio import SAMPLES, SOLID, Studio

HONEY_DEEP, HONEY_THIN = numpy.array([0.66, 0.24, 0.0]), numpy.array([1.0, 0.60, 0.10])
LEVEL_SET = [(0.72, 0.42, 0.0), (0.94, 0.71, 0.24), (0.98, 0.91, 0.72),
             (0.91, 0.94, 0.96), (0.73, 0.79, 0.86), (0.50, 0.61, 0.71)]


class Pictures3D:
    """The studio is built once; draw() exchanges the liquid or the mesh."""

    def __init__(self, run, frames, options):
        self.run, self.mesh = run, options.mesh
        self.studio = Studio(run.lower, run.upper, options.view, options.size)
        self.actors, self.colours = [], None
        if options.mesh:
            limit = 0.1 * (run.upper - run.lower).min()
            self.colours = colour_table(LEVEL_SET, -limit, limit)
            self.studio.colour_bar(self.colours, "level set (m)")
        elif options.colour == "speed":
            fastest = max(run.surface(k).speed.max(initial=0) for k in frames)
            self.colours = colour_table(viridis(), 0, fastest or 1)
            self.studio.colour_bar(self.colours, "speed (m/s)")
        if self.colours is not None:
            self.studio.light(0.75, (0, 0, 1))
        if not options.mesh:
            self._solids()
        lower, upper = run.lower, run.upper
        if options.focus == "liquid":
            clouds = [run.surface(k).points for k in frames]
            cloud = numpy.concatenate([c for c in clouds if len(c)] or [[lower, upper]])
            lower, upper = cloud.min(axis=0), cloud.max(axis=0)
        self.studio.look_at(lower, upper, 1.0 if self.colours is None else 0.82)

    def draw(self, frame, path):
        while self.actors:
            self.studio.remove(self.actors.pop())
        surface = self.run.surface(frame)
        if self.mesh:
            self._mesh(frame)
            surface.facets = surface.facets[:0]
        elif len(surface.facets):
            self._liquid(surface)
        self.studio.paint_floor(surface.points, surface.facets)
        self.studio.title.SetInput(f"t = {self.run.time(frame):.3f} s")
        self.studio.save(path)

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
        points, cells, phi = mesh.points, mesh.cells, mesh.point_data["phi"]
        toward = self.studio.toward_camera
        axis = int(numpy.argmax(abs(toward[:2])))
        middle = 0.5 * (self.run.lower + self.run.upper)[axis]
        centre = points[cells].mean(axis=1)[:, axis]
        cells = cells[(centre - middle) * toward[axis] < 0]
        faces, cell = boundary_faces(points, cells)
        corners = points[faces].reshape(-1, 3)
        actor = self.studio.add(poly_data(corners, numpy.arange(len(corners)).reshape(-1, 3),
                                          phi=numpy.repeat(phi[cells].mean(axis=1)[cell], 3)))
        mapper, material = actor.GetMapper(), actor.GetProperty()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("phi")
        mapper.SetLookupTable(self.colours)
        material.SetInterpolationToFlat()
        material.SetAmbient(0.25)
        material.SetDiffuse(0.8)
        material.EdgeVisibilityOn()
        material.SetEdgeColor(0.13, 0.15, 0.17)
        material.SetLineWidth(0.7 * SAMPLES)
        self.actors.append(actor)

    def _solids(self):
        for shape, value, inside_out in self.run.solids():
            source = body(shape, value, self.run)
            if source is None:
                continue
            material = self.studio.add(source).GetProperty()
            material.SetColor(*SOLID)
            material.SetInterpolationToPBR()
            material.SetRoughness(0.6)
            if inside_out:
                material.SetOpacity(0.12)


def body(shape, value, run):
    """What draws a body, within the box, or None where nothing here can."""
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
    plane.SetOrigin(*value("Centre"))
    plane.SetNormal(*-value("Normal"))
    planes.AddItem(plane)
    part.SetInputConnection(box.GetOutputPort())
    part.SetClippingPlanes(planes)
    return part


class Cutaway(Pictures3D):
    """All cells of the liquid, as honey, and of the air, pale, those behind a plane through
    the middle of the box."""

    LIQUID, AIR = (0.98, 0.62, 0.12), (0.86, 0.90, 0.94)

    def __init__(self, run, frames, options):
        super().__init__(run, frames, options)
        self.studio.light(0.6, (0.3, 0.2, 1))

    def draw(self, frame, path):
        mesh = self.run.mesh(frame)
        points, cells, phi = mesh.points, mesh.cells, mesh.point_data["phi"]
        axis = int(numpy.argmax(abs(self.studio.toward_camera[:2])))
        side = numpy.sign(self.studio.toward_camera[axis])
        middle = 0.5 * (self.run.lower + self.run.upper)[axis]
        centre = points[cells].mean(axis=1)
        behind = (centre[:, axis] - middle) * side < 0
        is_liquid = phi[cells].mean(axis=1) < 0
        self._cells(points, cells[is_liquid], self.LIQUID, (0.36, 0.17, 0.0))
        self._cells(points, cells[behind & ~is_liquid], self.AIR, (0.42, 0.49, 0.56))
        self.studio.paint_floor(points[:0], numpy.zeros((0, 3), int))
        self.studio.title.SetInput("")
        self.studio.save(path)

    def _cells(self, points, cells, colour, edge_colour):
        faces, _ = boundary_faces(points, cells)
        corners = points[faces].reshape(-1, 3)
        actor = self.studio.add(poly_data(corners, numpy.arange(len(corners)).reshape(-1, 3)))
        material = actor.GetProperty()
        material.SetColor(*colour)
        material.SetInterpolationToFlat()
        material.SetAmbient(0.40)
        material.SetDiffuse(0.62)
        material.EdgeVisibilityOn()
        material.SetEdgeColor(*edge_colour)
        material.SetLineWidth(0.5 * SAMPLES)


def wall_caps(points, facets, lower, upper):
    """Where the liquid touches a wall its surface is open. Yields for each such wall
    the polygons (n x 3) that close it."""
    edges = numpy.concatenate([facets[:, [0, 1]], facets[:, [1, 2]], facets[:, [2, 0]]])
    n = len(points)
    edges = edges[~numpy.isin(edges @ [n, 1], edges @ [1, n])]  # no triangle beyond
    tolerance = 1e-5 * (upper - lower).max()
    for axis in range(3):
        for wall, order in (lower[axis], (2, 1)), (upper[axis], (1, 2)):
            on_wall = (abs(points[edges, axis] - wall) < tolerance).all(axis=1)
            # seen from outside, the cap's edges run against the surface's
            plane = [(axis + k) % 3 for k in order]
            caps = []
            for loop in liquid_loops(points[:, plane], edges[on_wall][:, ::-1],
                                     lower[plane], upper[plane]):
                caps.append(numpy.full((len(loop), 3), wall))
                caps[-1][:, plane] = loop
            if caps:
                yield caps


def boundary_faces(points, cells):
    """Faces (n x 3 points) that belong to one cell only, and that cell. The points may
    be repeated from cell to cell."""
    _, label = numpy.unique(points.astype("f4"), axis=0, return_inverse=True)
    faces = numpy.concatenate([numpy.delete(cells, k, axis=1) for k in range(4)])
    _, first, count = numpy.unique(numpy.sort(label[faces], axis=1), axis=0,
                                   return_index=True, return_counts=True)
    alone = first[count == 1]
    return faces[alone], alone % len(cells)


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


def with_normals(data):
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def colour_table(colours, low, high):
    table = vtk.vtkColorTransferFunction()
    for x, colour in zip(numpy.linspace(low, high, len(colours)), colours):
        table.AddRGBPoint(x, *colour)
    return table


def viridis():
    from matplotlib import colormaps
    return [colormaps["viridis"](x)[:3] for x in numpy.linspace(0, 1, 17)]
