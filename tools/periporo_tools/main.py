# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The command line of tools/pictures."""
from __future__ import annotations

import argparse
import sys
from contextlib import ExitStack
from pathlib import Path

from periporo_tools import figures, verdict
from periporo_tools.results import Results, ResultError, write_comparison

_EXAMPLES = """examples:
  tools/pictures results/quickstart
  tools/pictures results/paper_a1.2 --times 0.09 0.18 0.29
  tools/pictures results/rain_slope --field saturation
  tools/pictures --table results/paper_a0.6 results/paper_a1.2 results/paper_a2.0
  tools/pictures --series results/paper_a0.6 results/paper_a1.2 results/paper_a2.0 --out series.png
  tools/pictures --side-by-side results/mine results/yours --out side_by_side.png
"""


def _arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/pictures",
        description="Draws the outcome of a run (deposit.png, profile.png, history.png, sequence.png in its folder),"
        " holds it against the published law and writes the numbers into its summary.json.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folders", metavar="RESULT_DIR", nargs="+", type=Path, help="folder that a run wrote")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--table", action="store_true", help="print a Markdown table of the runs, draw nothing")
    what.add_argument("--series", action="store_true", help="draw the final sections of the runs at one scale")
    what.add_argument("--side-by-side", action="store_true",
                      help="draw the final sections of the runs beside each other, with their energies below")
    parser.add_argument("--out", type=Path, metavar="FILE",
                        help="picture of --series (series.png) or --side-by-side (side_by_side.png)")
    parser.add_argument("--field", metavar="NAME",
                        help="field of the results to colour by: saturation, suction, pore_pressure, porosity, density,"
                        " velocity, effective_stress.zz ... (plastic shear strain)")
    parser.add_argument("--colour-max", type=float, metavar="VALUE", help="upper end of the colours (2 for strain)")
    parser.add_argument("--extent", type=float, metavar="MM", help="half-width of the views, for one scale in a series")
    parser.add_argument("--times", type=float, nargs="+", metavar="S", help="times of sequence.png [s]")
    return parser.parse_args(arguments)


def _draw(folder: Path, options: argparse.Namespace) -> None:
    with Results(folder, options.field) as results:
        for lost in results.missing:
            print(f"pictures: the results in {folder} lack {lost}", file=sys.stderr)
        comparison = verdict.compare(results)
        write_comparison(folder, comparison)
        extent = options.extent and options.extent * 1e-3
        drawn = [
            figures.deposit(results, folder / "deposit.png", options.colour_max, extent),
            figures.profile(results, comparison, folder / "profile.png"),
            figures.history(results, comparison, folder / "history.png"),
            figures.sequence(
                results, comparison, folder / "sequence.png", options.colour_max, extent, options.times
            ),
        ]
    if "law_error" in comparison:
        print(f"pictures: [comparison] {comparison['law_error']}", file=sys.stderr)
    print(f"\n{comparison['title']}")
    print(verdict.table(comparison))
    print("\nPictures and numbers:")
    for path in [*filter(None, drawn), folder / "summary.json"]:
        print(f"  {path}")
    print(f"\nVerdict: {comparison['verdict']}")


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status: 0 done, 2 when a folder holds no usable results."""
    options = _arguments(arguments)
    try:
        if options.table:
            records = []
            for folder in options.folders:
                with Results(folder) as results:
                    records.append(verdict.compare(results))
            print(verdict.markdown(records))
        elif options.series or options.side_by_side:
            with ExitStack() as stack:
                runs = [stack.enter_context(Results(folder, options.field)) for folder in options.folders]
                if options.series:
                    print(figures.series(runs, options.out or Path("series.png"), options.colour_max))
                else:
                    names = [folder.absolute().name for folder in options.folders]
                    out = options.out or Path("side_by_side.png")
                    print(figures.side_by_side(runs, names, out, options.colour_max))
        else:
            for folder in options.folders:
                _draw(folder, options)
    except ResultError as error:
        print(f"pictures: {error}", file=sys.stderr)
        return 2
    return 0
