# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The table and the page of pictures of a verification."""
from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from periporo_tools.verification.outcome import Curve, Refinement, Row

_HEAD = ("", "case", "quantity", "expected", "found", "difference", "tolerance", "reason of the tolerance")


def _number(value: float, unit: str) -> str:
    return f"{value:.5g}" + ("" if unit == "-" else f" {unit}")


def table(rows: list[Row]) -> str:
    """Aligned columns, a line a row; rows outside their tolerance begin with FAIL."""
    lines = [_HEAD]
    for row in rows:
        sign = "" if row.absolute else " rel."
        lines.append(
            ("ok" if row.holds else "FAIL", row.name, row.quantity, _number(row.expected, row.unit),
             _number(row.found, row.unit), f"{row.difference:+.1e}{sign}", f"{row.tolerance:.1e}", row.reason)
        )
    widths = [max(len(line[column]) for line in lines) for column in range(len(_HEAD))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in lines)


def records(rows: list[Row]) -> list[dict]:
    """For machines."""
    return [
        {
            "name": row.name, "quantity": row.quantity, "unit": row.unit, "expected": row.expected, "found": row.found,
            "difference": row.difference, "relative": not row.absolute, "tolerance": row.tolerance,
            "reason": row.reason, "holds": row.holds,
        }
        for row in rows
    ]


def write_json(rows: list[Row], path: Path) -> None:
    aside = path.with_name(path.name + ".part")
    aside.write_text(json.dumps(records(rows), indent=2) + "\n")
    aside.replace(path)


def _refinement_panel(refinements: list[Refinement]) -> Curve:
    """All refinements, with the slopes of first and second order through the first one's coarsest point."""
    first = refinements[0]
    ratio = first.spacings / first.spacings[0]
    guides = [
        (name, 1e3 * first.spacings, abs(first.differences[0]) * ratio**order)
        for name, order in (("first order", 1), ("second order", 2))
    ]
    found = [(one.name, 1e3 * one.spacings, np.abs(one.differences)) for one in refinements]
    return Curve("Refinement", "spacing [mm]", "relative difference from the closed form", found, guides, True)


def draw(curves: list[Curve], refinements: list[Refinement], path: Path) -> Path:
    """All curves on one page, the refinements together in the last panel."""
    if refinements:
        curves = [*curves, _refinement_panel(refinements)]
    from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, plt

    columns = min(3, len(curves))
    lines = math.ceil(len(curves) / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.5 * lines), squeeze=False, layout="constrained")
    colours = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY)
    for panel in axes.flat[len(curves):]:
        panel.axis("off")
    for panel, curve in zip(axes.flat, curves):
        for name, x, y in curve.expected:
            panel.plot(x, y, color=INK, linestyle="--", linewidth=1.2, label=name)
        for index, (name, x, y) in enumerate(curve.found):
            if curve.logarithmic:  # in pairs, one for each force state
                panel.loglog(x, y, color=colours[index // 2], linestyle=("-", ":")[index % 2], marker="o", label=name)
            else:
                panel.plot(x, y, color=colours[index], label=name)
        panel.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
        if curve.y_label.startswith("depth"):
            panel.invert_yaxis()
        beside = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0)} if curve.logarithmic else {}
        legend = panel.legend(fontsize=7, **beside)
        if curve.logarithmic:  # an empty place beside the last panel is room enough
            legend.set_in_layout(len(curves) % columns == 0)
    figure.savefig(path)
    plt.close(figure)
    return path
