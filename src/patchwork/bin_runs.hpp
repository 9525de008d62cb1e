// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/buffer.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "patchwork/concentric_zones.hpp"

namespace flagstone::patchwork {

/// Consecutive input points that share a bin.
struct Run {
  std::uint32_t begin;   ///< index of the first point
  std::uint32_t length;  ///< number of points, at least 1
};

/// The points of a scan grouped by bin, without moving one.
///
/// A spinning sensor delivers neighbours one after another: a scan of 124,000 points is 6 to 9
/// thousand runs within one bin. Sorting the runs is a tenth of the work of sorting the points.
class BinRuns {
 public:
  /// Makes room for scans of `points` points over `bins` bins; may throw std::bad_alloc.
  void reserve(std::size_t points, std::size_t bins);

  /// Locates every point and groups the runs by bin. Labels the points that fall into none.
  /// `labels` has one element per point; `cloud` and zones are within what `reserve` was told.
  void collect(CloudView cloud, const ConcentricZones& zones, std::span<Label> labels) noexcept;

  /// The runs of a bin, in input order.
  [[nodiscard]] std::span<const Run> of(std::uint32_t bin) const noexcept {
    return {grouped_.data() + bins_.data()[bin].first_run,
            bins_.data()[bin + 1].first_run - bins_.data()[bin].first_run};
  }

  /// Points in a bin.
  [[nodiscard]] std::uint32_t points_in(std::uint32_t bin) const noexcept {
    return bins_.data()[bin].points;
  }

 private:
  struct FoundRun {
    std::uint32_t begin;
    std::uint32_t bin;
  };
  struct Bin {
    std::uint32_t first_run;
    std::uint32_t points;
  };

  std::size_t find_runs(CloudView cloud, const ConcentricZones& zones) noexcept;
  void count_runs(std::size_t runs, std::uint32_t bins) noexcept;
  void group_runs(std::size_t runs, std::uint32_t bins) noexcept;

  Buffer<FoundRun> found_;  ///< in input order, closed by one that begins at the number of points
  Buffer<Run> grouped_;     ///< by bin
  Buffer<Bin> bins_;        ///< one more than there are bins, to close the last
};

}  // namespace flagstone::patchwork
