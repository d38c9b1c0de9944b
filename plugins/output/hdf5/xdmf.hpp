// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// An XDMF 3 description of a result file, through which ParaView opens it.
#pragma once

#include "results_file.hpp"

#include <string>
#include <vector>

namespace periporo::output {

/// The text of the description: a temporal collection of point clouds, each point a vertex, with all fields at the
/// points. A field of six components is given as a plain array of six ("Matrix"): its order xx yy zz xy yz xz is the
/// one that ParaView labels so, whereas XDMF's "Tensor6" has another. Both XDMF readers of ParaView 5.11 read it; the
/// newer one shows vertices only when they are listed, hence the lists in the result file.
/// @param data_file name of the result file, relative to the description
std::string xdmf_text(const std::vector<StoredSnapshot>& snapshots, const std::string& data_file);

} // namespace periporo::output
