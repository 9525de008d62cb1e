// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace flagstone::report {

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
