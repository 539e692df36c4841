# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Reads the table `statistics` that a run writes, one row a time step."""

import re
from pathlib import Path

import numpy

from treacle.errors import DataError


class Statistics(dict):
    """The columns of the table: arrays of one shape (n_steps,) by name, as in
    "Liquid maximum x (m)"; the name holds the unit. Reading a column that is not there
    raises DataError."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, name):
        raise DataError(f"'{self.path}' has no column '{name}'")


def read_statistics(path):
    """The Statistics of a run; `path` is the file or its directory. A row that is being
    written is left out.

    Raises DataError if there is no such file, or no table in it."""
    path = Path(path)
    if path.is_dir():
        path = path / "statistics"
    try:
        text = path.read_text()
    except FileNotFoundError:
        raise DataError(f"there is no '{path}'") from None
    except (OSError, UnicodeDecodeError) as error:
        raise DataError(f"'{path}' cannot be read: {error}") from None
    names, rows = [], []
    for line in text[:text.rfind("\n") + 1].splitlines():
        header = re.match(r"#\s*\d+:\s*(.*\S)", line)
        if header:
            names.append(header[1])
        elif line.strip() and not line.startswith("#"):
            rows.append(line.split())
    if not names:
        raise DataError(f"'{path}' is not a table of statistics")
    rows = [row for row in rows if len(row) == len(names)]
    columns = zip(*rows) if rows else [[] for _ in names]
    return Statistics(path, {name: _as_array(column) for name, column in zip(names, columns)})


def _as_array(column):
    try:
        return numpy.array(column, dtype=float)
    except ValueError:
        return numpy.array(column)
