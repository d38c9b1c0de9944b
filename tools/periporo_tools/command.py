# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the commands in tools/ share."""
from __future__ import annotations

import os
import sys
from collections.abc import Callable


def run(main: Callable[..., int], *arguments: str) -> int:
    """Calls `main` and returns its exit status; 0 as well when the reader of the output, as `head`, has seen enough."""
    try:
        status = main(*arguments)
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        # nothing more may be written when the interpreter ends
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
