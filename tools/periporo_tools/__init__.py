# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Reading, measuring and drawing results of periporo; they know the documented outputs only."""
