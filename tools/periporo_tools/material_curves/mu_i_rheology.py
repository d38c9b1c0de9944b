# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The mu(I) law against its own formula in steady shear, and against the relaxation that follows from it."""
from __future__ import annotations

import numpy as np

from periporo_tools.material_curves.comparison import ORDERS, Curve, Panel, curve_over, through
from periporo_tools.material_curves.driver import Driver

_BULK, _SHEAR = 2.5e6, 1.5e6  # K, G [Pa]
# The glass beads of Jop, Forterre and Pouliquen (2006).
_STATIC, _LIMITING = np.tan(np.radians(20.9)), np.tan(np.radians(32.76))  # mu_s, mu_2
_REFERENCE = 0.279  # I_0
_DIAMETER, _DENSITY = 0.53e-3, 2450.0  # [m], [kg/m3]
_BEADS = {
    "model": "mu_i_rheology", "bulk_modulus": _BULK, "shear_modulus": _SHEAR, "static_friction": _STATIC,
    "limiting_friction": _LIMITING, "reference_inertial_number": _REFERENCE, "grain_diameter": _DIAMETER,
    "solid_density": _DENSITY,
}


def _friction(inertial_number: np.ndarray) -> np.ndarray:
    """mu(I) of Jop, Forterre and Pouliquen (2006)."""
    return _STATIC + (_LIMITING - _STATIC) / (1.0 + _REFERENCE / inertial_number)


def _rate(inertial_number: np.ndarray | float, pressure: float) -> np.ndarray | float:
    """The shear rate [1/s] of an inertial number I = rate d/sqrt(p/rho_s)."""
    return inertial_number * np.sqrt(pressure / _DENSITY) / _DIAMETER


def _steady_shear(drive: Driver, pressure: float, numbers: np.ndarray) -> Curve:
    """A stage of shear, without the spin of a simple one, for each inertial number: steady at its end."""
    strain = 100 * 15.0 * pressure / _SHEAR  # an elastic stress of 15 p in each of 100 steps: the past is forgotten
    stages = [
        {"type": "mixed", "steps": 100, "strain": {"xz": 0.5 * strain}, "duration": strain / _rate(number, pressure)}
        for number in numbers
    ]
    path = drive(_BEADS, {"pressure": pressure}, *stages)
    found = (path.columns["stress_xz"] / path.columns["p"])[path.ends]
    return curve_over(
        f"p = {pressure / 1e3:g} kPa", numbers, found, _friction, 1e-10, "round-off of some 1000 steps",
        logarithmic=True,
    )


def _relaxation(drive: Driver, start: float) -> Curve:
    """At held strain x = tau - mu_s p obeys dx/dt = -a x/(m - x), a = G I_0 sqrt(p/rho_s)/d, m = (mu_2 - mu_s) p, so
    m ln(x0/x) - (x0 - x) = a t. A step h of backward Euler leaves h/2 |dx/dt| ln(|dx/dt|_0/|dx/dt|) to first order,
    at most h/(2 e) |dx/dt|_0.

    @param start x0/m
    """
    pressure = 1e3
    limit = (_LIMITING - _STATIC) * pressure
    speed = _SHEAR * _rate(_REFERENCE, pressure)
    duration, steps = 3.0 * limit / speed, 500
    path = drive(
        _BEADS, {"stress": [-pressure, -pressure, -pressure, 0.0, 0.0, _STATIC * pressure + start * limit]},
        {"type": "mixed", "steps": steps, "duration": duration},
    )
    excess = np.geomspace(1.0, 1e-3, 20001) * start * limit
    time = (limit * np.log(excess[0] / excess) - (excess[0] - excess)) / speed
    error = duration / steps / (2.0 * np.e) * speed * start / (1.0 - start)
    formula = through(1e6 * time, _STATIC + excess / pressure)
    friction = path.columns["stress_xz"] / pressure
    return curve_over(
        f"from {start:g} of the way to mu_2", 1e6 * path.columns["time"], friction, formula,
        ORDERS * error / (pressure * friction[0]), "the first order of the step, and a fifth for higher ones",
    )


def panels(drive: Driver) -> list[Panel]:
    """mu(I) under two pressures, and how a stress above the static friction fades."""
    numbers = np.geomspace(1e-4, 1e2, 25)
    steady = [_steady_shear(drive, 500.0, numbers[::2]), _steady_shear(drive, 5e3, numbers[1::2])]
    fading = [_relaxation(drive, 0.9), _relaxation(drive, 0.5)]
    return [
        Panel("Steady simple shear", "inertial number I [-]", "tau/p [-]", "mu(I), Jop et al. (2006)", steady,
              logarithmic=True),
        Panel("Held strain, p = 1 kPa", "time [µs]", "tau/p [-]", "what mu(I) gives: m ln(x0/x) - (x0 - x) = a t",
              fading),
    ]
