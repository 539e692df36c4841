# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Runs beside one another: heights and widths of the liquid over time, and its outlines in two
dimensions; tables and plots."""

from typing import NamedTuple

import numpy
from matplotlib.figure import Figure

from treacle.errors import DataError
from treacle.outline import area, outline_of
from treacle.render.pictures_2d import draw_box
from treacle.run import Run

N_TIMES = 7  # of the table of heights and widths


class Entry(NamedTuple):
    label: str
    run: Run
    frame: int  # None for the last

    def outline(self):
        """The polygons of the liquid in the frame, in two dimensions."""
        if self.run.dim != 2:
            raise DataError(f"'{self.run.directory}' is a run in {self.run.dim} dimensions, not 2")
        return outline_of(self.run, self.chosen_frame())

    def chosen_frame(self):
        return self.run.frames[-1] if self.frame is None else self.frame

    def time(self):
        """Of the frame (s)."""
        return self.run.time(self.chosen_frame())


def read_entry(text):
    """The Entry that LABEL=DIRECTORY[:FRAME] names. Raises DataError."""
    label, _, place = text.partition("=")
    directory, colon, frame = place.rpartition(":")
    if not label or not place or (colon and not frame.isdigit()):
        raise DataError(f"'{text}' is not LABEL=DIRECTORY[:FRAME]")
    return Entry(label, Run(directory), int(frame)) if colon else Entry(label, Run(place), None)


class Extent:
    """Height and width (m) of a run's liquid over time (s), each (n_steps,)."""

    def __init__(self, run):
        table, up = run.statistics, "xyz"[run.dim - 1]
        self.time = table["Time (s)"]
        self.height = table[f"Liquid maximum {up} (m)"]
        self.width = table["Liquid maximum x (m)"] - table["Liquid minimum x (m)"]
        if len(self.time) == 0:
            raise DataError(f"'{table.path}' has no rows")

    def at(self, times, values):
        """Interpolated; nan after the end of the run."""
        return numpy.interp(times, self.time, values, right=numpy.nan)


def extent_table(entries):
    """Heights and widths at some times, in markdown."""
    extents = {entry.label: Extent(entry.run) for entry in entries}
    times = numpy.linspace(0, max(e.time[-1] for e in extents.values()), N_TIMES)
    lines = []
    for name in "height", "width":
        lines += ["", f"| {name} (m) | " + " | ".join(f"t = {t:.2f} s" for t in times) + " |",
                  "|---" * (N_TIMES + 1) + "|"]
        for label, extent in extents.items():
            values = extent.at(times, getattr(extent, name))
            lines.append(f"| {label} | " + " | ".join(f"{v:.4f}" for v in values) + " |")
    return "\n".join(lines)


def plot_extents(path, entries):
    """Heights and widths over time; where all runs are in two dimensions, the outlines too."""
    is_flat = all(entry.run.dim == 2 for entry in entries)
    figure = Figure((14 if is_flat else 9, 4), dpi=110, layout="constrained")
    axes = figure.subplots(1, 3 if is_flat else 2)
    for k, entry in enumerate(entries):
        extent = Extent(entry.run)
        axes[-2].plot(extent.time, extent.height, color=f"C{k}", linewidth=1.4, label=entry.label)
        axes[-1].plot(extent.time, extent.width, color=f"C{k}", linewidth=1.4, label=entry.label)
        if is_flat:
            draw_outline(axes[0], entry._replace(frame=None), f"C{k}", 1.4)
    if is_flat:
        draw_box(axes[0], entries[0].run, entries[0]._replace(frame=None).time())
        axes[0].set(xlabel="x (m)", ylabel="y (m)", title="at the end")
        axes[0].set_ylim(top=axes[0].get_ylim()[0] + 0.6 * numpy.ptp(axes[0].get_xlim()))
    axes[-2].set(xlabel="time (s)", ylabel="height (m)")
    axes[-1].set(xlabel="time (s)", ylabel="width (m)")
    axes[-1].legend(frameon=False)
    for plot in axes:
        open_frame(plot)
    figure.savefig(path)


def outline_table(entries):
    """Time, height, width and area of the liquid in a frame of runs in two dimensions."""
    lines = [f"{'run':<24} {'time s':>10} {'height m':>10} {'width m':>10} {'area m^2':>10}"]
    for entry in entries:
        loops = entry.outline()
        cloud = numpy.concatenate(loops) if loops else numpy.zeros((1, 2))
        width, height = numpy.ptp(cloud, axis=0)
        lines.append(f"{entry.label:<24} {entry.time():10.4f} "
                     f"{height:10.5f} {width:10.5f} {sum(map(area, loops)):10.6f}")
    return "\n".join(lines)


def plot_outlines(path, entries):
    """Outlines over one another, and heights over time; returns a line for each run whose
    heights are not known."""
    figure = Figure((13, 5), dpi=120, layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [3, 2]})
    missing = []
    draw_box(left, entries[0].run, entries[0].time())
    for k, entry in enumerate(entries):
        draw_outline(left, entry, f"C{k}", 1.6)
        try:
            extent = Extent(entry.run)
            right.plot(extent.time, extent.height, color=f"C{k}", linewidth=1.6, label=entry.label)
        except DataError as error:
            missing.append(str(error))
    left.set(xlabel="x (m)", ylabel="y (m)")
    left.legend(frameon=False, ncol=4, loc="lower right", bbox_to_anchor=(1, 1))
    right.set(xlabel="time (s)", ylabel="liquid height (m)")
    open_frame(right)
    figure.savefig(path)
    return missing


def draw_outline(axes, entry, colour, line_width):
    for k, loop in enumerate(entry.outline()):
        axes.plot(*numpy.vstack([loop, loop[:1]]).T, color=colour, linewidth=line_width,
                  label=None if k else entry.label)


def open_frame(axes):
    axes.grid(alpha=0.3)
    for side in "top", "right":
        axes.spines[side].set_visible(False)
