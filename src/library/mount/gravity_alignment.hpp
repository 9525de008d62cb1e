// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/cloud_view.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"
#include "library/core/buffer.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::mount {

/// Brings clouds of a mount to where a method expects its ground, and results back.
class GravityAlignment {
 public:
  /// The method expects the ground below the sensor at z = -method_height.
  explicit GravityAlignment(float method_height) noexcept : method_height_(method_height) {}

  /// From now on clouds stand like this. `mount.up` has unit length.
  void set(const Mount& mount) noexcept;

  /// Is there nothing to do?
  [[nodiscard]] bool is_identity() const noexcept { return is_identity_; }

  /// The cloud in the level frame, the ground where the method expects it. What is not finite stays
  /// so, what is all zero too, and nothing else becomes either. May throw std::bad_alloc.
  CloudView apply(CloudView cloud);

  /// Patches back to the frame of the cloud, the surface to the sensor's height.
  void bring_back(Segmentation& result) const noexcept;

 private:
  float method_height_;
  bool is_identity_ = true;
  Mount mount_;
  Turn turn_;
  float lift_ = 0;          // added to z in the level frame, metres
  Buffer<float> levelled_;  // x, y, z of each point
};

}  // namespace flagstone::mount
