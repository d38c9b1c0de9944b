# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What is held against what: one function a case, returning rows of a table and curves for the page.

Every expectation is a closed form; every tolerance carries its reason.
"""
from __future__ import annotations

from collections.abc import Callable

from periporo_tools.verification.motion import collision, incline, spinning_block, vibrating_block
from periporo_tools.verification.outcome import Outcome
from periporo_tools.verification.runner import Runner
from periporo_tools.verification.soil import heap_at_rest, sliding_sheet
from periporo_tools.verification.statics import cantilever, hanging_bar, self_weight_column, suction_cube
from periporo_tools.verification.water import floating_raft, half_submerged_slope, submerged_column
from periporo_tools.verification.waves import bar_vibration, bar_wave, p_wave, torsion

CHECKS: dict[str, Callable[[Runner], Outcome]] = {
    function.__name__: function
    for function in (
        p_wave, bar_wave, bar_vibration, torsion, hanging_bar, cantilever, self_weight_column, suction_cube, incline,
        collision, spinning_block, vibrating_block, submerged_column, half_submerged_slope, floating_raft, sliding_sheet,
        heap_at_rest,
    )
}
