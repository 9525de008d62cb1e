// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flagstone::cli {
namespace {

constexpr std::size_t bar_width = 40;

std::string line(const std::string& name, std::size_t count, std::size_t most, std::size_t all) {
  const std::size_t length = most == 0 ? 0 : (count * bar_width + most - 1) / most;
  return fmt::format("  {:>18}  {:#<{}}{: <{}}  {:5.1f} %\n", name, "", length, "",
                     bar_width - length,
                     100.0 * static_cast<double>(count) / static_cast<double>(all));
}

/// 1, 2 or 5 times a power of ten, not below `width`.
double round_up(double width) {
  const double power = std::pow(10, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= width) return factor * power;
  }
  return 10 * power;
}

}  // namespace

std::string histogram_text(std::span<const float> values, std::span<const float> edges) {
  std::vector<std::size_t> counts(edges.size() - 1);
  std::size_t outside = 0;
  for (const float value : values) {
    const auto above = std::ranges::upper_bound(edges, value);
    if (above == edges.begin() || (above == edges.end() && value > edges.back())) {
      ++outside;
    } else {
      const auto index = static_cast<std::size_t>(above - edges.begin()) - 1;
      ++counts[std::min(index, counts.size() - 1)];
    }
  }
  if (values.empty()) return "  no points\n";

  std::string text;
  const std::size_t most = std::max(std::ranges::max(counts), outside);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    text +=
        line(fmt::format("{:g} .. {:g} m", edges[i], edges[i + 1]), counts[i], most, values.size());
  }
  if (outside > 0) text += line("beyond", outside, most, values.size());
  return text;
}

std::vector<float> round_edges(std::span<const float> values, std::size_t count) {
  if (values.empty()) return {0, 1};
  std::vector<float> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t skip = sorted.size() / 1000;
  const double low = sorted[skip];
  const double high = sorted[sorted.size() - 1 - skip];
  // A wide enough class to tell its edges apart as floats, however large the values.
  const double size = std::max(std::abs(low), std::abs(high));
  const double spread = std::max({high - low, 0.01, 1e-4 * size});
  const double width = round_up(spread / static_cast<double>(count));
  constexpr double most = std::numeric_limits<float>::max();
  std::vector<float> edges;
  for (double edge = std::floor(low / width); edge * width < high + width; ++edge) {
    edges.push_back(static_cast<float>(std::clamp(edge * width, -most, most)));
  }
  if (edges.size() < 2) edges.push_back(edges.front() + static_cast<float>(width));
  return edges;
}

}  // namespace flagstone::cli
