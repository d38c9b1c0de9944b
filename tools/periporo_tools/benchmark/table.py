# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The table of a benchmark, for people and for machines."""
from __future__ import annotations

from dataclasses import dataclass, field

from periporo_tools.benchmark.loads import Load, Measurement
from periporo_tools.benchmark.machine import Ceilings
from periporo_tools.benchmark.peer import PeerMeasurement

_PHASES = ("kinematics", "material", "force", "contact", "integration", "refresh", "step_estimate", "output")


@dataclass
class Report:
    """Everything that was measured in one sitting."""

    machine: str
    date: str
    ceilings: dict[int, Ceilings] = field(default_factory=dict)  # by threads
    rows: list[tuple[Load, Measurement]] = field(default_factory=list)
    peers: list[PeerMeasurement] = field(default_factory=list)

    def fractions(self, load: Load, found: Measurement) -> tuple[float, float]:
        """Reached of the ceilings of arithmetic and of bandwidth."""
        ceilings = self.ceilings[load.threads]
        flops = found.bond_steps_per_second * load.flops_per_bond
        # all that a point keeps is read in a step, and the state of its bonds, some two thirds of it, is written
        traffic = found.point_steps_per_second * found.bytes_per_point * 5 / 3
        return flops / ceilings.flops_per_second, traffic / ceilings.bytes_per_second

    def as_json(self) -> dict:
        rows = []
        for load, found in self.rows:
            arithmetic, bandwidth = self.fractions(load, found)
            rows.append({
                **found.as_record(), "arithmetic_fraction": arithmetic, "bandwidth_fraction": bandwidth,
                "ceiling_fraction": max(arithmetic, bandwidth),
            })
        return {
            "format": "periporo benchmark", "machine": self.machine, "date": self.date,
            "ceilings": [vars(c) for c in self.ceilings.values()],
            "rows": rows, "peers": [peer.as_record() for peer in self.peers],
        }


def _million(rate: float) -> str:
    return f"{1e-6 * rate:.3f}"


def _formatted(header: list[str], lines: list[list[str]]) -> str:
    widths = [max(len(line[c]) for line in [header, *lines]) for c in range(len(header))]
    return "\n".join(
        "| " + " | ".join(text.ljust(width) for text, width in zip(line, widths)) + " |"
        for line in [header, ["-" * width for width in widths], *lines]
    )


def rates(report: Report) -> str:
    """Rates in millions of point-steps and bond-steps a second, memory, and what is reached of the ceilings."""
    header = ["force state", "material", "threads", "points", "M point-steps/s", "a thread", "M bond-steps/s",
              "bonds", "kB a point", "at most", "flowing", "of arithmetic", "of bandwidth"]
    lines = []
    for load, found in report.rows:
        arithmetic, bandwidth = report.fractions(load, found)
        rate = found.point_steps_per_second
        lines.append([
            load.force_state, load.material, str(load.threads), f"{found.points:,}", _million(rate),
            _million(rate / load.threads), f"{1e-6 * found.bond_steps_per_second:.1f}", f"{found.bonds_per_point:.0f}",
            f"{1e-3 * found.bytes_per_point:.1f}", f"{1e-3 * found.peak_bytes_per_point:.1f}",
            f"{100 * found.flowing:.0f} %" if found.flowing else "-",
            f"{100 * arithmetic:.0f} %", f"{100 * bandwidth:.0f} %",
        ])
    for peer in report.peers:
        rate = peer.point_steps_per_second
        lines.append([f"LAMMPS {peer.style}", "linear elastic", str(peer.threads), f"{peer.points:,}", _million(rate),
                      _million(rate / peer.threads), *["-"] * 7])
    return _formatted(header, lines)


def phases(report: Report) -> str:
    """Microseconds of one thread for a point and step, by phase."""
    lines = []
    for load, found in report.rows:
        per_refresh = (
            f"{found.microseconds('refresh') * found.steps / found.refreshes:.1f}" if found.refreshes else "-"
        )
        lines.append([
            load.force_state, load.material, str(load.threads), f"{found.points:,}",
            *(f"{found.microseconds(phase):.2f}" for phase in _PHASES),
            f"{sum(found.microseconds(phase) for phase in _PHASES):.2f}", per_refresh,
        ])
    header = ["force state", "material", "threads", "points", *(p.replace("_", " ") for p in _PHASES), "sum",
              "one refresh"]
    return _formatted(header, lines)


def against(report: Report, stored: dict) -> str:
    """Rates over those of a stored report, each relative to the arithmetic of its machine: 1 is unchanged."""
    peak = {c["threads"]: c["flops_per_second"] for c in stored["ceilings"]}
    before = {(r["force_state"], r["material"], r["threads"], r["points"]): r for r in stored["rows"]}
    lines = []
    for load, found in report.rows:
        key = (load.force_state, load.material, load.threads, found.points)
        if key not in before or load.threads not in peak:
            continue
        rate = found.point_steps_per_second / before[key]["point_steps_per_second"]
        machine = report.ceilings[load.threads].flops_per_second / peak[load.threads]
        lines.append([*map(str, key[:3]), f"{key[3]:,}", f"{rate:.2f}", f"{rate / machine:.2f}"])
    title = f"against {stored['date']}, {stored['machine']}:"
    header = ["force state", "material", "threads", "points", "rate", "rate over arithmetic"]
    return f"{title}\n\n{_formatted(header, lines)}" if lines else f"{title} no row in common"
