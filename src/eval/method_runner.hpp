// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"
#include "io/cloud.hpp"

namespace flagstone::eval {

/// A method on clouds as files hold them: it is told the rings of the points where the file has
/// them and the method can use them. One per thread.
class MethodRunner {
 public:
  /// As make_segmenter().
  MethodRunner(std::string_view name, const MethodConfig& config);

  /// Reads the rings of a cloud that is to be segmented next. A field `ring` counts if it numbers
  /// as many rings as the method has beams, as whole numbers from 0, the lowest first; else the
  /// method infers them. May throw std::bad_alloc.
  void prepare(const io::Cloud& cloud);

  /// As Segmenter::segment() on the cloud it is prepared for, with a message where it fails.
  Status segment(const io::Cloud& cloud, Segmentation& result);

 private:
  bool find_rings(const io::Cloud& cloud);

  std::unique_ptr<Segmenter> segmenter_;
  Cascaded* ring_aware_ = nullptr;  // the segmenter, if it can be told the rings
  bool has_rings_ = false;
  std::vector<std::uint16_t> rings_;
};

}  // namespace flagstone::eval
