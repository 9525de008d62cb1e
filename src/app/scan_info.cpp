// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "files/io/message.hpp"
#include "library/core/point_validity.hpp"

namespace flagstone::app {
namespace {

constexpr std::size_t bar_width = 40;

std::string line(const std::string& name, std::size_t count, std::size_t most, std::size_t all) {
  const std::size_t length = most == 0 ? 0 : (count * bar_width + most - 1) / most;
  return fmt::format("  {:>18}  {:#<{}}{: <{}}  {:5.1f} %\n", name, "", length, "",
                     bar_width - length,
                     100.0 * static_cast<double>(count) / static_cast<double>(all));
}

/// The smallest of 1, 2 and 5 times a power of ten that is at least `width`.
double round_up(double width) {
  const double power = std::pow(10, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= width) return factor * power;
  }
  return 10 * power;
}

/// Counts of points, and ranges and heights of the valid ones.
struct Survey {
  std::size_t not_finite = 0;
  std::size_t zero = 0;  ///< all three coordinates 0: missing returns
  std::vector<float> ranges;
  std::vector<float> heights;
};

Survey survey(CloudView cloud) {
  Survey found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    if (!is_finite(p)) {
      ++found.not_finite;
    } else if (is_missing_return(p)) {
      ++found.zero;
    } else {
      found.ranges.push_back(std::hypot(p.x, p.y));
      found.heights.push_back(p.z);
    }
  }
  return found;
}

std::string field_text(const io::Cloud& cloud, const io::Field& field) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t k = 0; k < field.count; ++k) {
      const double value = cloud.value(i, field, k);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const std::string type = field.count == 1
                               ? std::string(io::to_string(field.type))
                               : fmt::format("{}[{}]", io::to_string(field.type), field.count);
  const std::string bounds =
      low <= high ? fmt::format("{:g} .. {:g}", low, high) : "no finite values";
  return fmt::format("  {:<18} {:<10} {}\n", io::printable(field.name), type, bounds);
}

std::string count_text(const char* what, std::size_t count, std::size_t all) {
  const double share = all == 0 ? 0 : 100.0 * static_cast<double>(count) / static_cast<double>(all);
  return fmt::format("{:<20} {} ({:.1f} %)\n", what, count, share);
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
  if (outside > 0) text += line("outside", outside, most, values.size());
  return text;
}

std::vector<float> round_edges(std::span<const float> values, std::size_t count) {
  if (values.empty()) return {0, 1};
  std::vector<float> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t skip = sorted.size() / 1000;
  const double low = sorted[skip];
  const double high = sorted[sorted.size() - 1 - skip];
  // Bins must be wide enough that their edges differ as floats, however large the values are.
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

std::string info_text(const std::string& file, const io::Cloud& cloud) {
  const Survey found = survey(cloud.view());
  std::string text = fmt::format("{}\n{:<20} {}, {} bytes each\n", io::printable(file), "points",
                                 cloud.size(), cloud.stride());
  text += count_text("not finite", found.not_finite, cloud.size());
  text += count_text("missing returns", found.zero, cloud.size());
  text += "\nfields               type       bounds\n";
  for (const io::Field& field : cloud.fields()) {
    if (!field.is_padding()) text += field_text(cloud, field);
  }
  constexpr std::array range_edges = {0.0f,  2.0f,  5.0f,  10.0f, 20.0f,
                                      30.0f, 40.0f, 60.0f, 80.0f, 120.0f};
  text += "\nrange from the sensor, in the x-y plane\n" + histogram_text(found.ranges, range_edges);
  text += "\nz, height above the sensor\n" +
          histogram_text(found.heights, round_edges(found.heights, 16)) + "\n";
  return text;
}

}  // namespace flagstone::app
