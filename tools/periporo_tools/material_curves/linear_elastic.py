# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Linear elasticity against Hooke's law: the four moduli, and the sideways strain that goes with an axial one."""
from __future__ import annotations

import numpy as np

from periporo_tools.material_curves.comparison import Curve, Panel, curve_over
from periporo_tools.material_curves.driver import Driver
from periporo_tools.material_curves.elasticity import poisson_ratio, young_modulus

_BULK, _SHEAR = 25e6, 15e6  # K, G [Pa]
_SAND = {"model": "linear_elastic", "bulk_modulus": _BULK, "shear_modulus": _SHEAR}
_STRAIN = 0.01
_STEPS = 20
_TOLERANCE = 2e-8
_REASON = "the driver leaves 1e-9 of the held stress in each of 20 steps"


def _line(name: str, strain: np.ndarray, found: np.ndarray, slope: float) -> Curve:
    return curve_over(name, strain, found, lambda x: slope * x, _TOLERANCE, _REASON)


def panels(drive: Driver) -> list[Panel]:
    """Stress against strain in four tests, and the lateral strain of two."""

    def test(kind: str, **target):
        return drive(_SAND, {"pressure": 0.0}, {"type": kind, "steps": _STEPS, "duration": 1.0, **target})

    oedometer = test("oedometric", axial_compression=_STRAIN)
    triaxial = test("triaxial_drained", axial_compression=_STRAIN)
    isotropic = test("isotropic", volumetric_compression=_STRAIN)
    shear = test("mixed", strain={"xz": 0.5 * _STRAIN})  # pure: a simple one turns the stress
    plane = test("mixed", strain={"zz": -_STRAIN}, held_stress=["xx"])

    poisson = poisson_ratio(_BULK, _SHEAR)
    axial = 100.0 * triaxial.compression("z")
    moduli = [
        _line("oedometer: K + 4 G/3", 100.0 * oedometer.compression("z"), oedometer.pressure("z") / 1e3,
              (_BULK + 4.0 / 3.0 * _SHEAR) / 1e5),
        _line("free sides: E", axial, triaxial.pressure("z") / 1e3, young_modulus(_BULK, _SHEAR) / 1e5),
        _line("isotropic: K", 100.0 * isotropic.columns["volumetric_compression"], isotropic.columns["p"] / 1e3,
              _BULK / 1e5),
        _line("shear: G", 200.0 * shear.columns["strain_xz"], shear.columns["stress_xz"] / 1e3, _SHEAR / 1e5),
    ]
    sideways = [
        _line("plane strain: nu/(1 - nu)", axial, -100.0 * plane.compression("x"), poisson / (1.0 - poisson)),
        _line("free sides: nu", axial, -100.0 * triaxial.compression("x"), poisson),
    ]
    return [
        Panel("Stiffness", "axial, volumetric or shear strain [%]", "stress of the test [kPa]", "Hooke's law", moduli),
        Panel("Lateral strain", "axial compression [%]", "lateral extension [%]", "Hooke's law", sideways),
    ]
