# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Headers that most sources include, read once for each set of compiler options instead of once for each source.
#
# A source includes what it uses all the same: the preset "tidy" builds without precompiled headers. Headers of the project
# do not belong here: a change in one would compile everything anew. g++ takes precompiled headers only with the options
# that they were made with; a target reuses those of another one (REUSE_FROM) when the two agree in options, when it has
# all macros of the other, and when these headers read none that it has alone (FMT_SHARED, _OPENMP).
set(PERIPORO_PRECOMPILED
  <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numeric> <optional>
  <set> <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
  <experimental/simd>
  <Eigen/Core>
  <fmt/format.h> <fmt/ranges.h>)
