// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/sample_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "library/core/statistics.hpp"

namespace flagstone::bench {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void SampleTimes::add(std::size_t round, std::size_t scan, double milliseconds) {
  if (times_.size() < (round + 1) * scans_) times_.resize((round + 1) * scans_, no_number);
  times_[round * scans_ + scan] = milliseconds;
}

std::size_t SampleTimes::count() const { return known().size(); }

double SampleTimes::median() const { return flagstone::median(known()); }

double SampleTimes::percentile_99() const { return percentile(known(), 99); }

double SampleTimes::ratio_to(const SampleTimes& other) const {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(times_.size(), other.times_.size()); ++i) {
    const double ratio = times_[i] / other.times_[i];
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return flagstone::median(ratios);
}

double SampleTimes::points_per_second(std::span<const std::size_t> points) const {
  std::vector<double> rates;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const double rate = 1000 * static_cast<double>(points[i % scans_]) / times_[i];
    if (std::isfinite(rate)) rates.push_back(rate);
  }
  return flagstone::median(rates);
}

std::vector<double> SampleTimes::known() const {
  std::vector<double> known;
  std::ranges::copy_if(times_, std::back_inserter(known), [](double t) { return !std::isnan(t); });
  return known;
}

}  // namespace flagstone::bench
