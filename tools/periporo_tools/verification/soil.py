# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Soil that flows and comes to rest."""
from __future__ import annotations

import numpy as np

from periporo_tools.verification.elastic import GRAVITY, STATES, choose
from periporo_tools.verification.outcome import Curve, Outcome, Row
from periporo_tools.verification.runner import Runner


def sliding_sheet(runner: Runner) -> Outcome:
    """A sheet two points thick falls 5 mm, slides v^2/(2 mu g) and lies on the floor: nothing hangs, nothing sinks."""
    outcome = Outcome()
    speed, friction, spacing = 0.5, 0.2, 0.01
    fall = np.sqrt(2.0 * 0.005 / GRAVITY)  # flies at full speed until then
    # a landing without bounce takes mu times the vertical momentum
    landed = speed - friction * GRAVITY * fall
    expected = speed * fall + landed**2 / (2.0 * friction * GRAVITY)
    curve = Curve("A thin sheet of soil slides to rest", "time [s]", "travel of the centre of mass [mm]", [])
    for state in STATES:
        run = runner("sliding_sheet", **choose(state, "linear"))
        times = np.array(run.times)
        travel = run.travel(axis=0)
        last, history = run.fields(), run.history
        height = last["position"][:, 2] / spacing
        name = f"sliding_sheet: {state}"
        outcome.rows += [
            Row(name, "travel", "m", expected, travel[-1], 0.05,
                "the sheet is soft: its landing takes a few ms, and its rim slides apart from the rest"),
            Row(name, "lowest point above the floor over the spacing", "-", 0.5, float(height.min()), 0.05,
                "the contact spring gives way by m g/k, 1e-4 of a spacing, and by more under the landing",
                absolute=True),
            Row(name, "highest point above the floor over the spacing", "-", 1.5, float(height.max()), 0.5,
                "loosened soil of two layers; a point that hangs would be higher", absolute=True),
            Row(name, "root-mean-square speed at the end over that at the start", "-", 0.0,
                float(np.sqrt(history["kinetic_energy"][-1] / history["kinetic_energy"][0])), 0.02,
                "a few loose grains still lie down", absolute=True),
            Row(name, "energy error at the end over the energy at the start", "-", 0.0,
                float(abs(history["energy_error"][-1]) / history["kinetic_energy"][0]), 0.005,
                "landing and plastic flow are not linear within a step", absolute=True),
        ]
        curve.found.append((state, times, 1e3 * travel))
        if not curve.expected:
            sliding = np.maximum(times - fall, 0.0)
            sliding = np.minimum(sliding, landed / (friction * GRAVITY))
            path = speed * np.minimum(times, fall) + landed * sliding - 0.5 * friction * GRAVITY * sliding**2
            curve.expected.append(("Coulomb friction", times, 1e3 * path))
    outcome.curves.append(curve)
    return outcome


def heap_at_rest(runner: Runner) -> Outcome:
    """A coarse heap of soil stays where it came to rest."""
    settings = {"stage__rest__duration": 0.3} if runner.small else {}
    run = runner("heap_at_rest", **settings)
    times = np.array(run.times)
    start = int(np.argmin(np.abs(times - 0.7)))  # 0.1 s for the last grains to lie down
    begin, end = run.fields(start), run.fields(-1)
    moved = np.linalg.norm(end["position"] - begin["position"], axis=1)
    history = run.history
    resting = history["time"] >= times[start]
    return Outcome(
        [
            Row("heap_at_rest", f"largest motion of a point in {times[-1] - times[start]:.1f} s over the spacing", "-",
                0.0, float(moved.max() / 0.02), 0.1, "a tenth of a spacing is what finds families anew", absolute=True),
            Row("heap_at_rest", "largest kinetic energy at rest over that of the collapse", "-", 0.0,
                float(history["kinetic_energy"][resting].max() / history["kinetic_energy"].max()), 1e-4,
                "motion of 1 per cent of the speed of the collapse", absolute=True),
        ],
        [Curve("A heap at rest", "time [s]", "log10 of kinetic energy [J]",
               [("found", history["time"], np.log10(np.maximum(history["kinetic_energy"], 1e-18)))])],
    )
