# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""A curve of the program beside its closed form, and how far the two are apart."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

Line = tuple[np.ndarray, np.ndarray]  # x and y as they are drawn
ORDERS = 1.2  # what the higher orders of a step may add to its first
_FINE = 600  # points of a drawn formula


@dataclass(frozen=True)
class Curve:
    """What the program found along a path, and what a formula says there.

    @param points what is drawn of the program
    @param line what is drawn of the formula
    @param found, expected the values that are compared, one a step of the path
    @param tolerance on the difference, relative to the largest expected value
    """

    name: str
    points: Line
    line: Line
    found: np.ndarray
    expected: np.ndarray
    tolerance: float
    reason: str  # of the tolerance

    @property
    def difference(self) -> float:
        """The largest |found - expected| over the largest |expected|; not a number when one of them is not, or when
        there is nothing to compare."""
        if self.found.size == 0:
            return float("nan")
        return float(np.max(np.abs(self.found - self.expected)) / np.max(np.abs(self.expected)))

    @property
    def holds(self) -> bool:
        """False as well when the difference is not a number."""
        return bool(self.difference <= self.tolerance)


@dataclass(frozen=True)
class Panel:
    """Curves that share axes and formula."""

    title: str
    x_label: str
    y_label: str
    formula: str  # for the legend: the closed form or where it comes from
    curves: list[Curve]
    context: dict[str, Line] = field(default_factory=dict)  # by name: drawn faintly, not compared
    logarithmic: bool = False  # in x
    downwards: bool = False  # y, as settlements are drawn
    same_scale: bool = False  # in x and y


def curve_over(
    name: str, x: np.ndarray, found: np.ndarray, formula: Callable[[np.ndarray], np.ndarray], tolerance: float,
    reason: str, *, logarithmic: bool = False,
) -> Curve:
    """A curve y(x) beside a formula for y(x)."""
    fine = (np.geomspace if logarithmic else np.linspace)(x.min(), x.max(), _FINE)
    return Curve(name, (x, found), (fine, formula(fine)), found, formula(x), tolerance, reason)


def through(x: np.ndarray, y: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """y(x) of a closed form that gives both by a parameter: straight between points that are dense; x rises."""
    return lambda at: np.interp(at, x, y)


_HEAD = ("", "law", "test", "curve", "largest difference", "tolerance", "reason of the tolerance")


def table(panels: dict[str, list[Panel]]) -> str:
    """The panels of each law in aligned columns, a line a curve; those outside their tolerance begin with FAIL."""
    lines = [_HEAD]
    for law, tests in panels.items():
        for panel in tests:
            for curve in panel.curves:
                verdict, apart = "ok" if curve.holds else "FAIL", f"{curve.difference:.1e}"
                lines.append((verdict, law, panel.title, curve.name, apart, f"{curve.tolerance:.1e}", curve.reason))
    widths = [max(len(line[column]) for line in lines) for column in range(len(_HEAD))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in lines)
