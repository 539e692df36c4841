# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""The exact cases by name, what was measured of them (doc/verification/results.json), and
the verdict on it."""

import json
import math
import os
import re
from dataclasses import dataclass

from treacle import read_parameters
from treacle.repository import ROOT
from treacle.verification.cases import Program
from treacle.verification.fixed_surface_cases import CLOSED_CASES, VISCOUS_CASES
from treacle.verification.free_surface_cases import FREE_SURFACE_CASES

FILE = ROOT / "doc/verification/results.json"
CASES = {**VISCOUS_CASES, **CLOSED_CASES, **FREE_SURFACE_CASES}
DEFAULT_MAPPING = read_parameters(ROOT / "doc/parameters.prm")["Viscosity/Mapping"]

ENERGY_TOLERANCE = 0.01   # gained, over the largest kinetic energy plus the range of the potential one
VOLUME_TOLERANCE = 0.005  # drift
NEGLIGIBLE = 0.001        # an error that need not fall any more


def rounded(value):
    """With numbers of 4 digits; None for those that are none."""
    if isinstance(value, dict):
        return {name: rounded(v) for name, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(v) for v in value]
    if isinstance(value, (str, int)):
        return value
    return float(f"{value:.4g}") if math.isfinite(value) else None


def load():
    """Of the cases that there are, in their order."""
    stored = json.loads(FILE.read_text()) if FILE.exists() else {}
    return {name: stored[name] for name in CASES if name in stored}


def one_line(numbers):
    return "[" + " ".join(numbers[0][1:-1].split()) + "]"


def store(name, result):
    """In place of what is kept of this case; a kill loses nothing."""
    text = json.dumps({**load(), name: result}, indent=1, sort_keys=True)
    text = re.sub(r"\[[^][{}]*\]", one_line, text)
    FILE.parent.mkdir(exist_ok=True)
    temporary = FILE.with_suffix(".tmp")
    temporary.write_text(text + "\n")
    os.replace(temporary, FILE)


@dataclass
class Row:
    """A quantity of a case."""
    name: str
    quantity: str
    errors: list
    tolerance: float
    required_order: float  # or None
    is_absolute: bool
    is_target: bool        # or for comparison alone

    @property
    def orders(self):
        return [order(a, b) for a, b in zip(self.errors, self.errors[1:])]

    @property
    def excess(self):
        """The error on the finest mesh, in tolerances."""
        return abs(self.errors[-1]) / self.tolerance if self.errors[-1] is not None else math.inf

    @property
    def held_to(self):
        return format_error(self.tolerance, self.is_absolute).lstrip("+") if self.is_target else ""

    def verdict(self):
        if not self.is_target:
            return ""
        error = self.errors[-1]
        if error is None:
            return "not reached: no number"
        if abs(error) > self.tolerance:
            return "not reached"
        if self.required_order is None or abs(error) <= NEGLIGIBLE:
            return "reached"
        if len(self.errors) == 1:
            return "within, one mesh"
        mean = order(self.errors[0], error, len(self.errors) - 1)
        return "reached" if mean > self.required_order else "not reached: does not fall"


def rows(name, result):
    """Of a result or a study in time: those quantities that the case still has, in its order;
    what is for comparison comes last."""
    case, found = CASES[name], []
    for key, errors in result.get("errors", {}).items():
        mapping, _, quantity = key.rpartition(": ") if isinstance(case, Program) else ("", "", key)
        if quantity in case.quantities:
            is_target = mapping in ("", DEFAULT_MAPPING)
            found.append(((not is_target, mapping, case.quantities.index(quantity)),
                          Row(name, key, errors, case.target(quantity), case.order,
                              case.is_absolute(quantity), is_target)))
    return [row for _, row in sorted(found, key=lambda pair: pair[0])]


def order(a, b, n=1):
    """By which errors fall with n halvings."""
    return math.log2(abs(a / b)) / n if a and b else math.nan


def limits_exceeded(result):
    """What a case breaks on the finest mesh beside its errors."""
    for name, tolerance in ("energy gain", ENERGY_TOLERANCE), ("volume drift", VOLUME_TOLERANCE):
        values = result.get(name)
        if values and not abs(values[-1] or 0) <= tolerance:
            yield f"{name} above {100 * tolerance:g} %"


def format_error(error, is_absolute):
    if error is None or math.isnan(error):
        return "-"
    if error == 0:
        return "0"
    return f"{error:+.1e}" if is_absolute or abs(error) < 1e-6 else f"{100 * error:+.3g} %"
