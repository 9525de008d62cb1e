// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "flagstone/segmenter.hpp"
#include "lab/eval/protocol.hpp"
#include "real_scans.hpp"

namespace flagstone::tests {

/// Creates the segmenter for a sensor at this height, metres.
using MakeSegmenter = std::function<std::unique_ptr<Segmenter>(float sensor_height)>;

/// Mean F1 over the scans with full density, percent. Prints it with `name`, the protocol and the
/// number of scans. Each scan is segmented in `turns` evenly spaced directions about z. Where F1
/// depends on a few patches, the mean over turns varies less than a single result.
double mean_f1(const std::string& name, const MakeSegmenter& make,
               const std::vector<RealScan>& scans, const eval::Protocol& protocol, int turns = 1);

}  // namespace flagstone::tests
