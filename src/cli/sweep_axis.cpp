// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sweep_axis.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "app/config/config_toml.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {
namespace {

/// The whole number that `text` is; 0 for anything else.
int whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

void make_uniform_grid(const std::string& value, MethodConfig& config) {
  auto* patchwork = std::get_if<PatchworkConfig>(&config);
  const std::size_t times = value.find('x');
  const int rings = whole_number(std::string_view(value).substr(0, times));
  const int sectors =
      times == std::string::npos ? 0 : whole_number(std::string_view(value).substr(times + 1));
  if (patchwork == nullptr || rings < 1 || rings > 1000 || sectors < 1) {
    throw std::invalid_argument(fmt::format(
        "bins = {}: allowed: RINGSxSECTORS, e.g. 30x108, of patchwork and its relatives", value));
  }
  const float outer = patchwork->zones.back().ring_radii.back();
  patchwork->zones = {{.ring_radii = equal_rings(patchwork->min_range, outer, rings),
                       .sectors = sectors,
                       .height_margin = -std::numeric_limits<float>::infinity()}};
}

}  // namespace

SweepAxis sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw std::invalid_argument(fmt::format(
        "--param {}: allowed: KEY=VALUE,VALUE,..., e.g. --param distance_margin=0.1,0.125,0.15",
        text));
  }
  if (io::printable(text) != text) {
    throw std::invalid_argument(fmt::format("--param {}: holds what cannot be printed", text));
  }
  SweepAxis axis{.key = text.substr(0, equals), .values = {}};
  std::size_t begin = equals + 1;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    axis.values.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return axis;
}

void apply_axis(const std::string& key, const std::string& value, MethodConfig& config) {
  if (key == "bins") {
    make_uniform_grid(value, config);
  } else {
    config::apply_toml(fmt::format("{} = {}", key, value), fmt::format("--param {}={}", key, value),
                       config);
  }
}

}  // namespace flagstone::cli
