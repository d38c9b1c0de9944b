# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Bodies below and across a water table."""
from __future__ import annotations

import numpy as np

from periporo_tools.verification.elastic import GRAVITY, HORIZON_RATIO, STATES, choose
from periporo_tools.verification.outcome import Curve, Outcome, Row
from periporo_tools.verification.runner import Run, Runner

WATER = 1000.0  # density [kg/m3]
GRAINS, PORES, ABOVE = 2200.0, 0.4, 0.5  # grain density, porosity and saturation above the table of the cases
MOIST = GRAINS * (1.0 - PORES) + ABOVE * PORES * WATER
IN_WATER = (GRAINS - WATER) * (1.0 - PORES)


def submerged_column(runner: Runner) -> Outcome:
    """sigma_v' + S_r s is the weight above, in water that of grains less that of the water in their place."""
    outcome = Outcome()
    height, spacing = 0.3, 0.01
    curve = Curve("Layer below a water table", "effective vertical stress [kPa]", "height [mm]", [])

    def carried(z: np.ndarray, table: float) -> np.ndarray:
        dry = height - np.clip(z, table, height)
        return GRAVITY * (MOIST * dry + IN_WATER * (height - z - dry))

    def profile(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Heights of the layers, effective stress and S_r s, compression positive."""
        last = run.fields()
        order = np.argsort(last["position"][:, 2])
        stress, suction = -last["effective_stress"][order, 2], last["suction"][order]
        return last["initial_position"][order, 2], stress, last["saturation"][order] * suction

    for table, name in ((0.4, "under water"), (0.15, "half under water")):
        for state in STATES:
            run = runner("submerged_column", body__layer__water__water_table=f"z = {1e3 * table:g} mm",
                         **choose(state, "linear"))
            z, stress, pull = profile(run)
            bottom = carried(np.zeros(1), table)[0]
            deviation = np.convolve((stress - pull - carried(z, table)) / bottom, (0.25, 0.5, 0.25), "same")
            inner = (z > z[0] + HORIZON_RATIO * spacing) & (z < z[-1] - HORIZON_RATIO * spacing)
            title = f"submerged_column: {state}, {name}"
            outcome.rows.append(
                Row(title, "sigma_v' + S_r s less the weight in water over the bottom stress", "-", 0.0,
                    float(np.abs(deviation[inner]).max()), 0.03,
                    "as self_weight_column: one layer weighs 3 per cent of the bottom stress, the reaction of the"
                    " floor leaves a wave two layers long", absolute=True)
            )
            pressure = run.fields()["pore_pressure"]
            at_rest = WATER * GRAVITY * (table - run.fields()["position"][:, 2])
            outcome.rows.append(
                Row(title, "largest difference of the pore pressure from water at rest over rho_w g dx", "-", 0.0,
                    float(np.abs(pressure - at_rest).max() / (WATER * GRAVITY * spacing)), 0.05,
                    "suction stays with the soil, which settles by 0.3 mm", absolute=True)
            )
            if state == STATES[0]:
                curve.found.append((name, 1e-3 * stress, 1e3 * z))
                suction = ABOVE * WATER * GRAVITY * np.maximum(z - table, 0.0)
                curve.expected.append((f"weight, {name}", 1e-3 * (carried(z, table) + suction), 1e3 * z))
    outcome.curves.append(curve)
    return outcome


def half_submerged_slope(runner: Runner) -> Outcome:
    """The floor carries the weight less rho_w g times the volume under water; still water pushes to no side."""
    outcome = Outcome()
    for state in STATES:
        run = runner("half_submerged_slope", **choose(state, "linear"))
        last, history = run.fields(), run.history
        below = last["initial_position"][:, 2] < 0.06
        # grains and pores of the beginning: pores that open under water take up what their buoyancy grows by
        volume = last["volume"] / last["volume_ratio"]
        weight = GRAVITY * float(volume @ np.where(below, IN_WATER, MOIST))
        travel = run.travel(axis=0)
        outcome.rows += [
            Row(f"half_submerged_slope: {state}", "load on the floor", "N", weight, -history["floor_force_z"][0], 2e-3,
                "the residual of the settling, 1e-4 of the root sum of the weights, times the root of 312 points"),
            Row(f"half_submerged_slope: {state}", "travel along the smooth floor over that of a free fall", "-", 0.0,
                float((travel[-1] - travel[0]) / (0.5 * GRAVITY * run.times[-1] ** 2)), 1e-9,
                "round-off: forces within the slope are opposite. The water on the vertical face alone would make it"
                " 0.04", absolute=True),
        ]
    return outcome


def floating_raft(runner: Runner) -> Outcome:
    """Rises with (rho_w/rho - 1) g and without added mass; its flight ends at the height that the work allows."""
    run = runner("floating_raft")
    density, thickness, middle = 500.0 * 0.8 + 0.2 * WATER, 0.06, 0.37
    history, times, travel = run.history, np.array(run.times), run.travel(axis=2)
    up = (WATER / density - 1.0) * GRAVITY
    surfaced = np.sqrt(2.0 * (middle - 0.5 * thickness) / up)  # its top reaches the surface
    rising = times < surfaced
    last_wet = int(np.flatnonzero(rising)[-1])
    # m g (middle + summit) = rho_w V g middle: each layer loses its lift at the surface
    summit = (WATER / density - 1.0) * middle
    peak = np.polyfit(times[np.argmax(travel) - 1:np.argmax(travel) + 2] - times[np.argmax(travel)],
                      travel[np.argmax(travel) - 1:np.argmax(travel) + 2], 2)
    found = float(peak[2] - 0.25 * peak[1] ** 2 / peak[0]) - middle
    work = float(np.abs(history["boundary_work"]).max())
    outcome = Outcome(
        [
            Row("floating_raft", "rise while under water", "m", 0.5 * up * times[last_wet] ** 2,
                float(travel[last_wet]), 1e-6, "a constant force on all points alike, which velocity Verlet"
                " integrates exactly"),
            Row("floating_raft", "summit of the flight above the surface", "m", summit, found, 2e-3,
                "a parabola through three snapshots; the raft springs by rho g h^2/(2E) when it leaves the water"),
            Row("floating_raft", "largest energy error over the work of the water", "-", 0.0,
                float(np.abs(history["energy_error"]).max() / work), 1e-3,
                "stress is not linear in the motion of a step", absolute=True),
        ]
    )
    outcome.curves.append(
        Curve("A raft comes up from under water", "time [s]", "height of the middle [mm]",
              [("found", times, 1e3 * (travel - middle))],
              [("(rho_w/rho - 1) g t^2/2", times[rising], 1e3 * (0.5 * up * times[rising] ** 2 - middle))])
    )
    return outcome
