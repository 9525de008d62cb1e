// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/method.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace flagstone::eval {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> titles = {{
    {"ransac", "RANSAC"},
    {"gpf", "GPF"},
    {"line_fit", "LineFit"},
    {"cascaded", "CascadedSeg"},
    {"r_gpf", "R-GPF"},
    {"r_gpf+u", "R-GPF + U"},
    {"czm+u", "CZM + U"},
    {"czm+u+e", "CZM + U + E"},
    {"czm+u+e+f", "CZM + U + E + F"},
    {"patchwork", "Patchwork"},
    {"surface", "Surface"},
}};

}  // namespace

std::string title_of(std::string_view name) {
  const auto* const found =
      std::ranges::find(titles, name, [](const auto& row) { return row.first; });
  return std::string(found == titles.end() ? name : found->second);
}

Method method_of(std::string_view name, MethodConfig config, const MountSettings& mount) {
  return {.name = std::string(name),
          .title = title_of(name),
          .config = std::move(config),
          .mount = mount,
          .labels = {},
          .label_map = io::LabelMap::flagstone};
}

}  // namespace flagstone::eval
