# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where the time of a run went."""

import re
from pathlib import Path


def read_timing(directory):
    """Seconds of the sections of a run's timing.txt by name, "Total" among them, and the peak memory
    of all ranks (MiB)."""
    text = (Path(directory) / "timing.txt").read_text()
    seconds = re.findall(r"^(\S.*?) +\d+ +([0-9.]+) s", text, re.M)
    return ({name: float(value) for name, value in seconds},
            int(re.search(r"Peak memory: (\d+)", text)[1]))
