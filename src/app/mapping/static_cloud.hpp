// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <unordered_set>
#include <vector>

#include "flagstone/label.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// A point of a StaticCloud.
struct StaticPoint {
  double x = 0, y = 0, z = 0;  ///< world frame after levelling, metres
  float height = 0;            ///< above the ground, metres; NaN if unknown
  Label label = Label::nonground;
};

/// The points of a run that do not move: the first one in each voxel.
class StaticCloud {
 public:
  /// `voxel`: metres, above 0.
  explicit StaticCloud(double voxel) : voxel_(voxel) {}

  /// Adds points; the order matters. May throw std::bad_alloc.
  void add(const std::vector<StaticPoint>& points);

  [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }

  /// Writes the points as x, y, z (float64), height (float32) and label (uint8); the file extension
  /// determines the format. Errors as io::write_cloud().
  [[nodiscard]] Status write(const std::filesystem::path& path) const;

 private:
  struct Voxel {
    std::int64_t x, y, z;
    friend bool operator==(const Voxel&, const Voxel&) = default;
  };
  struct Hash {
    std::size_t operator()(const Voxel& voxel) const noexcept;
  };

  double voxel_;
  std::unordered_set<Voxel, Hash> taken_;
  std::vector<StaticPoint> points_;
};

}  // namespace flagstone::app
