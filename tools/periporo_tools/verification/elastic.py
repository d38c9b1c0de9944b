# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the elastic checks have in common: the material of elastic_base.toml, operators to run, refinement."""
from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from periporo_tools.verification.outcome import Outcome, Refinement, Row
from periporo_tools.verification.runner import Run, Runner

# cases/verification/elastic_base.toml
DENSITY, BULK, SHEAR = 2000.0, 2.0e6, 1.2e6
YOUNG = 9.0 * BULK * SHEAR / (3.0 * BULK + SHEAR)
POISSON = (3.0 * BULK - 2.0 * SHEAR) / (6.0 * BULK + 2.0 * SHEAR)
GRAVITY = 9.81
HORIZON_RATIO = 3.015

# why a body whose strain varies across the section is soft, and how that goes with refinement
SOFT_FACES = "within delta of a face a bond sees the gradient up to 3 delta/8 farther in, where it is smaller: of "
SOFT_FACES_ORDER = "second order in the end, less while the soft layers of the faces fill the section"

STATES = ("energy_conjugate", "bond_projection")
INFLUENCES = ("constant", "linear", "quadratic", "gaussian", "cubic_b_spline", "inverse_distance")


def operators(runner: Runner) -> Iterator[tuple[str, str]]:
    """Force state and influence function: all of them in full, the defaults of both states in the small variant."""
    for state in STATES:
        for influence in ("linear",) if runner.small else INFLUENCES:
            yield state, influence


def choose(state: str, influence: str) -> dict[str, str]:
    return {"operator__force_state": state, "operator__influence": influence}


def mean_displacement(run: Run, along: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the layers of points across an axis began, and the mean of u_z over each [m]."""
    last = run.fields()
    place = last["initial_position"][:, along]
    layers = np.unique(np.round(place, 9))
    return layers, np.array([last["displacement"][np.isclose(place, layer), 2].mean() for layer in layers])


def refine(
    outcome: Outcome, runner: Runner, case: str, state: str, spacings: Sequence[float],
    difference: Callable[[Run], float], expected: float, tolerance: float, reason: str,
) -> Run:
    """Adds the order at which a case comes nearer to its closed form, with the default influence function.

    @param spacings coarse to fine [mm]; they divide the edges of the body
    @param difference of a run from the closed form, relative
    @return the run on the finest lattice
    """
    runs = [runner(case, discretization__spacing=f"{spacing:g} mm", **choose(state, "linear")) for spacing in spacings]
    refinement = Refinement(
        f"{case}: {state}", 1e-3 * np.array(spacings), np.array([difference(run) for run in runs])
    )
    outcome.refinements.append(refinement)
    outcome.rows.append(
        Row(refinement.name, f"order of convergence, spacing {spacings[-2]:g} to {spacings[-1]:g} mm", "-", expected,
            refinement.order, tolerance, reason, absolute=True)
    )
    return runs[-1]
