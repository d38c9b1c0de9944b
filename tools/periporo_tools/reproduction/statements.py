# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the paper says of its columns, held against the runs: what was measured, and whether it is so.

Each function takes a sweep with the axes a = h0/r0 and s, the suction. The limits stand in the text of the statement.
"""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from periporo_tools import measures
from periporo_tools.reproduction.outcomes import Outcome, SweepOutcome
from periporo_tools.results import Results

REPRODUCED, NOT_REPRODUCED, NOT_RUN = "reproduced", "not reproduced", "not run"
_DISTURBED = 0.01  # plastic shear strain
_WHOLE = 0.99  # of the mass, as for the radius of 99 per cent
_TRUNCATED, _CONE, _INERTIAL = 0.6, 1.2, 2.0  # the paper's columns, one for each regime


@dataclass(frozen=True)
class Finding:
    statement: str
    criterion: str  # when it is held to be so
    measured: str
    outcome: str
    numbers: dict = field(default_factory=dict)  # for machines, SI units


@dataclass(frozen=True)
class Statement:
    """What the paper says, and when it is held to be so."""

    text: str
    criterion: str

    def found(self, measured: str, holds: bool, **numbers: object) -> Finding:
        return Finding(self.text, self.criterion, measured, REPRODUCED if holds else NOT_REPRODUCED, numbers)

    def not_run(self) -> Finding:
        return Finding(self.text, self.criterion, "-", NOT_RUN)


@dataclass(frozen=True)
class Column:
    """The points of the column at one time, SI units."""

    time: float
    position: np.ndarray
    initial: np.ndarray  # position at the start of the run
    mass: np.ndarray
    strain: np.ndarray  # equivalent plastic shear strain

    @property
    def moved(self) -> np.ndarray:
        return np.linalg.norm(self.position - self.initial, axis=1)

    @property
    def outward(self) -> np.ndarray:
        """How much farther from the axis than at the start."""
        return measures.radius(self.position) - measures.radius(self.initial)

    def share(self, chosen: np.ndarray) -> float:
        """Of the mass."""
        return float(self.mass[chosen].sum() / self.mass.sum())


def column(results: Results, index: int) -> Column:
    """@throws ResultError when the snapshots lack a field."""
    snapshot = results.snapshot(index)
    own = snapshot.body == snapshot.body.min()
    displacement = results.values(index, "displacement")
    return Column(snapshot.time, snapshot.position[own], (snapshot.position - displacement)[own], snapshot.mass[own],
                  results.values(index, "equivalent_plastic_shear_strain").ravel()[own])


def _early(outcome: Outcome, results: Results) -> int:
    """The snapshot at the first of the times that the case asks for, where the paper shows the column in motion."""
    times = outcome.special_times()
    return results.nearest(times[0]) if times else len(results.times) - 1


def _percent(share: float) -> str:
    """With a decimal near nothing and near all, where it matters."""
    return f"{100.0 * share:.0f} %" if 0.05 <= share <= 0.95 or share in (0.0, 1.0) else f"{100.0 * share:.1f} %"


def undisturbed_core(result: SweepOutcome) -> Finding:
    statement = Statement(
        f"a = {_TRUNCATED}, dry: a central column is left undisturbed",
        "points on the axis have less than 1 % plastic shear strain up to the full height, within one spacing",
    )
    outcome = result.at(a=_TRUNCATED, s=0.0)
    if outcome is None:
        return statement.not_run()
    with outcome.results() as results:
        final = column(results, -1)
        spacing = results.spacing
    intact = final.strain < _DISTURBED
    core = intact & (measures.radius(final.position) <= 1.01 * spacing)
    top = float(final.position[core, 2].max(initial=-0.5 * spacing)) + 0.5 * spacing
    full = outcome.comparison["measured"]["initial_height"]
    return statement.found(
        f"{_percent(final.share(intact))} of the mass undisturbed, on the axis up to {1e3 * top:.0f} of"
        f" {1e3 * full:.0f} mm",
        top >= full - spacing,
        undisturbed_share=final.share(intact), undisturbed_height=top, initial_height=full,
    )


def all_deforms(result: SweepOutcome) -> Finding:
    statement = Statement(f"a = {_CONE}, dry: the entire column deforms",
                          "at least 99 % of the mass has more than 1 % plastic shear strain")
    outcome = result.at(a=_CONE, s=0.0)
    if outcome is None:
        return statement.not_run()
    with outcome.results() as results:
        final = column(results, -1)
    share = final.share(final.strain >= _DISTURBED)
    return statement.found(f"{_percent(share)} of the mass", share >= _WHOLE, deformed_share=share)


def peak_stays(result: SweepOutcome) -> Finding:
    statement = Statement(f"a = {_CONE}, dry: the deposit is as high as the column was",
                          "the heights differ by no more than one spacing")
    outcome = result.at(a=_CONE, s=0.0)
    if outcome is None:
        return statement.not_run()
    measured, spacing = outcome.comparison["measured"], outcome.comparison["spacing"]
    height, full = measured["height"], measured["initial_height"]
    return statement.found(f"{1e3 * height:.0f} of {1e3 * full:.0f} mm", abs(height - full) <= spacing,
                    height=height, initial_height=full)


def all_moves(result: SweepOutcome) -> Finding:
    statement = Statement(
        f"a = {_INERTIAL}, dry: the entire column moves from the start",
        "at least 99 % of the mass has moved by more than one spacing at the first of the paper's times",
    )
    outcome = result.at(a=_INERTIAL, s=0.0)
    if outcome is None:
        return statement.not_run()
    with outcome.results() as results:
        early, final = column(results, _early(outcome, results)), column(results, -1)
        spacing = results.spacing
    at_first, at_last = early.share(early.moved > spacing), final.share(final.moved > spacing)
    strained = final.share(final.strain >= _DISTURBED)
    return statement.found(
        f"{_percent(at_first)} of the mass at {early.time:.2f} s, {_percent(at_last)} at the end; {_percent(strained)}"
        " beyond 1 % plastic shear strain",
        at_first >= _WHOLE, time=early.time, moved_share=at_first, moved_share_at_rest=at_last, deformed_share=strained,
    )


def upper_half_falls(result: SweepOutcome) -> Finding:
    statement = Statement(
        f"a = {_INERTIAL}, dry: at first the upper half falls straight while the base spreads",
        "the upper half moves outward by less than a quarter of what it falls, and less than the lower half",
    )
    outcome = result.at(a=_INERTIAL, s=0.0)
    if outcome is None:
        return statement.not_run()
    with outcome.results() as results:
        early = column(results, _early(outcome, results))
    upper = early.initial[:, 2] > 0.5 * outcome.comparison["measured"]["initial_height"]
    outward = [float(np.average(early.outward[part], weights=early.mass[part])) for part in (upper, ~upper)]
    down = float(np.average((early.initial - early.position)[upper, 2], weights=early.mass[upper]))
    return statement.found(
        f"at {early.time:.2f} s the upper half is {1e3 * down:.0f} mm lower and {1e3 * outward[0]:.0f} mm farther out,"
        f" the lower half {1e3 * outward[1]:.0f} mm farther out, in the mean",
        down > 0.0 and outward[0] < 0.25 * down and outward[1] > outward[0],
        time=early.time, upper_down=down, upper_outward=outward[0], lower_outward=outward[1],
    )


def thin_rim(result: SweepOutcome) -> Finding:
    statement = Statement(
        f"a = {_INERTIAL}, dry: a conical mound is surrounded by a wide, very thin rim",
        "the part whose mean surface is lower than a tenth of the deposit is at least r0 wide",
    )
    outcome = result.at(a=_INERTIAL, s=0.0)
    if outcome is None:
        return statement.not_run()
    with outcome.results() as results:
        before = measures.main_body(results.snapshot(results.release))
        final = measures.main_body(results.snapshot(-1))
        inside = final.position[measures.connected(final, results.spacing)]
        line = measures.profile(inside, results.spacing, results.symmetry)
        half_width = float(np.abs(before.position[:, 0]).max()) + 0.5 * results.spacing
    measured = outcome.comparison["measured"]
    mound = float(line.radius[line.mean >= 0.1 * measured["height"]].max())
    front = measured["front_mean"]
    return statement.found(
        f"mound to {mound / half_width:.1f} r0, rim from there to {front / half_width:.1f} r0",
        front - mound >= half_width, mound_radius=mound, front=front, r0=half_width,
    )


def _by_suction(result: SweepOutcome) -> dict[float, list[Outcome]]:
    """For each a with two or more runs, the runs in the order of their suction."""
    found: dict[float, list[Outcome]] = {}
    for a in result.numbers("a"):
        runs = [run for s in result.numbers("s") if (run := result.at(a=a, s=s))]
        if len(runs) > 1:
            found[a] = runs
    return found


def _run_out(outcome: Outcome | None) -> float:
    """Of the front, over the half-width of the column [r0]; over its initial front where the case names none."""
    assert outcome is not None and outcome.comparison is not None
    record = outcome.comparison
    if "run_out" in record:
        return record["run_out"]
    return record["measured"]["front_mean"] / record["measured"]["initial_front_mean"] - 1.0


def _suction_unit(result: SweepOutcome) -> str:
    axis = result.sweep.axis("s")
    return "" if axis is None or axis.unit == "-" else f" {axis.unit}"


def _lists(result: SweepOutcome, values: dict[float, list[float]], unit: str) -> str:
    """\"s = 0, 20, 40 kPa; a = 0.6: 1.14, 1.02, 0.97 r0; ...\"."""
    heading = f"s = {', '.join(f'{s:g}' for s in result.numbers('s'))}{_suction_unit(result)}"
    rows = [f"a = {a:g}: {', '.join(f'{value:.2f}' for value in row)}{unit}" for a, row in values.items()]
    missing = len(result.outcomes) - len(result.complete)
    return "; ".join([heading, *rows]) + (f" ({missing} of {len(result.outcomes)} runs missing)" if missing else "")


def run_out_falls(result: SweepOutcome) -> Finding:
    statement = Statement("suction reduces the run-out for the same a",
                          "it falls at every step of suction, for every a")
    found = {a: [_run_out(run) for run in runs] for a, runs in _by_suction(result).items()}
    if not found:
        return statement.not_run()
    holds = all(after < before for row in found.values() for before, after in zip(row, row[1:]))
    return statement.found(_lists(result, found, " r0"), holds, run_out={f"{a:g}": row for a, row in found.items()})


def height_rises(result: SweepOutcome) -> Finding:
    statement = Statement(
        "suction raises the deposit for the same a",
        "it rises from least to most suction, and at no step falls by more than a tenth of a spacing, for every a; one"
        " that is as high as the column was, within one spacing, need not rise",
    )
    found = _by_suction(result)
    if not found:
        return statement.not_run()
    holds, heights = True, {}
    for a, runs in found.items():
        spacing = runs[0].comparison["spacing"]
        full = runs[0].comparison["measured"]["initial_height"]
        row = [run.comparison["measured"]["height"] for run in runs]
        falls = any(after < before - 0.1 * spacing for before, after in zip(row, row[1:]))
        rises = row[-1] > row[0] + 0.1 * spacing or row[0] >= full - spacing
        holds = holds and rises and not falls
        heights[a] = row
    over_initial = {a: [height / found[a][0].comparison["measured"]["initial_height"] for height in row]
                    for a, row in heights.items()}
    return statement.found(_lists(result, over_initial, " h0"), holds,
                    height={f"{a:g}": row for a, row in heights.items()})


def effect_grows(result: SweepOutcome) -> Finding:
    statement = Statement("the effect of suction is larger at larger a",
                          "the fall of the run-out from least to most suction grows with a")
    ratios = list(_by_suction(result))
    suctions = [s for s in result.numbers("s") if all(result.at(a=a, s=s) for a in ratios)]
    if len(ratios) < 2 or len(suctions) < 2:
        return statement.not_run()
    least, most = suctions[0], suctions[-1]
    falls = {a: _run_out(result.at(a=a, s=least)) - _run_out(result.at(a=a, s=most)) for a in ratios}
    ordered = list(falls.values())
    return statement.found(
        f"s from {least:g} to {most:g}{_suction_unit(result)}; "
        + "; ".join(f"a = {a:g}: {fall:.2f} r0" for a, fall in falls.items()),
        all(after > before for before, after in zip(ordered, ordered[1:])),
        fall_of_run_out={f"{a:g}": fall for a, fall in falls.items()},
    )


def findings(result: SweepOutcome) -> list[Finding]:
    """All statements, in the order of the paper. @throws ResultError when a snapshot lacks a field."""
    statements = (undisturbed_core, all_deforms, peak_stays, all_moves, upper_half_falls, thin_rim, run_out_falls,
                  height_rises, effect_grows)
    return [statement(result) for statement in statements]
