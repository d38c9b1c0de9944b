# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The list of sweeps: what each costs, and what is done."""
from __future__ import annotations

from pathlib import Path

from periporo_tools.reproduction.cost import Pace, duration_text
from periporo_tools.reproduction.plan import Run, State, distinct
from periporo_tools.reproduction.sweeps import Book

_WIDTH = 80


def _points(runs: list[Run]) -> str:
    """\"4,800 to 16,000\"."""
    known = sorted({run.cost.points for run in runs if run.cost.points is not None})
    if not known:
        return "?"
    return f"{known[0]:,}" if len(known) == 1 else f"{known[0]:,} to {known[-1]:,}"


def _left(runs: list[Run], pace: Pace) -> str:
    waiting = [run.cost for run in distinct(runs) if run.state() is not State.COMPLETE]
    seconds = pace.seconds(waiting)
    if not waiting:
        return "-"
    return "?" if seconds is None else duration_text(seconds)


def text(book: Book, runs: dict[str, list[Run]], pace: Pace, out: Path) -> str:
    """A line for each sweep with its title below."""
    rows = [("sweep", "runs", "done", "points of a run", "left, about")]
    for sweep in book.sweeps:
        own = runs[sweep.name]
        done = sum(run.state() is State.COMPLETE for run in own)
        rows.append((sweep.name, str(len(own)), str(done), _points(own), _left(own, pace)))
    everything = [run for sweep_runs in runs.values() for run in sweep_runs]
    once = distinct(everything)
    rows.append(("all", str(len(once)), str(sum(run.state() is State.COMPLETE for run in once)), _points(once),
                 _left(once, pace)))
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    lines = [f"{book.path}, {'small' if book.small else 'full'} variant, results in {out}", ""]
    for index, row in enumerate(rows):
        lines.append("  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
        if 0 < index < len(rows) - 1:
            title = book.sweeps[index - 1].title
            lines.append(f"      {title if len(title) < _WIDTH - 6 else title[: _WIDTH - 9] + '...'}")
    shared = len(everything) - len(once)
    if shared:
        lines += ["", f"Runs that two sweeps have in common, and that run once: {shared}"]
    changed = [run.label for run in once if run.state() is State.CHANGED]
    if changed:
        lines += ["", f"The case has changed since it ran: {', '.join(changed)}"]
    command = "tools/reproduce " + ("--small " if book.small else "") + book.sweeps[0].name
    lines += ["", f"{command}    runs and draws it; --help says what else there is"]
    return "\n".join(lines)
