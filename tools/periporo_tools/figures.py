# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The pictures of a run."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable

from periporo_tools import measures, views
from periporo_tools.results import Field, ResultError, Results, Snapshot
from periporo_tools.style import BLUE, GREEN, INK, MILLI, ORANGE, PALE, PURPLE, RED, SKY, colour_bar, plt, scale_of

_NO_FIELD = Field("", "-", np.zeros(1))  # where the results hold nothing to colour by
_AXES_WIDTH = 7.1  # of a figure 9.4 inches wide with a colour bar [inches]


def save(figure, path: Path) -> Path:
    aside = path.with_suffix(".png.part")
    figure.savefig(aside, format="png", facecolor="white", bbox_inches="tight")
    plt.close(figure)
    aside.replace(path)
    return path


def _title(results: Results) -> str:
    return results.title + ("" if results.complete else " (run not complete)")


def _reach(results: Results, *snapshots: Snapshot) -> float:
    """How far out the deposit goes in x and y at any of these times [m]."""
    far = 0.0
    for snapshot in snapshots:
        position = snapshot.position[measures.connected(snapshot, results.spacing)]
        far = max(far, float(np.abs(position[:, :2]).max()) + 0.5 * results.spacing)
    return far


def _frame_section(axes, reach: float, height: float) -> None:
    axes.set_xlim(-1.06 * reach * MILLI, 1.06 * reach * MILLI)
    axes.set_ylim(-0.05 * height * MILLI, 1.08 * height * MILLI)


def _initial_outline(results: Results, initial: Snapshot) -> tuple[float, float, float]:
    """Left and right end in the section, images at a symmetry plane x = 0 included, and height of the column [m]."""
    x = initial.position[:, 0]
    right = float(x.max()) + 0.5 * results.spacing
    left = -right if "x" in results.symmetry else float(x.min()) - 0.5 * results.spacing
    return left, right, float(initial.position[:, 2].max()) + 0.5 * results.spacing


def deposit(results: Results, path: Path, colour_max: float | None, extent: float | None) -> Path:
    """Section and perspective of the last snapshot."""
    initial = measures.main_body(results.snapshot(results.release))
    final = measures.main_body(results.snapshot(-1))
    left, right, height = _initial_outline(results, initial)
    reach = extent or max(_reach(results, initial, final), -left, right)
    field = final.colour
    highest = max(height, float(final.position[:, 2].max()))
    heights = [_AXES_WIDTH * 1.13 * highest / (2.12 * reach), 0.5 * _AXES_WIDTH]
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(9.4, sum(heights) + 0.9), gridspec_kw={"height_ratios": heights, "hspace": 0.14}
    )
    scale = _scale(field, colour_max)
    views.section(top, final, results.spacing, results.symmetry, scale)
    views.outline(top, left, right, height, label="before the collapse")
    _frame_section(top, reach, highest)
    top.set_xlabel("x [mm]")
    top.set_title(f"{_title(results)}\nt = {final.time:.3f} s, section y = 0")
    top.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0)
    views.perspective(bottom, final, results.spacing, results.symmetry, scale, reach)
    bottom.set_anchor("N")
    if field:
        colour_bar(figure, scale, field, [top, bottom], fraction=0.025, pad=0.02, aspect=45)
    return save(figure, path)


def profile(results: Results, comparison: dict, path: Path) -> Path:
    """Height over distance from the axis before and after, with what the laws say."""
    planar = comparison["planar"]
    figure, axes = plt.subplots(figsize=(9, 4.6))
    furthest = 0.0
    for snapshot, colour, name in (
        (results.snapshot(results.release), PALE, "before the collapse"),
        (results.snapshot(-1), BLUE, "deposit"),
    ):
        snapshot = measures.main_body(snapshot)
        inside = snapshot.position[measures.connected(snapshot, results.spacing)]
        line = measures.profile(inside, results.spacing, results.symmetry, planar)
        axes.fill_between(
            line.radius * MILLI, line.lowest * MILLI, line.highest * MILLI, color=colour, alpha=0.25, linewidth=0
        )
        label = f"{name}, t = {max(snapshot.time, 0.0):.3f} s (mean and range over {'y' if planar else 'directions'})"
        axes.plot(line.radius * MILLI, line.mean * MILLI, color=colour, label=label)
        furthest = max(furthest, float(line.radius.max()) * MILLI)

    measured = comparison["measured"]
    front = measured["front_mean"] * MILLI
    axes.plot([front], [0], marker="^", color=BLUE, markersize=9, clip_on=False, linestyle="none", zorder=5,
              label=f"front, mean over {'sides' if planar else 'directions'}: {front:.0f} mm")
    axes.plot([measured["radius_99"] * MILLI], [0], marker="|", color=BLUE, markersize=16, markeredgewidth=2.5,
              clip_on=False, linestyle="none", zorder=5,
              label=f"99 % of the mass within {measured['radius_99'] * MILLI:.0f} mm")
    furthest = max(furthest, measured["radius_99"] * MILLI, _draw_laws(axes, comparison))
    axes.set_xlim(0.0, 1.05 * furthest)
    axes.set_ylim(0.0, None)
    axes.set_xlabel("distance from the " + ("middle plane" if planar else "axis") + " [mm]")
    axes.set_ylabel("height [mm]")
    axes.set_title(_title(results))
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), ncol=2, borderaxespad=0.0)
    return save(figure, path)


def _draw_laws(axes, comparison: dict) -> float:
    """Run-out as a vertical line, height as a short horizontal one; a gap as a band between its neighbours."""
    unit = comparison.get("radius", 0.0) * MILLI
    furthest = 0.0
    sources: list[str] = []
    for row in comparison.get("laws", []):
        if row["quantity"] not in ("run_out", "height"):
            continue
        if row["source"] not in sources:
            sources.append(row["source"])
        colour = (RED, GREEN, PURPLE)[sources.index(row["source"]) % 3]
        style = ("--", ":", "-.")[sources.index(row["source"]) % 3]
        run_out = row["quantity"] == "run_out"
        if row["law"] is None:
            edges = [edge["value"] for edge in row["gap_between"]]
            low, high = ((1 + min(edges)) * unit, (1 + max(edges)) * unit) if run_out else (
                min(edges) * unit, max(edges) * unit)
            label = f"{'front' if run_out else 'height'} {low:.0f} .. {high:.0f} mm, gap of {row['source']}"
            if run_out:
                axes.axvspan(low, high, ymax=0.35, color=colour, alpha=0.15, label=label, linewidth=0)
                furthest = max(furthest, high)
            else:
                axes.fill_between([0.0, 0.6 * unit], low, high, color=colour, alpha=0.15, linewidth=0, label=label)
            continue
        if run_out:
            at = (1.0 + row["law"]) * unit
            furthest = max(furthest, at)
            axes.axvline(at, ymax=0.35, color=colour, linestyle=style, label=f"front {at:.0f} mm, {row['source']}")
        else:
            at = row["law"] * unit
            axes.plot([0.0, 0.6 * unit], [at, at], color=colour, linestyle=style,
                      label=f"height {at:.0f} mm, {row['source']}")
    return furthest


_ENERGIES = {
    "kinetic_energy": ("kinetic", BLUE, "-"),
    "stress_work": ("stress work", RED, "-"),
    "friction_work": ("friction", GREEN, "-"),
    "contact_energy": ("contact", ORANGE, "-"),
    "collision_work": ("collisions", ORANGE, ":"),
    "other_work": ("other", SKY, "-"),
    "energy_error": ("error of the sum", INK, ":"),
}


def _since_release(results: Results) -> dict[str, np.ndarray]:
    """The histories from the release on; empty when the run wrote none of it."""
    columns = results.history
    if "time" not in columns or not (columns["time"] >= 0.0).any():
        return {}
    settled = np.flatnonzero(columns["time"] <= 0.0)
    since = slice(int(settled[-1]) if settled.size else 0, None)
    return {name: values[since] for name, values in columns.items()}


def _energies(axes, columns: dict[str, np.ndarray]) -> None:
    """Energies over the time since the release."""
    time = columns["time"]
    potential = columns.get("gravity_energy")
    if potential is not None:
        axes.plot(time, potential[0] - potential, color=PURPLE, linestyle="--", label="potential energy released")
    for name, (label, colour, style) in _ENERGIES.items():
        if name in columns and (name == "energy_error" or np.any(columns[name] != columns[name][0])):
            values = columns[name]
            axes.plot(time, values if name == "kinetic_energy" else values - values[0], color=colour, linestyle=style,
                      label=label)
    axes.axhline(0.0, color=PALE, linewidth=0.8, zorder=0)
    axes.set_ylabel("energy since the release [J]")


def history(results: Results, comparison: dict, path: Path) -> Path | None:
    """Energies, front and height over time; none when the run wrote no history."""
    columns = _since_release(results)
    if not columns:
        return None
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(9, 7), sharex=True, gridspec_kw={"hspace": 0.12})
    _energies(top, columns)
    part = {1: " (energies of the half computed)", 2: " (energies of the quarter computed)"}
    top.set_title(_title(results) + part.get(len(results.symmetry), ""))
    top.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))

    for name, label, colour in (
        ("front", "front: farthest point\nof all, escaped ones included", BLUE),
        ("height", "height: highest point of all", ORANGE),
    ):
        if name in columns:
            bottom.plot(columns["time"], columns[name] * MILLI, color=colour, label=label)
    rest = comparison["measured"]["rest_time"]
    if rest is not None:
        bottom.axvline(rest, color=INK, linewidth=1.0, linestyle="-", label=f"at rest: {rest:.2f} s")
    for row in comparison.get("laws", []):
        if row["quantity"] == "end_of_motion" and row["law"] is not None:
            end = row["law"] * np.sqrt(comparison["height"] / 9.81)
            bottom.axvline(end, color=RED, linestyle="--", linewidth=1.2,
                           label=f"end of motion: {end:.2f} s,\n{row['source']}")
    bottom.set_ylim(0.0, None)
    bottom.set_xlabel("time since the release [s]")
    bottom.set_ylabel("distance [mm]")
    bottom.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return save(figure, path)


def sequence_times(results: Results, rest: float | None, count: int = 5) -> list[int]:
    """Snapshots spread evenly from the release to rest, the last one instead of the one at rest."""
    end = float(results.times[-1])
    rest = end if rest is None else min(rest, end)
    between = [results.nearest(time) for time in np.linspace(0.0, rest, count)[1:-1]]
    return sorted({results.release, *between, len(results.times) - 1})


def sequence(
    results: Results, comparison: dict, path: Path, colour_max: float | None, extent: float | None,
    times: list[float] | None,
) -> Path:
    """Sections at several times at one scale, one below the other."""
    if times:
        chosen = sorted({results.nearest(time) for time in times})
    else:
        chosen = sequence_times(results, comparison["measured"]["rest_time"])
    snapshots = [measures.main_body(results.snapshot(index)) for index in chosen]
    initial = measures.main_body(results.snapshot(results.release))
    left, right, height = _initial_outline(results, initial)
    reach = extent or max(_reach(results, *snapshots), -left, right)
    row_height = _AXES_WIDTH * 1.13 * height / (2.12 * reach)
    figure, axes = plt.subplots(
        len(snapshots),
        1,
        figsize=(9.4, len(snapshots) * (row_height + 0.25) + 0.8),
        sharex=True,
        squeeze=False,
        gridspec_kw={"hspace": 0.2},
    )
    axes = list(axes[:, 0])
    field = _common_field(snapshots)
    scale = _scale(field, colour_max)
    for axis, snapshot in zip(axes, snapshots):
        views.section(axis, snapshot, results.spacing, results.symmetry, scale)
        views.outline(axis, left, right, height)
        _frame_section(axis, reach, height)
        axis.text(0.99, 0.9, f"t = {max(snapshot.time, 0.0):.3f} s", transform=axis.transAxes, ha="right", va="top")
    axes[0].set_title(f"{_title(results)}: section y = 0")
    axes[-1].set_xlabel("x [mm]")
    if field:
        colour_bar(figure, scale, field, axes, fraction=0.025, pad=0.02, aspect=40)
    return save(figure, path)


def _common_field(snapshots: list[Snapshot]) -> Field | None:
    """What colours all of the snapshots, with the values of them all."""
    fields = [snapshot.colour for snapshot in snapshots if snapshot.colour]
    if len({field.name for field in fields}) > 1:
        raise ResultError("runs in one picture must hold the same field to colour by; these do not")
    if not fields:
        return None
    return Field(fields[0].name, fields[0].unit, np.concatenate([field.values for field in fields]))


def _scale(field: Field | None, colour_max: float | None) -> ScalarMappable:
    return scale_of(field, colour_max) if field else scale_of(_NO_FIELD, 1.0)


def series(runs: list[Results], path: Path, colour_max: float | None) -> Path:
    """Final sections of several runs at one scale of lengths and one of colours, one below the other."""
    final = [measures.main_body(run.snapshot(-1)) for run in runs]
    initial = [measures.main_body(run.snapshot(run.release)) for run in runs]
    outlines = [_initial_outline(run, snapshot) for run, snapshot in zip(runs, initial)]
    reach = max(_reach(run, snapshot) for run, snapshot in zip(runs, final))
    heights = [height for *_, height in outlines]
    inches = _AXES_WIDTH / (2.12 * reach)
    figure, axes = plt.subplots(
        len(runs),
        1,
        figsize=(9.4, sum(1.13 * height * inches + 0.45 for height in heights) + 0.6),
        sharex=True,
        squeeze=False,
        gridspec_kw={"height_ratios": heights, "hspace": 0.35},
    )
    axes = list(axes[:, 0])
    field = _common_field(final)
    scale = _scale(field, colour_max)
    for axis, run, snapshot, (left, right, height) in zip(axes, runs, final, outlines):
        views.section(axis, snapshot, run.spacing, run.symmetry, scale)
        views.outline(axis, left, right, height)
        _frame_section(axis, reach, height)
        axis.set_title(f"{_title(run)}, t = {snapshot.time:.3f} s", fontsize=10)
    axes[-1].set_xlabel("x [mm]")
    if field:
        colour_bar(figure, scale, field, axes, fraction=0.025, pad=0.02, aspect=40)
    return save(figure, path)


def side_by_side(runs: list[Results], names: list[str], path: Path, colour_max: float | None) -> Path:
    """Final sections of several runs beside each other, the energies of each below, all at one scale."""
    final = [measures.main_body(run.snapshot(-1)) for run in runs]
    initial = [measures.main_body(run.snapshot(run.release)) for run in runs]
    outlines = [_initial_outline(run, snapshot) for run, snapshot in zip(runs, initial)]
    reach = max(_reach(run, snapshot) for run, snapshot in zip(runs, final))
    highest = max([float(snapshot.position[:, 2].max()) for snapshot in final] + [height for *_, height in outlines])
    field = _common_field(final)
    scale = _scale(field, colour_max)
    width = 5.2
    section = width * 1.13 * highest / (2.12 * reach)
    figure, axes = plt.subplots(
        2, len(runs), figsize=(width * len(runs) + 1.6, section + 4.4), sharex="row", sharey="row", squeeze=False,
        gridspec_kw={"height_ratios": [section, 3.2], "hspace": 0.3, "wspace": 0.08},
    )
    for run, name, snapshot, (left, right, height), top, bottom in zip(runs, names, final, outlines, *axes):
        views.section(top, snapshot, run.spacing, run.symmetry, scale)
        views.outline(top, left, right, height)
        _frame_section(top, reach, highest)
        top.set_title(f"{name}\nt = {snapshot.time:.3f} s", fontsize=10)
        top.set_xlabel("x [mm]")
        columns = _since_release(run)
        if columns:
            _energies(bottom, columns)
        bottom.set_xlabel("time since the release [s]")
    for panel in axes[:, 1:].flat:
        panel.set_ylabel("")
    axes[1, -1].legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    if field:
        bar = colour_bar(figure, scale, field, list(axes[0]), fraction=0.025, pad=0.01, aspect=15)
        bar.set_label(f"{field.name} [{field.unit}]".replace(" plastic ", " plastic\n"), fontsize=8)
    return save(figure, path)
