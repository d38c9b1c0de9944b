# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Drucker-Prager against its cones: round the deviatoric plane, and strength and dilation in triaxial compression."""
from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from periporo_tools.material_curves.comparison import Curve, Panel, curve_over
from periporo_tools.material_curves.deviatoric_plane import (
    AXES, coordinates, coulomb_strength, deviator_stress, outline, turned, turning_path,
)
from periporo_tools.material_curves.driver import Driver
from periporo_tools.material_curves.elasticity import poisson_ratio, young_modulus
from periporo_tools.material_curves.frictional_sand import (
    BULK, COHESION, DILATANCY, FRICTION, PRESSURE, REASON, SHEAR, STRAIN, TOLERANCE, axial_test, sand,
)


@dataclass(frozen=True)
class _Cone:
    """q = k + M p with the dilation M_psi.

    In triaxial compression at held lateral pressure, q = 3 (p - p0): failure at q = 3 (k + M p0)/(3 - M). A plastic
    shear strain dl expands by M_psi dl and shortens the axis by dl - M_psi dl/3.
    """

    match: str
    slope: float  # M
    strength: float  # k [Pa]
    dilatancy: float  # M_psi

    def _elastic_part(self, strain: np.ndarray) -> np.ndarray:
        failure = 3.0 * (self.strength + self.slope * PRESSURE) / (3.0 - self.slope)
        return np.minimum(strain, 100.0 * failure / young_modulus(BULK, SHEAR))

    def deviator(self, strain: np.ndarray) -> np.ndarray:
        """q [kPa] at an axial compression [%]."""
        return young_modulus(BULK, SHEAR) * self._elastic_part(strain) / 1e5

    def expansion(self, strain: np.ndarray) -> np.ndarray:
        """Volumetric expansion [%] at an axial compression [%]."""
        elastic = self._elastic_part(strain)
        flow = 3.0 * self.dilatancy / (3.0 - self.dilatancy)
        return -(1.0 - 2.0 * poisson_ratio(BULK, SHEAR)) * elastic + flow * (strain - elastic)


def _cones(dilatancy: float) -> list[_Cone]:
    """Along the edges of compression, along those of extension, and where flow in plane strain is steady: there the
    plastic strain across the plane is none, 3/2 s_y/q + M_psi/3 = 0, which puts the radius of Mohr's circle at
    q/sqrt(3 + sin^2 psi) and its middle at p - q sin psi/(3 sqrt(3 + sin^2 psi)); Coulomb's criterion gives M and k."""
    sine, cosine, dilation = np.sin(FRICTION), np.cos(FRICTION), np.sin(dilatancy)
    root = np.sqrt(3.0 + dilation**2)
    factors = {  # F with M = F sin phi and k = F c cos phi; M_psi
        "compression": (6.0 / (3.0 - sine), 6.0 * dilation / (3.0 - dilation)),
        "plane_strain": (3.0 * root / (3.0 + sine * dilation), 3.0 * dilation / root),
        "extension": (6.0 / (3.0 + sine), 6.0 * dilation / (3.0 + dilation)),
    }
    return [
        _Cone(match, factor * sine, factor * COHESION * cosine, slope) for match, (factor, slope) in factors.items()
    ]


def _round_the_plane(drive: Driver, cone: _Cone) -> Curve:
    """Strain that turns at constant volume, without dilatancy so that p stays."""
    material = sand("drucker_prager", dilatancy=0.0, match=cone.match)
    pressures = turned(drive(material, {"pressure": PRESSURE}, *turning_path(6e-4, 6)))
    strength = cone.strength + cone.slope * PRESSURE
    found = deviator_stress(pressures)
    return Curve(
        cone.match, coordinates(pressures / 1e3), outline(lambda angle: strength / 1e3), found,
        np.full_like(found, strength), 1e-12, "round-off of 170 steps",
    )


def panels(drive: Driver) -> list[Panel]:
    """The three cones, and q and volume over axial compression with each."""
    strengths, volumes = [], []
    for cone in _cones(DILATANCY):
        path = drive(
            sand("drucker_prager", match=cone.match), {"pressure": PRESSURE},
            axial_test("triaxial_drained", axial_compression=STRAIN),
        )
        axial = 100.0 * path.compression("z")
        expansion = -100.0 * path.columns["volumetric_compression"]
        strengths.append(curve_over(cone.match, axial, path.columns["q"] / 1e3, cone.deviator, TOLERANCE, REASON))
        volumes.append(curve_over(cone.match, axial, expansion, cone.expansion, TOLERANCE, REASON))
    pyramid = partial(coulomb_strength, pressure=PRESSURE / 1e3, friction_angle=FRICTION, cohesion=COHESION / 1e3)
    return [
        Panel("Deviatoric plane, p = 20 kPa", *AXES, "q = k + M p", [_round_the_plane(drive, c) for c in _cones(0.0)],
              context={"Coulomb (1776)": outline(pyramid)}, same_scale=True),
        Panel("Strength in triaxial compression", "axial compression [%]", "deviator stress q [kPa]",
              "Hooke, then q = 3 (k + M p0)/(3 - M)", strengths),
        Panel("Dilation in triaxial compression", "axial compression [%]", "volumetric expansion [%]",
              "Hooke, then slope 3 M_psi/(3 - M_psi)", volumes),
    ]
