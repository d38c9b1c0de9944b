# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""J2 plasticity against its hardening curves in uniaxial tension, and against Bingham's fluid in simple shear."""
from __future__ import annotations

from collections.abc import Callable

import numpy as np

from periporo_tools.material_curves.comparison import Curve, Panel, curve_over, through
from periporo_tools.material_curves.driver import Driver, Table
from periporo_tools.material_curves.elasticity import young_modulus

_BULK, _SHEAR = 10e6, 1e6  # K, G [Pa]
_YIELD = 17.3e3  # [Pa]
_CLAY = {"model": "j2_plasticity", "bulk_modulus": _BULK, "shear_modulus": _SHEAR, "yield_stress": _YIELD}
_STRAIN = 0.15
_STEPS = 150
_TOLERANCE = 2e-7
_REASON = "the driver leaves 1e-9 of the axial stress in each of 150 steps"


def _tension(drive: Driver, name: str, hardening: Table, formula: Callable[[np.ndarray], np.ndarray]) -> Curve:
    """Axial stress [kPa] over axial strain [%]."""
    path = drive(
        _CLAY | hardening, {"pressure": 0.0},
        {"type": "triaxial_drained", "axial_compression": -_STRAIN, "steps": _STEPS, "duration": 1.0},
    )
    return curve_over(name, -100.0 * path.compression("z"), -path.pressure("z") / 1e3, formula, _TOLERANCE, _REASON)


def _linear(drive: Driver) -> Curve:
    """Tangent E H/(E + H) beyond the yield stress."""
    modulus, young = 40e3, young_modulus(_BULK, _SHEAR)

    def formula(strain):
        elastic = np.minimum(strain / 100.0, _YIELD / young)
        return (young * elastic + young * modulus / (young + modulus) * (strain / 100.0 - elastic)) / 1e3

    return _tension(drive, "hardens with H = 40 kPa", {"hardening_modulus": modulus}, formula)


def _saturating(drive: Driver, name: str, limit: float, rate: float) -> Curve:
    """Voce (1948): s = s_inf + (s_0 - s_inf) exp(-m e), at the strain e + s/E."""
    plastic = np.linspace(0.0, _STRAIN, 20001)
    stress = limit + (_YIELD - limit) * np.exp(-rate * plastic)
    strain = plastic + stress / young_modulus(_BULK, _SHEAR)
    formula = through(100.0 * np.append(0.0, strain), np.append(0.0, stress) / 1e3)
    return _tension(drive, name, {"saturation_stress": limit, "saturation_rate": rate}, formula)


def _bingham(drive: Driver, viscosity: float) -> Curve:
    """Steady shear, without the spin of a simple one, at ever higher rates: tau = s_y/sqrt(3) + eta gamma_dot."""
    rates = np.geomspace(1.0, 1e3, 16)
    relaxation = viscosity / _SHEAR
    # Backward Euler divides the distance from the steady stress by 1 + 2 or more in each of 50 steps.
    strains = 0.1 + 100.0 * relaxation * rates
    stages = [
        {"type": "mixed", "steps": 50, "strain": {"xz": 0.5 * strain}, "duration": strain / rate}
        for strain, rate in zip(strains, rates)
    ]
    path = drive(_CLAY | {"viscosity": viscosity}, {"pressure": 0.0}, *stages)
    found = path.columns["stress_xz"][path.ends] / 1e3
    return curve_over(
        f"eta = {viscosity:g} Pa s", rates, found, lambda rate: (_YIELD / np.sqrt(3.0) + viscosity * rate) / 1e3, 1e-10,
        "round-off of some 1000 steps", logarithmic=True,
    )


def panels(drive: Driver) -> list[Panel]:
    """Hardening and softening, and the flow curve of mud."""
    tension = [
        _saturating(drive, "hardens to 25 kPa, rate 40", 25e3, 40.0),
        _linear(drive),
        _saturating(drive, "softens to 8.7 kPa, rate 20", 8.7e3, 20.0),
    ]
    flow = [_bingham(drive, 50.0), _bingham(drive, 5.0)]
    return [
        Panel("Uniaxial tension", "axial strain [%]", "axial stress [kPa]", "slope E H/(E + H); Voce (1948)", tension),
        Panel("Steady simple shear", "shear rate [1/s]", "shear stress [kPa]", "Bingham: s_y/sqrt(3) + eta rate", flow,
              logarithmic=True),
    ]
