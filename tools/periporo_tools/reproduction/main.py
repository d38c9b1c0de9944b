# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The command line of tools/reproduce."""
from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from periporo_tools.reproduction import listing
from periporo_tools.reproduction.cost import Pace, duration_text
from periporo_tools.reproduction.plan import Run, State, distinct, plan, write_whole
from periporo_tools.reproduction.runner import Interrupted, Runner, locked
from periporo_tools.reproduction.sweeps import STATEMENTS, Book, Sweep, SweepError, read_sweeps
from periporo_tools.results import ResultError, read_summary

_ROOT = Path(__file__).resolve().parents[3]
_EXAMPLES = """examples:
  tools/reproduce                           what there is, what it costs, what is done
  tools/reproduce --small columns           one sweep, coarse: minutes
  tools/reproduce columns friction          runs what is missing of two, draws both
  tools/reproduce --all --page              everything, and into cases/paper/README.md
  tools/reproduce --draw --json FILE        no runs: what is there, for machines too
Ctrl-C stops with a checkpoint, from which the same command goes on.

exit status: 0 done, 1 a run failed, 2 the input is wrong, 130 interrupted
"""


class BuildFailure(Exception):
    """The program could not be built; tools/build has said why."""


def _arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/reproduce",
        description="Runs the sweeps of cases that stand beside the paper, as far as they are missing, and draws their"
        " figures and tables. Without arguments it lists them. Each run has its folder DIR/SWEEP/RUN; pictures go to"
        " DIR/pictures, tables to DIR/tables.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", metavar="SWEEP", nargs="*", help="sweeps to run and draw")
    parser.add_argument("--all", action="store_true", help="all sweeps")
    parser.add_argument("--small", action="store_true", help="the small variant, with results of its own")
    parser.add_argument("--draw", action="store_true", help="run nothing; draw what is there (all sweeps unless named)")
    parser.add_argument("--page", action="store_true",
                        help="write tables and pictures into README.md beside the file of sweeps; those of the small"
                        " variant have names with small_ before them")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all numbers for machines")
    parser.add_argument("--out", type=Path, metavar="DIR",
                        help="where results go (results/reproduce, small: results/reproduce_small)")
    parser.add_argument("--threads", type=int, metavar="N", help="threads of a run (all processors)")
    parser.add_argument("--sweeps", type=Path, metavar="FILE", default=_ROOT / "cases/paper/sweeps.toml",
                        help="the file of sweeps (cases/paper/sweeps.toml)")
    parser.add_argument("--program", type=Path, metavar="FILE",
                        help="the program (build/release/bin/periporo, built first)")
    options = parser.parse_args(arguments)
    if options.names and options.all:
        parser.error("--all means all sweeps; leave it out or name none")
    if options.threads is not None and options.threads < 1:
        parser.error("--threads needs a number from 1 on")
    return options


def _say(text: str) -> None:
    print(f"reproduce: {text}", file=sys.stderr)


def _seen_pace(runs: list[Run], threads: int | None) -> Pace:
    """The speed of the runs that are done."""
    pace = Pace(threads)
    for run in distinct(runs):
        if run.state() is State.COMPLETE and (seconds := read_summary(run.folder).get("wall_seconds")):
            pace.add(run.cost, seconds)
    return pace


def _built() -> Path:
    if subprocess.run([_ROOT / "tools/build", "release", "program"], check=False).returncode != 0:
        raise BuildFailure
    return _ROOT / "build/release/bin/periporo"


def _run(runs: list[Run], pace: Pace, options: argparse.Namespace, out: Path) -> list[Run]:
    """Runs what is missing and returns what failed."""
    with locked(out):
        wanted = distinct(runs)
        waiting = [run for run in wanted if run.state() is not State.COMPLETE]
        if not waiting:
            _say(f"all {len(wanted)} runs are done")
            return []
        seconds = pace.seconds([run.cost for run in waiting])
        about = "" if seconds is None else f", about {duration_text(seconds)}"
        _say(f"{len(wanted) - len(waiting)} of {len(wanted)} runs are done, {len(waiting)} to do{about}")
        program = options.program or _built()
        return Runner(program, options.threads, sys.stderr, pace)(waiting)


def _show(book: Book, sweeps: list[Sweep], runs: dict[str, list[Run]], options: argparse.Namespace, out: Path) -> None:
    """Measures, prints, draws and writes."""
    # matplotlib and h5py take a second to load; the list and its errors do without.
    from periporo_tools.reproduction import figures, page, statements, tables
    from periporo_tools.reproduction.outcomes import Measurer

    measurer = Measurer(_say)
    written: dict[str, str] = {}
    pictures: list[Path] = []
    results = []
    for sweep in sweeps:
        result = measurer(sweep, runs[sweep.name])
        print(f"\n{sweep.title} ({sweep.name})")
        print(tables.terminal(result))
        findings: list[statements.Finding] = []
        remark = f"Small variant: {', '.join(f'`{entry}`' for entry in sweep.small_set)}.\n\n" if book.small else ""
        written[sweep.name] = remark + tables.markdown(result)
        drawn: list[Path] = []
        try:
            if sweep.statements:
                findings = statements.findings(result)
                print("\nThe paper's statements:")
                print(tables.statements_terminal(findings))
                written[STATEMENTS] = remark + tables.statements_markdown(findings)
            drawn = figures.draw(result, out / "pictures")
        except ResultError as error:
            _say(f"{sweep.name}: {error}")
        for picture in drawn:
            print(f"  {picture}")
        pictures += drawn
        results.append((result, findings))
    for name, text in written.items():
        write_whole(out / "tables" / f"{name}.md", text + "\n")
    print(f"\nPictures in {out / 'pictures'}, tables in {out / 'tables'}")
    if options.json:
        tables.write_json(options.json, tables.records(book, results))
        print(f"All numbers in {options.json}")
    if options.page:
        known = [sweep.name for sweep in book.sweeps] + [STATEMENTS] * any(sweep.statements for sweep in book.sweeps)
        target = book.path.parent / "README.md"
        changes = page.update(target, written, known, pictures, book.small)
        print(f"{target}: {len(changes.tables)} tables and {len(changes.pictures)} pictures")
        for name in changes.missing:
            _say(f"{target} shows pictures/{name}, which is not there and no run has drawn")


def _reproduce(options: argparse.Namespace) -> int:
    book = read_sweeps(options.sweeps, options.small)
    out = options.out or Path("results/reproduce_small" if options.small else "results/reproduce")
    runs = plan(book, out)
    drawing = options.draw or options.page or options.json
    sweeps = list({name: book.sweep(name) for name in options.names}.values())
    pace = _seen_pace([run for sweep_runs in runs.values() for run in sweep_runs], options.threads)
    if not (sweeps or options.all or drawing):
        print(listing.text(book, runs, pace, out))
        return 0
    failed: list[Run] = []
    if (sweeps or options.all) and not options.draw:
        chosen = [run for sweep in sweeps or book.sweeps for run in runs[sweep.name]]
        failed = _run(chosen, pace, options, out)
    _show(book, sweeps or list(book.sweeps), runs, options, out)
    if failed:
        _say(f"{len(failed)} of the runs failed:")
        for run in failed:
            _say(f"  {run.label}")
    return 1 if failed else 0


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status: 0 done, 1 a run failed, 2 the input is wrong, 130 interrupted."""
    options = _arguments(arguments)
    try:
        return _reproduce(options)
    except (SweepError, ResultError) as error:
        _say(str(error))
        return 2
    except BuildFailure:
        return 1
    except (Interrupted, KeyboardInterrupt):
        return 130
