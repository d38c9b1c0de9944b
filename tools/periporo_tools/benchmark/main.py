# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The command line of tools/bench."""
from __future__ import annotations

import argparse
import datetime
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from periporo_tools.benchmark import loads, machine, peer, table
from periporo_tools.benchmark.loads import Load

_ROOT = Path(__file__).resolve().parents[3]
_CASES = _ROOT / "tests/performance"
_STORED = _CASES / "measured.json"
_EXAMPLES = """examples:
  tools/bench                       all loads: about a quarter of an hour on two cores
  tools/bench --quick               one size, a minute or two
  tools/bench --json bench.json     the table for machines too
"""
_ELASTIC, _SOIL = loads.MATERIALS
_FORCE_STATES = ("energy_conjugate", "volume_weighted", "bond_projection", "unstabilized")


def _arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/bench",
        description="Measures point-steps a second of the operator with an elastic material and with soil in flow, by"
        " force state, threads and size, beside the ceilings of the machine and, where Debian's lammps is installed,"
        " LAMMPS on the same lattice. Let nothing else run meanwhile.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--quick", action="store_true", help="one size, soil in flow, without peers")
    parser.add_argument("--edge", type=int, default=30, metavar="N", help="points along an edge of the block (30)")
    parser.add_argument("--steps", type=int, default=101, metavar="N", help="steps of a run (101)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the table for machines")
    parser.add_argument("--against", type=Path, default=_STORED, metavar="FILE",
                        help="a table to compare with (tests/performance/measured.json)")
    parser.add_argument("--build", type=Path, default=_ROOT / "build/release", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def _loads(options: argparse.Namespace) -> list[Load]:
    threads = [1, 2] if (os.cpu_count() or 1) > 1 else [1]
    most = threads[-1]
    if options.quick:
        return [Load(state, _SOIL, t, options.edge, options.steps)
                for state in ("energy_conjugate", "bond_projection") for t in threads]
    chosen = [Load(state, material, t, options.edge, options.steps)
              for state in _FORCE_STATES for material in (_SOIL, _ELASTIC) for t in threads]
    # a million points: as many steps as show one refresh
    for edge, steps in ((22, options.steps), (46, options.steps), (100, 30)):
        chosen += [Load(state, _SOIL, most, edge, steps) for state in ("energy_conjugate", "bond_projection")]
    return chosen


def _measure(options: argparse.Namespace, folder: Path) -> table.Report:
    report = table.Report(machine.name(), datetime.date.today().isoformat())
    chosen = _loads(options)
    for threads in sorted({load.threads for load in chosen}):
        report.ceilings[threads] = machine.ceilings(options.build / "bin/ceilings", threads)
    for count, load in enumerate(chosen, 1):
        found = loads.run(load, options.build / "bin/periporo", _CASES, folder / "run")
        report.rows.append((load, found))
        print(f"[{count}/{len(chosen)}] {load.force_state}, {load.material}, {found.points:,} points, {load.threads}"
              f" threads: {1e-6 * found.point_steps_per_second:.3f} million point-steps/s", file=sys.stderr)
        # the peer takes turns with the loads of its size, so that both see the same moods of the machine
        if (not options.quick and load.edge == options.edge and load.material == _ELASTIC
                and load.force_state in ("energy_conjugate", "bond_projection") and peer.available()):
            style = dict(zip(("energy_conjugate", "bond_projection"), peer.STYLES))[load.force_state]
            report.peers.append(peer.run(style, load.threads, load.edge, 60, folder))
    return report


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status: 0 measured, 1 a run failed, 2 the arguments are wrong."""
    options = _arguments(arguments)
    try:
        with tempfile.TemporaryDirectory() as folder:
            report = _measure(options, Path(folder))
    except (subprocess.CalledProcessError, ValueError) as failure:
        print(f"bench: a run failed: {failure}", file=sys.stderr)
        return 1
    print(f"{report.machine}, {report.date}")
    for ceilings in report.ceilings.values():
        print(f"{ceilings.threads} threads: {1e-9 * ceilings.flops_per_second:.0f} Gflop/s,"
              f" {1e-9 * ceilings.bytes_per_second:.0f} GB/s")
    print(f"\n{table.rates(report)}\n\nmicroseconds of a thread for a point and step:\n\n{table.phases(report)}")
    if not peer.available() and not options.quick:
        print("\nLAMMPS is not installed (Debian's package lammps): no peer was measured")
    if options.against.exists():
        print(f"\n{table.against(report, json.loads(options.against.read_text()))}")
    if options.json:
        options.json.write_text(json.dumps(report.as_json(), indent=1) + "\n")
    return 0
