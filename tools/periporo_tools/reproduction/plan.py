# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The runs of a file of sweeps: names, cases, overrides, folders, and how each stands."""
from __future__ import annotations

import enum
import itertools
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path

from periporo_tools.reproduction.case_text import read_case
from periporo_tools.reproduction.cost import Cost, cost_of
from periporo_tools.reproduction.sweeps import Axis, Book, Sweep, SweepError, Value, fill
from periporo_tools.results import read_summary


class State(enum.Enum):
    """How a run stands."""

    MISSING = "not run"
    COMPLETE = "complete"
    INTERRUPTED = "interrupted"
    FAILED = "failed"
    CHANGED = "the case has changed since it ran"
    FOREIGN = "not of this tool"  # a folder with content and no record


@dataclass(frozen=True)
class Run:
    """One case with its overrides. `folder` is the program's alone; `record`, beside it, is this tool's."""

    sweep: str
    name: str
    values: tuple[Value, ...]  # one for each axis of the sweep
    case: Path
    overrides: tuple[str, ...]
    folder: Path
    record: Path
    identity: str  # equal for runs that compute the same
    cost: Cost
    shared_with: str | None  # the run, in an earlier sweep or this one, that computes the same and owns the folder

    @property
    def label(self) -> str:
        return f"{self.sweep}/{self.name}"

    def state(self) -> State:
        """@throws ResultError for a summary.json that is not JSON."""
        if not self.folder.is_dir() or not any(self.folder.iterdir()):
            return State.MISSING
        record = read_record(self.record)
        if not record:
            return State.FOREIGN
        if record.get("identity") != self.identity:
            return State.CHANGED
        outcome = read_summary(self.folder).get("outcome")
        if outcome == "complete" and (self.folder / "results.h5").is_file():
            return State.COMPLETE
        # A program that could not write to the disk fails too, and goes on from its checkpoint.
        failed = outcome == "failed" or (record.get("failed") and not self.resumable)
        return State.FAILED if failed else State.INTERRUPTED

    @property
    def resumable(self) -> bool:
        return any((self.folder / name).is_file() for name in ("checkpoint.bin", "checkpoint.previous.bin"))


def read_record(path: Path) -> dict:
    """Case, overrides, identity and program of the run beside it; empty when there is none that can be read."""
    try:
        record = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return record if isinstance(record, dict) else {}


def write_whole(path: Path, text: str) -> None:
    """The file is complete at every moment."""
    path.parent.mkdir(parents=True, exist_ok=True)
    aside = path.with_name(path.name + ".part")
    aside.write_text(text)
    os.replace(aside, path)


def run_name(axes: tuple[Axis, ...], values: tuple[Value, ...]) -> str:
    """\"a0.6_s20\", \"plane-tilted\", \"K0-0.5\": fit for a folder."""
    parts = []
    for axis, value in zip(axes, values):
        number = re.fullmatch(r"[+-]?[\d.][\d.eE+-]*", value.label) is not None
        label = re.sub(r"[^A-Za-z0-9._+-]+", "-", value.label).strip("-")
        together = number and not axis.name[-1].isdigit()
        parts.append(f"{axis.name}{label}" if together else f"{axis.name}-{label}")
    return "_".join(parts)


def _case_of(book: Book, sweep: Sweep, values: tuple[Value, ...], labels: dict[str, str], place: str) -> Path:
    name = next((value.case for value in reversed(values) if value.case), sweep.case)
    if name is None:
        raise SweepError(f"{place}: it has no case; write case = \"FILE.toml\" in the sweep or in the value")
    case = book.path.parent / fill(name, labels, f"{place}: case")
    if not case.is_file():
        raise SweepError(f"{place}: case: there is no file {case}; paths are relative to {book.path.name}")
    return Path(os.path.normpath(case))


def plan(book: Book, out: Path) -> dict[str, list[Run]]:
    """The runs of every sweep, in the order of the file, each in OUT/SWEEP/RUN; one that computes the same as an
    earlier one shares its folder.

    @throws SweepError
    """
    owners: dict[str, Run] = {}
    runs: dict[str, list[Run]] = {}
    for sweep in book.sweeps:
        place = f"{book.path}, sweep \"{sweep.name}\""
        runs[sweep.name] = []
        taken: set[str] = set()
        for values in itertools.product(*(axis.values for axis in sweep.axes)):
            labels = {axis.name: value.label for axis, value in zip(sweep.axes, values)}
            name = run_name(sweep.axes, values)
            if name.lower() in taken:
                raise SweepError(f"{place}: two runs would be called \"{name}\"; give their values other labels")
            taken.add(name.lower())
            case = _case_of(book, sweep, values, labels, place)
            overrides = [*sweep.set, *sweep.small_set, *(entry for value in values for entry in value.set)]
            filled = tuple(fill(entry, labels, f"{place}: set") for entry in overrides)
            text = read_case(case, filled)
            identity = text.identity()
            owner = owners.get(identity)
            folder = owner.folder if owner else out / sweep.name / name
            run = Run(sweep.name, name, values, case, filled, folder, folder.with_name(folder.name + ".json"),
                      identity, cost_of(text), owner.label if owner else None)
            owners.setdefault(identity, run)
            runs[sweep.name].append(run)
    return runs


def distinct(runs: list[Run]) -> list[Run]:
    """Without those that share the folder of another one in the list."""
    first: dict[Path, Run] = {}
    for run in runs:
        first.setdefault(run.folder, run)
    return list(first.values())
