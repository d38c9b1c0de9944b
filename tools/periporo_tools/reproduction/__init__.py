# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Sweeps of cases that are run, resumed, measured, drawn and laid beside the paper: tools/reproduce."""
