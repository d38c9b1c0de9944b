# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The table and the page of pictures of a verification."""
from __future__ import annotations

import json
import math
from pathlib import Path

from periporo_tools.verification.checks import Curve, Row

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


def draw(curves: list[Curve], path: Path) -> Path:
    """All curves on one page."""
    from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PURPLE, RED, plt

    columns = min(3, len(curves))
    lines = math.ceil(len(curves) / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.5 * lines), squeeze=False, layout="constrained")
    for panel in axes.flat[len(curves):]:
        panel.axis("off")
    for panel, curve in zip(axes.flat, curves):
        for name, x, y in curve.expected:
            panel.plot(x, y, color=INK, linestyle="--", linewidth=1.2, label=name)
        for (name, x, y), colour in zip(curve.found, (BLUE, ORANGE, GREEN, RED, PURPLE)):
            panel.plot(x, y, color=colour, label=name)
        panel.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
        if curve.y_label.startswith("depth"):
            panel.invert_yaxis()
        panel.legend(fontsize=7)
    figure.savefig(path)
    plt.close(figure)
    return path
