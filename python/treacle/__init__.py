# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What runs of Treacle leave behind, for Python; lengths are in m, times in s.

    from treacle import Run

    run = Run("results/column")
    run.parameters["Material/Viscosity"]            # text, as in the parameter file
    run.statistics["Kinetic energy (J)"]            # an array with a value a time step
    surface = run.surface(run.frame_at(0.4))        # points, facets, velocity

Pictures are in treacle.render, plots of several runs in treacle.comparison, cases with known
solutions in treacle.verification. These need matplotlib, SciPy or VTK; this module needs NumPy
alone, except Run.mesh(), which needs VTK."""

from treacle.errors import DataError
from treacle.parameters import read_parameters
from treacle.run import Run, Solid
from treacle.statistics import Statistics, read_statistics
from treacle.surface import Surface, read_surface
from treacle.timing import read_timing

__all__ = ["DataError", "Run", "Solid", "Statistics", "Surface", "read_parameters",
           "read_statistics", "read_surface", "read_timing"]
