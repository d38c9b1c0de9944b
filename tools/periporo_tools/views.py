# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The two ways a cloud of points is shown: a vertical section and a perspective."""
from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection

from periporo_tools.rendering import aimed_at, render, smaller
from periporo_tools.results import Snapshot
from periporo_tools.style import INK, MILLI, PALE


def mirrored(position: np.ndarray, values: np.ndarray, axes: str) -> tuple[np.ndarray, np.ndarray]:
    """Adds the images of the points at symmetry planes through the origin, across x, y or both."""
    for axis in axes:
        flip = np.ones(3)
        flip["xyz".index(axis)] = -1.0
        position = np.concatenate([position, position * flip])
        values = np.concatenate([values, values])
    return position, values


def colour_values(snapshot: Snapshot) -> np.ndarray:
    return snapshot.colour.values if snapshot.colour else np.zeros(len(snapshot.position))


def section(axes: Axes, snapshot: Snapshot, spacing: float, symmetry: frozenset[str], scale: ScalarMappable) -> None:
    """The points nearer to the plane y = 0 than 1.5 spacings, drawn to scale in mm: of a lattice the first row. Where a
    flow spreads sideways it leaves a thinner slice, which then shows gaps that are not there."""
    beside = np.abs(snapshot.position[:, 1]) < 1.49 * spacing
    position, values = mirrored(
        snapshot.position[beside], colour_values(snapshot)[beside], "x" if "x" in symmetry else ""
    )
    order = np.argsort(-np.abs(position[:, 1]), kind="stable")  # those in the plane are drawn last
    position = position[order] * MILLI
    size = np.full(len(position), 1.42 * spacing * MILLI)  # no gaps in a square lattice
    axes.add_collection(
        EllipseCollection(
            size,
            size,
            np.zeros_like(size),
            units="xy",
            offsets=position[:, [0, 2]],
            offset_transform=axes.transData,
            facecolors=scale.to_rgba(values[order]),
            linewidths=0,
            rasterized=True,
        )
    )
    axes.axhline(0.0, color=INK, linewidth=1.0, zorder=0)
    axes.set_aspect("equal")
    axes.set_ylabel("z [mm]")


def outline(axes: Axes, left: float, right: float, height: float, **options: object) -> None:
    """The undeformed column, dashed."""
    axes.plot(
        [MILLI * x for x in (left, left, right, right)],
        [MILLI * z for z in (0.0, height, height, 0.0)],
        color=INK,
        linewidth=1.0,
        linestyle=(0, (4, 3)),
        **options,
    )


def _grid_step(size: float) -> float:
    """A round distance [mm] that divides `size` [mm] into four to ten."""
    rough = size / 8.0
    power = 10.0 ** np.floor(np.log10(rough))
    return float(next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= rough))


def perspective(
    axes: Axes,
    snapshot: Snapshot,
    spacing: float,
    symmetry: frozenset[str],
    scale: ScalarMappable,
    reach: float,
    width: int = 1400,
    top: float | None = None,
) -> None:
    """The whole body on a floor with a grid in mm; points farther out than `reach` [m] are left out.

    @param top what the view must hold above the floor [m], the highest point unless given: views of the same reach and
    top are at one scale
    """
    position, values = mirrored(snapshot.position, colour_values(snapshot), "".join(sorted(symmetry)))
    near = (np.abs(position[:, :2]) <= reach).all(axis=1)
    position, values = position[near], values[near]
    step = _grid_step(2.0 * reach * MILLI) / MILLI
    edge = step * np.ceil(reach / step)
    top = float(position[:, 2].max(initial=0.0)) + spacing if top is None else top
    rim = 1.12 * edge  # room for the numbers
    camera = aimed_at(np.array([-rim, -rim, 0.0]), np.array([rim, rim, top]), width)

    fine = 2
    sharp = replace(camera, focal=camera.focal * fine, width=camera.width * fine, height=camera.height * fine)
    image = smaller(render(position, scale.to_rgba(values)[:, :3], 0.72 * spacing, sharp), fine)

    def line(start: tuple[float, float], end: tuple[float, float], **options: object) -> None:
        column, row, _ = camera.project(np.array([[*start, 0.0], [*end, 0.0]]))
        axes.plot(column, row, zorder=1, **options)

    marks = np.arange(-edge, edge + 0.5 * step, step)
    for mark in marks:
        line((mark, -edge), (mark, edge), color=PALE, linewidth=0.5)
        line((-edge, mark), (edge, mark), color=PALE, linewidth=0.5)
    every = 2 if len(marks) > (9 if width >= 1400 else 5) else 1
    centre = len(marks) // 2
    last = max(index for index in range(len(marks)) if (index - centre) % every == 0)
    for index, mark in enumerate(marks):
        if (index - centre) % every:
            continue
        for where, name in (((mark, -1.09 * edge), "x"), ((1.07 * edge, mark), "y")):
            if name == "y" and index == 0:
                continue  # the corner has its number from x
            column, row, _ = camera.project(np.array([*where, 0.0]))
            text = f"{name} = 0" if abs(mark) < 0.5 * step else f"{mark * MILLI:.0f}"
            unit = " mm" if name == "y" and index == last else ""
            axes.text(column, row, text + unit, ha="center", va="center", fontsize=8, color=INK)
    axes.imshow(image, zorder=2, interpolation="bilinear")
    axes.set_xlim(0, camera.width)
    axes.set_ylim(camera.height, 0)
    axes.axis("off")
