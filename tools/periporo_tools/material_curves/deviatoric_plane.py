# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The deviatoric plane: a path that turns once round it, and the strength of Coulomb's criterion in each direction.

Directions are counted by an angle from the axis of z, at which the pressure along z is the largest one.
"""
from __future__ import annotations

from collections.abc import Callable

import numpy as np

from periporo_tools.material_curves.comparison import Line
from periporo_tools.material_curves.driver import DrivenPath, Table

AXES = ("(s_x - s_y)/sqrt(2) [kPa]", "(2 s_z - s_x - s_y)/sqrt(6) [kPa]")  # labels, s pressures
_THIRD = 2.0 * np.pi / 3.0
_TURN = np.pi / 12.0


def direction(angle: np.ndarray | float) -> np.ndarray:
    """Deviatoric principal pressures in x, y and z at q = 1."""
    return 2.0 / 3.0 * np.array([np.cos(angle - _THIRD), np.cos(angle + _THIRD), np.cos(angle)])


def turning_path(shear_strain: float, steps: int) -> list[Table]:
    """Stages of shear at constant volume: to the surface along the axis of z, then once round, 15 degrees at a time.

    @param shear_strain of each stage, of the size of the elastic strain at the surface
    """
    turns = [0.0, 0.0, *np.arange(0.0, 2.0 * np.pi + 1.5 * _TURN, _TURN)]
    return [
        {
            "type": "true_triaxial", "compressions": list(1.5 * shear_strain * direction(turn)), "steps": steps,
            "duration": 1.0,
        }
        for turn in turns
    ]


def turned(path: DrivenPath) -> np.ndarray:
    """Principal pressures in x, y and z of a turning path, once the surface is reached [Pa]; a row an axis."""
    reached = path.columns["stage"] > 2
    return np.array([path.pressure(axis)[reached] for axis in "xyz"])


def angle_of(pressures: np.ndarray) -> np.ndarray:
    """The direction of a stress in the deviatoric plane."""
    x, y = coordinates(pressures)
    return np.arctan2(x, y)


def coordinates(pressures: np.ndarray) -> Line:
    """Place in the deviatoric plane, whose distance from the middle is sqrt(2/3) q."""
    x, y, z = pressures
    return (x - y) / np.sqrt(2.0), (2.0 * z - x - y) / np.sqrt(6.0)


def deviator_stress(pressures: np.ndarray) -> np.ndarray:
    """q of principal pressures."""
    x, y, z = pressures
    return np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2))


def coulomb_strength(angle: np.ndarray, pressure: float, friction_angle: float, cohesion: float) -> np.ndarray:
    """q at failure: s_1 - s_3 = (s_1 + s_3) sin phi + 2 c cos phi, Coulomb's criterion (1776) in principal pressures
    s_i = p + q n_i, solved for q."""
    largest, least = direction(angle).max(axis=0), direction(angle).min(axis=0)
    sine, cosine = np.sin(friction_angle), np.cos(friction_angle)
    return 2.0 * (pressure * sine + cohesion * cosine) / (largest - least - (largest + least) * sine)


def outline(strength: Callable[[np.ndarray], np.ndarray | float]) -> Line:
    """The line of a strength q(angle), with points at the corners of a hexagon."""
    angle = np.linspace(0.0, 2.0 * np.pi, 6 * 24 + 1)
    return coordinates(direction(angle) * strength(angle))
