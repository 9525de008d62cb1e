// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// A column of a table of poses.
enum class PoseColumn { time, seconds, nanoseconds, x, y, z, qx, qy, qz, qw, roll, pitch, yaw };

/// Which columns of a CSV file contain what.
class PoseColumns {
 public:
  static constexpr std::size_t kinds = 13;

  [[nodiscard]] bool has(PoseColumn column) const noexcept { return place(column) > 0; }
  /// The index of a column that the file has, from 0.
  [[nodiscard]] std::size_t index(PoseColumn column) const noexcept { return place(column) - 1; }
  void set(PoseColumn column, std::size_t index) noexcept {
    places_[static_cast<std::size_t>(column)] = index + 1;
  }

  char separator = ',';
  std::size_t count = 0;              ///< columns of the file
  std::optional<double> time_unit{};  ///< seconds; nothing if the header does not name a unit
  double angle_unit = 1;              ///< radians

  [[nodiscard]] bool has_quaternion() const noexcept { return has(PoseColumn::qw); }

 private:
  [[nodiscard]] std::size_t place(PoseColumn column) const noexcept {
    return places_[static_cast<std::size_t>(column)];
  }

  std::array<std::size_t, kinds> places_{};  // index + 1; 0 if the file does not have the column
};

/// The cells of a line of a CSV file, without blanks and quotes around them.
std::vector<std::string_view> cells_of(std::string_view line, char separator);

/// True if the line has separators and names the columns x, y and z.
bool is_pose_header(std::string_view line);

/// Finds the columns in a header. bad_file with the missing columns, or with two columns of the
/// same content.
Status find_pose_columns(std::string_view header, PoseColumns& out);

}  // namespace flagstone::io
