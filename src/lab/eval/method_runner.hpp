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

/// Runs a method on clouds read from files, with the mounting pose given by `mount`. Not
/// thread-safe: use one instance per thread.
class MethodRunner {
 public:
  /// Throws the exceptions of MethodConfig::make() and GravityAlignedSegmenter.
  explicit MethodRunner(const MethodConfig& config, const MountSettings& mount = {});

  /// Passes the next cloud to a method that uses more fields than x, y and z. May throw
  /// std::bad_alloc.
  void prepare(const io::Cloud& cloud);

  /// As Segmenter::segment(), on the cloud passed to prepare(), with a message for every error.
  Status segment(const io::Cloud& cloud, Segmentation& result);

  /// The estimated height and tilt of the sensor, from this scan and the previous ones.
  [[nodiscard]] const GravityAlignedSegmenter& levelled() const noexcept { return *levelled_; }

  /// Clears the state from previous scans.
  void reset() noexcept { levelled_->reset(); }

 private:
  UsesField* field_user_ = nullptr;  // the method if it uses a field, otherwise null
  std::vector<double> values_;       // values of that field
  std::unique_ptr<GravityAlignedSegmenter> levelled_;
};

}  // namespace flagstone::eval
