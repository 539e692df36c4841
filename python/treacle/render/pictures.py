# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Makes the pictures and the film of a run."""

import shutil
import subprocess
from dataclasses import dataclass

from treacle.errors import DataError


@dataclass
class Options:
    """What pictures show."""
    view: tuple = (25, 16, 1)   # in 3D: azimuth (0 looks along +y), elevation in degrees, zoom
    size: tuple = (960, 720)    # in pixels
    focus: str = "box"          # what the 3D camera takes in: box or liquid
    colour: str = "honey"       # or speed, or with mesh level
    mesh: bool = False          # cells, in 3D those behind a plane, and not the liquid


def select(frames, text):
    """The frames that a text names, as a slice of their numbers or a list: "0:100:10",
    "0,10,-1"; all of them for None. Raises DataError if there are none."""
    if text is None:
        return frames
    try:
        if ":" in text:
            start, stop, step = ([int(s) if s else None for s in text.split(":")] + [None])[:3]
            wanted = range(frames[-1] + 1)[start:stop:step]
        else:
            wanted = [int(s) if int(s) >= 0 else frames[int(s)] for s in text.split(",")]
    except (ValueError, IndexError):
        raise DataError(f"--frames '{text}': give start:stop:step or numbers like 0,10,-1")
    chosen = [k for k in frames if k in set(wanted)]
    if not chosen:
        raise DataError(f"there are no frames '{text}'; the run has {frames[0]} to {frames[-1]}")
    return chosen


def mesh_colours(run, frames, options):
    """What cells are coloured by: their values as a function of a Mesh, the limits of these, and their
    name. Level 0 are the largest leaves of all."""
    if options.colour != "level":
        limit = 0.1 * (run.upper - run.lower).min()
        return (lambda mesh: mesh.point_data["phi"][mesh.cells].mean(axis=1)), (-limit, limit), "level set (m)"
    from treacle.mesh import level_of  # needs vtk
    edges = (run.mesh(k).leaf_edges() for k in frames)
    extremes = [(e.min(), e.max()) for e in edges]
    smallest, largest = min(e[0] for e in extremes), max(e[1] for e in extremes)
    return (lambda mesh: mesh.levels(largest)), (0, max(1, level_of(smallest, largest))), "level"


def draw(run, frames, options):
    """Pictures of frames of a Run, in the directory `pictures` of its own; returns their paths."""
    if run.dim == 3:
        from treacle.render.pictures_3d import Pictures3D as Pictures
    else:
        from treacle.render.pictures_2d import Pictures2D as Pictures
    directory = run.directory / "pictures"
    directory.mkdir(exist_ok=True)
    pictures = Pictures(run, frames, options)
    name = "mesh" if options.mesh else "surface"
    paths = [directory / f"{name}_{frame:05d}.png" for frame in frames]
    for frame, path in zip(frames, paths):
        pictures.draw(frame, path)
    return paths


def real_time(run, frames):
    """Pictures a second in a film that is as fast as the liquid, within 10 and 60."""
    interval = (run.time(frames[-1]) - run.time(frames[0])) / (len(frames) - 1)
    return min(60, max(10, 1 / interval if interval > 0 else 25))


def film(pictures, path, rate):
    """A film at `path` of pictures (paths of PNG files), `rate` a second."""
    if not shutil.which("ffmpeg"):
        raise DataError("the film needs ffmpeg")
    command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "image2pipe", "-framerate", str(rate),
               "-c:v", "png", "-i", "-", "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2",
               "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
               str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as process:
        for picture in pictures:
            process.stdin.write(picture.read_bytes())
        process.stdin.close()
    if process.returncode:
        raise DataError(f"ffmpeg could not write '{path}'")
