# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Draws and tabulates the phase speeds that `periporo dispersion` prints."""
from __future__ import annotations

import csv
import math
from collections import defaultdict
from pathlib import Path

from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, plt

_DIRECTIONS = {"100": "-", "110": "--", "111": ":"}
_COLOURS = (INK, BLUE, GREEN, ORANGE, RED, PURPLE, SKY)
# by force state, influence function, direction and wave: (|k| dx, relative phase speed)
Curves = dict[tuple[str, str, str, str], list[tuple[float, float]]]


def read(table: Path) -> Curves:
    """The table that `periporo dispersion` prints."""
    curves = defaultdict(list)
    with table.open() as lines:
        for row in csv.DictReader(lines):
            key = (row["force_state"], row["influence"], row["direction"], row["wave"])
            curves[key].append((float(row["wave_number_times_spacing"]), float(row["relative_phase_speed"])))
    return dict(curves)


def draw(curves: Curves, picture: Path) -> Path:
    """A row of panels a wave, a column a force state; colours are influence functions, dashes directions."""
    states = list(dict.fromkeys(key[0] for key in curves))
    influences = list(dict.fromkeys(key[1] for key in curves))
    figure, axes = plt.subplots(
        2, len(states), figsize=(3.6 * len(states), 6.4), sharex=True, sharey=True, squeeze=False, layout="constrained"
    )
    for line, wave in enumerate("PS"):
        for column, state in enumerate(states):
            panel = axes[line][column]
            panel.axhline(1.0, color=INK, linewidth=0.6)
            for (its_state, influence, direction, its_wave), points in curves.items():
                if (its_state, its_wave) == (state, wave):
                    panel.plot(
                        *zip(*points), color=_COLOURS[influences.index(influence)],
                        linestyle=_DIRECTIONS[direction], linewidth=1.2,
                        label=influence if direction == "100" else None,
                    )
            panel.set_title(f"{state}: {wave}-wave", fontsize=9)
    for panel in axes[-1]:
        panel.set_xlabel("|k| dx [-]")
    for line in axes:
        line[0].set_ylabel("phase speed over continuum [-]")
    axes[0][0].set_ylim(0.0, 1.1)
    axes[0][-1].legend(fontsize=7, title="solid [100], dashed [110], dotted [111]", title_fontsize=7)
    figure.savefig(picture)
    plt.close(figure)
    return picture


def summary(curves: Curves) -> str:
    """A line a force state and influence function: relative speeds along [100] of long, middling and shortest waves."""
    rows = [f"{'force state':18} {'influence':17} {'wave':5} {'k dx = pi/4':>12} {'pi/2':>7} {'pi':>7}"]
    for (state, influence, direction, wave), points in curves.items():
        if direction != "100":
            continue
        at = [min(points, key=lambda point: abs(point[0] - k))[1] for k in (math.pi / 4, math.pi / 2, math.pi)]
        rows.append(f"{state:18} {influence:17} {wave:5} {at[0]:12.3f} {at[1]:7.3f} {at[2]:7.3f}")
    return "\n".join(rows)


def main(table: str, picture: str) -> int:
    curves = read(Path(table))
    print(summary(curves))
    print(f"\n{draw(curves, Path(picture))}\n{table}")
    return 0
