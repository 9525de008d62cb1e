// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

/// Base class of all ground segmentation methods. A segmenter owns its working memory. Not
/// thread-safe: use one instance per thread.
class Segmenter {
 public:
  virtual ~Segmenter() = default;

  /// Labels every point of `cloud` and replaces the contents of `result`.
  ///
  /// `cloud` is one scan in the sensor frame, in metres; see Point. Coordinates may have any value,
  /// including NaN, infinity and denormals.
  ///
  /// The result is deterministic: the same cloud gives a bit-identical result, whatever was
  /// segmented before. Memory is allocated only until the buffers fit the largest scan. The method
  /// neither throws nor prints.
  ///
  /// Errors: `out_of_memory`; `invalid_argument` if the cloud has a null pointer but a size above
  /// 0, or more than 2^32 - 1 points. `result` is then empty.
  virtual Status segment(CloudView cloud, Segmentation& result) noexcept = 0;

 protected:
  Segmenter() = default;
  Segmenter(Segmenter&&) = default;
  Segmenter& operator=(Segmenter&&) = default;
};

}  // namespace flagstone
