# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Reads what a run left behind: results.h5 and summary.json."""
from __future__ import annotations

import json
import os
from dataclasses import dataclass, replace
from pathlib import Path

import h5py
import numpy as np


STRAIN, DISPLACEMENT = "equivalent plastic shear strain", "displacement"  # what pictures are coloured by unless told


class ResultError(Exception):
    """A result folder that cannot be used, in words for the user."""


@dataclass(frozen=True)
class Field:
    """Values at the material points with their unit."""

    name: str
    unit: str
    values: np.ndarray


@dataclass(frozen=True)
class Snapshot:
    """The material points at one time, SI units."""

    time: float
    stage: str
    position: np.ndarray  # N x 3 [m]
    mass: np.ndarray  # N [kg]
    body: np.ndarray  # N
    colour: Field | None  # what the pictures are coloured by
    not_finite: int = 0  # points left out because their position is no number, as at the failure of a run

    def select(self, chosen: np.ndarray) -> "Snapshot":
        """The points where `chosen` holds."""
        colour = self.colour and Field(self.colour.name, self.colour.unit, self.colour.values[chosen])
        return replace(
            self, position=self.position[chosen], mass=self.mass[chosen], body=self.body[chosen], colour=colour
        )


@dataclass(frozen=True)
class Comparison:
    """What a case asks to be held against."""

    law: str
    radius: float  # r0, or half-width d0 [m]
    height: float  # h0 [m]

    @property
    def aspect_ratio(self) -> float:
        return self.height / self.radius


class Results:
    """One result folder.

    @code
    results = Results(Path("results/quickstart"))
    final = results.snapshot(-1)
    print(final.time, final.position.max(axis=0))
    @endcode
    """

    def __init__(self, folder: Path, field: str | None = None):
        """
        @param field that colours the snapshots, "saturation", "velocity" (its length) or "effective_stress.zz"
        """
        self.folder = folder
        self._field = field
        path = folder / "results.h5"
        if not path.is_file():
            raise ResultError(f"{path}: there is no such file; has the case been run with the writer \"hdf5\"?")
        self._open(path)
        if "snapshots" not in self._file or not len(self._file["snapshots"]):
            raise ResultError(f"{path}: it holds no snapshot")
        self._names = sorted(self._file["snapshots"])
        self.times = np.array([float(self._group(name).attrs["time"]) for name in self._names])
        self.complete = bool(self._file.attrs.get("complete", True))
        self.missing = _text(self._file.attrs.get("missing")).splitlines()  # what was lost, in words
        self.summary = read_summary(folder)
        self._case = self.summary.get("case") or {}

    def _open(self, path: Path) -> None:
        try:
            self._file = h5py.File(path, "r")
        except OSError as error:
            raise ResultError(f"{path}: not a readable HDF5 file ({error})") from error

    def _group(self, name: str) -> h5py.Group:
        """A snapshot. Until a run is complete it is a link to another file, which is merged and deleted at the end: then
        the new results.h5 is opened."""
        try:
            return self._file["snapshots"][name]
        except KeyError:
            self.close()
            self._open(self.folder / "results.h5")
        try:
            return self._file["snapshots"][name]
        except KeyError as error:
            raise ResultError(
                f"{self.folder / 'results.h5'}: snapshot {name} is not there; have its parts in"
                f" {self.folder / 'results.parts'} been deleted, or has results.h5 been copied without them?"
            ) from error

    def close(self) -> None:
        self._file.close()

    def __enter__(self) -> "Results":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def title(self) -> str:
        return _text(self._file.attrs.get("title")) or self._case.get("title") or self.folder.name

    @property
    def symmetry(self) -> frozenset[str]:
        """Axes whose plane through the origin is a symmetry plane: "x", "y" or both."""
        return frozenset(self._case.get("symmetry") or ())

    @property
    def comparison(self) -> Comparison | None:
        asked = self._case.get("comparison")
        if not asked:
            return None
        return Comparison(asked["law"], float(asked["radius"]), float(asked["height"]))

    @property
    def spacing(self) -> float:
        """Distance of neighbouring points in the undeformed lattice [m]."""
        given = self._case.get("spacing")
        if given:
            return float(given)
        volume = np.asarray(self._group(self._names[0])["volume"])
        return float(np.cbrt(np.median(volume)))

    @property
    def release(self) -> int:
        """Index of the snapshot at the start of the first dynamic stage."""
        settled = np.flatnonzero(self.times <= 0.0)
        return int(settled[-1]) if settled.size else 0

    def nearest(self, time: float) -> int:
        """Index of the snapshot nearest to a time."""
        return int(np.argmin(np.abs(self.times - time)))

    def snapshot(self, index: int) -> Snapshot:
        group = self._group(self._names[index])
        position = np.asarray(group["position"], dtype=float)
        finite = np.isfinite(position).all(axis=1)
        if not finite.any():
            raise ResultError(
                f"{self.folder / 'results.h5'}: snapshot {self._names[index]} (t = {self.times[index]:g} s) holds no"
                " point with a finite position"
            )
        count = len(position)
        volume = np.asarray(group["volume"], dtype=float)
        density = np.asarray(group["density"], dtype=float) if "density" in group else np.ones(count)
        body = np.asarray(group["body"], dtype=int) if "body" in group else np.zeros(count, dtype=int)
        snapshot = Snapshot(
            time=float(group.attrs["time"]),
            stage=_text(group.attrs.get("stage")),
            position=position,
            mass=volume * density,
            body=body,
            colour=_colour(group) if self._field is None else self._chosen(group, self._field),
            not_finite=int((~finite).sum()),
        )
        return snapshot if finite.all() else snapshot.select(finite)

    def _chosen(self, group: h5py.Group, field: str) -> Field:
        name, _, component = field.partition(".")
        known = sorted(key for key in group if key != "position")
        if name not in known:
            raise ResultError(f"{self.folder / 'results.h5'}: there is no field \"{name}\"; there are {', '.join(known)}")
        values = np.asarray(group[name], dtype=float).reshape(len(group["position"]), -1)
        components = {1: ("",), 3: ("", "x", "y", "z"), 6: ("xx", "yy", "zz", "xy", "yz", "xz")}[values.shape[1]]
        if component not in components:
            raise ResultError(f"field \"{field}\": {name} has the components"
                              f" {', '.join(f'{name}.{one}' for one in components if one)}"
                              if len(components) > 1 else f"field \"{field}\": {name} has no components")
        if not component:
            values = values[:, 0] if values.shape[1] == 1 else np.linalg.norm(values, axis=1)
        else:
            values = values[:, [one for one in components if one].index(component)]
        return Field(" ".join(filter(None, (name.replace("_", " "), component))), _text(group[name].attrs.get("unit")),
                     values)

    def values(self, index: int, name: str) -> np.ndarray:
        """A field of a snapshot, for the points that `snapshot(index)` returns, in its order."""
        group = self._group(self._names[index])
        if name not in group:
            raise ResultError(f"{self.folder / 'results.h5'}: its snapshots hold no field \"{name}\"")
        finite = np.isfinite(np.asarray(group["position"], dtype=float)).all(axis=1)
        return np.asarray(group[name], dtype=float)[finite]

    @property
    def history(self) -> dict[str, np.ndarray]:
        """Columns over time; empty when the run wrote none."""
        group = self._file.get("history")
        return {name: np.asarray(group[name], dtype=float).ravel() for name in group} if group else {}


def _text(value: object) -> str:
    if isinstance(value, bytes):
        return value.decode()
    return "" if value is None else str(value)


def _colour(group: h5py.Group) -> Field | None:
    """Plastic shear strain where the material has it, otherwise how far the points have moved."""
    name = STRAIN.replace(" ", "_")
    if name in group:
        return Field(STRAIN, "-", np.asarray(group[name], dtype=float).ravel())
    if "displacement" in group:
        moved = np.linalg.norm(np.asarray(group["displacement"], dtype=float), axis=1)
        return Field(DISPLACEMENT, "mm", 1e3 * moved)
    return None


def read_summary(folder: Path) -> dict:
    """summary.json of a result folder; empty when there is none."""
    path = folder / "summary.json"
    if not path.is_file():
        return {}
    try:
        summary = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise ResultError(f"{path}: not readable as JSON ({error})") from error
    if not isinstance(summary, dict):
        raise ResultError(f"{path}: expected an object at the top")
    return summary


def write_comparison(folder: Path, comparison: dict) -> None:
    """Puts the key "comparison" into summary.json and leaves all others; the file is complete at every moment."""
    summary = read_summary(folder)
    summary["comparison"] = comparison
    aside = folder / "summary.json.part"
    aside.write_text(json.dumps(summary, indent=2, allow_nan=False) + "\n")
    os.replace(aside, folder / "summary.json")
