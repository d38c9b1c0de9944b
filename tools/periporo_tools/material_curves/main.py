# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The command line of tools/material_curves."""
from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from periporo_tools.material_curves import (
    drucker_prager, j2_plasticity, linear_elastic, mohr_coulomb, mu_i_rheology, viscoplastic_critical_state,
)
from periporo_tools.material_curves.comparison import Panel, table
from periporo_tools.material_curves.driver import Driver
from periporo_tools.material_curves.picture import draw
from periporo_tools.verification.runner import RunFailure

_ROOT = Path(__file__).resolve().parents[3]
_EXAMPLES = """examples:
  tools/material_curves                     all laws; pictures in results/material_curves
  tools/material_curves mohr_coulomb        one law
  tools/material_curves --pages             draws the pictures of the laws' pages anew

exit status: 0 all curves within their tolerance, 1 not, or a path failed, 2 the arguments are wrong
"""
LAWS: dict[str, Callable[[Driver], list[Panel]]] = {
    module.__name__.rpartition(".")[2]: module.panels
    for module in (
        linear_elastic, drucker_prager, mohr_coulomb, j2_plasticity, mu_i_rheology, viscoplastic_critical_state,
    )
}


def _arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/material_curves",
        description="Leads every material law along paths whose course is known in closed form, prints how far apart"
        " program and formula are, and draws both.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("laws", metavar="LAW", nargs="*", help=f"all without a name: {', '.join(LAWS)}")
    places = parser.add_mutually_exclusive_group()
    places.add_argument("--out", type=Path, metavar="DIR", default=Path("results/material_curves"),
                        help="where LAW.png is drawn (%(default)s)")
    places.add_argument("--pages", action="store_true", help="draw plugins/material/LAW/curves.png instead")
    parser.add_argument("--program", type=Path, default=_ROOT / "build/release/bin/periporo", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if unknown := [name for name in options.laws if name not in LAWS]:
        parser.error(f"no law is called {', '.join(unknown)}; there are {', '.join(LAWS)}")
    return options


def _place(options: argparse.Namespace, law: str) -> Path:
    if options.pages:
        return _ROOT / "plugins/material" / law / "curves.png"
    options.out.mkdir(parents=True, exist_ok=True)
    return options.out / f"{law}.png"


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status: 0 all curves within their tolerance, 1 not, 2 the arguments are wrong."""
    options = _arguments(arguments)
    panels, pictures = {}, []
    try:
        with tempfile.TemporaryDirectory() as folder:
            drive = Driver(options.program, Path(folder))
            for law in options.laws or LAWS:
                panels[law] = LAWS[law](drive)
                pictures.append(draw(panels[law], _place(options, law)))
    except RunFailure as failure:
        print(f"material_curves: a path did not run to its end:\n{failure}", file=sys.stderr)
        return 1
    print(table(panels), "", *pictures, sep="\n")
    curves = [curve for tests in panels.values() for panel in tests for curve in panel.curves]
    apart = sum(not curve.holds for curve in curves)
    print(f"\n{len(curves) - apart} of {len(curves)} curves within their tolerance")
    return 1 if apart else 0
