#!/usr/bin/python3
# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Gives the program thousands of broken inputs. None may crash it, hang it, pass silently or leave files behind.

    tests/hostile/run.py --program build/release/bin/periporo               every input, some 25,000
    tests/hostile/run.py --program build/release/bin/periporo --count 500   a spread of all kinds
    tests/hostile/run.py --program build/release/bin/periporo --only 4711   one input again, with its message
"""
from __future__ import annotations

import argparse
import concurrent.futures
import json
import os
import random
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

import jsonschema

from broken_cases import Broken, broken_includes, broken_keys, broken_texts, broken_values, fixed
from broken_files import broken_checkpoints, broken_files, broken_plugins, sound_files
from judge import Verdict, judge
from toml_text import load_case, to_text

_ROOT = Path(__file__).resolve().parents[2]
# Cases with many points are checked on a coarser lattice: a check builds the model.
_COARSER = {"column_collapse": "10 mm", "wet_quickstart": "10 mm", "whole_column": "10 mm", "terrain_slope": "20 mm",
            "tube_lift": "10 mm"}


# Their keys are those of column_a0.6, and a check of them takes ten seconds.
_TALLER = ("column_a1.2.toml", "column_a2.0.toml")


def shipped_cases() -> Iterator[Path]:
    """Yields every case of the tree; included files, paths of one point and lists of runs are none."""
    for file in sorted((_ROOT / "cases").rglob("*.toml")):
        if file.stem.endswith("_base") or file.parent.name == "material" or file.name in ("sweeps.toml", *_TALLER):
            continue
        yield file


def coarse(file: Path) -> dict:
    """Returns a case that is checked in a second."""
    case = load_case(file)
    for name, spacing in _COARSER.items():
        if name in (file.stem, file.parent.name) and "spacing" in case["discretization"]:
            case["discretization"]["spacing"] = spacing
    return case


def inputs(program: str, seed: int) -> list[Broken]:
    """Returns all broken inputs, always the same for one seed."""
    dice = random.Random(seed)
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, check=True).stdout)
    is_valid = jsonschema.Draft4Validator(schema).is_valid
    everything: list[Broken] = []
    for file in shipped_cases():
        case = coarse(file)
        found = [*broken_keys(case, is_valid), *broken_values(case, is_valid)]
        for broken in found:
            broken.what = f"{file.relative_to(_ROOT / 'cases')}: {broken.what}"
        everything += found
    small = coarse(_ROOT / "cases" / "verification" / "self_weight_column.toml")
    everything += [*broken_texts(small, dice), *broken_includes(small), *broken_files(dice),
                   *broken_checkpoints(dice, _stopped_run(program)),
                   *broken_plugins(dice, _a_plugin(program))]
    return everything


def _stopped_run(program: str) -> dict[str, bytes]:
    with tempfile.TemporaryDirectory() as folder:
        case = next(case for name, (case, _) in sound_files().items() if name == "points.csv")
        case = case.replace(b'generator = "points", file = "points.csv"',
                            b'generator = "box", size = ["40 mm", "40 mm", "40 mm"]')
        (Path(folder) / "case.toml").write_bytes(case)
        subprocess.run([program, "run", "case.toml", "--out", "out", "--stop-after", "5", "--quiet"], cwd=folder,
                       check=False, capture_output=True)
        out = Path(folder) / "out"
        return {str(file.relative_to(out)): file.read_bytes() for file in out.rglob("*") if file.is_file()}


def _a_plugin(program: str) -> Path:
    listed = json.loads(subprocess.run([program, "inspect", "--json"], capture_output=True, check=True).stdout)
    return next(Path(plugin["file"]) for plugin in listed if plugin["name"] == "linear_elastic")


def spread(everything: list[Broken], count: int, seed: int) -> list[int]:
    """Returns the numbers of `count` inputs in which every kind has a part, rare kinds a larger one."""
    dice = random.Random(seed)
    by_kind: dict[str, list[int]] = defaultdict(list)
    for number, broken in enumerate(everything):
        by_kind[broken.kind].append(number)
    for numbers in by_kind.values():
        dice.shuffle(numbers)
    chosen: list[int] = []
    while len(chosen) < min(count, len(everything)):
        for numbers in by_kind.values():
            if numbers and len(chosen) < count:
                chosen.append(numbers.pop())
    return sorted(chosen)


def try_one(program: str, broken: Broken) -> Verdict:
    """Judges one input in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="hostile-") as folder:
        if broken.files:
            broken.files(Path(folder))
        case, must_refuse = broken.content()
        (Path(folder) / "case.toml").write_bytes(case)
        return judge(program, broken, must_refuse, Path(folder))


def check_sound_inputs(program: str) -> list[str]:
    """Returns what the program says against inputs without a mistake: the generator itself must be right."""
    sound = [Broken("sound", str(file.relative_to(_ROOT)), fixed(to_text(coarse(file)).encode(), False), exits=(0,))
             for file in shipped_cases()]
    for name, (case, data) in sound_files().items():
        def make(folder: Path, name: str = name, data: bytes = data) -> None:
            (folder / name).write_bytes(data)
            if name == "field.csv":
                (folder / "field_curve.csv").write_bytes(sound_files()["curve.csv"][1])
        sound.append(Broken("sound", name, fixed(case, False), make, exits=(0,)))
    verdicts = [(broken.what, try_one(program, broken)) for broken in sound]
    return [f"{what}: {verdict.fault}\n{verdict.message}" for what, verdict in verdicts if verdict.fault]


def report(tried: list[Broken], verdicts: list[Verdict]) -> str:
    """Returns a table of kinds."""
    counts: dict[str, Counter] = defaultdict(Counter)
    for broken, verdict in zip(tried, verdicts):
        counts[broken.kind].update(tried=1, refused=verdict.refused, faults=bool(verdict.fault))
    lines = [f"{'kind':26} {'tried':>6} {'refused':>8} {'faults':>7}"]
    total: Counter = Counter()
    for kind, count in counts.items():
        lines.append(f"{kind:26} {count['tried']:6} {count['refused']:8} {count['faults']:7}")
        total += count
    lines.append(f"{'all':26} {total['tried']:6} {total['refused']:8} {total['faults']:7}")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.environ.get("PERIPORO_PROGRAM", "periporo"))
    parser.add_argument("--count", type=int, help="so many inputs, spread over all kinds; all of them when left out")
    parser.add_argument("--only", type=int, help="the input of this number alone, with its message")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    everything = inputs(program, options.seed)
    if options.only is not None:
        broken = everything[options.only]
        verdict = try_one(program, broken)
        print(f"{broken.kind}: {broken.what}\n{verdict.fault or 'no fault'}\n{verdict.message}")
        return 1 if verdict.fault else 0
    failures = check_sound_inputs(program)
    chosen = range(len(everything)) if options.count is None else spread(everything, options.count, options.seed)
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        verdicts = list(pool.map(lambda number: try_one(program, everything[number]), chosen))
    for number, verdict in zip(chosen, verdicts):
        if verdict.fault:
            failures.append(f"{number}: {everything[number].kind}: {everything[number].what}: {verdict.fault}\n"
                            f"    {verdict.message.strip()[:300]}")
    for failure in failures:
        print(failure, file=sys.stderr)
    print(report([everything[number] for number in chosen], verdicts))
    if failures:
        print(f"{len(failures)} faults; --only NUMBER tries one again", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
