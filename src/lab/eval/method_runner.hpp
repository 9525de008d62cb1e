// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"
#include "library/methods/method.hpp"

namespace flagstone::eval {

/// A method on clouds as files hold them, of sensors that stand as the mount says. One per thread.
class MethodRunner {
 public:
  /// Throws as MethodConfig::make() and GravityAlignedSegmenter.
  explicit MethodRunner(const MethodConfig& config, const MountSettings& mount = {});

  /// Hands the cloud that is segmented next to a method that uses more of it than x, y and z. May
  /// throw std::bad_alloc.
  void prepare(const io::Cloud& cloud);

  /// As Segmenter::segment() on the cloud it is prepared for, with a message where it fails.
  Status segment(const io::Cloud& cloud, Segmentation& result);

  /// What was found out of the sensor's mount, by this scan and those before.
  [[nodiscard]] const GravityAlignedSegmenter& levelled() const noexcept { return *levelled_; }

  /// Forgets the scans before.
  void reset() noexcept { levelled_->reset(); }

 private:
  UsesField* field_user_ = nullptr;  // the method, if it is one
  std::vector<double> values_;       // of its field
  std::unique_ptr<GravityAlignedSegmenter> levelled_;
};

}  // namespace flagstone::eval
