# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The figures of sweeps in curves: run-out and height over an axis, and over a with the published laws."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from periporo_tools.figures import save
from periporo_tools.laws import predictions
from periporo_tools.reproduction.outcomes import Outcome, SweepOutcome
from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PALE, PURPLE, RED, SKY, plt

_COLOURS = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY)
_MARKERS = "osD^vP"
_LAW_STYLES = ("--", ":", "-.")
_QUANTITIES = ("run_out", "height")
_LABEL_WIDTH = 0.14  # of the longest labels, over the length of an axis
_MOST_TICKS = 8

Group = tuple[str, list[Outcome]]  # what it is called, and its runs along the first axis
Law = float | tuple[float, float] | None  # a value, the ends of a gap, or nothing


def _groups(result: SweepOutcome) -> list[Group]:
    """The complete runs along the first axis, for each combination of the others."""
    found: dict[str, list[Outcome]] = {}
    for outcome in result.complete:
        others = [axis.words(value) for axis, value in zip(result.sweep.axes[1:], outcome.run.values[1:])]
        found.setdefault(", ".join(others), []).append(outcome)
    return list(found.items())


def _value(outcome: Outcome, quantity: str, laws: bool) -> float:
    """In r0 where the cases name a law, otherwise in mm."""
    record = outcome.comparison
    assert record is not None
    name = {"run_out": "front_mean", "run_out_99": "radius_99", "height": "height"}[quantity]
    if not laws:
        return 1e3 * record["measured"][name]
    scaled = record["measured"][name] / record["radius"]
    return scaled if quantity == "height" else scaled - 1.0


def _label(quantity: str, laws: bool) -> str:
    if laws:
        return "run-out (front - r0)/r0" if quantity == "run_out" else "height h/r0"
    return "front [mm]" if quantity == "run_out" else "height [mm]"


def _laws(outcome: Outcome, quantity: str) -> dict[str, Law]:
    """What each source says of this run."""
    found: dict[str, Law] = {}
    for row in (outcome.comparison or {}).get("laws", []):
        if row["quantity"] == quantity:
            edges = sorted(edge["value"] for edge in row.get("gap_between", []))
            found[row["source"]] = row["law"] if row["law"] is not None else (
                (edges[0], edges[1]) if len(edges) == 2 else None)
    return found


def _sources(groups: list[Group]) -> list[str]:
    sources: list[str] = []
    for _, outcomes in groups:
        for outcome in outcomes:
            for quantity in _QUANTITIES:
                sources += [source for source in _laws(outcome, quantity) if source not in sources]
    return sources


def _lower_and_upper(laws: list[Law]) -> tuple[np.ndarray, np.ndarray]:
    """Ends of what a law says at each place; NaN where it says nothing."""
    pairs = [(np.nan, np.nan) if law is None else law if isinstance(law, tuple) else (law, law) for law in laws]
    lower, upper = zip(*pairs)
    return np.array(lower), np.array(upper)


def _draw_laws(axes, places: list[list[float]], groups: list[Group], quantity: str, sideways: bool) -> None:
    """A line for each source, a band where it has a gap. One for all groups when it says the same for all."""
    for source in _sources(groups):
        style = _LAW_STYLES[_sources(groups).index(source) % 3]
        said = [[_laws(outcome, quantity).get(source) for outcome in outcomes] for _, outcomes in groups]
        everywhere = {law for row in said for law in row}
        if len(everywhere) == 1:
            _constant_law(axes, everywhere.pop(), style, sideways)
            continue
        common = all(row == said[0] for row in said) and all(place == places[0] for place in places)
        for index, (place, row) in enumerate(list(zip(places, said))[: 1 if common else None]):
            colour = INK if common else _COLOURS[index % 6]
            lower, upper = _lower_and_upper(row)
            if sideways:
                for at, low, high in zip(place, lower, upper):
                    axes.plot([low, low, high, high], [at - 0.3, at + 0.3, at + 0.3, at - 0.3], color=colour,
                              linestyle=style, linewidth=1.3, zorder=1)
                continue
            axes.plot(place, np.where(lower == upper, lower, np.nan), color=colour, linestyle=style, linewidth=1.3,
                      marker="_", markersize=12, zorder=1)
            for at, low, high in zip(place, lower, upper):
                axes.plot([at, at], [low, high], color=colour, alpha=0.15, linewidth=8, solid_capstyle="butt", zorder=0)


def _constant_law(axes, law: Law, style: str, sideways: bool) -> None:
    if isinstance(law, tuple):
        (axes.axvspan if sideways else axes.axhspan)(*law, color=INK, alpha=0.1, linewidth=0, zorder=0)
    elif law is not None:
        (axes.axvline if sideways else axes.axhline)(law, color=INK, linestyle=style, linewidth=1.3, zorder=1)


def _legend(axes, groups: list[Group], line: str) -> None:
    """Beside the last panel: groups, measures, laws."""
    handles = [
        Line2D([], [], color=_COLOURS[index % 6], marker=_MARKERS[index % 6], label=name, linestyle=line)
        for index, (name, _) in enumerate(groups) if name
    ]
    shade = INK if len(groups) > 1 else _COLOURS[0]
    handles += [
        Line2D([], [], color=shade, marker="o", linestyle="none", label="front (mean over directions), height"),
        Line2D([], [], color=shade, marker="o", linestyle="none", markerfacecolor="white",
               label="radius of 99 % of the mass"),
    ]
    for index, source in enumerate(_sources(groups)):
        handles.append(Line2D([], [], color=INK, linestyle=_LAW_STYLES[index % 3], linewidth=1.3, label=source))
    if any(isinstance(law, tuple) for _, outcomes in groups for outcome in outcomes for quantity in _QUANTITIES
           for law in _laws(outcome, quantity).values()):
        handles.append(Patch(color=INK, alpha=0.15, linewidth=0, label="between the ranges of a law"))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0)


def _plain_numbers(axis) -> None:
    """1, 2, 3, 5, 7, 10 on a logarithmic axis, instead of powers of ten."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 5.0, 7.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())


def _crowded(ticks: list[float], logarithmic: bool) -> bool:
    """Would labels of the ticks touch each other, side by side?"""
    places = np.sort(np.log(ticks) if logarithmic else np.array(ticks))
    return len(places) > 1 and float(np.diff(places).min()) < _LABEL_WIDTH * (places[-1] - places[0])


def _over_numbers(axes, result: SweepOutcome, groups: list[Group], quantity: str, laws: bool) -> None:
    axis = result.sweep.axes[0]
    places = [[outcome.number(0) for outcome in outcomes] for _, outcomes in groups]
    order = [np.argsort(place, kind="stable") for place in places]
    groups = [(name, [outcomes[i] for i in rank]) for (name, outcomes), rank in zip(groups, order)]
    places = [sorted(place) for place in places]
    for index, ((_, outcomes), place) in enumerate(zip(groups, places)):
        look = {"color": _COLOURS[index % 6], "marker": _MARKERS[index % 6]}
        axes.plot(place, [_value(outcome, quantity, laws) for outcome in outcomes], **look, zorder=3)
        if quantity == "run_out":
            axes.plot(place, [_value(outcome, "run_out_99", laws) for outcome in outcomes], **look, linewidth=0.8,
                      markerfacecolor="white", zorder=2)
    if axis.logarithmic:
        axes.set_xscale("log")
        _plain_numbers(axes.xaxis)
    if len(axis.values) <= _MOST_TICKS:
        axes.set_xticks([value.number for value in axis.values], [value.label for value in axis.values])
        if _crowded([value.number for value in axis.values], axis.logarithmic):
            axes.tick_params(axis="x", rotation=45)
    _draw_laws(axes, places, groups, quantity, sideways=False)
    axes.set_xlabel(axis.plot_label)
    axes.set_ylabel(_label(quantity, laws))
    axes.margins(x=0.08)
    axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])


def _over_labels(axes, result: SweepOutcome, groups: list[Group], quantity: str, laws: bool) -> None:
    """Dots in rows, one row for each label of the first axis."""
    values = result.sweep.axes[0].values
    spread = np.linspace(-0.18, 0.18, len(groups)) if len(groups) > 1 else [0.0]
    places = [[float(values.index(outcome.run.values[0])) for outcome in outcomes] for _, outcomes in groups]
    for index, ((_, outcomes), place) in enumerate(zip(groups, places)):
        look = {"color": _COLOURS[index % 6], "marker": _MARKERS[index % 6], "linestyle": "none"}
        rows = np.array(place) + spread[index]
        if quantity == "run_out":
            far = [_value(outcome, "run_out_99", laws) for outcome in outcomes]
            axes.plot(far, rows, **look, markerfacecolor="white", zorder=2)
        axes.plot([_value(outcome, quantity, laws) for outcome in outcomes], rows, **look, zorder=3)
    _draw_laws(axes, places, groups, quantity, sideways=True)
    axes.set_yticks(range(len(values)), [value.label for value in values])
    axes.set_ylim(len(values) - 0.5, -0.5)
    axes.grid(axis="y", color=PALE, linewidth=0.5)
    axes.set_axisbelow(True)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(_label(quantity, laws))
    axes.set_xlim(0.0, 1.05 * axes.get_xlim()[1])


def response(result: SweepOutcome, stem: Path) -> list[Path]:
    """Run-out and height over the first axis, a line for each value of the others; dots over its labels where they are
    no numbers. The laws that the cases name are drawn in."""
    groups = _groups(result)
    if not groups:
        return []
    laws = all(outcome.has_laws for _, outcomes in groups for outcome in outcomes)
    numeric = result.sweep.axes[0].numeric
    labels = len(result.sweep.axes[0].values)
    size = (9.6, 3.8) if numeric else (9.6, 1.1 + 0.42 * labels * max(1.0, 0.6 * len(groups)))
    apart = {"wspace": 0.26 if numeric else 0.08}
    figure, panels = plt.subplots(1, 2, figsize=size, sharey=not numeric, gridspec_kw=apart)
    for panel, quantity in zip(panels, _QUANTITIES):
        (_over_numbers if numeric else _over_labels)(panel, result, groups, quantity, laws)
    panels[0].set_title(result.sweep.title)
    _legend(panels[1], groups, "-" if numeric else "none")
    return [save(figure, stem.with_name(stem.name + ".png"))]


def scaling(result: SweepOutcome, stem: Path) -> list[Path]:
    """Run-out and height over a = h0/r0, both logarithmic, with the laws over their whole ranges."""
    groups = [(name, [outcome for outcome in outcomes if outcome.has_laws]) for name, outcomes in _groups(result)]
    groups = [(name, outcomes) for name, outcomes in groups if outcomes]
    if not groups:
        return []
    records = [outcome.comparison for _, outcomes in groups for outcome in outcomes if outcome.comparison]
    ratios = [record["aspect_ratio"] for record in records]
    along = np.geomspace(0.5 * min(ratios), 2.0 * max(ratios), 400)
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 4.2), gridspec_kw={"wspace": 0.26})
    for panel, quantity in zip(panels, _QUANTITIES):
        _law_curves(panel, records[0]["law"], quantity, along, _sources(groups))
        for index, (_, outcomes) in enumerate(groups):
            look = {"color": _COLOURS[index % 6], "marker": _MARKERS[index % 6], "linestyle": "none"}
            x = [outcome.comparison["aspect_ratio"] for outcome in outcomes if outcome.comparison]
            if quantity == "run_out":
                panel.plot(x, [_value(outcome, "run_out_99", True) for outcome in outcomes], **look,
                           markerfacecolor="white", zorder=2)
            panel.plot(x, [_value(outcome, quantity, True) for outcome in outcomes], **look, zorder=3)
        panel.set_xscale("log")
        panel.set_yscale("log")
        _plain_numbers(panel.xaxis)
        _plain_numbers(panel.yaxis)
        panel.set_xlim(along[0], along[-1])
        panel.set_xlabel("a = h0/r0")
        panel.set_ylabel(_label(quantity, True))
    panels[0].set_title(f"{result.sweep.title}: against the laws")
    _legend(panels[1], groups, "none")
    return [save(figure, stem.with_name(stem.name + ".png"))]


def _law_curves(axes, law: str, quantity: str, along: np.ndarray, sources: list[str]) -> None:
    """Every source over its ranges; the gap between two of them as a band between their ends."""
    said = [[row for row in predictions(law, float(a)) if row.quantity == quantity] for a in along]
    for index, first in enumerate(said[0]):
        style = _LAW_STYLES[sources.index(first.source) % 3] if first.source in sources else "-"
        values = np.array([np.nan if rows[index].value is None else rows[index].value for rows in said])
        axes.plot(along, values, color=INK, linestyle=style, linewidth=1.3, zorder=1)
        silent = {rows[index].neighbours for rows in said if rows[index].value is None}
        for low, high in (edges for edges in silent if len(edges) == 2):
            axes.fill_between([low.aspect_ratio, high.aspect_ratio], *sorted((low.value, high.value)), color=INK,
                              alpha=0.12, linewidth=0, zorder=0)
