# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Every material law along paths whose course is known in closed form: numbers and pictures for the page of the law."""
