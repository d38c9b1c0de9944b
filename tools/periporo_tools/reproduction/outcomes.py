# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the runs of a sweep came to: the numbers of verdict.compare, and the summary beside them."""
from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from periporo_tools import verdict
from periporo_tools.reproduction.plan import Run, State, read_record
from periporo_tools.reproduction.sweeps import Sweep
from periporo_tools.results import ResultError, Results, read_summary


@dataclass(frozen=True)
class Outcome:
    """A run, how it stands, and what was measured; `comparison` is None where there is nothing to measure."""

    run: Run
    state: State
    comparison: dict | None
    summary: dict
    program: str  # the version that ran it

    @property
    def complete(self) -> bool:
        """Ran to its end, though perhaps with an earlier text of the case."""
        return self.comparison is not None and self.summary.get("outcome") == "complete"

    @property
    def has_laws(self) -> bool:
        return bool(self.comparison and self.comparison.get("laws"))

    def number(self, axis: int) -> float:
        number = self.run.values[axis].number
        assert number is not None
        return number

    def results(self) -> Results:
        return Results(self.run.folder)

    def special_times(self) -> list[float]:
        """Times of single snapshots that the case asks for [s], in order."""
        try:
            case = tomllib.loads((self.run.folder / "case.toml").read_text())
        except (OSError, tomllib.TOMLDecodeError):
            return []
        return sorted({float(time) for output in case.get("output", []) for time in output.get("times", [])})


@dataclass(frozen=True)
class SweepOutcome:
    sweep: Sweep
    outcomes: tuple[Outcome, ...]

    @property
    def complete(self) -> list[Outcome]:
        return [outcome for outcome in self.outcomes if outcome.complete]

    def at(self, **numbers: float) -> Outcome | None:
        """The complete run with these numbers on the axes of these names."""
        names = [axis.name for axis in self.sweep.axes]
        for outcome in self.complete:
            if all(outcome.run.values[names.index(name)].number == number for name, number in numbers.items()):
                return outcome
        return None

    def numbers(self, axis: str) -> list[float]:
        """The values on an axis, in ascending order."""
        found = self.sweep.axis(axis)
        return sorted(value.number for value in found.values if value.number is not None) if found else []


class Measurer:
    """Measures runs, each folder once."""

    def __init__(self, complain: Callable[[str], None]):
        """@param complain is told of results that cannot be read, which then count as not there"""
        self._complain = complain
        self._seen: dict[Path, tuple[State, dict | None, dict]] = {}

    def __call__(self, sweep: Sweep, runs: list[Run]) -> SweepOutcome:
        return SweepOutcome(sweep, tuple(self._outcome(run) for run in runs))

    def _outcome(self, run: Run) -> Outcome:
        if run.folder not in self._seen:
            try:
                self._seen[run.folder] = self._measured(run)
            except ResultError as error:
                self._complain(f"{run.label}: {error}")
                self._seen[run.folder] = State.MISSING, None, {}
        return Outcome(run, *self._seen[run.folder], read_record(run.record).get("program", ""))

    @staticmethod
    def _measured(run: Run) -> tuple[State, dict | None, dict]:
        state = run.state()
        if state is State.FOREIGN or not (run.folder / "results.h5").is_file():
            return state, None, {}
        with Results(run.folder) as results:
            return state, verdict.compare(results), read_summary(run.folder)
