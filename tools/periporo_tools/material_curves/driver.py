# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Leads materials along paths with `periporo drive`."""
from __future__ import annotations

import json
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from periporo_tools import drive
from periporo_tools.verification.runner import RunFailure

Table = dict[str, Any]
_CASES = Path(__file__).resolve().parents[3] / "cases/material"


@dataclass(frozen=True)
class DrivenPath:
    """A path that was driven to its end, in SI units."""

    columns: dict[str, np.ndarray]  # of path.csv by name without unit, a row a step
    material: Table  # its parameters, defaults filled in

    def pressure(self, axis: str) -> np.ndarray:
        """The normal stress along x, y or z, compression positive [Pa]."""
        return -self.columns[f"stress_{2 * axis}"]

    def compression(self, axis: str) -> np.ndarray:
        """The strain along x, y or z, compression positive [-]."""
        return -self.columns[f"strain_{2 * axis}"]

    @property
    def ends(self) -> np.ndarray:
        """The last row of each stage."""
        stage = self.columns["stage"]
        return np.flatnonzero(np.append(stage[1:] != stage[:-1], True) & (stage > 0))


class Driver:
    """Drives paths with the program; what it writes stays in `folder`."""

    def __init__(self, program: Path, folder: Path) -> None:
        self._program = program
        self._folder = folder
        self._count = 0

    def __call__(self, material: Table, initial: Table, *stages: Table) -> DrivenPath:
        """Values are numbers in SI units, or text with a unit. @throws RunFailure"""
        file = self._folder / f"path_{self._count:02d}.toml"
        lines = ['title = "A path of the curves of a material"', *_table("[material.it]", material)]
        lines += _table("[initial]", initial)
        for stage in stages:
            lines += _table("[[stage]]", stage)
        file.write_text("\n".join(lines) + "\n")
        return self._drive(file)

    def case(self, name: str) -> DrivenPath:
        """A path of cases/material. @throws RunFailure"""
        return self._drive(_CASES / f"{name}.toml")

    def _drive(self, file: Path) -> DrivenPath:
        out = self._folder / f"results_{self._count:02d}"
        self._count += 1
        command = [str(self._program), "drive", str(file), "--out", str(out)]
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        if finished.returncode != 0:
            raise RunFailure(f"{' '.join(command)}\n{finished.stderr}")
        (material,) = tomllib.loads((out / "path.toml").read_text())["material"].values()
        return DrivenPath(drive.read(out).columns, material)


def _table(head: str, values: Table) -> list[str]:
    return ["", head] + [f"{key} = {_toml(value)}" for key, value in values.items()]


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(one)}" for key, one in value.items()) + " }"
    return json.dumps(value)
