// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

/// A ground segmentation method. It owns its working memory: use one object per thread.
class Segmenter {
 public:
  virtual ~Segmenter() = default;

  /// Labels every point of `cloud` and replaces what `result` held.
  ///
  /// The same cloud gives the same bytes every time, whatever came before. Once buffers have grown
  /// to the largest scan nothing is allocated; nothing is thrown or printed. Any bit pattern is
  /// allowed in the coordinates.
  ///
  /// Fails with `out_of_memory`, or with `invalid_argument` for a null cloud that claims points or
  /// one of more than 2^32 - 1 points; `result` then holds no labels.
  virtual Status segment(CloudView cloud, Segmentation& result) noexcept = 0;

 protected:
  Segmenter() = default;
  Segmenter(Segmenter&&) = default;
  Segmenter& operator=(Segmenter&&) = default;
};

}  // namespace flagstone
