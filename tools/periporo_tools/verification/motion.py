# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Contact, friction and the conservation laws of elastic bodies in motion."""
from __future__ import annotations

import numpy as np

from periporo_tools.verification.elastic import DENSITY, GRAVITY, STATES, choose
from periporo_tools.verification.outcome import Curve, Outcome, Row
from periporo_tools.verification.runner import Runner


def incline(runner: Runner) -> Outcome:
    """Travel g (sin a - mu cos a) t^2/2 on 30 degrees with mu = 0.3; none with mu = 0.8 > tan 30 = 0.577."""
    outcome = Outcome()
    for state in STATES:
        run = runner("incline", **choose(state, "linear"))
        time = np.array(run.times)
        travel = run.travel(axis=0)
        rate = 0.5 * (GRAVITY * 0.5 - 0.3 * GRAVITY * np.sqrt(0.75))
        outcome.rows.append(
            Row(f"incline: {state}, mu = 0.3", "travel in 0.2 s", "m", rate * time[-1] ** 2, travel[-1], 0.005,
                "the block lands on its contact springs in the first 1 per cent of the time")
        )
        held = runner("incline_held", **choose(state, "linear"))
        middle = int(np.argmin(np.abs(np.array(held.times) - 0.1)))
        begin, end = held.fields(middle), held.fields()
        base = np.isclose(begin["initial_position"][:, 2], begin["initial_position"][:, 2].min())
        slid = np.linalg.norm((end["position"] - begin["position"])[base], axis=1)
        outcome.rows.append(
            Row(f"incline_held: {state}, mu = 0.8", "largest slip of a point of the base from 0.1 to 0.2 s", "m", 0.0,
                float(slid.max()), 1e-7, "a fiftieth of the block's own compression, rho g h^2/(2E): what vibration"
                " of the residual of the settling leaves", absolute=True)
        )
        if state == STATES[0]:
            outcome.curves.append(
                Curve("Block on an incline", "time [s]", "travel [mm]", [("mu = 0.3", time, 1e3 * travel)],
                      [("g (sin - mu cos) t^2/2", time, 1e3 * rate * time**2)])
            )
    return outcome


def collision(runner: Runner) -> Outcome:
    """Two grains and a spring: contact lasts pi (m_r/k)^(1/2), and they part as fast as they came."""
    run = runner("collision")
    history = run.history
    mass = DENSITY * 1e-6
    duration = np.pi * np.sqrt(0.5 * mass / 1e3)
    energy = history["contact_energy"]
    step = history["time"][1] - history["time"][0]
    # the grains start apart: count the rows with overlap
    found = np.count_nonzero(energy > 0.0) * step
    last = run.fields()
    speed = last["velocity"][:, 0]
    time = history["time"][energy > 0.0]
    begin = time[0] - 0.5 * step
    peak = mass * 0.1**2
    outcome = Outcome(
        [
            Row("collision", "duration of the contact", "s", duration, float(found), 2.0 * step / duration,
                "one row of the history at either end"),
            Row("collision", "restitution", "-", 1.0, float(np.abs(speed).mean() / 0.1), 1e-3,
                "a step ends inside the contact: (omega dt)^2/8 of the energy of the spring"),
            Row("collision", "largest energy of the spring over the energy of motion", "-", 1.0,
                float(energy.max() / peak), 2e-3, "the row nearest to the peak: (omega dt)^2/4"),
        ]
    )
    outcome.curves.append(
        Curve("Two grains collide", "time since the first touch [ms]", "energy of the spring [uJ]",
              [("found", 1e3 * (time - begin), 1e6 * energy[energy > 0.0])],
              [("half a sine, squared", 1e3 * (time - begin),
                1e6 * peak * np.sin(np.pi * (time - begin) / duration) ** 2)])
    )
    return outcome


def spinning_block(runner: Runner) -> Outcome:
    """Momentum and angular momentum to round-off through families found anew in every step."""
    outcome = Outcome()
    curve = Curve("A block that flies and spins", "time [s]", "change of angular momentum over its start [-]", [])
    for state in STATES:
        settings = {"stage__flight__duration": 0.05} if runner.small else {}
        run = runner("spinning_block", **choose(state, "linear"), **settings)
        momentum, spin = [], []
        for index in range(len(run.times)):
            f = run.fields(index)
            weight = f["mass"][:, None]
            momentum.append((weight * f["velocity"]).sum(axis=0))
            spin.append((weight * np.cross(f["position"], f["velocity"])).sum(axis=0))
        momentum, spin = np.array(momentum), np.array(spin)
        steps = run.summary["steps"]
        reason = f"round-off of {steps} steps, 2e-16 each of forces 1e3 times the weight of the change"
        name = f"spinning_block: {state}"
        outcome.rows.append(
            Row(name, "change of momentum over its size", "-", 0.0,
                float(np.abs(momentum - momentum[0]).max() / np.linalg.norm(momentum[0])), 1e-11, reason, absolute=True)
        )
        outcome.rows.append(
            Row(name, "change of angular momentum over its size", "-", 0.0,
                float(np.abs(spin - spin[0]).max() / np.linalg.norm(spin[0])), 1e-10, reason, absolute=True)
        )
        curve.found.append((state, np.array(run.times), np.linalg.norm(spin - spin[0], axis=1) / np.linalg.norm(spin[0])))
    outcome.curves.append(curve)
    return outcome


def vibrating_block(runner: Runner) -> Outcome:
    """A stressed elastic block vibrates for 200,000 steps: kinetic energy and work of stress keep their sum."""
    outcome = Outcome()
    curve = Curve("A stressed block vibrates", "time [s]", "energy error over the largest kinetic energy [-]", [])
    for state in STATES:
        settings = {"stage__vibration__duration": 0.5} if runner.small else {}
        run = runner("vibrating_block", **choose(state, "linear"), **settings)
        history = run.history
        error = history["energy_error"] / history["kinetic_energy"].max()
        outcome.rows.append(
            Row(f"vibrating_block: {state}", f"energy error after {run.summary['steps']} steps", "-", 0.0,
                float(np.abs(error).max()), 1e-3, "0.1 per cent of the energy that moves to and fro", absolute=True)
        )
        curve.found.append((state, history["time"], error))
    outcome.curves.append(curve)
    return outcome
