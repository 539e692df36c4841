# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The one error for what a user can get wrong."""


class DataError(Exception):
    """The data is missing or cannot be used; the message is one line."""
