# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The sand of the curves of Drucker-Prager and Mohr-Coulomb, and the tests it goes through."""
from __future__ import annotations

import numpy as np

from periporo_tools.material_curves.driver import Table

BULK, SHEAR = 25e6, 15e6  # K, G [Pa]
FRICTION, DILATANCY = np.radians(34.0), np.radians(10.0)  # phi, psi
COHESION = 2e3  # c [Pa]
PRESSURE = 20e3  # at the start, and of the deviatoric plane [Pa]
STRAIN, STEPS = 0.006, 60  # axial, of a test
TOLERANCE, REASON = 1e-7, "the driver leaves 1e-9 of the axial stress in each of 60 steps"


def sand(model: str, dilatancy: float = DILATANCY, **more: object) -> Table:
    """The material by its law; angles go to the program in degrees."""
    return {
        "model": model, "bulk_modulus": BULK, "shear_modulus": SHEAR, "cohesion": COHESION,
        "friction_angle": f"{np.degrees(FRICTION)} deg", "dilatancy_angle": f"{np.degrees(dilatancy)} deg", **more,
    }


def axial_test(kind: str, **target: object) -> Table:
    """A stage of the tests."""
    return {"type": kind, "steps": STEPS, "duration": 1.0, **target}
