# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Constants of isotropic elasticity from bulk and shear modulus."""
from __future__ import annotations


def young_modulus(bulk: float, shear: float) -> float:
    """E [Pa] of K and G [Pa]."""
    return 9.0 * bulk * shear / (3.0 * bulk + shear)


def poisson_ratio(bulk: float, shear: float) -> float:
    """nu [-] of K and G [Pa]."""
    return (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
