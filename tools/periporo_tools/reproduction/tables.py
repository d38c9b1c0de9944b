# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The tables of sweeps: Markdown for the page, columns for a terminal, JSON for machines."""
from __future__ import annotations

import json
import textwrap
from pathlib import Path

from periporo_tools import verdict
from periporo_tools.reproduction.outcomes import Outcome, SweepOutcome
from periporo_tools.reproduction.plan import State, write_whole
from periporo_tools.reproduction.statements import NOT_RUN, Finding
from periporo_tools.reproduction.sweeps import Book

_MILLI = 1e3
_WIDTH = 80  # of a terminal; a name of a run that is too long for it has a line of its own


def _remark(outcome: Outcome) -> str:
    """What a reader must know of a row: \"not complete\" and the like; empty for a sound one."""
    if outcome.comparison is None:
        return "not run" if outcome.state is State.COMPLETE else outcome.state.value
    if outcome.state is State.CHANGED:
        return "of an earlier text of the case"
    if outcome.complete:
        return ""
    return "failed" if outcome.state is State.FAILED else "not complete"


def _lengths(outcome: Outcome, laws: bool) -> list[str]:
    """Run-out, law, difference, 99 % of the mass, height, law, difference in r0; front, 99 % and height [mm] when the
    cases of the sweep name no law."""
    record = outcome.comparison
    if record is None:
        return ["-"] * (7 if laws else 3)
    measured = record["measured"]
    if not laws:
        return [f"{_MILLI * measured[name]:.0f}" for name in ("front_mean", "radius_99", "height")]
    far = f"{record['run_out_99']:.2f}" if "run_out_99" in record else "-"
    return [*verdict.law_cells(record, "run_out"), far, *verdict.law_cells(record, "height")]


def _points(outcome: Outcome) -> str:
    points = outcome.summary.get("points") or (outcome.comparison or {}).get("points") or outcome.run.cost.points
    return "-" if points is None else f"{points:,}"


def _percent(share: float | None, digits: str) -> str:
    return "-" if share is None else f"{100.0 * share:{digits}} %"


def _end(outcome: Outcome) -> list[str]:
    """Time of rest, its law, share of the mass that escaped, energy error."""
    record = outcome.comparison
    if record is None:
        return ["-"] * 4
    measured, law = record["measured"], verdict.law_of_rest(record)
    return [
        "-" if measured["rest_time"] is None else f"{measured['rest_time']:.2f}",
        "-" if law is None else f"{law:.2f}",
        "0" if measured["escaped_points"] == 0 else _percent(measured["escaped_mass"], ".2g"),
        _percent(measured["energy_error_largest"], ".2g"),
    ]


def markdown(result: SweepOutcome) -> str:
    """A row for each run."""
    laws = any(outcome.has_laws for outcome in result.outcomes)
    head = [axis.heading for axis in result.sweep.axes] + ["points"]
    if laws:
        head += ["run-out [r0]", "law", "difference", "99 % of mass [r0]", "height [r0]", "law", "difference"]
    else:
        head += ["front [mm]", "99 % of mass [mm]", "height [mm]"]
    head += ["rest [s]", "law [s]", "escaped", "energy error"]
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    for outcome in result.outcomes:
        labels = [value.label for value in outcome.run.values]
        if remark := _remark(outcome):
            labels[-1] += f" ({remark})"
        cells = [*labels, _points(outcome), *_lengths(outcome, laws), *_end(outcome)]
        lines.append(f"| {' | '.join(cells)} |")
    if sources := verdict.sources_line([outcome.comparison for outcome in result.outcomes if outcome.comparison]):
        lines += ["", sources]
    return "\n".join(lines)


def terminal(result: SweepOutcome) -> str:
    """The same in 80 columns, with the differences from the laws instead of their values."""
    laws = any(outcome.has_laws for outcome in result.outcomes)
    head = ["run-out", "from law", "height", "from law"] if laws else ["front", "height"]
    head += ["rest", "escaped", "energy"]
    rows = [("", head)]
    for outcome in result.outcomes:
        lengths, (rest, _, escaped, energy) = _lengths(outcome, laws), _end(outcome)
        if laws:
            shown = [lengths[i].replace("; ", ", ").replace(" %,", ",") for i in (0, 2, 4, 6)]
        else:
            shown = [f"{lengths[0]} mm", f"{lengths[2]} mm"]
        cells = [*shown, rest if rest == "-" else f"{rest} s", escaped, energy]
        mark = "*" if outcome.comparison and _remark(outcome) else ""
        rows.append((outcome.run.name + mark, cells if outcome.comparison else [_remark(outcome)]))
    widths = [max(len(cells[column]) for _, cells in rows if len(cells) > 1) for column in range(len(head))]
    longest = max(len(name) for name, _ in rows)
    own_line = 4 + longest + sum(width + 2 for width in widths) - 2 > _WIDTH
    indent = 4 if own_line else 4 + longest
    lines = []
    for name, cells in rows:
        lines += [f"  {name}"] if own_line and name else []
        text = "  ".join(cell.ljust(width) for cell, width in zip(cells, widths)).rstrip()
        lines.append(("" if own_line else f"  {name}").ljust(indent) + text)
    lines += ["  run-out and height in r0"] if laws else []
    lines += [f"  * {outcome.run.name}: {remark}" for outcome in result.outcomes
              if outcome.comparison and (remark := _remark(outcome))]
    return "\n".join(lines)


def statements_markdown(findings: list[Finding]) -> str:
    lines = ["| the paper | is held to be so when | measured | outcome |", "|---|---|---|---|"]
    lines += [f"| {finding.statement} | {finding.criterion} | {finding.measured} | {finding.outcome} |"
              for finding in findings]
    return "\n".join(lines)


def statements_terminal(findings: list[Finding]) -> str:
    lines = []
    for finding in findings:
        lines += textwrap.wrap(f"{finding.outcome}: {finding.statement}", _WIDTH, initial_indent="  ",
                               subsequent_indent="    ")
        if finding.outcome != NOT_RUN:
            for text in (f"measured: {finding.measured}", f"wanted: {finding.criterion}"):
                lines += textwrap.wrap(text, _WIDTH, initial_indent="      ", subsequent_indent="        ")
    return "\n".join(lines)


_UNITS = {
    "run_out": "(front - r0)/r0, front as a mean over directions [-]",
    "run_out_99": "(radius of 99 per cent of the mass - r0)/r0 [-]",
    "height": "height/r0 [-]",
    "front": "[m]", "radius_99": "[m]", "deposit_height": "[m]",
    "laws": "run_out and height in r0, end_of_motion in (h0/g)^(1/2); difference is measured/law - 1",
    "rest_time": "[s]", "rest_time_law": "[s]",
    "escaped_share": "of the mass of the column [-]",
    "energy_error": "largest, over the potential energy released [-]",
    "wall_seconds": "[s]", "spacing": "[m]",
}


def _run_record(result: SweepOutcome, outcome: Outcome) -> dict:
    record, run = outcome.comparison or {}, outcome.run
    measured = record.get("measured", {})
    laws = record.get("laws", [])
    height = next((row["measured"] for row in laws if row["quantity"] == "height"), None)
    kept = ("quantity", "source", "law", "measured", "difference", "gap_between")
    return {
        "name": run.name,
        "axes": {
            axis.name: {"label": value.label, "number": value.number}
            for axis, value in zip(result.sweep.axes, run.values)
        },
        "case": str(run.case),
        "overrides": list(run.overrides),
        "folder": str(run.folder),
        "shared_with": run.shared_with,
        "state": outcome.state.value,
        "complete": outcome.complete,
        "program": outcome.program,
        "spacing": record.get("spacing"),
        "points": outcome.summary.get("points", record.get("points")),
        "steps": outcome.summary.get("steps"),
        "wall_seconds": outcome.summary.get("wall_seconds"),
        "run_out": record.get("run_out"),
        "run_out_99": record.get("run_out_99"),
        "height": height,
        "front": measured.get("front_mean"),
        "radius_99": measured.get("radius_99"),
        "deposit_height": measured.get("height"),
        "laws": [{key: row[key] for key in kept if key in row} for row in laws],
        "rest_time": measured.get("rest_time"),
        "rest_time_law": verdict.law_of_rest(record) if record else None,
        "escaped_share": measured.get("escaped_mass"),
        "energy_error": measured.get("energy_error_largest"),
    }


def records(book: Book, results: list[tuple[SweepOutcome, list[Finding]]]) -> dict:
    """For machines."""
    return {
        "format": "periporo reproduction",
        "variant": "small" if book.small else "full",
        "units": _UNITS,
        "sweeps": [
            {
                "name": result.sweep.name,
                "title": result.sweep.title,
                "axes": [{"name": axis.name, "title": axis.title, "unit": axis.unit} for axis in result.sweep.axes],
                "runs": [_run_record(result, outcome) for outcome in result.outcomes],
                "statements": [
                    {"statement": finding.statement, "criterion": finding.criterion, "measured": finding.measured,
                     "outcome": finding.outcome, "numbers": finding.numbers}
                    for finding in findings
                ],
            }
            for result, findings in results
        ],
    }


def write_json(path: Path, content: dict) -> None:
    write_whole(path, json.dumps(content, indent=2, allow_nan=False) + "\n")
