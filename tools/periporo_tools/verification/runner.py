# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Runs verification cases and hands their results to the checks."""
from __future__ import annotations

import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from periporo_tools import dispersion
from periporo_tools.dispersion import Curves
from periporo_tools.results import read_summary


class RunFailure(Exception):
    """A case that did not run to its end, with what the program said."""


@dataclass(frozen=True)
class Run:
    """A finished run: last fields, all fields over time, history, summary. SI units."""

    folder: Path

    @property
    def summary(self) -> dict:
        return read_summary(self.folder)

    @property
    def history(self) -> dict[str, np.ndarray]:
        """Columns over time."""
        with h5py.File(self.folder / "results.h5") as file:
            return {name: np.asarray(file["history"][name], dtype=float).ravel() for name in file["history"]}

    @property
    def times(self) -> list[float]:
        with h5py.File(self.folder / "results.h5") as file:
            snapshots = file["snapshots"]
            return [float(snapshots[name].attrs["time"]) for name in sorted(snapshots)]

    def travel(self, axis: int) -> np.ndarray:
        """Displacement of the centre of mass in every snapshot [m]."""
        snapshots = map(self.fields, range(len(self.times)))
        return np.array([np.average(f["displacement"][:, axis], weights=f["mass"]) for f in snapshots])

    def fields(self, index: int = -1) -> dict[str, np.ndarray]:
        """All fields of a snapshot, and "initial_position" and "mass"."""
        with h5py.File(self.folder / "results.h5") as file:
            group = file["snapshots"][sorted(file["snapshots"])[index]]
            values = {name: np.asarray(group[name]) for name in group}
        values["initial_position"] = values["position"] - values["displacement"]
        values["mass"] = values["density"] * values["volume"]
        return values


@dataclass
class Runner:
    """Runs cases with the program; a case with the same settings runs once.

    @param small cheap variants, for the test suite
    """

    program: Path
    cases: Path
    out: Path
    small: bool
    seconds: float = 0.0
    done: dict[tuple, Run] = field(default_factory=dict)

    def __call__(self, case: str, **settings: object) -> Run:
        """Runs cases/verification/CASE.toml; settings are keys of the case with __ for each dot."""
        overrides = {key.replace("__", "."): _toml(value) for key, value in settings.items()}
        key = (case, tuple(sorted(overrides.items())))
        if key not in self.done:
            self.done[key] = self._run(case, overrides)
        return self.done[key]

    def dispersion(self, case: str) -> Curves:
        """Phase speeds in the lattice of a case."""
        table = self.out / f"{case}_dispersion.csv"
        table.write_text(self._call("dispersion", str(self.cases / f"{case}.toml")))
        return dispersion.read(table)

    def _run(self, case: str, overrides: dict[str, str]) -> Run:
        folder = self.out / f"{case}_{len(self.done):02d}"
        settings = [word for name, value in overrides.items() for word in ("--set", f"{name}={value}")]
        self._call("run", str(self.cases / f"{case}.toml"), "--out", str(folder), "--overwrite", "--quiet", *settings)
        return Run(folder)

    def _call(self, *arguments: str) -> str:
        """What the program prints. @throws RunFailure with its messages when it fails."""
        command = [str(self.program), *arguments]
        begin = time.monotonic()
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        self.seconds += time.monotonic() - begin
        if finished.returncode != 0:
            raise RunFailure(f"{' '.join(command)}\n{finished.stderr}")
        return finished.stdout


def _toml(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
