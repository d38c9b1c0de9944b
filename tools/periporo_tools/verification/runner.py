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

    def _run(self, case: str, overrides: dict[str, str]) -> Run:
        folder = self.out / f"{case}_{len(self.done):02d}"
        command = [str(self.program), "run", str(self.cases / f"{case}.toml"), "--out", str(folder), "--overwrite"]
        command.append("--quiet")
        for name, value in overrides.items():
            command += ["--set", f"{name}={value}"]
        begin = time.monotonic()
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        self.seconds += time.monotonic() - begin
        if finished.returncode != 0:
            raise RunFailure(f"{' '.join(command)}\n{finished.stderr}")
        return Run(folder)


def _toml(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
