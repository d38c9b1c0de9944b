# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The figures of sweeps in perspective: initial stress, snapshots, deposits."""
from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from periporo_tools import measures, views
from periporo_tools.figures import save
from periporo_tools.reproduction import plots
from periporo_tools.reproduction.outcomes import Outcome, SweepOutcome
from periporo_tools.reproduction.plan import run_name
from periporo_tools.results import Field, ResultError, Results, Snapshot
from periporo_tools.style import colour_bar, plt, scale_of

_COLUMNS = 3  # pictures beside each other
_PANEL = 4.5  # width of one [inches]
_PIXELS = 1000  # of one, which is more than is shown
_TITLE = 0.3  # height of a line of text with the space around it [inches]


@dataclass(frozen=True)
class Panel:
    title: str
    results: Results
    snapshot: Snapshot


def vertical_stress(results: Results, index: int) -> Field:
    """Total vertical stress in kPa, compression positive: effective stress less saturation times suction."""
    effective = results.values(index, "effective_stress")[:, 2]  # tension positive
    water = results.values(index, "saturation").ravel() * results.values(index, "suction").ravel()
    return Field("total vertical stress, compression positive", "kPa", -1e-3 * (effective + water))


def _round_up(value: float) -> float:
    """To one, two or five times a power of ten, or a half more of it: 3.1 to 3.5, 0.8 to 0.8."""
    power = 10.0 ** math.floor(math.log10(max(value, 1e-12)))
    return math.ceil(2.0 * value / power - 1e-9) * power / 2.0


def _reach(panels: list[Panel]) -> float:
    """How far out the deposits go in x and y [m]."""
    far = 0.0
    for panel in panels:
        spacing = panel.results.spacing
        position = panel.snapshot.position[measures.connected(panel.snapshot, spacing)]
        far = max(far, float(np.abs(position[:, :2]).max()) + 0.5 * spacing)
    return far


def _first_row(axis) -> float:
    """The uppermost row of pixels of a view that shows something: a point or the grid."""
    shown = np.flatnonzero(np.asarray(axis.images[0].get_array())[..., 3].any(axis=1))
    return min(float(shown[0]), *(float(np.min(line.get_ydata())) for line in axis.lines))


def _draw(panels: list[Panel], scale: ScalarMappable, field: Field, title: str, path: Path) -> Path:
    """All panels at one scale of lengths and one of colours, (a), (b), (c) beside each other."""
    reach = _reach(panels)
    top = max(float(panel.snapshot.position[:, 2].max()) + panel.results.spacing for panel in panels)
    columns = min(_COLUMNS, len(panels))
    rows = math.ceil(len(panels) / columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False)
    for axis in axes.flat[len(panels):]:
        axis.axis("off")
    for count, (axis, panel) in enumerate(zip(axes.flat, panels)):
        views.perspective(
            axis, panel.snapshot, panel.results.spacing, panel.results.symmetry, scale, reach, _PIXELS, top
        )
        letter = f"({'abcdefghijklmnopqrstuvwxyz'[count]}) " if len(panels) > 1 else ""
        axis.set_title(f"{letter}{panel.title}", fontsize=11)
    used = list(axes.flat[: len(panels)])
    highest = min(_first_row(axis) for axis in used) - 0.03 * _PIXELS
    for axis in used:
        axis.set_ylim(axis.get_ylim()[0], highest)
    # A view is as high as its proportions, which all have in common, ask for.
    view = _PANEL * abs(np.subtract(*axes.flat[0].get_ylim())) / _PIXELS
    width, height = _PANEL * columns, rows * (view + _TITLE) + _TITLE
    figure.set_size_inches(width, height)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=1.0 - 2.0 * _TITLE / height, wspace=0.02,
                           hspace=_TITLE / view)
    figure.text(0.0, 1.0 - 0.4 * _TITLE / height, title, va="center", fontsize=12)
    bar = colour_bar(figure, scale, field, None, cax=figure.add_axes([1.0 + 0.1 / width, 0.0, 0.13 / width,
                                                                      1.0 - 2.0 * _TITLE / height]))
    bar.set_label(f"{field.name} [{field.unit}]".replace(" plastic ", "\nplastic ").replace(", ", ",\n"), fontsize=9,
                  labelpad=8)
    return save(figure, path)


def _first_of_others(result: SweepOutcome) -> list[Outcome]:
    """The complete runs along the first axis with the first value of every other one."""
    others = [axis.values[0] for axis in result.sweep.axes[1:]]
    return [outcome for outcome in result.complete if list(outcome.run.values[1:]) == others]


def _words(result: SweepOutcome, outcome: Outcome, first: int = 0, last: int | None = None) -> str:
    """\"a = 0.6, s = 20 kPa\" for some of the axes."""
    pairs = list(zip(result.sweep.axes, outcome.run.values))[first:last]
    return ", ".join(axis.words(value) for axis, value in pairs)


def _coloured_deposit(results: Results, index: int) -> Snapshot:
    snapshot = measures.main_body(results.snapshot(index))
    if snapshot.colour is None:
        raise ResultError(f"{results.folder / 'results.h5'}: its snapshots hold nothing to colour by")
    return snapshot


def initial_stress(result: SweepOutcome, stem: Path) -> list[Path]:
    """The columns at the release, coloured by total vertical stress: the paper's Figure 1."""
    outcomes = _first_of_others(result)
    if not outcomes:
        return []
    with ExitStack() as stack:
        panels = []
        for outcome in outcomes:
            results = stack.enter_context(outcome.results())
            stress = vertical_stress(results, results.release)
            snapshot = replace(results.snapshot(results.release), colour=stress)
            panels.append(Panel(_words(result, outcome, last=1), results, measures.main_body(snapshot)))
        fields = [panel.snapshot.colour for panel in panels if panel.snapshot.colour]
        largest = _round_up(max(float(np.percentile(field.values, 99.5)) for field in fields))
        scale = ScalarMappable(Normalize(0.0, largest), "viridis")
        others = _words(result, outcomes[0], first=1)
        title = "At the release" + (f", {others}" if others else "")
        return [_draw(panels, scale, fields[0], title, stem.with_name(stem.name + ".png"))]


def _moments(outcome: Outcome, results: Results) -> list[tuple[int, str]]:
    """The snapshots at the times that the case asks for; the last snapshot instead of those after it."""
    end = float(results.times[-1])
    times = outcome.special_times() or [end / 3.0, 2.0 * end / 3.0, end]
    moments: dict[int, str] = {}
    for time in times:
        index = results.nearest(min(time, end))
        late = time > end + 1e-3
        moments.setdefault(index, f"t = {results.times[index]:.2f} s" + (" (at rest)" if late else ""))
    return list(moments.items())


def snapshots(result: SweepOutcome, stem: Path) -> list[Path]:
    """Plastic shear strain at the times of the case, a picture for each value of the first axis: Figures 2 to 4."""
    drawn = []
    for outcome in _first_of_others(result):
        with outcome.results() as results:
            panels = [
                Panel(text, results, _coloured_deposit(results, index)) for index, text in _moments(outcome, results)
            ]
            drawn.append(_deposit_picture(panels, _words(result, outcome), _named(stem, result, outcome)))
    return drawn


def _named(stem: Path, result: SweepOutcome, outcome: Outcome) -> Path:
    """STEM_a0.6.png."""
    return stem.with_name(f"{stem.name}_{run_name(result.sweep.axes[:1], outcome.run.values[:1])}.png")


def _deposit_picture(panels: list[Panel], title: str, path: Path) -> Path:
    field = panels[0].snapshot.colour
    assert field is not None
    if field.unit == "-":
        return _draw(panels, scale_of(field, None), field, title, path)
    largest = max(float(panel.snapshot.colour.values.max()) for panel in panels if panel.snapshot.colour)
    return _draw(panels, scale_of(field, _round_up(largest)), field, title, path)


def deposits(result: SweepOutcome, stem: Path) -> list[Path]:
    """The deposits side by side: along the second axis, a picture for each value of the first one, Figures 5 to 7;
    along the first where there is no second."""
    if len(result.sweep.axes) == 1:
        groups = [(result.complete, stem.with_name(stem.name + ".png"), result.sweep.title, 0)]
    else:
        groups = []
        for value in result.sweep.axes[0].values:
            outcomes = [outcome for outcome in result.complete if outcome.run.values[0] == value]
            if outcomes:
                groups.append((outcomes, _named(stem, result, outcomes[0]), _words(result, outcomes[0], last=1), 1))
    drawn = []
    for outcomes, path, title, first in groups:
        with ExitStack() as stack:
            panels = []
            for outcome in outcomes:
                results = stack.enter_context(outcome.results())
                panels.append(Panel(_words(result, outcome, first=first), results, _coloured_deposit(results, -1)))
            if panels:
                drawn.append(_deposit_picture(panels, title, path))
    return drawn


FIGURES: dict[str, Callable[[SweepOutcome, Path], list[Path]]] = {
    "initial_stress": initial_stress,
    "snapshots": snapshots,
    "deposits": deposits,
    "response": plots.response,
    "scaling": plots.scaling,
}


def draw(result: SweepOutcome, folder: Path) -> list[Path]:
    """Draws what the sweep asks for into FOLDER/SWEEP_FIGURE*.png, as far as runs are complete.

    @throws ResultError when a result lacks what a figure shows
    """
    folder.mkdir(parents=True, exist_ok=True)
    drawn: list[Path] = []
    for name in result.sweep.figures:
        drawn += FIGURES[name](result, folder / f"{result.sweep.name}_{name}")
    return drawn
