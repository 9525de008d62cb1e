// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pose_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

constexpr std::size_t most_columns = 1024;

constexpr std::array<std::pair<std::string_view, double>, 4> time_units = {
    {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};

/// The words of a column's name, "pose", "position", "x", and its unit.
struct ColumnName {
  std::vector<std::string> words;
  std::string unit;

  [[nodiscard]] bool has_any(std::initializer_list<std::string_view> any) const {
    return std::ranges::any_of(words, [&](const std::string& word) { return is_in(word, any); });
  }
  static bool is_in(std::string_view word, std::initializer_list<std::string_view> any) {
    return std::ranges::find(any, word) != any.end();
  }
};

ColumnName parsed(std::string_view cell) {
  ColumnName name;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) name.words.push_back(std::exchange(word, {}));
  };
  bool in_unit = false;
  for (const char any_case : cell) {
    const char c =
        any_case >= 'A' && any_case <= 'Z' ? static_cast<char>(any_case - 'A' + 'a') : any_case;
    if (c == '[' || c == '(') {
      in_unit = true;
    } else if (c == ']' || c == ')') {
      in_unit = false;
    } else if (in_unit) {
      name.unit += c;
    } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
      word += c;
    } else {
      end_word();
    }
  }
  end_word();
  constexpr std::array<std::string_view, 7> units = {"s", "ms", "us", "ns", "m", "rad", "deg"};
  if (name.words.size() > 1 && name.unit.empty() &&
      std::ranges::find(units, name.words.back()) != units.end()) {
    name.unit = name.words.back();
    name.words.pop_back();
  }
  return name;
}

/// What a column contains; nothing for columns that a pose does not need.
std::optional<PoseColumn> content_of(const ColumnName& name) {
  using enum PoseColumn;
  if (name.words.empty()) return std::nullopt;
  // Twists, covariances, and the velocities and biases of EuRoC have components x, y and z too.
  if (name.has_any({"twist", "velocity", "vel", "linear", "angular", "acceleration", "accel",
                    "covariance", "cov", "bias", "sigma", "std", "error"}) ||
      (name.words.size() > 1 && ColumnName::is_in(name.words.front(), {"v", "b", "w", "a"}))) {
    return std::nullopt;
  }
  const std::string& last = name.words.back();
  const bool is_rotation =
      name.has_any({"orientation", "rotation", "quaternion", "quat", "q", "rot"});
  static const std::array<std::pair<std::string_view, PoseColumn>, 23> words = {
      {{"x", x},
       {"y", y},
       {"z", z},
       {"tx", x},
       {"ty", y},
       {"tz", z},
       {"px", x},
       {"py", y},
       {"pz", z},
       {"qx", qx},
       {"qy", qy},
       {"qz", qz},
       {"qw", qw},
       {"roll", roll},
       {"pitch", pitch},
       {"yaw", yaw},
       {"sec", seconds},
       {"secs", seconds},
       {"nsec", nanoseconds},
       {"nsecs", nanoseconds},
       {"nanosec", nanoseconds},
       {"t", time},
       {"stamp", time}}};
  if (is_rotation && ColumnName::is_in(last, {"x", "y", "z", "w"})) {
    constexpr std::array quaternion = {qx, qy, qz, qw};
    return quaternion[std::string_view("xyzw").find(last)];
  }
  for (const auto& [word, column] : words) {
    if (last == word) return column;
  }
  const std::string_view end = last;
  if (ends_with(end, "timestamp") || ends_with(end, "time")) return time;
  return std::nullopt;
}

char separator_of(std::string_view line) {
  return line.find(',') == std::string_view::npos && line.find(';') != std::string_view::npos ? ';'
                                                                                              : ',';
}

bool is_time(PoseColumn column) {
  return column == PoseColumn::time || column == PoseColumn::seconds ||
         column == PoseColumn::nanoseconds;
}

Status set_unit(PoseColumn column, const ColumnName& name, std::string_view cell,
                PoseColumns& columns) {
  if (name.unit.empty()) return {};
  const auto bad_unit = [&](std::string_view expected) {
    return Status(StatusCode::bad_file,
                  fmt::format("{} has an unknown unit (expected {})", quote(cell), expected));
  };
  if (column == PoseColumn::time) {
    const auto* const unit = std::ranges::find(time_units, std::string_view(name.unit),
                                               &std::pair<std::string_view, double>::first);
    if (unit == time_units.end()) return bad_unit("s, ms, us or ns");
    columns.time_unit = unit->second;
  } else if (column >= PoseColumn::roll) {
    if (name.unit != "rad" && name.unit != "deg") return bad_unit("rad or deg");
    columns.angle_unit = name.unit == "deg" ? std::numbers::pi / 180 : 1;
  } else if (column >= PoseColumn::x && column <= PoseColumn::z && name.unit != "m") {
    return bad_unit("m");
  }
  return {};
}

Status check_complete(PoseColumns& columns) {
  using enum PoseColumn;
  using Named = std::pair<PoseColumn, std::string_view>;
  std::vector<std::string_view> missing;
  const auto require = [&](std::initializer_list<Named> needed) {
    for (const auto& [column, name] : needed) {
      if (!columns.has(column)) missing.push_back(name);
    }
  };
  require({{x, "x"}, {y, "y"}, {z, "z"}});
  const bool has_quaternion =
      columns.has(qx) || columns.has(qy) || columns.has(qz) || columns.has(qw);
  if (has_quaternion || !(columns.has(roll) && columns.has(pitch) && columns.has(yaw))) {
    require({{qx, "qx"}, {qy, "qy"}, {qz, "qz"}, {qw, "qw"}});
  }
  if (missing.empty()) return {};
  return Status(StatusCode::bad_file,
                fmt::format("the header does not name the column{} {} (expected x, y, z, and qx, "
                            "qy, qz, qw or roll, pitch, yaw; a time is optional)",
                            missing.size() > 1 ? "s" : "", fmt::join(missing, ", ")));
}

}  // namespace

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (cells.size() <= most_columns) {
    const std::size_t end = line.find(separator);
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = trimmed(cell.substr(1, cell.size() - 2));
    }
    cells.push_back(cell);
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return cells;
}

bool is_pose_header(std::string_view line) {
  const char separator = separator_of(line);
  if (line.find(separator) == std::string_view::npos) return false;
  std::array<bool, 3> has{};
  for (const std::string_view cell : cells_of(line, separator)) {
    const std::optional<PoseColumn> column = content_of(parsed(cell));
    if (!column) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      has[axis] = has[axis] || *column == static_cast<PoseColumn>(
                                              static_cast<std::size_t>(PoseColumn::x) + axis);
    }
  }
  return has[0] && has[1] && has[2];
}

Status find_pose_columns(std::string_view header, PoseColumns& out) {
  PoseColumns columns;
  columns.separator = separator_of(header);
  const std::vector<std::string_view> cells = cells_of(header, columns.separator);
  if (cells.size() > most_columns) {
    return Status(StatusCode::bad_file, fmt::format("has more than {} columns", most_columns));
  }
  columns.count = cells.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ColumnName name = parsed(cells[i]);
    const std::optional<PoseColumn> column = content_of(name);
    if (!column) continue;
    if (columns.has(*column)) {
      const std::size_t other = columns.index(*column);
      // A recorder adds its own time to that of the message.
      if (is_time(*column) && !name.has_any({"header"})) continue;
      if (!is_time(*column)) {
        return Status(StatusCode::bad_file,
                      fmt::format("columns {} and {} have the same content, {} and {} (expected "
                                  "one of them)",
                                  other + 1, i + 1, quote(cells[other]), quote(cells[i])));
      }
    }
    columns.set(*column, i);
    if (*column == PoseColumn::time) columns.time_unit.reset();
    if (Status status = set_unit(*column, name, cells[i], columns); !status.ok()) return status;
  }
  if (Status status = check_complete(columns); !status.ok()) return status;
  out = columns;
  return {};
}

}  // namespace flagstone::io
