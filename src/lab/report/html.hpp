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

/// Base 64 with padding, in one line: RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);

enum class Format : std::uint8_t {
  text,     ///< a name, the row's heading
  percent,  ///< a share, 0 to 1, shown in per cent
  number,   ///< a count or a rate
  length,   ///< metres, shown in centimetres
};

/// A column of a table whose rows are objects.
struct Column {
  std::string group;  ///< heading above this and its neighbours of the same group; may be empty
  std::string heading;
  std::string path;  ///< JSON pointer from the row to the value, "/f1/mean"
  Format format;
  bool mark_best;  ///< sets the best value in bold: the highest, of lengths the lowest
};

/// An HTML table with a row per element of `rows`, an array. Values that are missing or null show
/// as no_number.
std::string table(const nlohmann::ordered_json& rows, std::span<const Column> columns);

}  // namespace flagstone::report
