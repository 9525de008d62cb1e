// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace flagstone::report {

/// Text for an HTML element or a quoted attribute.
std::string escaped(std::string_view text);

/// JSON for a <script> element: nothing in it can end the element. Bytes that are not UTF-8 become
/// U+FFFD.
std::string script_json(const nlohmann::ordered_json& value);

/// What is shown for a number that there is none of.
inline constexpr std::string_view no_number = "–";

/// A share, 0 to 1, in per cent with two decimals: "95.12"; no_number where `share` is no number.
std::string percent_text(const nlohmann::ordered_json& share);

/// A length in metres in centimetres with two decimals: "1.85"; no_number where it is none.
std::string centimetre_text(const nlohmann::ordered_json& metres);

/// A count or a rate with one decimal below 1,000: "55.2", "1240"; no_number where it is none.
std::string number_text(const nlohmann::ordered_json& number);

}  // namespace flagstone::report
