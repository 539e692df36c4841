#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Makes pictures and a film of a run: OUTPUT_DIRECTORY/pictures/*.png and film.mp4.

    scripts/render.py results/coiling
    scripts/render.py results/coiling --frames 0:100:10 --view 40,25,1.5 --colour speed
    scripts/render.py results/coiling --frames -1 --mesh --colour level
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def numbers(text, separator, count, convert):
    parts = text.split(separator)
    if len(parts) != count:
        raise argparse.ArgumentTypeError(f"'{text}' is not {count} numbers with '{separator}'")
    return tuple(convert(part) for part in parts)


def parse_arguments():
    parser = new_parser(__doc__)
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
    parser.add_argument("--colour", choices=["honey", "speed", "level"], default="honey",
                        help="level: of the cells, with --mesh")
    parser.add_argument("--mesh", action="store_true",
                        help="draw the cells, in 3D those behind a plane; files are mesh_*.png")
    parser.add_argument("--fps", type=float, help="pictures a second in the film "
                        "(default: real time, within 10 and 60)")
    parser.add_argument("--no-film", action="store_true")
    return parser.parse_args()


def readable(run, frames):
    """The frames whose surface can be read, with a line for each that cannot."""
    from treacle import DataError
    for frame in frames:
        try:
            run.surface(frame)
            yield frame
        except DataError as error:
            print(f"render: left out: {error}", file=sys.stderr)


def main():
    arguments = parse_arguments()
    from treacle import DataError, Run
    if arguments.colour == "level" and not arguments.mesh:
        raise DataError("--colour level is of cells: add --mesh")
    from treacle.render.display import restart_with_display
    from treacle.render.pictures import Options, draw, film, real_time, select
    run = Run(arguments.directory)
    if run.dim == 3:
        restart_with_display()
    frames = list(readable(run, select(run.frames, arguments.frames)))
    if not frames:
        raise DataError("no frame can be read")
    paths = draw(run, frames, Options(arguments.view, arguments.size, arguments.focus,
                                      arguments.colour, arguments.mesh))
    print(f"{len(paths)} pictures in {paths[0].parent}")
    if len(paths) > 1 and not arguments.no_film:
        path = paths[0].with_name("film_mesh.mp4" if arguments.mesh else "film.mp4")
        film(paths, path, arguments.fps or real_time(run, frames))
        print(f"film: {path}")


if __name__ == "__main__":
    run_command(main)
