// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace flagstone::report {

/// A value that replaces {{name}} in a template.
struct Slot {
  std::string_view name;
  std::string_view value;
};

/// Returns `text` with each {{name}} replaced by the value of its slot. Values are not searched for
/// slots. Throws std::logic_error for a name without a slot.
std::string fill(std::string_view text, std::span<const Slot> slots);

/// One self-contained HTML file. `body` is HTML, and `plots` is the data that `script` draws.
std::string page(std::string_view title, std::string_view body, const nlohmann::ordered_json& plots,
                 std::string_view script);

/// The list of facts below the heading: protocol, scans, datasets, machine, date, version.
std::string facts(const nlohmann::ordered_json& results);

/// The number of scans: "10 scans".
std::string scan_count(const nlohmann::ordered_json& results);

/// The names of the datasets, not escaped: "kitti, nuscenes".
std::string dataset_names(const nlohmann::ordered_json& results);

}  // namespace flagstone::report
