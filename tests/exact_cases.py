# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Exact cases on their coarsest mesh, on 1, 2 and 3 ranks: their errors must be those of
exact_cases.output, on any number of ranks. Usage: exact_cases.py path/to/treacle [--write]"""

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from treacle.verification.results import CASES  # noqa: E402
from treacle.verification.runs import run  # noqa: E402

# name, level or None for the coarsest of scripts/verify
COARSE = [("A6", None), ("A6 exponential, cut", None), ("B2 cut wall", None), ("B5", None), ("C2 fall", None), ("C2 flight", None),
          ("C2 rotation", None), ("C3 k pi, h 0.5, nu 1", None), ("C5", None), ("C9b", None),
          ("B4", 2), ("C2 fall 3D", 3), ("B9", None), ("B12", None), ("C15", None)]
EXPECTED = Path(__file__).with_suffix(".output")
TOLERANCE = 1e-5  # of errors relative to the exact value; solvers stop at 1e-10
TIGHT = {f"Linear solvers/{name}/Relative tolerance": "1e-10"
         for name in ("Viscosity", "Pressure", "Face fit", "Coupled")}


def errors_of(program, ranks, name, level):
    """Lines of case, quantity and error."""
    case = CASES[name]
    level = level or case.first_level
    step = case.time_step * 0.5 ** (level - case.first_level)
    errors = run(case, level, step, TIGHT, program, ranks)["errors"]
    return [(f"{name}; {quantity}", error) for quantity, error in errors.items()]


def measured(program, ranks):
    """The same of all cases; runs of one rank two at a time."""
    with ThreadPoolExecutor(2 if ranks == 1 else 1) as pool:
        for lines in pool.map(lambda case: errors_of(program, ranks, *case), COARSE):
            yield from lines


def main():
    program = sys.argv[1]
    if "--write" in sys.argv:
        EXPECTED.write_text("".join(f"{what}: {error:+.6f}\n" for what, error in measured(program, 1)))
        return
    expected = dict(line.rsplit(": ", 1) for line in EXPECTED.read_text().splitlines())
    n_failed = 0
    for ranks in (1, 2, 3):
        seen = dict(measured(program, ranks))
        if seen.keys() != expected.keys():
            sys.exit(f"other quantities: {sorted(seen.keys() ^ expected.keys())}")
        for what, error in seen.items():
            if not abs(error - float(expected[what])) <= TOLERANCE:
                n_failed += 1
                print(f"{ranks} ranks, {what}: {error:+.6f}, expected {expected[what]}")
    print(f"{3 * len(expected) - n_failed} of {3 * len(expected)} errors as expected")
    sys.exit(n_failed > 0)


if __name__ == "__main__":
    main()
