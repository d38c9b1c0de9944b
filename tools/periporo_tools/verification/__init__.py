# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Holds the program against closed forms: cases under cases/verification, one table, one page of pictures."""
