# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Reads the table `statistics` that a run writes, one row a time step.

    from statistics import read_statistics
    read_statistics("results/coiling")["Liquid volume (m^d)"]
"""

import re
from pathlib import Path

import numpy


def read_statistics(path):
    """Columns of the table by name, as arrays. `path`: the file or its directory."""
    path = Path(path)
    if path.is_dir():
        path = path / "statistics"
    names, rows = [], []
    for line in path.read_text().splitlines():
        header = re.match(r"#\s*\d+:\s*(.*\S)", line)
        if header:
            names.append(header[1])
        elif line.strip() and not line.startswith("#"):
            rows.append(line.split())
    rows = [row for row in rows if len(row) == len(names)]  # the last may be half written
    columns = zip(*rows) if rows else [[] for _ in names]
    return {name: _as_array(column) for name, column in zip(names, columns)}


def _as_array(column):
    try:
        return numpy.array(column, dtype=float)
    except ValueError:
        return numpy.array(column)
