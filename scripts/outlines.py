#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Draws the outlines of several two-dimensional runs over one another, and the
liquid's height against time; prints height, width and area.

    scripts/outlines.py OUT.png LABEL=DIRECTORY[:FRAME] ...     (default: the last frame)
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def main():
    parser = new_parser(__doc__)
    parser.add_argument("picture", metavar="OUT.png")
    parser.add_argument("runs", metavar="LABEL=DIRECTORY[:FRAME]", nargs="+")
    arguments = parser.parse_args()
    from treacle.comparison import outline_table, plot_outlines, read_entry
    entries = [read_entry(text) for text in arguments.runs]
    print(outline_table(entries))
    for text in plot_outlines(arguments.picture, entries):
        print(f"outlines: {text}", file=sys.stderr)


if __name__ == "__main__":
    run_command(main)
