// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patchwork/bin_runs.hpp"

#include <algorithm>
#include <array>

namespace flagstone::patchwork {

void BinRuns::reserve(std::size_t points, std::size_t bins) {
  found_.reserve(points + 1);
  grouped_.reserve(points);
  bins_.reserve(bins + 1);
}

void BinRuns::collect(CloudView cloud, const ConcentricZones& zones,
                      std::span<Label> labels) noexcept {
  const std::size_t runs = find_runs(cloud, zones);

  for (std::size_t i = 0; i < runs; ++i) {
    const FoundRun& run = found_.data()[i];
    if (run.bin < zones.bin_count()) continue;
    const Label label = run.bin == zones.noise()          ? Label::noise
                        : run.bin == zones.out_of_range() ? Label::out_of_range
                                                          : Label::invalid;
    std::fill(labels.begin() + run.begin, labels.begin() + found_.data()[i + 1].begin, label);
  }

  count_runs(runs, zones.bin_count());
  group_runs(runs, zones.bin_count());
}

std::size_t BinRuns::find_runs(CloudView cloud, const ConcentricZones& zones) noexcept {
  constexpr std::size_t block_size = ConcentricZones::block_size;
  std::array<float, block_size> x;
  std::array<float, block_size> y;
  std::array<float, block_size> z;
  std::array<std::uint32_t, block_size> bins;
  FoundRun* found = found_.data();
  std::size_t runs = 0;
  std::uint32_t previous = zones.invalid() + 1;  // no point's bin
  for (std::size_t begin = 0; begin < cloud.size(); begin += block_size) {
    const std::size_t count = std::min(block_size, cloud.size() - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const Point p = cloud[begin + k];
      x[k] = p.x;
      y[k] = p.y;
      z[k] = p.z;
    }
    zones.locate(x.data(), y.data(), z.data(), count, bins.data());
    for (std::size_t k = 0; k < count; ++k) {
      found[runs] = {static_cast<std::uint32_t>(begin + k), bins[k]};  // kept where a run begins
      runs += bins[k] != previous;
      previous = bins[k];
    }
  }
  found[runs] = {static_cast<std::uint32_t>(cloud.size()), zones.invalid()};
  return runs;
}

void BinRuns::count_runs(std::size_t runs, std::uint32_t bins) noexcept {
  std::fill_n(bins_.data(), bins + 1, Bin{0, 0});
  for (std::size_t i = 0; i < runs; ++i) {
    const FoundRun& run = found_.data()[i];
    if (run.bin >= bins) continue;
    Bin& bin = bins_.data()[run.bin];
    ++bin.first_run;  // for now, how many runs
    bin.points += found_.data()[i + 1].begin - run.begin;
  }
}

void BinRuns::group_runs(std::size_t runs, std::uint32_t bins) noexcept {
  std::uint32_t end = 0;
  for (std::uint32_t b = 0; b <= bins; ++b) {
    end += bins_.data()[b].first_run;
    bins_.data()[b].first_run =
        end;  // where the bin's runs end, until they are filled in backwards
  }
  for (std::size_t i = runs; i-- > 0;) {
    const FoundRun& run = found_.data()[i];
    if (run.bin >= bins) continue;
    grouped_.data()[--bins_.data()[run.bin].first_run] = {run.begin,
                                                          found_.data()[i + 1].begin - run.begin};
  }
}

}  // namespace flagstone::patchwork
