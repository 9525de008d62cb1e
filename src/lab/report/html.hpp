// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace flagstone::report {
/// Escapes text for an HTML element or a quoted attribute.
std::string escaped(std::string_view text);

/// JSON for a <script> element, escaped so that it cannot end the element. Bytes that are not UTF-8
/// become U+FFFD.
std::string script_json(const nlohmann::ordered_json& value);

/// Text for an undefined number.
inline constexpr std::string_view no_number = "–";

/// A ratio, 0 to 1, in per cent with two decimals: "95.12"; no_number if `share` is not a number.
std::string percent_text(const nlohmann::ordered_json& share);

/// A length in metres, in centimetres with two decimals: "1.85"; no_number if it is not a number.
std::string centimetre_text(const nlohmann::ordered_json& metres);

/// A count, or a rate with one decimal below 1,000: "55.2", "1240"; no_number if it is not a
/// number.
std::string number_text(const nlohmann::ordered_json& number);

/// Base 64 with padding, on one line: RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);

enum class Format : std::uint8_t {
  text,     ///< a name, the heading of the row
  percent,  ///< a ratio, 0 to 1, shown in per cent
  number,   ///< a count or a rate
  length,   ///< metres, shown in centimetres
};

/// A column of a table whose rows are JSON objects.
struct Column {
  std::string group;  ///< heading above adjacent columns of the same group; can be empty
  std::string heading;
  std::string path;  ///< JSON pointer from the row to the value, "/f1/mean"
  Format format;
  bool mark_best;  ///< sets the best value in bold: the lowest for lengths, otherwise the highest
};

/// An HTML table with one row per element of the array `rows`. Missing and null values are shown as
/// no_number.
std::string table(const nlohmann::ordered_json& rows, std::span<const Column> columns);

}  // namespace flagstone::report
