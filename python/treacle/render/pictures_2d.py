# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Pictures of two-dimensional runs: the liquid's outline, filled, or the mesh."""

import sys

import numpy
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path

from treacle.bodies import distance
from treacle.errors import DataError
from treacle.outline import liquid_loops
from treacle.render.cells import walls, weld, wet_polygons
from treacle.render.pictures import mesh_colours

LIQUID, EDGE, SOLID, FRAME = "#f0b43c", "#8a5200", "#9aa0a6", "#3c4043"
POINTS = 400  # in each direction, at which distances of solids are known
LEVEL_SET = LinearSegmentedColormap.from_list(
    "level set", ["#b86a00", "#f0b43c", "#fbe7b8", "#e9eff5", "#b9cadb", "#7f9bb6"])


def filled(loops, **style):
    """Closed polygons as one patch, holes left open."""
    return PathPatch(Path.make_compound_path(
        *(Path(numpy.vstack([loop, loop[:1]]), closed=True) for loop in loops)), **style)


def draw_box(axes, run, time):
    """The domain and its solids at a time (s), with a margin."""
    if not run.has_mesh_file:
        axes.add_patch(Rectangle(run.lower, *(run.upper - run.lower), fill=False,
                                 edgecolor=FRAME, linewidth=1.5, zorder=5))
    margin = 0.02 * (run.upper - run.lower).max()
    for solid in run.solids():
        draw_solid(axes, solid, time, run.lower - margin, run.upper + margin)
    axes.set(aspect="equal", xlim=(run.lower[0] - margin, run.upper[0] + margin),
             ylim=(run.lower[1] - margin, run.upper[1] + margin))
    axes.tick_params(colors=FRAME)
    for side in axes.spines.values():
        side.set_visible(False)


def draw_solid(axes, solid, time, lower, upper):
    """What of a solid is between two corners, where its distance is negative."""
    place = solid.pose(time)
    if place is None:
        return
    matrix, shift = place
    x, y = (numpy.linspace(a, b, POINTS) for a, b in zip(lower, upper))
    points = numpy.stack(numpy.meshgrid(x, y), axis=-1).reshape(-1, 2)
    try:
        values = distance(solid, (points - shift) @ matrix).reshape(POINTS, POINTS)
    except DataError as error:
        print(f"A solid is not in the pictures: {error}", file=sys.stderr)
        return
    far = (upper - lower).max()
    values = values.clip(-far, far)
    if not solid.is_inverted:
        axes.contourf(x, y, values, levels=[-2 * far, 0], colors=[SOLID], zorder=4)
    axes.contour(x, y, values, levels=[0], colors=[FRAME], linewidths=1, zorder=4)


class Pictures2D:
    """draw() makes the picture of a frame; what the frames share is known from the start."""

    def __init__(self, run, frames, options):
        self.run, self.options = run, options
        self.fastest = 0.0
        if options.mesh:
            self.cell_colours = mesh_colours(run, frames, options)
        if options.colour == "speed":
            self.fastest = max((run.surface(k).speed.max(initial=0) for k in frames), default=0)

    def draw(self, frame, path):
        run, options = self.run, self.options
        width, height = options.size
        figure = Figure((width / 100, height / 100), dpi=100, layout="constrained")
        axes = figure.subplots()
        surface = run.surface(frame)
        points = surface.points[:, :2]
        if options.mesh:
            self._mesh(figure, axes, frame)
        elif run.has_mesh_file:
            self._container(axes, frame)
        else:
            loops = liquid_loops(points, surface.facets, run.lower, run.upper)
            if loops:
                axes.add_patch(filled(loops, facecolor=LIQUID, edgecolor="none"))
        lines = LineCollection(points[surface.facets], linewidths=1.6, capstyle="round", zorder=3)
        if options.colour == "speed":
            lines.set(array=surface.speed[surface.facets].mean(axis=1), cmap="viridis",
                      clim=(0, self.fastest or 1), linewidths=3)
            figure.colorbar(lines, ax=axes, label="speed (m/s)", shrink=0.8)
        else:
            lines.set_color(EDGE)
        axes.add_collection(lines)
        draw_box(axes, run, run.time(frame))
        axes.set_title(f"t = {run.time(frame):.3f} s", color=FRAME)
        axes.set(xlabel="x (m)", ylabel="y (m)")
        figure.savefig(path)

    def _container(self, axes, frame):
        mesh = self.run.mesh(frame)
        points, cells, phi = mesh.points, mesh.cells, mesh.point_data["phi"]
        polygons = list(wet_polygons(points[:, :2], cells, phi))
        axes.add_collection(PolyCollection(polygons, facecolors=LIQUID, edgecolors=LIQUID,
                                           linewidths=0.3))
        points, cells = weld(points[:, :2], cells)
        axes.add_collection(LineCollection(walls(points, cells), colors=FRAME, linewidths=1.5,
                                           capstyle="round", zorder=5))

    def _mesh(self, figure, axes, frame):
        mesh = self.run.mesh(frame)
        values, limits, name = self.cell_colours
        level = self.options.colour == "level"
        polygons = PolyCollection(mesh.points[mesh.cells][:, :, :2], array=values(mesh),
                                  cmap="viridis" if level else LEVEL_SET, clim=limits,
                                  edgecolors="#20252b", linewidths=min(0.5, 40 / len(mesh.cells)**0.5))
        axes.add_collection(polygons)
        figure.colorbar(polygons, ax=axes, label=name, shrink=0.8, extend="neither" if level else "both")
