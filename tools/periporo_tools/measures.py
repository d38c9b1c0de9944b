# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Shape, motion and energy of a deposit, measured.

Lengths are taken to the edge of a point's cell, half a spacing beyond its centre, so that an undeformed column measures
its own radius and height. The axis of the column is x = y = 0, its base z = 0.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from periporo_tools.clusters import heaviest_component
from periporo_tools.results import Snapshot

LINK = 1.5  # points closer than this many spacings hang together: past the edge (1) and face diagonal (1.41) of a cell
REST = 0.03  # at rest: root-mean-square speed below this share of (g h0)^(1/2); 0.05 per cent of the energy m g h0


@dataclass(frozen=True)
class Shape:
    """Extent of a deposit [m]."""

    front_mean: float  # mean over directions of the farthest point in each
    front_largest: float  # the farthest point of all
    front_axes: float  # mean of the fronts along x and along y
    radius_99: float  # holds 99 per cent of the mass of all points, escaped ones included
    height: float  # the highest point
    escaped: int  # points that do not hang together with the deposit
    escaped_mass: float  # their share of the mass [-]


def main_body(snapshot: Snapshot) -> Snapshot:
    """The points of the first body, which is the one that collapses."""
    return snapshot.select(snapshot.body == snapshot.body.min())


def connected(snapshot: Snapshot, spacing: float) -> np.ndarray:
    """True for the points still in contact with the deposit."""
    return heaviest_component(snapshot.position, snapshot.mass, LINK * spacing)


def radius(position: np.ndarray) -> np.ndarray:
    """Distance from the axis."""
    return np.hypot(position[:, 0], position[:, 1])


def is_planar(body: Snapshot, spacing: float) -> bool:
    """Whether a body is one point thick along y, as a periodic slab in plane strain is."""
    return bool(np.ptp(body.position[:, 1]) < 0.5 * spacing)


def _angles(symmetry: frozenset[str]) -> tuple[float, float]:
    """The directions that a model covers."""
    if symmetry >= {"x", "y"}:
        return 0.0, np.pi / 2
    if "x" in symmetry:
        return -np.pi / 2, np.pi / 2
    if "y" in symmetry:
        return 0.0, np.pi
    return -np.pi, np.pi


def fronts(position: np.ndarray, spacing: float, symmetry: frozenset[str]) -> tuple[np.ndarray, np.ndarray]:
    """Directions [rad] and the farthest point in each [m].

    A direction is a sector of 5 degrees, or as wide as two spacings at the farthest point where that is wider. A sector
    without a point has a front of zero.
    """
    low, high = _angles(symmetry)
    distance = radius(position)
    width = max(np.radians(5.0), 2.0 * spacing / distance.max())
    # Whole sectors in each quadrant, so that a quarter model and its full body are measured alike.
    quadrants = round((high - low) / (0.5 * np.pi))
    count = quadrants * max(1, int(0.5 * np.pi / width * (1.0 + 1e-12)))
    angle = np.arctan2(position[:, 1], position[:, 0])
    # A point a hair outside a symmetry plane belongs to the sector beside it.
    sector = np.clip(((angle - low) / (high - low) * count).astype(int), 0, count - 1)
    front = np.zeros(count)
    np.maximum.at(front, sector, distance + 0.5 * spacing)
    return low + (np.arange(count) + 0.5) * (high - low) / count, front


def _front_along(position: np.ndarray, axis: int, spacing: float) -> float:
    beside = np.abs(position[:, 1 - axis]) <= 1.01 * spacing
    return float(np.abs(position[beside, axis]).max(initial=0.0)) + 0.5 * spacing


def shape(snapshot: Snapshot, spacing: float, symmetry: frozenset[str], planar: bool = False) -> Shape:
    """Measures a snapshot of one body. With `planar`, distances are taken along x alone."""
    if planar:
        flat = snapshot.position * np.array([1.0, 0.0, 1.0])
        snapshot_distance = np.abs(snapshot.position[:, 0])
    else:
        flat = snapshot.position
        snapshot_distance = radius(snapshot.position)
    holds = connected(snapshot, spacing)
    inside = flat[holds]
    largest = float(snapshot_distance[holds].max()) + 0.5 * spacing
    if planar:
        sides = [side for side in (inside[:, 0], -inside[:, 0]) if (side > 0).any()]
        mean = float(np.mean([side.max() for side in sides])) + 0.5 * spacing
        along = mean
    else:
        mean = float(fronts(inside, spacing, symmetry)[1].mean())
        along = 0.5 * (_front_along(inside, 0, spacing) + _front_along(inside, 1, spacing))
    order = np.argsort(snapshot_distance)
    share = np.cumsum(snapshot.mass[order]) / snapshot.mass.sum()
    return Shape(
        front_mean=mean,
        front_largest=largest,
        front_axes=along,
        radius_99=float(snapshot_distance[order][np.searchsorted(share, 0.99)]),
        height=float(inside[:, 2].max()) + 0.5 * spacing,
        escaped=int((~holds).sum()),
        escaped_mass=float(snapshot.mass[~holds].sum() / snapshot.mass.sum()),
    )


@dataclass(frozen=True)
class Profile:
    """Height over distance from the axis [m]; a ring without a point has height zero."""

    radius: np.ndarray
    mean: np.ndarray  # over the directions
    lowest: np.ndarray
    highest: np.ndarray


def profile(
    position: np.ndarray, spacing: float, symmetry: frozenset[str], planar: bool = False
) -> Profile:
    """The upper surface: rings one spacing wide, cut into arcs of two spacings, the highest point of each."""
    distance = np.abs(position[:, 0]) if planar else radius(position)
    low, high = _angles(symmetry)
    ring = (distance / spacing).astype(int)
    rings = int(ring.max()) + 2
    columns = np.zeros((3, rings))
    middle = (np.arange(rings) + 0.5) * spacing
    across = position[:, 1] - position[:, 1].min()
    fraction = (np.arctan2(position[:, 1], position[:, 0]) - low) / (high - low)
    order = np.argsort(ring, kind="stable")
    bounds = np.searchsorted(ring[order], np.arange(rings + 1))
    for index in range(rings):
        members = order[bounds[index] : bounds[index + 1]]
        if planar:
            arcs = max(1, int((across.max() + spacing) / (2.0 * spacing)))
            arc = (across[members] / (across.max() + spacing) * arcs).astype(int)
        else:
            arcs = max(1, int(middle[index] * (high - low) / (2.0 * spacing)))
            arc = (fraction[members] * arcs).astype(int)
        top = np.zeros(arcs)
        np.maximum.at(top, np.clip(arc, 0, arcs - 1), position[members, 2] + 0.5 * spacing)
        columns[:, index] = top.mean(), top.min(), top.max()
    return Profile(middle, *columns)


@dataclass(frozen=True)
class Motion:
    """When the column came to rest, and whether its energies add up."""

    rest_time: float | None  # [s] after the release; None while it still moves
    released: float  # potential energy given up since the release [J]
    error_final: float  # energy ledger error over `released` at the end [-]
    error_largest: float  # the largest error of the whole collapse over `released` [-]


def motion(history: dict[str, np.ndarray], mass: float, height: float, gravity: float = 9.81) -> Motion | None:
    """Reads the histories; None without them."""
    needed = {"time", "kinetic_energy", "gravity_energy", "energy_error"}
    if not needed <= history.keys() or not history["time"].size:
        return None
    time = history["time"]
    settled = np.flatnonzero(time <= 0.0)
    since = slice(int(settled[-1]) if settled.size else 0, None)
    time = time[since]
    speed = np.sqrt(2.0 * np.maximum(history["kinetic_energy"][since], 0.0) / mass)
    moving = np.flatnonzero(speed > REST * np.sqrt(gravity * height))
    if moving.size == 0:
        rest = float(time[0])
    elif moving[-1] + 1 < len(time):
        rest = float(time[moving[-1] + 1])
    else:
        rest = None
    potential = history["gravity_energy"][since]
    released = float(potential[0] - potential[-1])
    error = np.abs(history["energy_error"][since] - history["energy_error"][since][0])
    scale = abs(released) if released != 0.0 else np.inf
    return Motion(rest, released, float(error[-1] / scale), float(error.max() / scale))
