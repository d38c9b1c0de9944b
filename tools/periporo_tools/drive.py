# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Draws the path of a material point that `periporo drive` left behind."""
from __future__ import annotations

import csv
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import ticker

from periporo_tools.style import BLUE, GREEN, INK, ORANGE, PALE, plt

Surface = tuple[np.ndarray, np.ndarray]  # p and q [Pa]
_TIME_UNITS = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"), (1.0, "s"), (1e-3, "ms"))


@dataclass
class MaterialPath:
    """A path with what is known beside it."""

    title: str
    columns: dict[str, np.ndarray]  # by name without unit; a row a step
    surfaces: dict[str, Surface]  # "initial" and "final", where the law has a yield surface
    critical_state_slope: float | None  # M, where the material has such a parameter
    failed: bool

    @property
    def sheared(self) -> bool:
        """True when there is more shear strain than round-off leaves."""
        return self.columns["equivalent_shear_strain"].max() > 1e-9

    @property
    def of_constant_volume(self) -> bool:
        return np.ptp(self.columns["volumetric_compression"]) < 1e-9

    def volume(self) -> tuple[np.ndarray, str]:
        """Specific volume where the porosity at the start is known, else volumetric strain."""
        if "specific_volume" in self.columns:
            return self.columns["specific_volume"], "specific volume v [-]"
        return -self.columns["volumetric_compression"], "volumetric strain [-], extension positive"


def _table(file: Path) -> tuple[list[str], list[list[str]]]:
    with file.open(newline="") as lines:
        rows = list(csv.reader(lines))
    return [name.split(" [")[0] for name in rows[0]], rows[1:]


def _surfaces(file: Path) -> dict[str, Surface]:
    points: dict[str, list[tuple[float, float]]] = {}
    if file.exists():
        for moment, p, q in _table(file)[1]:
            points.setdefault(moment, []).append((float(p), float(q)))
    return {moment: tuple(np.array(pairs).T) for moment, pairs in points.items()}


def read(folder: Path) -> MaterialPath:
    """The files of `periporo drive` in a folder."""
    names, rows = _table(folder / "path.csv")
    columns = dict(zip(names, np.array(rows, dtype=float).T))
    resolved = tomllib.loads((folder / "path.toml").read_text())
    (material,) = resolved["material"].values()
    return MaterialPath(
        resolved["title"], columns, _surfaces(folder / "yield_surface.csv"), material.get("critical_state_slope"),
        (folder / "failing_step.toml").exists(),
    )


def _stress_unit(largest: float) -> tuple[float, str]:
    """How many pascals make the unit that suits a stress, and its name."""
    for size, name in ((1e6, "MPa"), (1e3, "kPa")):
        if largest >= 10.0 * size:
            return size, name
    return 1.0, "Pa"


def _trace(axes, x: np.ndarray, y: np.ndarray) -> None:
    """The path with a ring where it starts and a dot where it ends."""
    axes.plot(x, y, color=BLUE, linewidth=1.5, zorder=3)
    axes.plot(x[:1], y[:1], "o", color=BLUE, markerfacecolor="white", markersize=6, zorder=4, clip_on=False)
    axes.plot(x[-1:], y[-1:], "o", color=BLUE, markersize=6, zorder=4, clip_on=False)


def _window(path: MaterialPath) -> tuple[float, float, float]:
    """Least and greatest p and greatest q of the stress path's panel [Pa]. It holds the path, and the whole of a yield
    surface unless that is open or much larger than the path."""
    p, q = path.columns["p"], path.columns["q"]
    farthest = max(p.max(), q.max())
    left, right, top = min(0.0, p.min()), farthest, q.max()
    for surface_p, surface_q in path.surfaces.values():
        whole = surface_p.max() <= 10.0 * farthest
        right = max(right, surface_p.max() if whole else 2.0 * farthest)
        left = min(left, max(surface_p.min(), -farthest))
        top = max(top, surface_q[surface_p <= right].max(initial=0.0))
    return 1.08 * left, 1.08 * right, 1.15 * top if top > 1e-6 * farthest else right


def _stress_path(axes, path: MaterialPath) -> None:
    p, q = path.columns["p"], path.columns["q"]
    left, right, top = _window(path)
    size, unit = _stress_unit(max(np.abs(p).max(), q.max()))
    for moment, colour in (("initial", PALE), ("final", ORANGE)):
        if moment in path.surfaces:
            surface_p, surface_q = path.surfaces[moment]
            label = f"yield in compression, {moment}"
            axes.plot(surface_p / size, surface_q / size, color=colour, linewidth=1.5, label=label)
    if path.critical_state_slope:
        ends = np.array([0.0, right])
        axes.plot(
            ends / size, path.critical_state_slope * ends / size, "--", color=GREEN, linewidth=1.2,
            label=f"critical state, q = {path.critical_state_slope:g} p",
        )
    _trace(axes, p / size, q / size)
    axes.set_xlim(left / size, right / size)
    axes.set_ylim(0.0, top / size)
    axes.set_xlabel(f"mean effective pressure p [{unit}]")
    axes.set_ylabel(f"deviator stress q [{unit}]")
    if path.surfaces or path.critical_state_slope:
        axes.legend(
            loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, fontsize=7, columnspacing=0.8, handlelength=1.2,
            handletextpad=0.4,
        )


@dataclass
class _Shear:
    """Shear strain and stress, with a sign where one component carries them."""

    strain: np.ndarray
    stress: np.ndarray
    strain_name: str
    stress_name: str


def _shear_of(path: MaterialPath) -> _Shear:
    columns = path.columns
    ranges = {name: np.ptp(columns[f"strain_{name}"]) for name in ("xx", "yy", "zz", "xy", "yz", "xz")}
    component = max(ranges, key=ranges.get)
    if component in ("xy", "yz", "xz"):
        strain, stress = 2.0 * columns[f"strain_{component}"], columns[f"stress_{component}"]
        return _Shear(strain, stress, f"shear strain gamma_{component} [-]", f"shear stress {component}")
    if _axisymmetric(path):
        strain = 2.0 / 3.0 * (columns["strain_xx"] - columns["strain_zz"])
        stress = columns["stress_xx"] - columns["stress_zz"]
        return _Shear(strain, stress, "shear strain eps_s [-]", "axial minus lateral pressure q")
    strain, stress = columns["equivalent_shear_strain"], columns["q"]
    return _Shear(strain, stress, "shear strain eps_s [-]", "deviator stress q")


def _shear_response(axes, path: MaterialPath) -> None:
    shear = _shear_of(path)
    size, unit = _stress_unit(np.abs(shear.stress).max())
    _trace(axes, shear.strain, shear.stress / size)
    axes.set_xlabel(shear.strain_name)
    axes.set_ylabel(f"{shear.stress_name} [{unit}]")


def _axisymmetric(path: MaterialPath) -> bool:
    columns = path.columns
    stress = np.abs(columns["p"]).max() + columns["q"].max()
    shear = sum(np.abs(columns[f"stress_{name}"]).max() for name in ("xy", "yz", "xz"))
    return np.abs(columns["stress_xx"] - columns["stress_yy"]).max() + shear <= 1e-6 * stress


def _volume_against_suction(axes, path: MaterialPath) -> None:
    volume, label = path.volume()
    size, unit = _stress_unit(path.columns["suction"].max())
    _trace(axes, path.columns["suction"] / size, volume)
    axes.set_xlabel(f"suction [{unit}]")
    axes.set_ylabel(label)


def _pressure_against_compression(axes, path: MaterialPath) -> None:
    size, unit = _stress_unit(np.abs(path.columns["p"]).max())
    _trace(axes, path.columns["volumetric_compression"], path.columns["p"] / size)
    axes.set_xlabel("volumetric compression [-]")
    axes.set_ylabel(f"mean effective pressure p [{unit}]")


def _compression_curve(axes, path: MaterialPath) -> None:
    p = path.columns["p"]
    volume, label = path.volume()
    size, unit = _stress_unit(np.abs(p).max())
    pressed = p > 0.0  # a logarithm has no place for the others
    if pressed.any():
        _trace(axes, p[pressed] / size, volume[pressed])
        axes.set_xscale("log")
        _readable_decade(axes, p[pressed] / size)
    axes.set_xlabel(f"mean effective pressure p [{unit}], logarithmic")
    axes.set_ylabel(label)


def _readable_decade(axes, values: np.ndarray) -> None:
    """Plain numbers at the ticks of a logarithmic axis, and enough of them when it spans less than a decade."""
    low, high = values.min(), values.max()
    margin = max(1.02, (high / low) ** 0.05)
    axes.set_xlim(low / margin, high * margin)
    if high < 3.0 * low:
        axes.xaxis.set_major_locator(ticker.MaxNLocator(6))
        axes.xaxis.set_minor_locator(ticker.NullLocator())
    else:
        labelled = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0) if high < 10.0 * low else (1.0, 2.0, 5.0)
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=labelled if high < 100.0 * low else (1.0,)))
    axes.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())


def _void_ratio(axes, path: MaterialPath) -> None:
    volume, label = path.volume()
    if "void_ratio" in path.columns:
        volume, label = path.columns["void_ratio"], "void ratio e [-]"
    if path.sheared:
        shear = _shear_of(path)
        _trace(axes, shear.strain, volume)
        axes.set_xlabel(shear.strain_name)
    else:
        time = path.columns["time"]
        size, unit = next((pair for pair in _TIME_UNITS if time.max() >= 3.0 * pair[0]), (1.0, "s"))
        _trace(axes, time / size, volume)
        axes.set_xlabel(f"time [{unit}]")
    axes.set_ylabel(label)


def _pressure_against_shear(axes, path: MaterialPath) -> None:
    """What takes the place of the void ratio when that is constant."""
    shear = _shear_of(path)
    size, unit = _stress_unit(np.abs(path.columns["p"]).max())
    _trace(axes, shear.strain, path.columns["p"] / size)
    axes.set_xlabel(shear.strain_name)
    axes.set_ylabel(f"mean effective pressure p [{unit}]")


def _panels(path: MaterialPath) -> tuple[Callable[..., None], ...]:
    """Stress path, response, compression curve and void ratio, or what says more where these say nothing."""
    if path.sheared:
        response = _shear_response
    else:
        response = _volume_against_suction if np.ptp(path.columns["suction"]) > 0.0 else _pressure_against_compression
    last = _pressure_against_shear if path.sheared and path.of_constant_volume else _void_ratio
    return _stress_path, response, _compression_curve, last


def draw(path: MaterialPath, picture: Path) -> Path:
    """Four panels in one picture."""
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.8), layout="constrained")
    for panel, place in zip(_panels(path), axes.flat):
        panel(place, path)
        if place.get_xscale() == "linear":
            place.xaxis.set_major_locator(ticker.MaxNLocator(6))
        place.grid(color=PALE, linewidth=0.4, alpha=0.6)
    figure.suptitle(path.title + (" (a step failed)" if path.failed else ""), color=INK, fontsize=11)
    aside = picture.with_suffix(".png.part")
    figure.savefig(aside, format="png", facecolor="white")
    plt.close(figure)
    aside.replace(picture)
    return picture


def main(folder: str) -> int:
    print(draw(read(Path(folder)), Path(folder) / "path.png"))
    return 0
