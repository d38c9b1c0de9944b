# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The picture of a law: the program as points, closed forms as lines."""
from __future__ import annotations

import io
from pathlib import Path

from matplotlib import ticker
from PIL import Image  # with matplotlib, which needs it

from periporo_tools.material_curves.comparison import Panel
from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PALE, RED, plt

_MARKERS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (RED, "D"))
_APART = 0.045  # of a panel's diagonal, between the points that are drawn of a long path
_ALL = 30  # points that are all drawn
_COLOURS = 64  # enough for lines and letters, and a third of the size


def _draw_panel(axes, panel: Panel) -> None:
    for name, line in panel.context.items():
        axes.plot(*line, color=PALE, linewidth=1.2, label=name)
    for number, curve in enumerate(panel.curves):
        axes.plot(*curve.line, color=INK, linewidth=1.1, label=panel.formula if number == 0 else None, zorder=2)
    for (colour, marker), curve in zip(_MARKERS, panel.curves, strict=False):
        axes.plot(
            *curve.points, marker, color=colour, markersize=4, markerfacecolor="white", markeredgewidth=1.1,
            markevery=_APART if curve.found.size > _ALL else 1, label=curve.name, zorder=3,
        )
    axes.set(title=panel.title, xlabel=panel.x_label, ylabel=panel.y_label)
    axes.grid(color=PALE, linewidth=0.4, alpha=0.6)
    if panel.logarithmic:
        axes.set_xscale("log")
        least, most = axes.get_xlim()
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0) if most < 100.0 * least else (1.0,)))
        axes.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    if panel.downwards:
        axes.invert_yaxis()
    if panel.same_scale:
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="upper left", bbox_to_anchor=(-0.05, -0.17), handlelength=1.5, labelspacing=0.25)


def draw(panels: list[Panel], picture: Path) -> Path:
    """All panels of a law in a row, each with its legend below."""
    figure, axes = plt.subplots(1, len(panels), figsize=(1.5 + 3.1 * len(panels), 4.4), dpi=110, layout="constrained")
    for place, panel in zip(axes, panels):
        _draw_panel(place, panel)
    figure.get_layout_engine().set(wspace=0.06)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", facecolor="white")
    plt.close(figure)
    aside = picture.with_suffix(".png.part")
    Image.open(drawn).convert("RGB").quantize(_COLOURS, dither=Image.Dither.NONE).save(aside, "PNG", optimize=True)
    aside.replace(picture)
    return picture
