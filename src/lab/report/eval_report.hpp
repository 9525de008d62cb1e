// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace flagstone::report {

/// An image in the report.
struct ReportPicture {
  std::string title;           ///< caption, UTF-8
  std::vector<std::byte> png;  ///< bytes of the PNG file
};

/// Converts the results of `flagstone eval`, in the format of its --json, to one self-contained
/// HTML file with tables and plots. Ratios in `results` are 0 to 1; null is an undefined number.
/// Throws nlohmann::json::exception if `results` does not have this format.
std::string eval_report(const nlohmann::ordered_json& results,
                        std::span<const ReportPicture> pictures);

}  // namespace flagstone::report
