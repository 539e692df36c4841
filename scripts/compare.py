#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Compares runs: a table of the liquid's height and width over time, and a plot of both;
for runs in two dimensions also their final outlines over one another.

    scripts/compare.py OUT.png LABEL=DIRECTORY ...
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def main():
    parser = new_parser(__doc__)
    parser.add_argument("picture", metavar="OUT.png")
    parser.add_argument("runs", metavar="LABEL=DIRECTORY", nargs="+")
    arguments = parser.parse_args()
    from treacle.comparison import extent_table, plot_extents, read_entry
    entries = [read_entry(text) for text in arguments.runs]
    print(extent_table(entries))
    plot_extents(arguments.picture, entries)


if __name__ == "__main__":
    run_command(main)
