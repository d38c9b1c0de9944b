# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Runs the program on a broken input and judges what it does."""
from __future__ import annotations

import os
import re
import resource
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

from broken_cases import Broken

_MEMORY = 6 << 30  # bytes of address space
_LONGEST = 60  # seconds, on a busy machine; the slowest sound case takes one
_LONGEST_MESSAGE = 20_000  # characters
# Words of libraries and of the language, which tell a user nothing.
_RAW = re.compile(r"std::|basic_string|vector::|_M_|H5[A-Z][a-z]|boost::|toml::|CGAL ERROR|terminate called|what\(\)")
# A remedy names what is right, or what to do.
_REMEDY = re.compile(
    r"hint:|must |give |use |expected|allowed|needs? |choose|did you mean|one of|at most|at least|above|below|raise|"
    r"move |remove|delete|leave|put |only |write |instead|between|start anew|known|missing|not in|is no|"
    r"cannot|already|twice|no such|larger|smaller|wants|lies|unknown|not |without|or ", re.IGNORECASE)


@dataclass(frozen=True)
class Verdict:
    """The outcome for one input; no fault means that all is well."""

    refused: bool
    fault: str
    message: str


def _limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _content(folder: Path) -> dict[str, tuple[int, int]]:
    return {str(path.relative_to(folder)): (path.lstat().st_size, path.lstat().st_mtime_ns)
            for path in folder.rglob("*")}


def judge(program: str, broken: Broken, must_refuse: bool, folder: Path) -> Verdict:
    """Runs the program in the folder, in which the input lies already."""
    before = _content(folder)
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    try:
        done = subprocess.run([program, *broken.arguments], cwd=folder, env=environment, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=_LONGEST, preexec_fn=_limit)
    except subprocess.TimeoutExpired:
        return Verdict(False, f"does not end within {_LONGEST} s", "")
    message = done.stderr.decode(errors="replace")
    fault = _fault(broken, must_refuse, done.returncode, message)
    if not fault and "run" not in broken.arguments and _content(folder) != before:
        fault = "writes into the folder"
    return Verdict(done.returncode != 0, fault, message)


def _fault(broken: Broken, must_refuse: bool, status: int, message: str) -> str:
    if status < 0:
        return f"ends by {signal.Signals(-status).name}"
    if status not in broken.exits:
        return f"exit status {status}"
    if status == 0:
        return "passes silently" if must_refuse else ""
    if not message.strip():
        return "says nothing"
    if len(message) > _LONGEST_MESSAGE:
        return f"a message of {len(message)} characters"
    if _RAW.search(message):
        return f"words of a library: {_RAW.search(message)[0]!r}"
    if not re.search(broken.named, message):
        return f"does not name {broken.named}"
    if not _REMEDY.search(message):
        return "says no remedy"
    return ""
