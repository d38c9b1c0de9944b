# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Elastic bodies in equilibrium."""
from __future__ import annotations

import numpy as np

from periporo_tools.verification.elastic import (
    BULK, DENSITY, GRAVITY, HORIZON_RATIO, POISSON, SHEAR, SOFT_FACES, SOFT_FACES_ORDER, STATES, YOUNG, choose,
    mean_displacement, operators, refine,
)
from periporo_tools.verification.outcome import Curve, Outcome, Row
from periporo_tools.verification.runner import Run, Runner


def hanging_bar(runner: Runner) -> Outcome:
    """ln of the stretch = sigma/E on the axis of a slender bar, sigma = rho g (L - z) over the narrowed section.

    At small strain u_z = rho g (L z - z^2/2)/E; the strain of 0.2 per cent adds 0.13 per cent to the elongation.
    """
    outcome = Outcome()
    length = 0.3
    spacings = (10.0, 7.5) if runner.small else (15.0, 10.0, 7.5, 5.0)

    def displacement(z: np.ndarray) -> np.ndarray:
        places = np.linspace(0.0, length, 10001)
        load = DENSITY * GRAVITY * (length - places) / YOUNG
        stretch = np.exp(load)
        for _ in range(20):
            stretch = np.exp(load * stretch ** (2.0 * POISSON))
        strain = stretch - 1.0
        summed = np.concatenate([[0.0], np.cumsum(0.5 * (strain[1:] + strain[:-1]) * np.diff(places))])
        return np.interp(z, places, summed)

    def difference(run: Run) -> float:
        layers, mean = mean_displacement(run, along=2)
        return mean[-1] / displacement(layers[-1]) - 1.0

    curve = Curve("Bar under its own weight", "distance from the plane [mm]", "displacement [um]", [])
    for state, influence in operators(runner):
        layers, mean = mean_displacement(runner("hanging_bar", **choose(state, influence)), along=2)
        outcome.rows.append(
            Row(f"hanging_bar: {state}, {influence}", "elongation", "m", float(displacement(layers[-1])), mean[-1],
                0.003, "the section at the plane, which may not warp, delta/L = 10 per cent of a bar whose stress"
                " falls by 3 per cent a layer")
        )
        if influence == "linear":
            curve.found.append((f"{state}, {influence}", 1e3 * layers, 1e6 * mean))
            if not curve.expected:
                curve.expected.append(("closed form", 1e3 * layers, 1e6 * displacement(layers)))
    for state in STATES:
        refine(outcome, runner, "hanging_bar", state, spacings, difference, 1.5, 0.6,
               "between first order, from the layers at both ends, and second, from those at the sides")
    outcome.curves.append(curve)
    return outcome


def self_weight_column(runner: Runner) -> Outcome:
    """sigma_v = rho g depth more than a horizon away from the ends."""
    outcome = Outcome()

    def profile(run: Run) -> np.ndarray:
        """Rows: depth, vertical stress and -rho g depth of the layers."""
        stage = next(stage for stage in run.summary["stages"] if "vertical_stress" in stage)
        return np.array(stage["vertical_stress"]["layers"]).T

    def deviation(run: Run) -> np.ndarray:
        _, stress, weight = profile(run)
        return (stress - weight) / np.abs(weight).max()

    def resolved_deviation(run: Run) -> float:
        depth = profile(run)[0]
        horizon = HORIZON_RATIO * (depth[1] - depth[0])
        smooth = np.convolve(deviation(run), (0.25, 0.5, 0.25), "same")
        return float(np.abs(smooth[(depth > depth[0] + horizon) & (depth < depth[-1] - horizon)]).max())

    curve = Curve("Layer under its own weight", "vertical stress [kPa]", "depth [mm]", [])
    for state, influence in operators(runner):
        run = runner("self_weight_column", **choose(state, influence))
        outcome.rows.append(
            Row(f"self_weight_column: {state}, {influence}", "deviation from rho g depth over the bottom stress", "-",
                0.0, resolved_deviation(run), 0.03,
                "one layer weighs 3 per cent of the bottom stress; of each layer with half its neighbours: the reaction"
                " of the floor acts on one row and leaves a wave two layers long that dies out upwards", absolute=True)
        )
        if influence == "linear":
            depth, stress, weight = profile(run)
            curve.found.append((f"{state}, {influence}", -1e-3 * stress, 1e3 * depth))
            if not curve.expected:
                curve.expected.append(("rho g depth", -1e-3 * weight, 1e3 * depth))
    for state in STATES:
        refine(outcome, runner, "self_weight_column", state, (10.0, 5.0), lambda run: np.abs(deviation(run)).mean(),
               1.0, 0.1,
               "first order: the deviation lives in a layer as thick as the horizon, with the same profile at every"
               " spacing")
    outcome.curves.append(curve)
    return outcome


def suction_cube(runner: Runner) -> Outcome:
    """sigma' = -S_r s 1, so that the total stress is zero, and ln(l/l0) = -S_r s/(3K) of every edge."""
    outcome = Outcome()
    pull = 0.5 * 2.0e3
    for state, influence in operators(runner):
        run = runner("suction_cube", **choose(state, influence))
        last = run.fields()
        total = last["effective_stress"][:, :3] + pull
        size = np.ptp(last["position"], axis=0) / np.ptp(last["initial_position"], axis=0)
        name = f"suction_cube: {state}, {influence}"
        outcome.rows.append(
            Row(name, "largest total stress of a point over S_r s", "-", 0.0, float(np.abs(total).max() / pull), 1e-3,
                "the residual of the stage is 1e-5 of the force at its start, over the softest mode", absolute=True)
        )
        outcome.rows.append(
            Row(name, "ln of the stretch of the edges", "-", -pull / (3.0 * BULK), float(np.log(size).mean()), 1e-3,
                "the same; the stretch is uniform")
        )
    return outcome


def cantilever(runner: Runner) -> Outcome:
    """Deflection of a Timoshenko beam under rho g, I/A = h^2/12, shear factor 10 (1 + nu)/(12 + 11 nu) (Cowper 1966)."""
    outcome = Outcome()
    length, height, gravity = 0.24, 0.06, 0.5
    shear_factor = 10.0 * (1.0 + POISSON) / (12.0 + 11.0 * POISSON)
    spacings = (15.0, 10.0) if runner.small else (10.0, 7.5, 5.0)

    def deflection(x: np.ndarray) -> np.ndarray:
        bending = DENSITY * gravity / (2.0 * YOUNG * height**2) * x**2 * (6.0 * length**2 - 4.0 * length * x + x**2)
        return bending + DENSITY * gravity / (shear_factor * SHEAR) * (length * x - 0.5 * x**2)

    def axis(run: Run) -> tuple[np.ndarray, np.ndarray]:
        """The free part of the beam, and how far it hangs down."""
        x, mean = mean_displacement(run, along=0)
        return x[x > 0.0], -mean[x > 0.0]

    def stiffness(run: Run) -> float:
        x, found = axis(run)
        return deflection(x[-1]) / found[-1]

    curve = Curve("Cantilever under its own weight", "distance from the clamp [mm]", "deflection [mm]", [])
    for state in STATES:
        finest = refine(
            outcome, runner, "cantilever", state, spacings, lambda run: stiffness(run) - 1.0, 1.5, 0.5, SOFT_FACES_ORDER
        )
        horizon = HORIZON_RATIO * 1e-3 * spacings[-1]
        outcome.rows.append(
            Row(f"cantilever: {state}, spacing {spacings[-1]:g} mm", "stiffness over that of the beam", "-", 1.0,
                stiffness(finest), 3.0 * (horizon / height) ** 2, SOFT_FACES + "E I at most 3 delta^2/h^2")
        )
        x, found = axis(finest)
        curve.found.append((state, 1e3 * x, 1e3 * found))
        if not curve.expected:
            curve.expected.append(("Timoshenko beam", 1e3 * x, 1e3 * deflection(x)))
    outcome.curves.append(curve)
    return outcome
