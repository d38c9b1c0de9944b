# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What a check hands to the report: rows of the table, panels of the page."""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Row:
    """One line of the table. `tolerance` is on |found - expected|, relative to |expected| unless `absolute`."""

    name: str
    quantity: str
    unit: str
    expected: float
    found: float
    tolerance: float
    reason: str
    absolute: bool = False

    @property
    def difference(self) -> float:
        apart = self.found - self.expected
        return apart if self.absolute else apart / abs(self.expected)

    @property
    def holds(self) -> bool:
        return bool(np.isfinite(self.found) and abs(self.difference) <= self.tolerance)


@dataclass(frozen=True)
class Curve:
    """A panel of the page: what was found over what was expected."""

    title: str
    x_label: str
    y_label: str
    found: list[tuple[str, np.ndarray, np.ndarray]]
    expected: list[tuple[str, np.ndarray, np.ndarray]] = field(default_factory=list)
    logarithmic: bool = False


@dataclass(frozen=True)
class Refinement:
    """How far a quantity is from its closed form on finer and finer lattices."""

    name: str
    spacings: np.ndarray  # [m]
    differences: np.ndarray  # relative

    @property
    def order(self) -> float:
        """Slope of log |difference| over log spacing between the two finest lattices."""
        (coarse, fine), (more, less) = self.spacings[-2:], np.abs(self.differences[-2:])
        return float(np.log(more / less) / np.log(coarse / fine))


@dataclass
class Outcome:
    rows: list[Row] = field(default_factory=list)
    curves: list[Curve] = field(default_factory=list)
    refinements: list[Refinement] = field(default_factory=list)
