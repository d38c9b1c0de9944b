# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Made-up results whose run-out, height, times and energies are known in closed form."""
from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np

GRAVITY = 9.81
DENSITY = 1760.0


def lattice(lower, upper, spacing: float) -> np.ndarray:
    """Centres of whole cells between two corners."""
    axes = [np.arange(low + 0.5 * spacing, high, spacing) for low, high in zip(lower, upper)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def box(half_width: float, height: float, spacing: float, quarter: bool) -> np.ndarray:
    low = 0.0 if quarter else -half_width
    return lattice((low, low, 0.0), (half_width, half_width, height), spacing)


def cone(base_radius: float, height: float, spacing: float, quarter: bool) -> np.ndarray:
    """Lattice points inside a cone that stands on z = 0 with its tip on the axis."""
    points = box(base_radius, height, spacing, quarter)
    inside = np.hypot(points[:, 0], points[:, 1]) <= base_radius * (1.0 - points[:, 2] / height)
    return points[inside]


def write_snapshot(
    snapshots: h5py.Group, name: str, time: float, points: np.ndarray, spacing: float, strain: bool = True
) -> None:
    group = snapshots.create_group(name)
    group.attrs["time"] = time
    group.attrs["step"] = int(name)
    group.attrs["stage"] = "collapse" if time > 0 else "geostatic"
    count = len(points)
    fields = {
        "position": (points, "m"),
        "displacement": (np.full((count, 3), [3e-3, 0.0, 4e-3]), "m"),
        "volume": (np.full(count, spacing**3), "m3"),
        "density": (np.full(count, DENSITY), "kg/m3"),
        "body": (np.zeros(count, dtype=np.int64), "-"),
    }
    if strain:
        values = np.clip(10.0 * np.hypot(points[:, 0], points[:, 1]) - 0.4, 0.0, None) * (time > 0)
        fields["equivalent_plastic_shear_strain"] = (values, "-")
    for field, (values, unit) in fields.items():
        data = group.create_dataset(field, data=values)
        data.attrs["unit"] = unit


def write_history(file: h5py.File, rest_time: float, end: float, mass: float, error: float) -> None:
    """The kinetic energy is a bump that ends at `rest_time`; 10 J of potential energy are released by then."""
    time = np.concatenate([[-0.02, -0.01], np.linspace(0.0, end, 401)])
    part = np.clip(time / rest_time, 0.0, 1.0)
    columns = {
        "time": time,
        "kinetic_energy": 3.0 * np.sin(np.pi * part) ** 2,
        "gravity_energy": 50.0 - 10.0 * part,
        "stress_work": 7.0 * part,
        "friction_work": 3.0 * part,
        "contact_energy": 0.2 * part,
        "other_work": np.zeros_like(time),
        "energy_error": 5.0 + error * part,
        "front": 0.1 + 0.1 * part,
        "height": 0.12 - 0.04 * part,
        "maximum_speed": np.sin(np.pi * part),
    }
    history = file.create_group("history")
    for name, values in columns.items():
        history.create_dataset(name, data=values)


def write_results(
    folder: Path,
    *,
    spacing: float = 0.01,
    quarter: bool = True,
    base_radius: float = 0.2,
    height: float = 0.08,
    half_width: float = 0.1,
    initial_height: float = 0.12,
    extra: np.ndarray | None = None,
    rest_time: float = 0.3,
    end: float = 0.5,
    error: float = 0.05,
    strain: bool = True,
    history: bool = True,
    case: dict | None = None,
) -> Path:
    """A square column that turns into a cone. `extra` points are added to the last snapshot."""
    folder.mkdir(parents=True, exist_ok=True)
    column = box(half_width, initial_height, spacing, quarter)
    with h5py.File(folder / "results.h5", "w") as file:
        file.attrs["title"] = "A made-up heap"
        file.attrs["complete"] = 1
        snapshots = file.create_group("snapshots")
        write_snapshot(snapshots, "000000", -0.02, column, spacing, strain)
        write_snapshot(snapshots, "000001", 0.0, column, spacing, strain)
        steps = 10
        for step in range(1, steps + 1):
            part = min(1.0, step / steps * end / rest_time)
            heap = cone(
                half_width + (base_radius - half_width) * part,
                initial_height + (height - initial_height) * part,
                spacing,
                quarter,
            )
            if step == steps and extra is not None:
                heap = np.concatenate([heap, extra])
            write_snapshot(snapshots, f"{step + 1:06d}", end * step / steps, heap, spacing, strain)
        if history:
            write_history(file, rest_time, end, len(column) * spacing**3 * DENSITY, error)
    if case is None:
        case = {
            "title": "A made-up heap",
            "spacing": spacing,
            "symmetry": ["x", "y"] if quarter else [],
            "comparison": {"law": "axisymmetric_column", "radius": half_width, "height": initial_height},
        }
    (folder / "summary.json").write_text(json.dumps({"exit": "complete", "case": case}))
    return folder
