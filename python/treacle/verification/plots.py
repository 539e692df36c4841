# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Small multiples of errors of the exact cases: one panel a case."""

import io

import matplotlib
import numpy
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator
from PIL import Image

from treacle.verification.results import rows

COLUMNS = 4
COLOURS = ("#0b6fa4", "#c8511b", "#2a8c4a", "#8a4fa3")
STYLE = {"font.size": 7, "axes.titlesize": 7.5, "axes.titleweight": "bold", "legend.fontsize": 6,
         "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.1,
         "lines.markersize": 3}


def panels(by, results):
    """Title, resolutions and rows of each panel."""
    for name, result in results.items():
        for study in [result] if by == "h" else result.get("in time", ()):
            title = ", ".join([name, *map(str, study["settings"].values())]) if by == "dt" else name
            shown = [row for row in rows(name, study) if row.is_target and row.required_order
                     and len(row.errors) > 1 and None not in row.errors]
            if shown:
                yield title, numpy.array(study[by][:len(shown[0].errors)]), shown


def plot(path, by, results):
    """Whether there is anything to be seen."""
    every = list(panels(by, results))
    if not every:
        return False
    n_rows = -(-len(every) // COLUMNS)
    with matplotlib.rc_context(STYLE):
        figure = Figure((9.6, 2.1 * n_rows + 0.1), layout="constrained")
        axes = figure.subplots(n_rows, COLUMNS, squeeze=False)
        for axis, panel in zip(axes.flat, every):
            draw(axis, by, *panel)
        for axis in axes.flat[len(every):]:
            axis.remove()
        image = io.BytesIO()
        figure.savefig(image, dpi=100)
    Image.open(image).convert("RGB").quantize(128).save(path, optimize=True)  # a third of the size
    return True


def draw(axis, by, title, x, shown):
    shown = sorted(shown, key=lambda row: -abs(row.errors[-1]))
    axis.set(xscale="log", yscale="log", title=title)
    for row in shown[4:]:
        axis.plot(x, absolute(row), "o-", color="0.75", zorder=1)
    for row, colour in zip(shown, COLOURS):
        axis.plot(x, absolute(row), "o-", color=colour, label=row.quantity.rpartition(": ")[2], zorder=3)
    top = max(absolute(row)[0] for row in shown)
    for order in 1, 2:
        axis.plot(x, top * (x / x[0]) ** order, "--", color="0.5", linewidth=0.6, zorder=2)
    for tolerance in {row.tolerance for row in shown}:
        axis.axhline(tolerance, linestyle=":", color="black", linewidth=0.8)
    axis.xaxis.set(major_locator=FixedLocator(x), minor_locator=NullLocator(),
                   major_formatter=FuncFormatter(lambda value, _: f"{value:.3g}"))
    axis.yaxis.set(major_locator=LogLocator(subs=(1, 3)), minor_locator=NullLocator(),
                   major_formatter=FuncFormatter(lambda value, _: f"{100 * value:.3g} %"))
    axis.set_xlabel("h (m)" if by == "h" else "time step (s)", labelpad=1)
    axis.legend(framealpha=0.7, edgecolor="none", handlelength=1.2, labelspacing=0.2, borderpad=0)


def absolute(row):
    """An error of exactly 0 has no place on a logarithmic axis."""
    return numpy.maximum(numpy.abs(row.errors), 1e-9)
