# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Wave speeds and frequencies of elastic bodies."""
from __future__ import annotations

import numpy as np

from periporo_tools.verification.elastic import (
    BULK, DENSITY, HORIZON_RATIO, SHEAR, SOFT_FACES, SOFT_FACES_ORDER, STATES, YOUNG, choose, operators, refine,
)
from periporo_tools.verification.outcome import Curve, Outcome, Row
from periporo_tools.verification.runner import Run, Runner


def _arrest_time(run: Run) -> float:
    """When the wave has stopped the whole length: the straight part of E_kin(t), from 0.8 to 0.2, drawn on to zero."""
    history = run.history
    time, kinetic = history["time"], history["kinetic_energy"] / history["kinetic_energy"][0]
    first = int(np.argmax(kinetic < 0.05))
    part = (kinetic[:first] < 0.8) & (kinetic[:first] > 0.2)
    slope, start = np.polyfit(time[:first][part], kinetic[:first][part], 1)
    return -start / slope


def _wave(runner: Runner, case: str, length: float, speed: float, kind: str, tolerance: float, reason: str) -> Outcome:
    outcome = Outcome()
    found = []
    for state, influence in operators(runner):
        run = runner(case, **choose(state, influence))
        name = f"{state}, {influence}"
        outcome.rows.append(
            Row(f"{case}: {name}", f"speed of {kind}", "m/s", speed, length / _arrest_time(run), tolerance, reason)
        )
        history = run.history
        kinetic = history["kinetic_energy"]
        if influence == "linear":
            found.append((name, 1e3 * history["time"], kinetic / kinetic[0]))
    time = np.linspace(0.0, length / speed, 100)
    outcome.curves.append(
        Curve(f"{kind[0].upper()}{kind[1:]} stops a moving body", "time [ms]", "kinetic energy over its start [-]", found,
              [("continuum", 1e3 * time, 1.0 - time * speed / length)])
    )
    return outcome


def p_wave(runner: Runner) -> Outcome:
    """(K + 4G/3)/rho: no strain across. Refined, the speed of a wave of given length comes nearer as the square."""
    outcome = _wave(
        runner, "p_wave", 0.5, np.sqrt((BULK + 4.0 / 3.0 * SHEAR) / DENSITY), "a P-wave", 0.003,
        "a wave as long as the layer is slower by (k delta)^2/12 = 0.3 per cent at most",
    )
    speeds = runner.dispersion("p_wave")
    for state, influence in operators(runner):
        for wave in "PS":
            # the same wave on a lattice twice as fine is the one of half the wave number on the same lattice
            (fine, less), (coarse, more) = ((k, 1.0 - speed) for k, speed in speeds[state, influence, "100", wave][:2])
            outcome.rows.append(
                Row(f"p_wave: {state}, {influence}", f"order of the speed of a {wave}-wave, 12 to 24 spacings long", "-",
                    2.0, float(np.log(more / less) / np.log(coarse / fine)), 0.15,
                    "the next term, (k delta)^2/20 of the first, bends the slope by a tenth", absolute=True)
            )
    return outcome


def bar_wave(runner: Runner) -> Outcome:
    """(E/rho)^(1/2): free sides."""
    return _wave(
        runner, "bar_wave", 0.6, np.sqrt(YOUNG / DENSITY), "a wave in a bar", 0.004,
        "as in p_wave, and lateral inertia, (nu k r)^2/4 = 0.1 per cent for a wave as long as the bar",
    )


def _frequency(time: np.ndarray, signal: np.ndarray, near: float) -> float:
    """Angular frequency of the strongest component within a quarter of `near`, under a Hann window [rad/s]."""
    windowed = np.hanning(len(time)) * signal

    def strength(omega: np.ndarray) -> np.ndarray:
        return np.abs(np.exp(-1j * np.outer(omega, time)) @ windowed)

    width = 0.25 * near
    while width > 1e-6 * near:
        tried = np.linspace(near - width, near + width, 41)
        near = tried[np.argmax(strength(tried))]
        width /= 10.0
    return near


def bar_vibration(runner: Runner) -> Outcome:
    """Fixed at one end, free at the other: the lowest frequency is c/(4 L) with c = (E/rho)^(1/2)."""
    outcome = Outcome()
    length, speed = 0.6, np.sqrt(YOUNG / DENSITY)
    expected = speed / (4.0 * length)
    for state, influence in operators(runner):
        run = runner("bar_vibration", **choose(state, influence))
        name = f"{state}, {influence}"
        time, travel = np.array(run.times), run.travel(axis=2)
        found = _frequency(time, travel - travel.mean(), 2.0 * np.pi * expected) / (2.0 * np.pi)
        outcome.rows.append(
            Row(f"bar_vibration: {name}", "lowest frequency", "Hz", expected, found, 0.002,
                "(k delta)^2/12 = 0.05 per cent, and four periods, with overtones, tell a frequency to 0.1 per cent")
        )
        if influence == "linear" and not outcome.curves:
            outcome.curves.append(
                Curve("Axial vibration of a bar", "time [ms]", "displacement of the centre of mass [um]",
                      [(name, 1e3 * time, 1e6 * travel)],
                      [("fundamental mode", 1e3 * time, -1e6 * 0.01 * 8.0 / np.pi**2 / (2.0 * np.pi * expected)
                        * np.sin(2.0 * np.pi * expected * time))])
            )
    return outcome


def torsion(runner: Runner) -> Outcome:
    """c_t/(4 L) with c_t = (G J/(rho I_p))^(1/2); for a square J = 0.1406 a^4 (Saint-Venant) and I_p = a^4/6."""
    outcome = Outcome()
    length, half_width = 0.36, 0.03
    expected = np.sqrt(SHEAR * 6.0 * 0.14058 / DENSITY) / (4.0 * length)
    spacings = (10.0, 7.5) if runner.small else (10.0, 7.5, 5.0)

    # in the small variant delta is 1.0 and 0.75 of the half-width: the layers of opposite faces overlap
    order = (1.0, 1.0, "it falls; the soft layers of the faces fill the section") if runner.small else (
        1.5, 0.5, SOFT_FACES_ORDER)

    def spin(run: Run) -> tuple[np.ndarray, np.ndarray]:
        snapshots = [run.fields(index) for index in range(len(run.times))]
        x, v = snapshots[0]["initial_position"], [f["velocity"] for f in snapshots]
        return np.array(run.times), np.array(
            [(snapshots[0]["mass"] * (x[:, 0] * u[:, 1] - x[:, 1] * u[:, 0])).sum() for u in v]
        )

    def frequency(time: np.ndarray, momentum: np.ndarray) -> float:
        return _frequency(time, momentum, 2.0 * np.pi * expected) / (2.0 * np.pi)

    curve = Curve("Torsional vibration of a bar", "time [ms]", "angular momentum over its start [-]", [])
    for state in STATES:
        finest = refine(
            outcome, runner, "torsion", state, spacings, lambda run: frequency(*spin(run)) / expected - 1.0, *order,
        )
        time, momentum = spin(finest)
        horizon = HORIZON_RATIO * 1e-3 * spacings[-1]
        outcome.rows.append(
            Row(f"torsion: {state}, spacing {spacings[-1]:g} mm", "lowest frequency", "Hz", expected,
                frequency(time, momentum), 1.0 - np.sqrt(1.0 - (horizon / half_width) ** 2),
                SOFT_FACES + "G J at most delta^2/r^2")
        )
        curve.found.append((state, 1e3 * time, momentum / momentum[0]))
        if not curve.expected:
            curve.expected.append(
                ("fundamental mode", 1e3 * time, 8.0 / np.pi**2 * np.cos(2.0 * np.pi * expected * time))
            )
    outcome.curves.append(curve)
    return outcome
