# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What the commands of scripts/ share."""

import argparse
import sys
from pathlib import Path

from treacle.errors import DataError


def new_parser(text):
    """A parser of arguments whose help begins with this text, as it stands."""
    return argparse.ArgumentParser(description=text,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def run_command(main):
    """Calls main() and ends the program: with what it returns as the exit code, or with one
    line where data cannot be used or a library is missing."""
    name = Path(sys.argv[0]).stem
    try:
        sys.exit(main())
    except DataError as error:
        sys.exit(f"{name}: {error}")
    except ImportError as error:
        sys.exit(f"{name}: {error}: see scripts/install_packages, and use /usr/bin/python3")
