# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The loads of the benchmark, and what a run under one of them took."""
from __future__ import annotations

import os
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

import h5py
import numpy as np

from periporo_tools.results import read_summary

_SPACING = 0.005  # [m], of the case
_SKIN = 0.1 * _SPACING
_STEP = 3.8e-5  # about what the program takes [s]
# As often as on the mean of a whole collapse (a = 1.2, dx = 10 mm: 362 times in 10,000 steps).
_STEPS_PER_REFRESH = 28

# Floating-point operations of a bond and step that the formulas ask for, a multiply-add counted as two: gathering and
# features, shape tensor to velocity gradient, rotation of the stress; sums, 13 pairs of additions of rows of 16 and 9;
# stress to force. Counted in the sources.
_OPERATOR_FLOPS = {
    "energy_conjugate": 40 + 180 + 190 + 650 + 110,
    "volume_weighted": 40 + 180 + 190 + 416 + 110,
    "unstabilized": 60 + 190 + 20,
    # one state for two directions: half of what a bond that is held costs, and twice over all bonds for gradients
    "bond_projection": 60 + (120 + 280 + 130 + 60) // 2,
}
# Hooke's law; the soil in flow: trial, three rounds of the return map.
_MATERIAL_FLOPS = {"linear_elastic": 20, "viscoplastic_critical_state": 500}
_CASES = {"linear_elastic": "elastic.toml", "viscoplastic_critical_state": "soil_in_flow.toml"}
MATERIALS = tuple(_CASES)


@dataclass(frozen=True)
class Load:
    """A block of so many points along each edge."""

    force_state: str
    material: str  # of MATERIALS
    threads: int
    edge: int
    steps: int

    @property
    def flops_per_bond(self) -> float:
        material = _MATERIAL_FLOPS[self.material]
        return _OPERATOR_FLOPS[self.force_state] + (material / 2 if self.force_state == "bond_projection" else material)


@dataclass(frozen=True)
class Measurement:
    """What one run took. Seconds are wall-clock, of the steps alone."""

    force_state: str
    material: str
    threads: int
    points: int
    steps: int
    refreshes: int
    bonds_per_point: float
    bytes_per_point: float  # that the model held at its end
    peak_bytes_per_point: float  # the most that the whole process had
    flowing: float  # share of the points that flowed plastically
    seconds: float
    phase_seconds: dict[str, float]

    @property
    def point_steps_per_second(self) -> float:
        return self.points * self.steps / self.seconds

    @property
    def bond_steps_per_second(self) -> float:
        return self.bonds_per_point * self.point_steps_per_second

    def microseconds(self, phase: str) -> float:
        """Of one thread for one point and step."""
        return 1e6 * self.threads * self.phase_seconds[phase] / (self.points * self.steps)

    def as_record(self) -> dict:
        record = asdict(self)
        record["point_steps_per_second"] = self.point_steps_per_second
        record["bond_steps_per_second"] = self.bond_steps_per_second
        return record


def _run(command: list) -> int:
    """Returns the most bytes that the process had in memory. @throws subprocess.CalledProcessError when it fails."""
    process = subprocess.Popen(command, env={**os.environ, "OMP_WAIT_POLICY": "active"}, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, command)
    return 1024 * usage.ru_maxrss


def run(load: Load, program: Path, cases: Path, out: Path) -> Measurement:
    """Runs the program under a load. @throws subprocess.CalledProcessError when it fails, its messages on stderr."""
    length = _SPACING * load.edge
    # corners move so fast that families are found anew once in _STEPS_PER_REFRESH steps
    rate = 0.5 * _SKIN / (_STEPS_PER_REFRESH * _STEP) / (np.sqrt(1.5) * 0.5 * length)
    settings = {
        "operator.force_state": load.force_state,
        "body.block.geometry.size": f'["{length} m", "{length} m", "{length} m"]',
        "body.block.strain_rate": f'["{rate / 2} s^-1", "{rate / 2} s^-1", "{-rate} s^-1", 0, 0, 0]',
        "time.step": f"{_STEP} s" if load.steps < 50 else None,
        "stage.0.duration": f"{(load.steps - 0.5) * _STEP} s",
        "run.energy_error_limit": "1e3",  # speed is measured, of force states that create energy too
    }
    words = [word for key, value in settings.items() if value for word in ("--set", f"{key}={value}")]
    peak = _run([program, "run", cases / _CASES[load.material], "--out", out, "--overwrite", "--quiet",
                 "--threads", str(load.threads), *words])
    summary = read_summary(out)
    with h5py.File(out / "results.h5") as file:
        last = file["snapshots"][sorted(file["snapshots"])[-1]]
        strain = np.asarray(last.get("equivalent_plastic_shear_strain", [0.0]))
    return Measurement(
        load.force_state, load.material, load.threads, summary["points"], summary["steps"], summary["refreshes"],
        summary["bonds"] / summary["points"], summary["bytes_per_point"], peak / summary["points"],
        float(np.mean(strain > 0.0)), sum(summary["phase_seconds"].values()), summary["phase_seconds"],
    )
