# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Cases with known solutions, for scripts/verify: what is exact (cases, fixed_surface_cases,
free_surface_cases), what is measured of a run (measures), how a case is run at several
resolutions (runs, survey), what was measured and the verdict on it (results), and the pages
of doc/ made of that (report, plots)."""
