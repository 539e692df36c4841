# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where to draw in three dimensions."""

import os
import shutil
import sys
from pathlib import Path

from treacle.errors import DataError


def restart_with_display():
    """Returns where there is a display; else starts this command anew, in its place, with one
    that nobody sees. Raises DataError if that cannot be had."""
    if os.environ.get("DISPLAY"):
        return
    if not shutil.which("xvfb-run"):
        raise DataError("3D pictures need a display or xvfb-run (package xvfb)")
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable,
                           str(Path(sys.argv[0]).resolve()), *sys.argv[1:]])
