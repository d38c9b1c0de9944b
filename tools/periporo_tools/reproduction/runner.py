# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Runs what is missing, goes on with what was interrupted, and stops in order."""
from __future__ import annotations

import contextlib
import fcntl
import json
import re
import shutil
import signal
import subprocess
import textwrap
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import TextIO

from periporo_tools.reproduction.case_text import read_case
from periporo_tools.reproduction.cost import Pace, duration_text
from periporo_tools.reproduction.plan import Run, State, distinct, write_whole
from periporo_tools.reproduction.sweeps import SweepError
from periporo_tools.results import read_summary

_INTERRUPTED = 130  # exit status of a program that was stopped and wrote its checkpoint
_FAILED = 1
_WRONG_INPUT = 2
_WIDTH = 80
_PLAIN_SECONDS = 600.0  # between lines of progress where there is no terminal


class Interrupted(Exception):
    """The user asked to stop; the running program has written its checkpoint."""


@contextlib.contextmanager
def locked(out: Path) -> Iterator[None]:
    """Two runners in one folder would overwrite each other. @throws SweepError when another one is there."""
    out.mkdir(parents=True, exist_ok=True)
    with open(out / ".lock", "w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise SweepError(f"{out}: another tools/reproduce is running there; wait for it, or choose another --out"
                             ) from error
        yield


class _Line:
    """The last line of a terminal, kept up to date; elsewhere a line now and then."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self._terminal = stream.isatty()
        self._last = time.monotonic()

    def show(self, text: str) -> None:
        if self._terminal:
            width = shutil.get_terminal_size().columns
            self._stream.write(f"\r\033[K{text[: width - 1]}")
            self._stream.flush()
        elif time.monotonic() - self._last > _PLAIN_SECONDS:
            self._last = time.monotonic()
            self.print(text)

    def print(self, text: str) -> None:
        lines = textwrap.wrap(text, _WIDTH, subsequent_indent="    ", break_long_words=False,
                              break_on_hyphens=False)
        self._stream.write(("\r\033[K" if self._terminal else "") + "\n".join(lines) + "\n")
        self._stream.flush()


class _Signals:
    """Passes Ctrl-C and SIGTERM on to the program, which then stops in order."""

    def __init__(self) -> None:
        self.process: subprocess.Popen | None = None
        self.received: int | None = None

    def _note(self, number: int, _: object) -> None:
        self.received = number
        if self.process is not None and self.process.poll() is None:
            self.process.send_signal(number)

    def __enter__(self) -> "_Signals":
        self._before = {number: signal.signal(number, self._note) for number in (signal.SIGINT, signal.SIGTERM)}
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)


def _version(program: Path) -> str:
    """\"periporo 0.1.0\". @throws SweepError when the program does not start."""
    try:
        return subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError) as error:
        raise SweepError(f"{program}: the program does not start ({error}); tools/build builds it") from error


def _last_words(lines: list[str]) -> list[str]:
    """What the program said of its failure: from its own complaint on, or the end."""
    begin = next((index for index, line in enumerate(lines) if line.startswith("periporo: ")), max(0, len(lines) - 12))
    return lines[begin:][:12]


@dataclass
class Runner:
    """Runs cases with the program, a line as each begins and ends."""

    program: Path
    threads: int | None
    stream: TextIO
    pace: Pace
    version: str = field(init=False)

    def __post_init__(self) -> None:
        self.version = _version(self.program)
        self._line = _Line(self.stream)

    def __call__(self, runs: list[Run]) -> list[Run]:
        """Runs those that are not complete and returns those that failed.

        @throws Interrupted
        """
        waiting = [run for run in distinct(runs) if run.state() is not State.COMPLETE]
        failed = []
        with _Signals() as signals:
            for count, run in enumerate(waiting, 1):
                if not self._one(run, f"[{count}/{len(waiting)}] {run.label}", waiting[count:], signals):
                    failed.append(run)
        return failed

    def _one(self, run: Run, name: str, later: list[Run], signals: _Signals) -> bool:
        state = run.state()
        if state is State.FOREIGN:
            self._line.print(f"{name}: FAILED: {run.folder} holds something that this tool has no record of; move it"
                             " away, or choose another --out")
            return False
        self._line.print(f"{name}: {self._beginning(run, state)}")
        begin = time.monotonic()
        resume = state is State.INTERRUPTED and run.resumable
        status, lines = self._call(run, name, resume, signals)
        if resume and status == _WRONG_INPUT:
            self._line.print(f"{name}: its checkpoint cannot be used, runs anew:")
            self._print_indented(lines)
            status, lines = self._call(run, name, False, signals)
        seconds = time.monotonic() - begin
        if status == _INTERRUPTED or (status != 0 and signals.received is not None):
            what = "stopped with a checkpoint" if run.resumable else "stopped before its first checkpoint"
            self._line.print(f"{name}: {what}; the same command goes on")
            raise Interrupted
        if status != 0:
            how = f"killed by signal {-status}" if status < 0 else f"exit status {status}"
            self._line.print(f"{name}: FAILED ({how}) after {duration_text(seconds)}:")
            self._print_indented(lines)
            return False
        self.pace.add(run.cost, read_summary(run.folder).get("wall_seconds", seconds))
        self._line.print(f"{name}: done in {duration_text(seconds)}{self._left(later)}")
        if signals.received is not None:  # it came as the run ended
            raise Interrupted
        return True

    def _beginning(self, run: Run, state: State) -> str:
        words = {
            State.CHANGED: "the case has changed, runs anew",
            State.FAILED: "failed the last time, runs anew",
            State.INTERRUPTED: "goes on" if run.resumable else "was stopped before its first checkpoint, runs anew",
        }.get(state, "begins")
        points = "" if run.cost.points is None else f", {run.cost.points:,} points"
        seconds = self.pace.seconds([run.cost])
        about = "" if seconds is None or state is State.INTERRUPTED else f", about {duration_text(seconds)}"
        return words + points + about

    def _left(self, later: list[Run]) -> str:
        if not later:
            return ""
        seconds = self.pace.seconds([run.cost for run in later])
        about = "" if seconds is None else f", about {duration_text(seconds)}"
        return f"; {len(later)} more{about}"

    def _print_indented(self, lines: list[str]) -> None:
        for line in _last_words(lines):
            self._line.print(f"  {line.strip()}")

    def _call(self, run: Run, name: str, resume: bool, signals: _Signals) -> tuple[int, list[str]]:
        """Exit status of the program and what it said, without its lines of progress."""
        command = [str(self.program), "run", str(run.case), "--out", str(run.folder)]
        command += ["--resume"] if resume else ["--overwrite"]
        command += ["--threads", str(self.threads)] if self.threads else []
        command += [word for override in run.overrides for word in ("--set", override)]
        before = run.record.read_bytes() if run.record.is_file() else None
        self._write_record(run)
        lines: list[str] = []
        # A group of its own: Ctrl-C reaches this process alone, which passes it on once.
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace", process_group=0) as process:
            signals.process = process
            if signals.received is not None:
                process.send_signal(signals.received)
            for line in process.stdout or ():
                self._line.show(f"  {line.rstrip()}" if self.stream.isatty() else f"{name}: {line.rstrip()}")
                if not re.match(r"\S+: (step \d|[\d.]+ s \()|filling body", line):
                    lines.append(line.rstrip())
        if process.returncode == _WRONG_INPUT:  # it touched nothing: what lies there is still that of the record before
            run.record.unlink() if before is None else run.record.write_bytes(before)
        elif process.returncode == _FAILED:
            self._write_record(run, failed=True)
        return process.returncode, lines

    def _write_record(self, run: Run, failed: bool = False) -> None:
        record = {
            "about": "what tools/reproduce ran in the folder of this name",
            # As the case is now: it may have been edited since the list of runs was made.
            "identity": read_case(run.case, run.overrides).identity(),
            "case": str(run.case),
            "overrides": list(run.overrides),
            "program": self.version,
            "failed": failed,
            "written": datetime.now().isoformat(timespec="seconds"),
        }
        write_whole(run.record, json.dumps(record, indent=2) + "\n")
