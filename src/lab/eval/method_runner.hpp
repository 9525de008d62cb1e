// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "files/io/cloud.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone::eval {

/// A method on clouds as files hold them, of sensors that stand as the mount says: it is told the
/// rings of the points where the file has them and the method can use them. One per thread.
class MethodRunner {
 public:
  /// As make_segmenter() and GravityAlignedSegmenter.
  MethodRunner(std::string_view name, const MethodConfig& config, const MountSettings& mount = {});

  /// Reads the rings of a cloud that is to be segmented next. A field `ring` counts if it numbers
  /// as many rings as the method has beams, as whole numbers from 0, the lowest first; else the
  /// method infers them. May throw std::bad_alloc.
  void prepare(const io::Cloud& cloud);

  /// As Segmenter::segment() on the cloud it is prepared for, with a message where it fails.
  Status segment(const io::Cloud& cloud, Segmentation& result);

  /// What was found out of the sensor's mount, by this scan and those before.
  [[nodiscard]] const GravityAlignedSegmenter& levelled() const noexcept { return *levelled_; }

  /// Forgets the scans before.
  void reset() noexcept { levelled_->reset(); }

 private:
  class OnRings;

  bool find_rings(const io::Cloud& cloud);

  OnRings* on_rings_ = nullptr;  // the method, if it can be told the rings
  std::unique_ptr<GravityAlignedSegmenter> levelled_;
};

}  // namespace flagstone::eval
