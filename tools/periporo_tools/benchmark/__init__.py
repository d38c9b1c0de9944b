# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Measures how fast the operator is, beside the ceilings of the machine and another program."""
