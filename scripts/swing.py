#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Follows the centre of a falling stream at some height: how a rope coils and a sheet folds.

    scripts/swing.py DIRECTORY HEIGHT [--from TIME] [--plot FILE.png]

Prints time and centre of each frame's cut (the mean along the curve in which the height cuts
the surface), then what coiling and folding theory speak of: revolutions about the mean centre,
their frequency and mean radius, and reversals of x with their frequency. HEIGHT in m; --from
leaves out what came before.
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def report(times, centres):
    from treacle.stream import coiling, folding
    for t, (x, y) in zip(times, centres):
        print(f"{t:10.4f} {x:12.6f} {y:12.6f}")
    coil, fold = coiling(times, centres), folding(times, centres)
    print(f"revolutions {coil.revolutions:.2f} in {times[-1] - times[0]:.3f} s: "
          f"frequency {coil.frequency:.3f} 1/s, angular {2 * math.pi * coil.frequency:.2f} rad/s, "
          f"mean radius {coil.radius:.4g} m")
    if fold:
        print(f"reversals of x {fold.n_reversals}: folding frequency {fold.frequency:.3f} 1/s, "
              f"mean amplitude {fold.amplitude:.4g} m")
    print(f"mean centre {centres[:, 0].mean():.4g}, {centres[:, 1].mean():.4g} m")


def main():
    parser = new_parser(__doc__)
    parser.add_argument("directory", metavar="DIRECTORY")
    parser.add_argument("height", metavar="HEIGHT", type=float)
    parser.add_argument("--from", dest="start", metavar="TIME", type=float, default=0)
    parser.add_argument("--plot", metavar="FILE.png")
    options = parser.parse_args()
    from treacle import Run
    from treacle.stream import plot, track
    times, centres = track(Run(options.directory), options.height, options.start)
    report(times, centres)
    if options.plot:
        plot(options.plot, times, centres)


if __name__ == "__main__":
    run_command(main)
