# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where the time of a run went."""

import re
from pathlib import Path
from typing import NamedTuple

from treacle.errors import DataError


class Timing(NamedTuple):
    """What timing.txt says of a run."""

    seconds: dict  # of wall time in the sections, "Total" among them
    memory: int    # MiB, peak of all ranks
    work: dict     # what was counted, of all ranks: "cells made", ...


def read_timing(directory):
    """The Timing of the run in an output directory. Raises DataError if there is none."""
    path = Path(directory) / "timing.txt"
    try:
        text = path.read_text()
    except OSError:
        raise DataError(f"there is no file '{path}': runs write it at their end") from None
    seconds = re.findall(r"^(\S.*?) +\d+ +([0-9.]+) s", text, re.M)
    counts = re.findall(r"^(\S.*?) {2,}(\d+)$", text.partition("\nWork ")[2], re.M)
    memory = re.search(r"^Peak memory: (\d+)", text, re.M)
    if not seconds or not memory:
        raise DataError(f"'{path}' is not the timing of a run")
    return Timing({name: float(value) for name, value in seconds}, int(memory[1]),
                  {name: int(value) for name, value in counts})
