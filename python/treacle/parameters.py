# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Reads parameter files."""

from pathlib import Path

from treacle.errors import DataError


def read_parameters(path):
    """The parameters of a file as a dictionary from 'Section/Name' to text.

    Raises DataError if the file cannot be read."""
    try:
        text = Path(path).read_text()
    except FileNotFoundError:
        raise DataError(f"there is no file '{path}'") from None
    except (OSError, UnicodeDecodeError) as error:
        raise DataError(f"'{path}' cannot be read: {error}") from None
    result, sections = {}, []
    for line in text.replace("\\\n", " ").splitlines():
        line = line.split("#")[0].strip()
        if line.startswith("subsection "):
            sections.append(line.split(None, 1)[1])
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set ") and "=" in line:
            name, value = line[4:].split("=", 1)
            result["/".join(sections + [name.strip()])] = value.strip()
    return result
