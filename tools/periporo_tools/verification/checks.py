# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What is held against what: one function a case, returning rows of a table and a curve for the page.

Every expectation is a closed form; every tolerance carries its reason.
"""
from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from periporo_tools.verification.runner import Run, Runner

# cases/verification/elastic_base.toml
DENSITY, BULK, SHEAR = 2000.0, 2.0e6, 1.2e6
YOUNG = 9.0 * BULK * SHEAR / (3.0 * BULK + SHEAR)
GRAVITY = 9.81

STATES = ("energy_conjugate", "bond_projection")
INFLUENCES = ("constant", "linear", "quadratic", "gaussian", "cubic_b_spline", "inverse_distance")


@dataclass(frozen=True)
class Row:
    """One line of the table. `tolerance` is on |found - expected|, relative to |expected| unless `absolute`."""

    name: str
    quantity: str
    unit: str
    expected: float
    found: float
    tolerance: float
    reason: str
    absolute: bool = False

    @property
    def difference(self) -> float:
        apart = self.found - self.expected
        return apart if self.absolute else apart / abs(self.expected)

    @property
    def holds(self) -> bool:
        return bool(np.isfinite(self.found)) and abs(self.difference) <= self.tolerance


@dataclass(frozen=True)
class Curve:
    """A panel of the page: what was found over what was expected."""

    title: str
    x_label: str
    y_label: str
    found: list[tuple[str, np.ndarray, np.ndarray]]
    expected: list[tuple[str, np.ndarray, np.ndarray]] = field(default_factory=list)


@dataclass
class Outcome:
    rows: list[Row] = field(default_factory=list)
    curves: list[Curve] = field(default_factory=list)


def _operators(runner: Runner) -> Iterator[tuple[str, str]]:
    """Force state and influence function: all of them in full, the defaults of both states in the small variant."""
    for state in STATES:
        for influence in ("linear",) if runner.small else INFLUENCES:
            yield state, influence


def _set(state: str, influence: str) -> dict[str, str]:
    return {"operator__force_state": state, "operator__influence": influence}


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
    for state, influence in _operators(runner):
        run = runner(case, **_set(state, influence))
        name = f"{state}, {influence}"
        outcome.rows.append(
            Row(f"{case}: {name}", f"speed of {kind}", "m/s", speed, length / _arrest_time(run), tolerance, reason)
        )
        history = run.history
        kinetic = history["kinetic_energy"]
        if influence == "linear":
            found.append((name, 1e3 * history["time"], kinetic / kinetic[0]))
    time = np.linspace(0.0, 2.0 * length / speed, 100)
    outcome.curves.append(
        Curve(f"{kind} stops a moving body", "time [ms]", "kinetic energy over its start [-]", found,
              [("continuum", 1e3 * time, np.abs(1.0 - time * speed / length))])
    )
    return outcome


def p_wave(runner: Runner) -> Outcome:
    """(K + 4G/3)/rho: no strain across."""
    return _wave(
        runner, "p_wave", 0.5, np.sqrt((BULK + 4.0 / 3.0 * SHEAR) / DENSITY), "a P-wave", 0.005,
        "a wave as long as the layer is slower by (k delta)^2/12 = 0.3 per cent at most",
    )


def bar_wave(runner: Runner) -> Outcome:
    """(E/rho)^(1/2): free sides."""
    return _wave(
        runner, "bar_wave", 0.6, np.sqrt(YOUNG / DENSITY), "a wave in a bar", 0.005,
        "as in p_wave, and lateral inertia, (nu k r)^2/4 = 0.1 per cent for a wave as long as the bar",
    )


def hanging_bar(runner: Runner) -> Outcome:
    """u_z = rho g (L z - z^2/2)/E on the axis of a slender bar, the mean over a section at its end."""
    outcome = Outcome()
    length = 0.3
    for state, influence in _operators(runner):
        run = runner("hanging_bar", **_set(state, influence))
        last = run.fields()
        z = last["initial_position"][:, 2]
        layers = np.unique(np.round(z, 9))
        mean = np.array([last["displacement"][np.isclose(z, layer), 2].mean() for layer in layers])
        end = layers[-1]
        expected = DENSITY * GRAVITY / YOUNG * (length * end - 0.5 * end**2)
        outcome.rows.append(
            Row(f"hanging_bar: {state}, {influence}", "elongation", "m", expected, mean[-1], 0.005,
                "strain rho g L/E = 0.2 per cent, and the section at the plane, which may not warp, r^2/L^2 = 1 per cent"
                " of its own height")
        )
        if influence == "linear":
            if not outcome.curves:
                outcome.curves.append(
                    Curve("Bar under its own weight", "distance from the plane [mm]", "displacement [um]", [],
                          [("closed form", 1e3 * layers,
                            1e6 * DENSITY * GRAVITY / YOUNG * (length * layers - 0.5 * layers**2))])
                )
            outcome.curves[0].found.append((f"{state}, {influence}", 1e3 * layers, 1e6 * mean))
    return outcome


def self_weight_column(runner: Runner) -> Outcome:
    """sigma_v = rho g depth more than a horizon away from the ends."""
    outcome = Outcome()
    curve = Curve("Layer under its own weight", "vertical stress [kPa]", "depth [mm]", [])
    for state, influence in _operators(runner):
        run = runner("self_weight_column", **_set(state, influence))
        profile = next(s for s in run.summary["stages"] if "vertical_stress" in s)["vertical_stress"]
        outcome.rows.append(
            Row(f"self_weight_column: {state}, {influence}", "deviation from rho g depth over the bottom stress", "-",
                0.0, profile["inner_deviation"], 0.03,
                "the reaction of the floor acts on one row; what that does to the next rows dies out over a horizon or"
                " two, and one layer weighs 3 per cent of the bottom stress", absolute=True)
        )
        if influence == "linear":
            depth, stress, weight = np.array(profile["layers"]).T
            curve.found.append((f"{state}, {influence}", -1e-3 * stress, 1e3 * depth))
            if not curve.expected:
                curve.expected.append(("rho g depth", -1e-3 * weight, 1e3 * depth))
    outcome.curves.append(curve)
    return outcome


def suction_cube(runner: Runner) -> Outcome:
    """sigma' = -S_r s 1, so that the total stress is zero, and ln(l/l0) = -S_r s/(3K) of every edge."""
    outcome = Outcome()
    pull = 0.5 * 2.0e3
    for state, influence in _operators(runner):
        run = runner("suction_cube", **_set(state, influence))
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


def incline(runner: Runner) -> Outcome:
    """Travel g (sin a - mu cos a) t^2/2 on 30 degrees with mu = 0.3; none with mu = 0.8 > tan 30 = 0.577."""
    outcome = Outcome()
    for state in STATES:
        run = runner("incline", **_set(state, "linear"))
        time = np.array(run.times)
        travel = np.array(
            [(f["displacement"][:, 0] * f["mass"]).sum() / f["mass"].sum() for f in map(run.fields, range(len(time)))]
        )
        rate = 0.5 * (GRAVITY * 0.5 - 0.3 * GRAVITY * np.sqrt(0.75))
        outcome.rows.append(
            Row(f"incline: {state}, mu = 0.3", "travel in 0.2 s", "m", rate * time[-1] ** 2, travel[-1], 0.005,
                "the block lands on its contact springs in the first 1 per cent of the time")
        )
        held = runner("incline_held", **_set(state, "linear"))
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
        run = runner("spinning_block", **_set(state, "linear"), **settings)
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
        run = runner("vibrating_block", **_set(state, "linear"), **settings)
        history = run.history
        error = history["energy_error"] / history["kinetic_energy"].max()
        outcome.rows.append(
            Row(f"vibrating_block: {state}", f"energy error after {run.summary['steps']} steps", "-", 0.0,
                float(np.abs(error).max()), 1e-3, "0.1 per cent of the energy that moves to and fro", absolute=True)
        )
        curve.found.append((state, history["time"], error))
    outcome.curves.append(curve)
    return outcome


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
        run = runner("sliding_sheet", **_set(state, "linear"))
        times = np.array(run.times)
        travel = np.array(
            [(f["displacement"][:, 0] * f["mass"]).sum() / f["mass"].sum() for f in map(run.fields, range(len(times)))]
        )
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


CHECKS: dict[str, Callable[[Runner], Outcome]] = {
    function.__name__: function
    for function in (
        p_wave, bar_wave, hanging_bar, self_weight_column, suction_cube, incline, collision, spinning_block,
        vibrating_block, sliding_sheet, heap_at_rest,
    )
}
