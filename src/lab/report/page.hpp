// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace flagstone::report {

/// What stands in a template in place of {{name}}.
struct Slot {
  std::string_view name;
  std::string_view value;
};

/// `text` with each {{name}} replaced by its slot's value, which is taken as it is: what looks like
/// a slot in there stays. Throws std::logic_error for a name that has no slot.
std::string fill(std::string_view text, std::span<const Slot> slots);

/// One HTML file that needs nothing else: `body` is HTML, `plots` what `script` draws.
std::string page(std::string_view title, std::string_view body, const nlohmann::ordered_json& plots,
                 std::string_view script);

/// The list of facts under the heading: protocol, scans, data sets, machine, date, version.
std::string facts(const nlohmann::ordered_json& results);

/// "10 scans".
std::string scan_count(const nlohmann::ordered_json& results);

/// The names of the data sets, "kitti, nuscenes"; not yet escaped.
std::string dataset_names(const nlohmann::ordered_json& results);

}  // namespace flagstone::report
