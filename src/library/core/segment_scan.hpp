// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

/// Number of points per label, as in Segmentation::finish.
using LabelTotals = std::array<std::size_t, label_count>;

/// Returns `config`, or throws what its check() throws.
template <class Config>
Config checked(Config config) {
  config.check();
  return config;
}

/// Common part of every Segmenter::segment: rejects invalid clouds, starts and finishes the result,
/// and turns a failed allocation into a status. `work(labels)` sets all labels except `nonground`.
/// It may throw only std::bad_alloc. It can return the LabelTotals.
template <class Work>
Status segment_scan(CloudView cloud, Segmentation& result, Work&& work) noexcept {
  result.clear();
  if (cloud.data() == nullptr && !cloud.empty()) return Status(StatusCode::invalid_argument);
  if (cloud.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Status(StatusCode::invalid_argument);
  }
  try {
    const std::span<Label> labels = result.start(cloud.size());
    if constexpr (std::is_void_v<std::invoke_result_t<Work, std::span<Label>>>) {
      std::forward<Work>(work)(labels);
      result.finish();
    } else {
      result.finish(std::forward<Work>(work)(labels));
    }
  } catch (const std::bad_alloc&) {
    result.clear();
    return Status(StatusCode::out_of_memory);
  }
  return {};
}

}  // namespace flagstone
