// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace flagstone::report {

/// A picture in the report.
struct ReportPicture {
  std::string title;           ///< UTF-8, its caption
  std::vector<std::byte> png;  ///< the PNG file's bytes
};

/// The results of `flagstone eval`, as its --json writes them, as one HTML file with tables and
/// plots that loads nothing from anywhere. Shares in `results` are 0 to 1; null stands for a number
/// that there is none of. Throws nlohmann::json::exception where `results` is not of that form.
std::string eval_report(const nlohmann::ordered_json& results,
                        std::span<const ReportPicture> pictures);

}  // namespace flagstone::report
