# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The critical-state law against modified Cam-clay: undrained and drained triaxial paths, and the virgin lines of
suction.

The soil and the triaxial paths are those of cases/material. Its viscosity is too small to be seen; the closed forms
have none. With constant K and G:

    yield                pc = p + q^2/(M^2 p)
    hardening            ln(pc/pc0) = eps_v_p/(lambda - kappa)
    elastic volume       eps_v_e = (p - p0)/K
    flow                 d eps_s_p/d eps_v_p = 2 eta/(M^2 - eta^2),  eta = q/p     (Roscoe and Burland 1968)
"""
from __future__ import annotations

import numpy as np

from periporo_tools.material_curves.comparison import ORDERS, Curve, Panel, curve_over, through
from periporo_tools.material_curves.driver import DrivenPath, Driver, Table

_START = 100e3  # p0 of the triaxial paths [Pa]
_RATIOS = {"": 1.25, "_overconsolidated": 8.0}  # overconsolidation ratio by the ending of the case's name
_REFERENCE = 1e3  # p_ref [Pa]


def _index(soil: Table) -> float:
    """lambda - kappa."""
    return soil["compression_index"] - soil["swelling_index"]


def _undrained(path: DrivenPath, ratio: float) -> Curve:
    """q(p) once it yields. No volume changes: 0 = (p - p0)/K + (lambda - kappa) ln(pc/pc0), put into the yield
    surface."""
    soil = path.material

    def formula(p):
        preconsolidation = ratio * _START * np.exp(-(1e3 * p - _START) / (soil["bulk_modulus"] * _index(soil)))
        return soil["critical_state_slope"] * p * np.sqrt(preconsolidation / (1e3 * p) - 1.0)

    yields = path.columns["equivalent_plastic_shear_strain"] > 0.0
    return curve_over(
        f"OCR = {ratio:g}", path.columns["p"][yields] / 1e3, path.columns["q"][yields] / 1e3, formula, 1e-8,
        "the return leaves 1e-11 in each of 500 steps",
    )


def _drained_response(soil: Table, ratio: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Axial strain [-] and q [Pa] of drained triaxial compression, q = 3 (p - p0), and what backward Euler errs in q,
    to first order and over its step [Pa].

    With p = 3 p0/(3 - eta) and pc = p (1 + eta^2/M^2), d ln pc = d eta/(3 - eta) + 2 eta d eta/(M^2 + eta^2), and
        d eps_s_p = (lambda - kappa) 2 eta/(M^2 - eta^2) d ln pc
    is integrated in partial fractions, from the first yield towards M. Backward Euler sums the same with the flow at
    the end of each step h: too much strain by h/2 integral (d eps_v_p/d eps) d(2 eta/(M^2 - eta^2)).
    """
    m, index = soil["critical_state_slope"], _index(soil)
    # first yield: p^2 + q^2/M^2 = pc0 p with q = 3 (p - p0)
    a, b, c = 1.0 + 9.0 / m**2, -(18.0 / m**2 + ratio) * _START, 9.0 / m**2 * _START**2
    first = (-b + np.sqrt(b**2 - 4.0 * a * c)) / (2.0 * a)
    first_eta = 3.0 * (first - _START) / first
    eta = m + (first_eta - m) * np.append(np.linspace(1.0, 0.01, 20000), np.geomspace(0.0099, 1e-7, 20000))

    def integral(eta):
        volume = (
            -np.log(np.abs(m - eta)) / (3.0 - m) - np.log(m + eta) / (3.0 + m) + 6.0 / (9.0 - m**2) * np.log(3.0 - eta)
        )
        shear = (np.log((m + eta) / np.abs(m - eta)) - 2.0 * np.arctan(eta / m)) / m
        return volume + shear

    p = 3.0 * _START / (3.0 - eta)
    q = 3.0 * (p - _START)
    preconsolidation = p * (1.0 + (eta / m) ** 2)
    shear = q / (3.0 * soil["shear_modulus"]) + index * (integral(eta) - integral(first_eta))
    volume = (p - _START) / soil["bulk_modulus"] + index * np.log(preconsolidation / (ratio * _START))
    strain = shear + volume / 3.0
    flow = 2.0 * eta / (m**2 - eta**2)
    excess = 0.5 * np.cumsum(index * np.diff(np.log(preconsolidation)) / np.diff(strain) * np.diff(flow))
    error = np.max(np.abs(np.diff(q) / np.diff(strain) * excess))
    return np.append(0.0, strain), np.append(0.0, q), error


def _drained(path: DrivenPath, ratio: float) -> Curve:
    strain, q, error = _drained_response(path.material, ratio)
    axial = path.compression("z")
    return curve_over(
        f"OCR = {ratio:g}", 100.0 * axial, path.columns["q"] / 1e3, through(100.0 * strain, q / 1e3),
        ORDERS * error * np.diff(axial).max() / q.max(), "the first order of the step, and a fifth for higher ones",
    )


def _virgin_line(drive: Driver, soil: Table, suction: float, saturation: float) -> Curve:
    """Isotropic loading at constant suction: elastic to p_y = p_ref exp(a) (pc/p_ref)^b, then by
    (lambda - kappa)/b ln(p/p_y) more; a and b of Gallipoli et al. (2003) as Borja (2004) writes them."""
    start, preconsolidation = 20e3, 40e3
    bonds = {"bonding_c1": 0.185, "bonding_c2": 1.42, "reference_specific_volume": 2.76}
    path = drive(
        soil | bonds,
        {
            "pressure": start, "suction": suction, "saturation": saturation,
            "state": {"log_preconsolidation_pressure": np.log(preconsolidation)},  # pc, whatever the suction
        },
        {"type": "isotropic", "pressure": 800e3, "steps": 200, "duration": 3600.0},
    )
    relative = suction / soil["atmospheric_pressure"]
    bonding = (1.0 + relative / (10.7 + 2.4 * relative)) * (1.0 - saturation) if suction > 0.0 else 0.0
    ratio = 1.0 - bonds["bonding_c1"] * (1.0 - np.exp(bonds["bonding_c2"] * bonding))
    stretched = soil["compression_index"] * ratio - soil["swelling_index"]
    a, b = bonds["reference_specific_volume"] * (ratio - 1.0) / stretched, _index(soil) / stretched
    first = _REFERENCE * np.exp(a) * (preconsolidation / _REFERENCE) ** b

    def formula(p):
        plastic = _index(soil) / b * np.log(np.maximum(1e3 * p, first) / first)
        return 100.0 * ((1e3 * p - start) / soil["bulk_modulus"] + plastic)

    name = f"s = {suction / 1e3:g} kPa, S_r = {saturation:g}" if suction > 0.0 else "dry"
    return curve_over(
        name, path.columns["p"] / 1e3, 100.0 * path.columns["volumetric_compression"], formula, 2e-7,
        "the driver leaves 1e-9 of p in each of 200 steps", logarithmic=True,
    )


def panels(drive: Driver) -> list[Panel]:
    """Undrained paths, drained stress over strain, and compression at three suctions."""
    undrained = {ratio: drive.case(f"triaxial_undrained{ending}") for ending, ratio in _RATIOS.items()}
    drained = {ratio: drive.case(f"triaxial_drained{ending}") for ending, ratio in _RATIOS.items()}
    soil = drained[1.25].material
    paths = [_undrained(path, ratio) for ratio, path in undrained.items()]
    ends = np.array([0.0, 1.05 * max(np.max(curve.points[0]) for curve in paths)])
    critical_state = (ends, soil["critical_state_slope"] * ends)
    wet = [_virgin_line(drive, soil, *water) for water in ((0.0, 0.0), (100e3, 0.95), (100e3, 0.9))]
    return [
        Panel("Undrained triaxial, once it yields", "mean pressure p [kPa]", "deviator stress q [kPa]",
              "Roscoe and Burland (1968), q(p)", paths, context={"critical state": critical_state}),
        Panel("Drained triaxial", "axial compression [%]", "deviator stress q [kPa]",
              "Roscoe and Burland (1968), integrated", [_drained(path, ratio) for ratio, path in drained.items()]),
        Panel("Isotropic compression", "mean pressure p [kPa]", "volumetric compression [%]", "Gallipoli et al. (2003)",
              wet, logarithmic=True, downwards=True),
    ]
