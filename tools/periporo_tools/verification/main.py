# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The command line of tools/verify."""
from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from periporo_tools.verification import report
from periporo_tools.verification.checks import CHECKS
from periporo_tools.verification.runner import RunFailure, Runner

_ROOT = Path(__file__).resolve().parents[3]
_EXAMPLES = """examples:
  tools/verify                              all cases in full: about twenty minutes on two cores
  tools/verify --small p_wave incline       two cases as the test suite runs them
  tools/verify --json verification.json     the table for machines too
"""


def _arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/verify",
        description="Holds the program against closed forms: runs cases/verification, prints one table and draws one"
        " page of curves.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", metavar="CASE", nargs="*", help=f"cases, all without a name: {', '.join(CHECKS)}")
    parser.add_argument("--small", action="store_true", help="the cheap variants that the test suite runs")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the table for machines")
    parser.add_argument("--out", type=Path, metavar="DIR", help="keep runs and picture (results/verification)")
    parser.add_argument("--program", type=Path, default=_ROOT / "build/release/bin/periporo", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if unknown := [name for name in options.names if name not in CHECKS]:
        parser.error(f"no case is called {', '.join(unknown)}; there are {', '.join(CHECKS)}")
    return options


def _verify(options: argparse.Namespace, out: Path) -> int:
    rows, curves, refinements, unfinished = [], [], [], []
    runner = Runner(options.program, _ROOT / "cases/verification", out, options.small)
    names = options.names or list(CHECKS)
    for count, name in enumerate(names, 1):
        before = runner.seconds
        try:
            outcome = CHECKS[name](runner)
        except RunFailure as failure:  # the others are worth their while
            unfinished.append(name)
            print(f"[{count}/{len(names)}] {name}: did not run to its end:\n{failure}", file=sys.stderr)
            continue
        rows += outcome.rows
        curves += outcome.curves
        refinements += outcome.refinements
        failed = sum(not row.holds for row in outcome.rows)
        print(
            f"[{count}/{len(names)}] {name}: {len(outcome.rows)} quantities, {failed or 'none'} outside,"
            f" {runner.seconds - before:.0f} s",
            file=sys.stderr,
        )
    if not rows:
        return 1
    print(report.table(rows))
    if options.json:
        report.write_json(rows, options.json)
    if not options.small:
        print(f"\n{report.draw(curves, refinements, out / 'verification.png')}")
    failed = sum(not row.holds for row in rows)
    print(f"\n{len(rows) - failed} of {len(rows)} quantities within their tolerance")
    if unfinished:
        print(f"not to their end: {', '.join(unfinished)}")
    return 1 if failed or unfinished else 0


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status: 0 every quantity within its tolerance, 1 not or not run to the end, 2 the arguments are
    wrong."""
    options = _arguments(arguments)
    if options.out or not options.small:
        out = options.out or Path("results/verification")
        out.mkdir(parents=True, exist_ok=True)
        return _verify(options, out)
    with tempfile.TemporaryDirectory() as folder:
        return _verify(options, Path(folder))
