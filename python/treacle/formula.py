# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Formulas of parameter files, for pictures."""

import math
import re

from treacle.errors import DataError

FUNCTIONS = {**{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh",
                                                       "tanh", "exp", "sqrt", "floor", "ceil", "pow")},
             "ln": math.log, "abs": abs, "min": min, "max": max, "pi": math.pi, "_pi": math.pi, "_e": math.e,
             "when": lambda condition, yes, no: yes if condition else no}


def formula(text, *variables):
    """A function of these variables, which are numbers, from a formula of a parameter file; DataError where it is not
    understood here."""
    python = re.sub(r"\bif\s*\(", "when(", text.strip()).replace("^", "**")
    python = python.replace("&&", " and ").replace("||", " or ")
    number = r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    names = set(re.findall(r"[A-Za-z_]\w*", re.sub(number, "", python))) - {"and", "or"}
    try:
        if not names <= {*FUNCTIONS, *variables} or not re.fullmatch(r"[\w\s.,()+\-*/<>=!]+", python):
            raise SyntaxError
        code = compile(f"lambda {', '.join(variables)}: float({python})", "formula", "eval")
    except SyntaxError:
        raise DataError(f"pictures do not understand the formula '{text}'") from None
    return eval(code, {"__builtins__": {}, "float": float, **FUNCTIONS})
