// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pose_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/pose_columns.hpp"
#include "files/io/text.hpp"
#include "library/core/rotation.hpp"
#include "library/ground_map/poses.hpp"

namespace flagstone::io {
namespace {

constexpr std::size_t kitti_numbers = 12;
constexpr std::size_t tum_numbers = 8;
constexpr std::string_view formats =
    "12 numbers per line (KITTI), time x y z qx qy qz qw (TUM), or a header that names the columns "
    "(CSV)";

template <class... Args>
Status bad_line(std::size_t number, fmt::format_string<Args...> reason, Args&&... args) {
  return Status(StatusCode::bad_file, fmt::format("line {}: ", number) +
                                          fmt::format(reason, std::forward<Args>(args)...));
}

/// The lines of a text that are not empty, without blanks at both ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text_.starts_with(byte_order_mark)) offset_ = byte_order_mark.size();
  }

  /// Moves to the next line. False at the end.
  bool next() {
    while (offset_ < text_.size()) {
      ++number_;
      line_ = trimmed(next_line(text_, offset_));
      if (!line_.empty()) return true;
    }
    return false;
  }

  [[nodiscard]] std::string_view line() const noexcept { return line_; }
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  [[nodiscard]] bool is_comment() const noexcept { return line_.front() == '#'; }

 private:
  std::string_view text_;
  std::string_view line_;
  std::size_t offset_ = 0;
  std::size_t number_ = 0;
};

/// Reads exactly as many numbers as `out` has.
Status read_numbers(const Lines& at, std::span<double> out) {
  const std::vector<std::string_view> words = words_of(at.line(), out.size() + 1);
  for (std::size_t i = 0; i < std::min(words.size(), out.size()); ++i) {
    const std::optional<double> value = real_number(words[i]);
    if (!value) {
      return bad_line(at.number(), "{} is not a number (expected {} numbers)", quote(words[i]),
                      out.size());
    }
    out[i] = *value;
  }
  if (words.size() == out.size()) return {};
  if (words.size() > out.size()) {
    return bad_line(at.number(), "has more than {} numbers (expected {}, as in the lines before)",
                    out.size(), out.size());
  }
  return bad_line(at.number(),
                  "has {} numbers (expected {}, as in the lines before; the file may "
                  "be truncated)",
                  words.size(), out.size());
}

bool are_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Sets pose or fault. The rotation must be a rotation within 1e-3.
void set_pose(const Pose& pose, PoseLine& line) {
  if (!are_finite(pose.rotation) || !are_finite(pose.position)) {
    line.fault = PoseFault::not_finite;
  } else if (is_valid(pose)) {
    line.pose = Pose{.rotation = nearest_rotation(pose.rotation), .position = pose.position};
  } else {
    const bool is_far = std::ranges::any_of(
        pose.position, [](double coordinate) { return std::abs(coordinate) > max_world_position; });
    line.fault = is_far ? PoseFault::too_far : PoseFault::not_a_rotation;
  }
}

/// Sets pose or fault. The quaternion must have unit length within 1 %.
void set_pose(const Quaternion& rotation, const std::array<double, 3>& position, PoseLine& line) {
  constexpr double tolerance = 0.01;
  const double norm = length(rotation);
  if (!std::isfinite(norm)) {
    line.fault = PoseFault::not_finite;
  } else if (std::abs(norm - 1) > tolerance) {
    line.fault = PoseFault::not_a_rotation;
  } else {
    set_pose({.rotation = matrix_of(rotation), .position = position}, line);
  }
}

void set_time(double time, PoseLine& line) {
  if (std::isfinite(time)) {
    line.time = time;
  } else {
    line.pose.reset();
    line.fault = PoseFault::not_finite;
  }
}

Pose pose_of(std::span<const double, kitti_numbers> n) {
  return {.rotation = {n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10]},
          .position = {n[3], n[7], n[11]}};
}

Status read_kitti(const Lines& at, PoseLine& line) {
  std::array<double, kitti_numbers> numbers{};
  if (Status status = read_numbers(at, numbers); !status.ok()) return status;
  set_pose(pose_of(numbers), line);
  return {};
}

Status read_tum(const Lines& at, PoseLine& line) {
  std::array<double, tum_numbers> n{};
  if (Status status = read_numbers(at, n); !status.ok()) return status;
  set_pose({.x = n[4], .y = n[5], .z = n[6], .w = n[7]}, {n[1], n[2], n[3]}, line);
  set_time(n[0], line);
  return {};
}

Quaternion quaternion_of_angles(double roll, double pitch, double yaw) {
  const auto turn = [](double angle) {
    return std::pair(std::sin(angle / 2), std::cos(angle / 2));
  };
  const auto [sr, cr] = turn(roll);
  const auto [sp, cp] = turn(pitch);
  const auto [sy, cy] = turn(yaw);
  return {.x = sr * cp * cy - cr * sp * sy,
          .y = cr * sp * cy + sr * cp * sy,
          .z = cr * cp * sy - sr * sp * cy,
          .w = cr * cp * cy + sr * sp * sy};
}

/// Reads the lines after a header.
class CsvReader {
 public:
  CsvReader() = default;
  explicit CsvReader(const PoseColumns& columns) : columns_(columns) {}

  Status read(const Lines& at, PoseLine& line) {
    using enum PoseColumn;
    cells_ = cells_of(at.line(), columns_.separator);
    if (cells_.size() != columns_.count) {
      return bad_line(at.number(), "has {} cells (expected {}, as in the header)", cells_.size(),
                      columns_.count);
    }
    line_number_ = at.number();
    status_ = {};
    const std::array position = {number(x), number(y), number(z)};
    if (columns_.has_quaternion()) {
      set_pose({.x = number(qx), .y = number(qy), .z = number(qz), .w = number(qw)}, position,
               line);
    } else {
      const double unit = columns_.angle_unit;
      set_pose(quaternion_of_angles(unit * number(roll), unit * number(pitch), unit * number(yaw)),
               position, line);
    }
    if (columns_.has(seconds)) {
      set_time(number(seconds) + (columns_.has(nanoseconds) ? 1e-9 * number(nanoseconds) : 0),
               line);
    } else if (columns_.has(time)) {
      set_time(number(time) * columns_.time_unit.value_or(1), line);
    }
    return status_;
  }

 private:
  // Empty cells are NaN, as pandas writes NaN.
  double number(PoseColumn column) {
    const std::string_view cell = cells_[columns_.index(column)];
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    const std::optional<double> value = real_number(cell);
    if (!value && status_.ok()) {
      status_ = bad_line(line_number_, "{} in column {} is not a number", quote(cell),
                         columns_.index(column) + 1);
    }
    return value.value_or(0);
  }

  PoseColumns columns_;
  std::vector<std::string_view> cells_;
  std::size_t line_number_ = 0;
  Status status_;
};

/// Seconds per unit of a time without a named unit. Times since 1970 differ by a factor of 1000
/// between units, and clocks that start at 0 count seconds.
double unit_by_size(double time) {
  constexpr std::array<std::pair<double, double>, 3> units = {
      {{1e17, 1e-9}, {1e14, 1e-6}, {1e11, 1e-3}}};
  for (const auto& [least, unit] : units) {
    if (std::abs(time) >= least) return unit;
  }
  return 1;
}

void scale_times(std::vector<PoseLine>& poses) {
  const auto first =
      std::ranges::find_if(poses, [](const PoseLine& line) { return line.time.has_value(); });
  if (first == poses.end()) return;
  const double unit = unit_by_size(first->time.value_or(0));
  for (PoseLine& line : poses) {
    if (line.time) *line.time *= unit;
  }
}

/// The format of a file without a header, from its first line.
Status find_format(const Lines& at, PoseFormat& format) {
  const std::size_t numbers = words_of(at.line(), kitti_numbers + 1).size();
  const bool has_separators = at.line().find_first_of(",;") != std::string_view::npos;
  if (!has_separators && (numbers == kitti_numbers || numbers == tum_numbers)) {
    format = numbers == kitti_numbers ? PoseFormat::kitti : PoseFormat::tum;
    return {};
  }
  if (has_separators) {
    return bad_line(at.number(),
                    "a header that names the columns is missing (expected x, y, z, and qx, qy, qz, "
                    "qw or roll, pitch, yaw; a time is optional)");
  }
  return bad_line(at.number(), "is not a pose (expected {})", formats);
}

class Parser {
 public:
  explicit Parser(std::string_view text) : lines_(text) {}

  Status parse(PoseFile& out) {
    while (lines_.next()) {
      if (is_known_ && lines_.is_comment()) continue;
      if (Status status = is_known_ ? Status() : begin(); !status.ok()) return status;
      if (is_skipped_) {
        is_skipped_ = false;
        continue;
      }
      if (file_.poses.size() == max_poses) {
        return bad_line(lines_.number(), "has more than {} poses before it", max_poses);
      }
      PoseLine line{.number = lines_.number()};
      if (Status status = read(line); !status.ok()) return status;
      file_.poses.push_back(line);
    }
    if (file_.poses.empty()) {
      return Status(StatusCode::bad_file, fmt::format("contains no poses (expected {})", formats));
    }
    if (file_.has_times && !csv_has_unit_) scale_times(file_.poses);
    out = std::move(file_);
    return {};
  }

 private:
  /// Examines a line before the first pose. A header may be a comment, as in files of EuRoC.
  Status begin() {
    const bool is_header = is_pose_header(lines_.line());
    if (lines_.is_comment() && !is_header) {
      is_skipped_ = true;
      return {};
    }
    if (is_header) {
      file_.format = PoseFormat::csv;
    } else if (Status status = find_format(lines_, file_.format); !status.ok()) {
      return status;
    }
    is_known_ = true;
    file_.has_times = file_.format == PoseFormat::tum;
    return file_.format == PoseFormat::csv ? begin_csv() : Status();
  }

  Status begin_csv() {
    is_skipped_ = true;
    PoseColumns columns;
    if (Status status = find_pose_columns(lines_.line(), columns); !status.ok()) {
      return bad_line(lines_.number(), "{}", status.message());
    }
    const bool has_seconds = columns.has(PoseColumn::seconds);
    file_.has_times = has_seconds || columns.has(PoseColumn::time);
    csv_has_unit_ = has_seconds || columns.time_unit.has_value();
    csv_ = CsvReader(columns);
    return {};
  }

  Status read(PoseLine& line) {
    switch (file_.format) {
      case PoseFormat::kitti: return read_kitti(lines_, line);
      case PoseFormat::tum: return read_tum(lines_, line);
      case PoseFormat::csv: break;
    }
    return csv_.read(lines_, line);
  }

  Lines lines_;
  PoseFile file_;
  CsvReader csv_;
  bool is_known_ = false;
  bool is_skipped_ = false;
  bool csv_has_unit_ = false;
};

/// Loads a file and parses it. Errors begin with the path.
template <class Parse>
Status read_text(const std::filesystem::path& path, const Parse& parse) {
  return within_memory([&] {
    std::vector<std::byte> bytes;
    if (Status status = load_bytes(path, bytes); !status.ok()) return status;
    return with_path(path, parse(as_text(bytes)));
  });
}

}  // namespace

std::string_view to_text(PoseFault fault) noexcept {
  switch (fault) {
    case PoseFault::none: return "is valid";
    case PoseFault::not_finite: return "is not finite";
    case PoseFault::not_a_rotation: return "has no valid rotation";
    case PoseFault::too_far: break;
  }
  return "is farther than 10,000 km from the origin";
}

Status parse_poses(std::string_view text, PoseFile& out) {
  return within_memory([&] { return Parser(text).parse(out); });
}

Status read_poses(const std::filesystem::path& path, PoseFile& out) {
  return read_text(path, [&](std::string_view text) { return parse_poses(text, out); });
}

Status parse_sensor_to_camera(std::string_view text, Pose& out) {
  return within_memory([&] {
    for (Lines lines(text); lines.next();) {
      const std::string_view line = lines.line();
      if (!line.starts_with("Tr:") && !line.starts_with("Tr_velo_to_cam:")) continue;
      std::array<double, kitti_numbers> numbers{};
      const std::vector<std::string_view> words =
          words_of(line.substr(line.find(':') + 1), kitti_numbers + 1);
      bool are_numbers = words.size() == kitti_numbers;
      for (std::size_t i = 0; are_numbers && i < kitti_numbers; ++i) {
        const std::optional<double> value = real_number(words[i]);
        are_numbers = value.has_value();
        numbers[i] = value.value_or(0);
      }
      const Pose found = pose_of(numbers);
      if (!are_numbers || !is_valid(found)) {
        return bad_line(lines.number(),
                        "Tr is not a rotation and a translation (expected 12 numbers, the rows of "
                        "the transform from the sensor to the camera)");
      }
      out = {.rotation = nearest_rotation(found.rotation), .position = found.position};
      return Status();
    }
    return Status(StatusCode::bad_file,
                  "contains no line 'Tr:' (expected the transform from the sensor to the camera; "
                  "rename the file if these are poses of the sensor)");
  });
}

Status read_sensor_to_camera(const std::filesystem::path& path, Pose& out) {
  return read_text(path, [&](std::string_view text) { return parse_sensor_to_camera(text, out); });
}

void convert_from_camera(const Pose& sensor_to_camera, std::vector<PoseLine>& poses) noexcept {
  const RotationMatrix to_sensor = transposed(sensor_to_camera.rotation);
  const auto& offset = sensor_to_camera.position;
  for (PoseLine& line : poses) {
    if (!line.pose) continue;
    const auto& r = line.pose->rotation;
    std::array<double, 3> moved{};  // pose * Tr, minus the offset of Tr
    for (std::size_t row = 0; row < 3; ++row) {
      moved[row] = line.pose->position[row] - offset[row];
      for (std::size_t k = 0; k < 3; ++k) moved[row] += r[3 * row + k] * offset[k];
    }
    Pose sensor;
    sensor.rotation = product(to_sensor, product(r, sensor_to_camera.rotation));
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) sensor.position[row] += to_sensor[3 * row + k] * moved[k];
    }
    line.pose = sensor;
  }
}

Status parse_times(std::string_view text, std::vector<double>& out) {
  return within_memory([&] {
    std::vector<double> times;
    for (Lines lines(text); lines.next();) {
      if (lines.is_comment()) continue;
      if (times.size() == max_poses) {
        return bad_line(lines.number(), "has more than {} times before it", max_poses);
      }
      const std::optional<double> time = real_number(lines.line());
      if (!time) {
        return bad_line(lines.number(), "{} is not a time (expected seconds, one number per line)",
                        quote(lines.line()));
      }
      times.push_back(std::isfinite(*time) ? *time : std::numeric_limits<double>::quiet_NaN());
    }
    const auto first = std::ranges::find_if(times, [](double time) { return std::isfinite(time); });
    const double unit = first == times.end() ? 1 : unit_by_size(*first);
    for (double& time : times) time *= unit;
    out = std::move(times);
    return Status();
  });
}

Status read_times(const std::filesystem::path& path, std::vector<double>& out) {
  return read_text(path, [&](std::string_view text) { return parse_times(text, out); });
}

}  // namespace flagstone::io
