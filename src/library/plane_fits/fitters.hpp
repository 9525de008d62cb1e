// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "library/core/segment_scan.hpp"
#include "library/core/thread_pool.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/plane_fit.hpp"
#include "library/plane_fits/stage_clock.hpp"

namespace flagstone::plane_fits {

/// Working memory of one thread that fits planes, sixteen bins at a time, and labels points.
struct Fitter {
  explicit Fitter(const FitSettings& settings) noexcept : fit(settings) {}

  /// Reserves memory for bins with up to `points` points in total. May throw std::bad_alloc.
  void reserve(std::size_t points) {
    batch.reserve(points);
    fit.reserve(points);
  }

  BinBatch batch;
  Seeds seeds{};
  PlaneFit fit;
  PlaneFit::Result fitted;
  LabelTotals totals{};  ///< points that this thread labelled
};

/// One fitter per thread: `Fitter` or a class derived from it.
template <class OneFitter>
class Fitters {
 public:
  template <class... Arguments>
  explicit Fitters(std::size_t threads, const Arguments&... arguments) {
    for (std::size_t i = 0; i < threads; ++i) fitters_.emplace_back(arguments...);
  }

  void reserve(std::size_t points) {
    for (OneFitter& fitter : fitters_) fitter.reserve(points);
  }

  /// Calls `work(bins, fitter, clock)` with up to sixteen of `bins` at a time, from all threads of
  /// the pool. Only the clock of the caller's thread measures time.
  template <class Bin, class Work>
  void run(ThreadPool& pool, std::span<Bin> bins, StageClock& clock, const Work& work) noexcept {
    const std::size_t batches = (bins.size() + batch_size - 1) / batch_size;
    pool.run(batches, [&](std::size_t worker, std::size_t batch) {
      StageClock no_clock(nullptr);
      const std::size_t first = batch * batch_size;
      work(bins.subspan(first, std::min(batch_size, bins.size() - first)), fitters_[worker],
           worker == 0 ? clock : no_clock);
    });
  }

  /// The label totals of a worker.
  [[nodiscard]] LabelTotals& totals_of(std::size_t worker) noexcept {
    return fitters_[worker].totals;
  }

  void clear_totals() noexcept {
    for (OneFitter& fitter : fitters_) fitter.totals = {};
  }

  /// Number of points per label, over all threads, since clear_totals().
  [[nodiscard]] LabelTotals totals() const noexcept {
    LabelTotals sum{};
    for (const OneFitter& fitter : fitters_) {
      for (std::size_t i = 0; i < label_count; ++i) sum[i] += fitter.totals[i];
    }
    return sum;
  }

 private:
  std::vector<OneFitter> fitters_;
};

}  // namespace flagstone::plane_fits
