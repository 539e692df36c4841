# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""What an exact case is: what runs, what is exact, and the target it is held to."""

from dataclasses import dataclass, field

EULER = {"Time scheme": "backward Euler"}
SPLIT = {"Viscosity/Pressure coupling": "split"}
FIRST_PROJECTION = {"Viscosity/Pressure coupling": "split with first projection"}


@dataclass
class Case:
    """A parameter file; mesh and time step are refined together."""
    file: str         # of prm/verification
    first_level: int  # of the coarsest resolution
    time_step: float  # there (s); halved with every level
    exact: dict       # name of a quantity: (function of the results, exact value)
    settings: dict = field(default_factory=dict)
    tolerance: float = 0.01   # of the error on the finest mesh
    order: float = 0.5        # to be exceeded; None: the error need not fall
    n_levels: int = 9         # at most
    # settings, each with which time_step, 1/2 and 1/4 of it are run on a fixed mesh: first_level + 1
    in_time: tuple = ()

    @property
    def path(self):
        return f"prm/verification/{self.file}.prm"

    @property
    def quantities(self):
        return list(self.exact)

    def target(self, quantity):
        return self.tolerance

    def is_absolute(self, quantity):
        """Not relative to the exact value, which is 0."""
        return self.exact[quantity][1] == 0


@dataclass
class Program:
    """A program of tests/ that prints errors; with "{level}" among the arguments it is
    run once a level, else the levels follow them."""
    file: str         # of tests
    arguments: tuple
    first_level: int
    tolerances: dict  # of the quantities, in the order of the numbers of a line
    settings: dict = field(default_factory=dict)
    order: float = 0.5
    n_levels: int = 9

    @property
    def path(self):
        return f"tests/{self.file}.cc"

    @property
    def quantities(self):
        return list(self.tolerances)

    def target(self, quantity):
        return self.tolerances[quantity]

    def is_absolute(self, quantity):
        return False
