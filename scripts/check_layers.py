#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Checks that the house has one direction: a file includes only what stands in its own room
or in a group before it (treacle.layers.GROUPS); rooms of one group do not know each other,
and modules (x.h with x.cc) form no cycle.

    scripts/check_layers.py [ROOT]    prints the offending lines, exit code 1 if any
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from treacle.command import new_parser, run_command  # noqa: E402


def main():
    parser = new_parser(__doc__)
    parser.add_argument("root", metavar="ROOT", nargs="?", type=Path)
    arguments = parser.parse_args()
    from treacle.layers import problems
    from treacle.repository import ROOT
    found = list(problems(arguments.root or ROOT))
    print("\n".join(found) if found else "rooms: in order")
    return 1 if found else 0


if __name__ == "__main__":
    run_command(main)
