# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Mohr-Coulomb against Coulomb's criterion: round the deviatoric plane, and strength and dilation in three tests."""
from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from periporo_tools.material_curves.comparison import Curve, Panel, curve_over
from periporo_tools.material_curves.deviatoric_plane import (
    AXES, angle_of, coordinates, coulomb_strength, deviator_stress, outline, turned, turning_path,
)
from periporo_tools.material_curves.driver import DrivenPath, Driver, Table
from periporo_tools.material_curves.elasticity import poisson_ratio, young_modulus
from periporo_tools.material_curves.frictional_sand import (
    BULK, COHESION, DILATANCY, FRICTION, PRESSURE, REASON, SHEAR, STRAIN, TOLERANCE, axial_test, sand,
)


@dataclass(frozen=True)
class _Test:
    """Axial strain at held lateral pressure: elastic with constant slopes up to failure, steady flow beyond."""

    name: str
    path: DrivenPath
    stiffness: float  # change of axial pressure over the amount of axial strain [Pa]
    failure: float  # axial pressure [Pa]
    elastic_expansion: float  # volumetric expansion over the amount of axial strain before failure
    plastic_expansion: float  # and in flow

    @property
    def strain(self) -> np.ndarray:
        """The amount of axial strain [%]."""
        return 100.0 * np.abs(self.path.compression("z"))

    def _elastic_part(self, strain: np.ndarray) -> np.ndarray:
        return np.minimum(strain, 100.0 * (self.failure - PRESSURE) / self.stiffness)

    def pressure(self, strain: np.ndarray) -> np.ndarray:
        """Axial pressure [kPa] at a strain [%]."""
        return (PRESSURE + self.stiffness * self._elastic_part(strain) / 100.0) / 1e3

    def expansion(self, strain: np.ndarray) -> np.ndarray:
        """Volumetric expansion [%] at a strain [%]."""
        elastic = self._elastic_part(strain)
        return self.elastic_expansion * elastic + self.plastic_expansion * (strain - elastic)


def _tests(drive: Driver) -> list[_Test]:
    """Pressures at failure are s_1 = N s_3 + 2 c sqrt(N), N = (1 + sin phi)/(1 - sin phi). In flow with psi the
    expansion along the smaller pressure is (1 + sin psi)/(1 - sin psi) of the compression along the larger one; where
    two pressures are equal their strains together stand for the one."""
    sine, dilation = np.sin(FRICTION), np.sin(DILATANCY)
    ratio = (1.0 + sine) / (1.0 - sine)
    strongest = ratio * PRESSURE + 2.0 * COHESION * np.sqrt(ratio)
    weakest = (PRESSURE - 2.0 * COHESION * np.sqrt(ratio)) / ratio
    young, poisson = young_modulus(BULK, SHEAR), poisson_ratio(BULK, SHEAR)
    plane = young / (1.0 - poisson**2)  # the axial modulus of plane strain
    in_compression, in_extension = 2.0 * dilation / (1.0 - dilation), 2.0 * dilation / (1.0 + dilation)

    def driven(stage: Table) -> DrivenPath:
        return drive(sand("mohr_coulomb"), {"pressure": PRESSURE}, stage)

    return [
        _Test("plane strain compression", driven(axial_test("mixed", strain={"zz": -STRAIN}, held_stress=["xx"])),
              plane, strongest, -(1.0 + poisson) * plane / (3.0 * BULK), in_compression),
        _Test("triaxial compression", driven(axial_test("triaxial_drained", axial_compression=STRAIN)),
              young, strongest, -(1.0 - 2.0 * poisson), in_compression),
        _Test("triaxial extension", driven(axial_test("triaxial_drained", axial_compression=-STRAIN)),
              -young, weakest, 1.0 - 2.0 * poisson, in_extension),
    ]


def _round_the_plane(drive: Driver) -> Curve:
    """Strain that turns at constant volume, without dilatancy so that p stays."""
    path = drive(sand("mohr_coulomb", dilatancy=0.0), {"pressure": PRESSURE}, *turning_path(1.2e-3, 24))
    strength = partial(coulomb_strength, pressure=PRESSURE, friction_angle=FRICTION, cohesion=COHESION)
    pressures = turned(path)
    return Curve(
        "shear that turns at constant volume", coordinates(pressures / 1e3),
        outline(lambda angle: strength(angle) / 1e3), deviator_stress(pressures), strength(angle_of(pressures)), 1e-12,
        "round-off of 700 steps",
    )


def panels(drive: Driver) -> list[Panel]:
    """The hexagon, and axial pressure and volume over axial strain in three tests."""
    strengths, volumes = [], []
    for test in _tests(drive):
        pressure = test.path.pressure("z") / 1e3
        expansion = -100.0 * test.path.columns["volumetric_compression"]
        strengths.append(curve_over(test.name, test.strain, pressure, test.pressure, TOLERANCE, REASON))
        volumes.append(curve_over(test.name, test.strain, expansion, test.expansion, TOLERANCE, REASON))
    return [
        Panel("Deviatoric plane, p = 20 kPa", *AXES, "Coulomb (1776)", [_round_the_plane(drive)], same_scale=True),
        Panel("Strength", "amount of axial strain [%]", "axial pressure [kPa]", "Hooke, then Coulomb (1776)",
              strengths),
        Panel("Dilation", "amount of axial strain [%]", "volumetric expansion [%]",
              "Hooke, then slope 2 sin psi/(1 -+ sin psi)", volumes),
    ]
