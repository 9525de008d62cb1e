// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/segmenter.hpp"

namespace flagstone::tests {

/// A method that only records the cloud it received.
class RecordingMethod final : public Segmenter {
 public:
  struct Seen {
    CloudView view;
    std::vector<Point> points;
  };
  explicit RecordingMethod(Seen& seen) : seen_(seen) {}

  Status segment(CloudView cloud, Segmentation& result) noexcept override {
    seen_.view = cloud;
    seen_.points.resize(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) seen_.points[i] = cloud[i];
    result.start(cloud.size());
    result.finish();
    return {};
  }

 private:
  Seen& seen_;
};

}  // namespace flagstone::tests
