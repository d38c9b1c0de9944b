# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the machine is and what it can do."""
from __future__ import annotations

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Ceilings:
    """Of so many threads together."""

    threads: int
    flops_per_second: float  # a multiply-add counted as two
    bytes_per_second: float


def name() -> str:
    """The processor as it calls itself, and how many of its cores there are."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown processor")
    return f"{model}, {os.cpu_count()} cores"


def ceilings(program: Path, threads: int) -> Ceilings:
    """Measured now, by `program`."""
    printed = subprocess.run([str(program), str(threads)], capture_output=True, text=True, check=True).stdout
    found = json.loads(printed)
    return Ceilings(threads, found["flops_per_second"], found["bytes_per_second"])
