# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The environment in which the tests of the SDK start programs."""
from __future__ import annotations

import os

MISLEADING = {"PERIPORO_PLUGIN_PATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "DESTDIR"}


def clean_environment() -> dict[str, str]:
    """The environment without what would lead to another installation."""
    return {name: value for name, value in os.environ.items() if name not in MISLEADING}
