# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Where the repository is that holds this package: for what is measured and drawn in it."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
