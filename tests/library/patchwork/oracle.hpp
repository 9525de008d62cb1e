// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patch.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::oracle {

/// The result of the oracle for one bin.
struct Bin {
  int zone = 0;
  int ring = 0;
  int sector = 0;
  std::vector<std::size_t> points;  ///< indices into the cloud, S_n
  Verdict verdict = Verdict::too_few_points;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double d = 0;
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();  ///< lambda_1 >= lambda_2 >= lambda_3
};

/// The result of the oracle for a scan.
struct Answer {
  std::vector<Label> labels;
  std::vector<Bin> bins;  ///< bins with points, ordered by zone, ring and sector
};

/// A simple implementation of section III of the paper, in double precision, point by point. Only
/// for comparison: it is slow and allocates memory in every call.
Answer segment(CloudView cloud, const PatchworkConfig& config);

}  // namespace flagstone::oracle
