# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Makes doc/verification.md, and the plots in it, of what was measured of the exact cases."""

import math
import re

from treacle.repository import ROOT
from treacle.verification.plots import plot
from treacle.verification.results import (CASES, DEFAULT_MAPPING, ENERGY_TOLERANCE, NEGLIGIBLE,
                                          VOLUME_TOLERANCE, format_error, limits_exceeded, load,
                                          rows)

DOCUMENT = ROOT / "doc/verification.md"
DIRECTORY = ROOT / "doc/verification"
SECTIONS = {"A": "the viscous step alone", "B": "closed or fixed regions",
            "C": "free surfaces"}

INTRODUCTION = f"""# Verification

<!-- Made by scripts/verify --render; what is written by hand is in doc/verification/discussion.md. -->

Cases with a known solution or a reference, each run on meshes of several resolutions with the
default parameters. `scripts/verify --write CASE` measures a case again and makes this page;
without a case it runs all. `scripts/verify CASE` prints the table alone, with
`--set 'Section/Name=value'` to compare options; `--list` names the cases. Parameter files are in
`prm/verification`, each with its exact values; some cases of a single viscous step are programs
of `tests/`. What was measured is kept in [verification/results.json](verification/results.json).

*Errors* are relative to the exact value, from the coarsest mesh to the finest: a level halves
the leaves, and the time step with them. Those without "%" are absolute, where the exact value is
0, or too small for per cent. *Orders* are those by which errors fall from one mesh to the next.
*Drift* of the volume and *energy* gained are those on the finest mesh; energy is the largest rise
of the total energy above anything it was before, over the largest kinetic energy plus the range
of the potential one. *Seconds* are those on the finest mesh, on one core; of a program, all.

*Verdict*: "reached" if on the finest mesh the error is at most what it is *held to*, and falls at
a mean order above 0.5 (A7: 1.5) or is below {100 * NEGLIGIBLE:g} %. It also says where a case gains more
than {100 * ENERGY_TOLERANCE:g} % of energy, or its volume drifts by more than {100 * VOLUME_TOLERANCE:g} %.
What is conserved is held to the tolerance of the solvers, C9 to 5 % of lubrication theory, C9e to
the 10 % of the measurement. Mappings other than `{DEFAULT_MAPPING}` have no verdict.
"""


def render():
    results = load()
    parts = [INTRODUCTION]
    for letter, title in SECTIONS.items():
        parts.append(section(letter, title, {name: result for name, result in results.items()
                                             if name.startswith(letter)}))
    parts += [worst_five(results), discussion()]
    missing = [name for name in CASES if name not in results]
    if missing:
        parts.insert(1, f"Not measured yet: {'; '.join(missing)}.\n")
    DOCUMENT.write_text("\n".join(parts))


def section(letter, title, results):
    parts = [f"## {letter}. {title[0].upper()}{title[1:]}\n"]
    if not results:
        return parts[0]
    parts += ["| case | levels | quantity | errors | orders | held to | drift | energy | seconds | verdict |",
              "|---" * 10 + "|"]
    for name, result in results.items():
        parts += table_of_case(name, result)
    parts += notes(results)
    parts += picture(letter, "h", results, "Error against the edge h of a leaf.")
    others = [line(name, row.quantity, errors_text(row), orders_text(row))
              for name, result in results.items() for row in rows(name, result) if not row.is_target]
    if others:
        parts += ["\nOther mappings, for comparison.\n",
                  "| case | quantity | errors | orders |", "|---" * 4 + "|", *others]
    studies = [text for name, result in results.items() for text in table_in_time(name, result)]
    if studies:
        parts += ["\nOn a fixed mesh, with the time step halved. The order is that of the differences; "
                  "'dt = 0' is the error they lead to, which is that of the mesh.\n",
                  "| case | level | time steps | quantity | errors | order | dt = 0 |", "|---" * 7 + "|",
                  *studies,
                  *picture(letter, "dt", results, "Error against the time step on a fixed mesh.")]
    return "\n".join(parts) + "\n"


def table_of_case(name, result):
    case = CASES[name]
    first = [f"[{name}](../{case.path}) {case.file.split('/')[-1].replace('_', ' ')}",
             ", ".join(map(str, result.get("levels", ())))]
    ends = [*(format_error((result.get(what) or [math.nan])[-1], False)
              for what in ("volume drift", "energy gain")),
            f"{(result.get('seconds') or [math.nan])[-1]:.3g}"]
    wrong = ["failed"] if "failed" in result else list(limits_exceeded(result))
    for row in filter(lambda row: row.is_target, rows(name, result)):
        verdict = "; ".join([*([] if "failed" in result else [row.verdict()]), *wrong])
        yield line(*first, row.quantity, errors_text(row), orders_text(row), row.held_to, *ends, verdict)
        first, ends, wrong = ["", ""], ["", "", ""], ["failed"] if "failed" in result else []
    if first[0]:
        yield line(*first, "", "", "", "", *ends, "; ".join(wrong))


def notes(results):
    for name, result in results.items():
        if "failed" in result:
            yield f"\n{name} failed: `{result['failed']}`"
        if any(result.get("fallbacks", ())):
            yield (f"\n{name}: coupled solves taken by the split, by resolution: "
                   f"{', '.join(map(str, result['fallbacks']))}.")


def table_in_time(name, result):
    for study in result.get("in time", ()):
        title = ", ".join([name, *map(str, study["settings"].values())])
        first = [title, str(study["level"]), ", ".join(f"{dt:g}" for dt in study["dt"])]
        for row in rows(name, study):
            p, limit = extrapolated(row.errors)
            yield line(*first, row.quantity, errors_text(row), f"{p:.2f}" if p is not None else "-",
                       format_error(limit, row.is_absolute))
            first = ["", "", ""]


def extrapolated(errors):
    """Order in time of three errors, and the error for no time step; None where the
    differences do not fall as they should."""
    if len(errors) != 3 or None in errors:
        return None, None
    a, b = errors[0] - errors[1], errors[1] - errors[2]
    if a * b <= 0:
        return None, None
    p = math.log2(a / b)
    return p, errors[2] - b / (2 ** p - 1) if p > 0.3 else None


def worst_five(results):
    worst = {}
    for name, result in results.items():
        for row in rows(name, result):
            if row.is_target and "failed" not in result and (
                    name not in worst or row.excess > worst[name].excess):
                worst[name] = row
    worst = sorted(worst.values(), key=lambda row: -row.excess)[:5]
    return "\n".join(["## The worst five\n",
                      "The largest error on the finest mesh over what it is held to, one a case.\n",
                      "| | case | quantity | error | held to | ratio |", "|---" * 6 + "|",
                      *(line(str(k), row.name, row.quantity,
                             format_error(row.errors[-1], row.is_absolute), row.held_to, f"{row.excess:.2g}")
                        for k, row in enumerate(worst, 1))]) + "\n"


def discussion():
    """Its links are from its own directory; those of the page are from the directory above."""
    text = (DIRECTORY / "discussion.md").read_text()
    return re.sub(r"\]\((\.\./)?(?!http)", lambda link: "](" if link[1] else "](verification/", text)


def picture(letter, by, results, caption):
    path = DIRECTORY / f"{letter}_{by}.png"
    if not plot(path, by, results):
        path.unlink(missing_ok=True)
        return []
    return [f"\n![{caption}](verification/{path.name})\n",
            f"{caption} Dashed: first and second order; dotted: what it is held to. Coloured: the "
            "four largest of a case; grey: the others."]


def errors_text(row):
    texts = [format_error(error, row.is_absolute) for error in row.errors]
    if all(text.endswith(" %") for text in texts):
        texts = [text[:-2] for text in texts[:-1]] + texts[-1:]
    return ", ".join(texts)


def orders_text(row):
    if not row.required_order:
        return ""
    return ", ".join("-" if math.isnan(p) else f"{p:.2f}" for p in row.orders)


def line(*cells):
    return "| " + " | ".join(cells) + " |"


def terminal_table(name, result):
    levels = result.get("levels", ())
    lines = [line(name, *(f"level {level}" for level in levels), "orders", "held to", "verdict"),
             "|---" * (len(levels) + 4) + "|"]
    lines += [line(row.quantity, *(format_error(error, row.is_absolute) for error in row.errors),
                   orders_text(row), row.held_to, row.verdict()) for row in rows(name, result)]
    for what in "volume drift", "energy gain":
        values = result.get(what, ())
        if any(abs(value or 0) > 1e-9 for value in values):
            lines.append(line(what, *(format_error(value, False) for value in values), "", "", ""))
    studies = list(table_in_time(name, result))
    if studies:
        lines += ["", line("on a fixed mesh", "level", "time steps", "quantity", "errors", "order",
                           "dt = 0"), "|---" * 7 + "|", *studies]
    return "\n".join(lines) + "\n"
