# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What runs cost: points and steps guessed from the case, and the time left from the speed seen so far."""
from __future__ import annotations

import math
import os
from dataclasses import dataclass

from periporo_tools.reproduction.case_text import CaseText

# Stable step over spacing of the columns' soil [s/m]: 32.5 microseconds at 5 mm. Another material runs at another
# speed in the same proportion, and the speed seen so far takes it in.
_STEP_OVER_SPACING = 6.5e-3
# Point-steps a second of one thread before any run has shown its own: the soil in flow of tests/performance.
_TYPICAL_SPEED = 9e4

_UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "s": 1.0, "ms": 1e-3}


@dataclass(frozen=True)
class Cost:
    """What a run takes, as far as its case tells; None where it does not."""

    points: int | None
    point_steps: float | None  # points times steps of the dynamic stages, run to their full duration


def _quantity(value: object) -> float:
    """A length or a time in SI. @throws ValueError, TypeError or KeyError when it is neither."""
    if isinstance(value, str):
        number, _, unit = value.strip().partition(" ")
        return float(number) * _UNITS[unit.strip()]
    return float(value)  # type: ignore[arg-type]


def _volume(geometry: dict, cut: set[str]) -> float:
    """Volume of a box, a slab or an upright cylinder on the side of the symmetry planes that is kept [m3]."""
    origin = [_quantity(x) for x in geometry.get("origin", (0, 0, 0))]
    if geometry["generator"] in ("box", "slab"):
        volume = 1.0
        for axis, low, size in zip("xyz", origin, map(_quantity, geometry["size"])):
            volume *= max(0.0, low + size) - max(0.0, low) if axis in cut else size
        return volume
    if geometry["generator"] == "cylinder":
        return math.pi * _quantity(geometry["radius"]) ** 2 * _quantity(geometry["height"]) / 2 ** len(cut & {"x", "y"})
    raise KeyError(geometry["generator"])


def _symmetry(tables: dict) -> set[str]:
    """Axes with a symmetry plane through the origin."""
    planes = [entry["plane"].split("=") for entry in tables.get("boundary", []) if entry["type"] == "symmetry"]
    return {axis.strip() for axis, place in planes if _quantity(place.strip()) == 0.0}


def cost_of(case: CaseText) -> Cost:
    """A guess; nothing where the case holds what this does not read."""
    tables = case.tables
    try:
        spacing = _quantity(tables["discretization"]["spacing"])
        cut = _symmetry(tables)
        points = sum(round(_volume(body["geometry"], cut) / spacing**3) for body in tables["body"].values())
    except (KeyError, TypeError, ValueError, AttributeError):
        return Cost(None, None)
    try:
        duration = sum(_quantity(stage["duration"]) for stage in tables["stage"] if stage["type"] == "dynamic")
    except (KeyError, TypeError, ValueError, AttributeError):
        return Cost(points, None)
    return Cost(points, points * duration / (_STEP_OVER_SPACING * spacing))


class Pace:
    """How fast runs go on this machine, from those that are done."""

    def __init__(self, threads: int | None = None):
        self._typical = _TYPICAL_SPEED * (threads or len(os.sched_getaffinity(0)))
        self._point_steps = self._seconds = 0.0
        self._all: list[float] = []

    def add(self, cost: Cost, seconds: float) -> None:
        """A run with this cost took so long."""
        self._all.append(seconds)
        if cost.point_steps is not None:
            self._point_steps += cost.point_steps
            self._seconds += seconds

    def seconds(self, costs: list[Cost]) -> float | None:
        """How long these take; one of unknown cost takes the mean of all others. None when nothing can be said."""
        speed = self._point_steps / self._seconds if self._seconds > 0.0 else self._typical
        known = [cost.point_steps / speed for cost in costs if cost.point_steps is not None]
        unknown = len(costs) - len(known)
        others = self._all or known
        if unknown and not others:
            return None
        return sum(known) + unknown * (sum(others) / len(others) if unknown else 0.0)


def duration_text(seconds: float) -> str:
    """\"40 s\", \"3 min 5 s\", \"2 h 10 min\", as the program says it."""
    whole = round(seconds)
    if whole >= 3600:
        return f"{whole // 3600} h {whole % 3600 // 60} min"
    if whole >= 120:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole} s"
