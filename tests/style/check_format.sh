#!/usr/bin/env bash
# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Fails with the places where a C++ source is not as clang-format would have it.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.."
find framework plugins tests -name '*.cpp' -print0 -o -name '*.hpp' -print0 | xargs -0 clang-format --dry-run --Werror
