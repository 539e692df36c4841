#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Makes pictures and a film of a run: OUTPUT_DIRECTORY/pictures/*.png and film.mp4.

    scripts/render.py results/coiling
    scripts/render.py results/coiling --frames 0:100:10 --view 40,25,1.5 --colour speed
    scripts/render.py results/coiling --frames -1 --mesh
"""

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle import DataError, Run


def numbers(text, separator, count, convert):
    parts = text.split(separator)
    if len(parts) != count:
        raise argparse.ArgumentTypeError(f"'{text}' is not {count} numbers with '{separator}'")
    return tuple(convert(part) for part in parts)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", help="the run's output directory")
    parser.add_argument("--frames", help="start:stop:step, or numbers like 0,10,-1 "
                        "(negative: from the end); default: all")
    parser.add_argument("--view", default="25,16,1", metavar="AZIMUTH,ELEVATION,ZOOM",
                        type=lambda s: numbers(s, ",", 3, float),
                        help="3D camera, degrees and a factor (default: %(default)s; "
                        "write --view=-30,16,1 when the first is negative)")
    parser.add_argument("--focus", choices=["box", "liquid"], default="box",
                        help="what the 3D camera takes in")
    parser.add_argument("--size", default="960x720", metavar="WxH",
                        type=lambda s: numbers(s, "x", 2, int))
    parser.add_argument("--colour", choices=["honey", "speed"], default="honey")
    parser.add_argument("--mesh", action="store_true",
                        help="draw the cells, in 3D those behind a plane; files are mesh_*.png")
    parser.add_argument("--fps", type=float, help="pictures a second in the film "
                        "(default: real time, within 10 and 60)")
    parser.add_argument("--no-film", action="store_true")
    return parser.parse_args()


def select(frames, text):
    """The frames that the text names, as a slice of the frame numbers or a list."""
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


def readable(run, frames):
    """The frames whose surface can be read, with a line for each that cannot."""
    for frame in frames:
        try:
            run.surface(frame)
            yield frame
        except DataError as error:
            print(f"render: left out: {error}", file=sys.stderr)


def film(pictures, path, fps):
    command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "image2pipe", "-framerate", str(fps),
               "-c:v", "png", "-i", "-", "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2",
               "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
               str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as process:
        for picture in pictures:
            process.stdin.write(picture.read_bytes())
        process.stdin.close()
    if process.returncode:
        raise DataError(f"ffmpeg could not write '{path}'")


def main():
    options = parse_arguments()
    run = Run(options.directory)
    if run.dim == 3 and not os.environ.get("DISPLAY"):
        if not shutil.which("xvfb-run"):
            raise DataError("3D pictures need a display or xvfb-run (package xvfb)")
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24",
                               sys.executable, *sys.argv])
    try:
        if run.dim == 3:
            from render_3d import Pictures3D as Pictures
        else:
            from render_2d import Pictures2D as Pictures
    except ImportError as error:
        raise DataError(f"{error}: see scripts/install_packages, and use /usr/bin/python3")

    frames = list(readable(run, select(run.frames, options.frames)))
    if not frames:
        raise DataError("no frame can be read")
    directory = run.directory / "pictures"
    directory.mkdir(exist_ok=True)
    pictures = Pictures(run, frames, options)
    name = "mesh" if options.mesh else "surface"
    paths = [directory / f"{name}_{frame:05d}.png" for frame in frames]
    for frame, path in zip(frames, paths):
        pictures.draw(frame, path)
    print(f"{len(paths)} pictures in {directory}")

    if len(paths) > 1 and not options.no_film:
        if not shutil.which("ffmpeg"):
            raise DataError("the film needs ffmpeg")
        interval = (run.time(frames[-1]) - run.time(frames[0])) / (len(frames) - 1)
        path = directory / ("film.mp4" if name == "surface" else "film_mesh.mp4")
        film(paths, path, options.fps or min(60, max(10, 1 / interval if interval > 0 else 25)))
        print(f"film: {path}")


if __name__ == "__main__":
    try:
        main()
    except DataError as error:
        sys.exit(f"render: {error}")
