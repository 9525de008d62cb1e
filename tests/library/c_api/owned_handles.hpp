// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/flagstone.h"
#include "outcome.hpp"

namespace flagstone::tests {

/// Handles of the C API that free themselves.
struct Destroy {
  void operator()(flagstone_settings* handle) const { flagstone_settings_destroy(handle); }
  void operator()(flagstone_segmenter* handle) const { flagstone_segmenter_destroy(handle); }
  void operator()(flagstone_segmentation* handle) const { flagstone_segmentation_destroy(handle); }
};
using OwnedSettings = std::unique_ptr<flagstone_settings, Destroy>;
using OwnedSegmenter = std::unique_ptr<flagstone_segmenter, Destroy>;
using OwnedSegmentation = std::unique_ptr<flagstone_segmentation, Destroy>;

inline OwnedSettings settings_of(const char* method) {
  flagstone_settings* handle = nullptr;
  flagstone_error error;
  EXPECT_EQ(flagstone_settings_create(method, &handle, &error), FLAGSTONE_OK) << error.message;
  return OwnedSettings(handle);
}

inline OwnedSegmenter segmenter_of(const char* method, float sensor_height = 1.73f) {
  flagstone_segmenter* handle = nullptr;
  flagstone_error error;
  EXPECT_EQ(flagstone_segmenter_create(method, sensor_height, &handle, &error), FLAGSTONE_OK)
      << error.message;
  return OwnedSegmenter(handle);
}

inline OwnedSegmenter segmenter_with(const OwnedSettings& settings, std::uint32_t threads = 1) {
  flagstone_segmenter* handle = nullptr;
  flagstone_error error;
  EXPECT_EQ(flagstone_segmenter_create_with(settings.get(), threads, &handle, &error), FLAGSTONE_OK)
      << error.message;
  return OwnedSegmenter(handle);
}

inline OwnedSegmentation empty_segmentation() {
  flagstone_segmentation* handle = nullptr;
  EXPECT_EQ(flagstone_segmentation_create(&handle, nullptr), FLAGSTONE_OK);
  return OwnedSegmentation(handle);
}

inline flagstone_cloud cloud_of(const std::vector<Point>& points) {
  return flagstone_cloud_of_floats(points.empty() ? nullptr : &points.front().x, points.size(), 3);
}

/// The same values, member by member.
inline Patch cpp_patch(const flagstone_patch& patch) {
  Patch copy;
  copy.zone = patch.zone;
  copy.ring = patch.ring;
  copy.sector = patch.sector;
  copy.verdict = static_cast<Verdict>(patch.verdict);
  copy.point_count = patch.point_count;
  copy.ground_count = patch.ground_count;
  copy.lower_ground_count = patch.lower_ground_count;
  std::ranges::copy(patch.mean, copy.mean.begin());
  std::ranges::copy(patch.normal, copy.normal.begin());
  copy.d = patch.d;
  std::ranges::copy(patch.eigenvalues, copy.eigenvalues.begin());
  copy.uprightness = patch.uprightness;
  copy.elevation = patch.elevation;
  copy.flatness = patch.flatness;
  copy.likelihood = patch.likelihood;
  copy.surface_variable = patch.surface_variable;
  return copy;
}

/// The contents of a result, read through the C API.
inline Outcome outcome_of(const flagstone_segmentation& result) {
  const std::size_t size = flagstone_segmentation_size(&result);
  const float* const heights = flagstone_segmentation_heights(&result);
  Outcome outcome;
  outcome.labels.resize(size);
  if (size > 0) std::memcpy(outcome.labels.data(), flagstone_segmentation_labels(&result), size);
  for (std::size_t i = 0; i < flagstone_segmentation_patch_count(&result); ++i) {
    outcome.patches.push_back(cpp_patch(flagstone_segmentation_patches(&result)[i]));
  }
  if (heights != nullptr) outcome.heights.assign(heights, heights + size);
  for (std::size_t i = 0; i < flagstone_segmentation_grid_count(&result); ++i) {
    flagstone_grid grid;
    EXPECT_EQ(flagstone_segmentation_grid(&result, i, &grid, nullptr), FLAGSTONE_OK);
    const std::size_t cells = grid.width * grid.width;
    outcome.grids.push_back({.cell = grid.cell,
                             .width = grid.width,
                             .heights = {grid.heights, grid.heights + cells},
                             .confidences = {grid.confidences, grid.confidences + cells}});
  }
  return outcome;
}

}  // namespace flagstone::tests
