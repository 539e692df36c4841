# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The pictures of doc/gallery, each made from finished runs."""

import sys
import tempfile
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

from treacle.errors import DataError
from treacle.outline import outline_of
from treacle.render.pictures import Options
from treacle.render.pictures_2d import EDGE, FRAME, LIQUID, filled
from treacle.run import Run

# name: run, times (s; negative: of the end), (azimuth, elevation, zoom), size of a picture
STRIPS = {
    "drop": ("drop", (0, 0.04, 0.12, 0.2, 0.8), (25, 14, 1.0), (400, 300)),
    "armadillo": ("armadillo", (0, 0.16, 0.24, 0.32, 0.4), (28, 12, 1.0), (340, 380)),
    "coiling": ("coiling", (0.48, 0.6, 0.72, 0.96, 1.2, 1.6), (25, 16, 1.0), (250, 420)),
    "coiling_laplacian": ("coiling_laplacian", (0.48, 0.6, 0.72, 0.84, 0.96), (25, 16, 1.0),
                          (250, 420)),
    "armadillo_laplacian": ("armadillo_laplacian", (0, 0.16, 0.24, 0.32, 0.4), (28, 12, 1.0),
                            (340, 380)),
    "sheet": ("sheet", (0.36, 0.6, 0.72, 0.84, 1.0, 1.16), (25, 14, 1.0), (250, 420)),
    "cup": ("cup", (0.4, 0.8, 1.2, 1.6, 2.4), (25, 16, 1.0), (320, 360)),
    "pool": ("pool", (0.12, 0.2, 0.32, 0.44), (25, 22, 1.0), (420, 300)),
    "tori": ("tori", (0, 0.16, 0.24, 0.56), (20, 16, 1.0), (480, 260)),
}
MESHES = {"mesh": ("armadillo", 0, (28, 14, 1.0), (780, 640))}
COLUMNS = {"face coupled": "column_collapse_face_coupled",
           "face fitted": "column_collapse_face_fitted",
           "node FLIP": "column_collapse_node_flip", "node PIC": "column_collapse_node_pic"}
COLUMN_TIMES = (0, 0.2, 0.4, 1.2)
COLUMN = "column_collapse"
SCENES = [COLUMN, *STRIPS, *MESHES]


def draw_scene(name, results):
    """The picture of one of SCENES from runs in a directory, an Image of few colours."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory)
        if name == COLUMN:
            return side_by_side([columns(results, path / "columns.png")])
        make = strip if name in STRIPS else cutaway
        return side_by_side(make(name, results, path))


def strip(name, results, directory):
    """Paths of pictures of one run at several times."""
    from treacle.render.pictures_3d import Pictures3D
    folder, times, view, size = STRIPS[name]
    run = Run(results / folder)
    frames = [run.frame_at(time) for time in times]
    pictures = Pictures3D(run, frames, Options(view, size, "liquid"))
    pictures.studio.remove(pictures.studio.outline)
    paths = [directory / f"{k}.png" for k in range(len(frames))]
    for frame, path in zip(frames, paths):
        pictures.draw(frame, path)
    return paths


def cutaway(name, results, directory):
    from treacle.render.cutaway import Cutaway
    folder, time, view, size = MESHES[name]
    run = Run(results / folder)
    frame = run.frame_at(time)
    pictures = Cutaway(run, [frame], Options(view, size))
    pictures.studio.remove(pictures.studio.outline)
    pictures.draw(frame, directory / "mesh.png")
    return [directory / "mesh.png"]


def columns(results, path):
    """One row a mapping, one column a time."""
    runs = {}
    for label, folder in COLUMNS.items():
        try:
            run = Run(results / folder)
            if run.frames:  # an error if there are none
                runs[label] = run
        except DataError as error:
            print(f"gallery: column_collapse without {label}: {error}", file=sys.stderr)
    if not runs:
        raise DataError("there is no run of the column")
    figure = Figure((12, 1.45 * len(runs) + 0.3), dpi=100, layout="constrained")
    grid = figure.subplots(len(runs), len(COLUMN_TIMES), squeeze=False)
    for row, (label, run) in zip(grid, runs.items()):
        for axes, time in zip(row, COLUMN_TIMES):
            frame = run.frame_at(time)
            draw_column(axes, run, frame)
            if row is grid[0]:
                axes.set_title(f"t = {run.time(frame):.2f} s", color=FRAME, fontsize=10)
        row[0].set_ylabel(label, color=FRAME, fontsize=10)
    figure.savefig(path)
    return path


def draw_column(axes, run, frame):
    axes.add_patch(filled(outline_of(run, frame), facecolor=LIQUID, edgecolor=EDGE, linewidth=1.2))
    axes.axhline(run.lower[1], color=FRAME, linewidth=1.5)
    width = run.upper[0] - run.lower[0]
    axes.set(aspect="equal", xlim=(run.lower[0], run.upper[0]), xticks=[], yticks=[],
             ylim=(run.lower[1] - 0.02 * width, 0.37 * width))
    for side in axes.spines.values():
        side.set_visible(False)


def side_by_side(paths):
    pictures = [Image.open(path).convert("RGB") for path in paths]
    whole = Image.new("RGB", (sum(p.width for p in pictures), pictures[0].height))
    x = 0
    for picture in pictures:
        whole.paste(picture, (x, 0))
        x += picture.width
    return whole.quantize(256, dither=Image.Dither.NONE)  # some tens of KB
