# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""LAMMPS on the same lattice, where Debian's `lammps` is installed: its peridynamic solids, elastic."""
from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

# A cube of the same number of points, bonds and density, stretched so slowly that no bond breaks.
_INPUT = """units si
boundary s s s
atom_style peri
atom_modify map array
neighbor 0.00025 bin
lattice sc 0.005
region block block 0 {inside} 0 {inside} 0 {inside} units box
create_box 1 block
create_atoms 1 region block
pair_style {style}
pair_coeff * * {coefficients}
set group all density 1760
set group all volume 1.25e-7
velocity all ramp vx 0.0 1e-3 x 0.0 {inside} units box
fix motion all nve
timestep 1e-6
thermo 1000000
run {steps}
"""
# bulk and shear modulus [Pa], horizon [m], stretch at which a bond breaks, its dependence on strain
_COEFFICIENTS = {"peri/lps": "25e6 15e6 0.0150751 10.0 0.25", "peri/pmb": "1e15 0.0150751 10.0 0.25"}
STYLES = tuple(_COEFFICIENTS)
_LOOP = re.compile(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms")


@dataclass(frozen=True)
class PeerMeasurement:
    """What one run of the peer took."""

    style: str
    threads: int
    points: int
    point_steps_per_second: float

    def as_record(self) -> dict:
        return {"peer": "lammps", **asdict(self)}


def available() -> bool:
    return shutil.which("lmp") is not None


def read_loop(style: str, threads: int, printed: str) -> PeerMeasurement:
    """The rate of a run from what LAMMPS printed. @throws ValueError when it did not run to its end."""
    loop = _LOOP.search(printed)
    if loop is None:
        raise ValueError(f"LAMMPS did not run to its end:\n{printed[-2000:]}")
    seconds, steps, atoms = float(loop[1]), int(loop[2]), int(loop[3])
    return PeerMeasurement(style, threads, atoms, atoms * steps / seconds)


def run(style: str, threads: int, edge: int, steps: int, folder: Path) -> PeerMeasurement:
    """Runs a cube of `edge` points along each edge on so many processes."""
    script = folder / "lammps.in"
    inside = (edge - 1 + 0.5) * 0.005
    script.write_text(_INPUT.format(style=style, coefficients=_COEFFICIENTS[style], inside=inside, steps=steps))
    command = ["lmp", "-in", str(script), "-log", "none"]
    if threads > 1:
        command = ["mpirun", "--allow-run-as-root", "-np", str(threads), *command]
    finished = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    return read_loop(style, threads, finished.stdout + finished.stderr)
