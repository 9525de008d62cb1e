// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/map_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <new>
#include <utility>

#include "files/io/atomic_file.hpp"
#include "files/io/label_files.hpp"
#include "files/io/npy.hpp"

namespace flagstone::app {

Status write_moving(const std::filesystem::path& path, const MovingMask& moving) {
  try {
    const auto& numbers = moving.objects_of_points;
    std::string file = io::npy_header(io::FieldType::uint16, numbers.size());
    const std::size_t header = file.size();
    file.resize(header + 2 * numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto number = static_cast<std::uint16_t>(std::min<std::uint32_t>(numbers[i], 65535));
      std::memcpy(file.data() + header + 2 * i, &number, sizeof number);
    }
    return io::write_file(path, file);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status read_moving(const std::filesystem::path& path, std::size_t points, MovingMask& moving) {
  Status status = io::read_reference(path, points, moving.objects_of_points);
  if (!status.ok()) return status;
  const auto last = std::ranges::max_element(moving.objects_of_points);
  moving.objects.assign(last == moving.objects_of_points.end() ? 0 : *last, {});
  return status;
}

void ObjectTable::add(const std::string& scan, std::span<const MovingObject> objects) {
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const auto& [points, confidence, min, max] = objects[k];
    fmt::format_to(std::back_inserter(lines_),
                   "{},{},{},{:.3f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}\n", scan, k + 1,
                   points, confidence, min[0], min[1], min[2], max[0], max[1], max[2]);
  }
}

Status ObjectTable::write(const std::filesystem::path& path) const {
  return io::write_file(
      path, "scan,object,points,confidence,min_x,min_y,min_z,max_x,max_y,max_z\n" + lines_);
}

Pose levelled(const Pose& pose, const Levelling& levelling) noexcept {
  // The slope turns the z axis of the world frame; the rotation about it does not change.
  const double x = -levelling.slope_x;
  const double y = -levelling.slope_y;
  const double length = std::sqrt(1 + x * x + y * y);
  // The rotation from (0, 0, 1) to (-x, -y, 1) / length.
  const std::array<double, 3> up{-x / length, -y / length, 1 / length};
  const double k = 1 / (1 + up[2]);
  const std::array<double, 9> turn{1 - up[0] * up[0] * k,
                                   -up[0] * up[1] * k,
                                   up[0],
                                   -up[0] * up[1] * k,
                                   1 - up[1] * up[1] * k,
                                   up[1],
                                   -up[0],
                                   -up[1],
                                   up[2]};
  Pose result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        sum += turn[3 * row + i] * pose.rotation[3 * i + column];
      }
      result.rotation[3 * row + column] = sum;
    }
  }
  result.position = {pose.position[0], pose.position[1], pose.position[2] - levelling.offset};
  return result;
}

Status write_kitti_poses(const std::filesystem::path& path, std::span<const Pose> poses) {
  std::string text;
  for (const Pose& pose : poses) {
    for (std::size_t row = 0; row < 3; ++row) {
      fmt::format_to(std::back_inserter(text), "{}{:.9g} {:.9g} {:.9g} {:.9g}", row == 0 ? "" : " ",
                     pose.rotation[3 * row], pose.rotation[3 * row + 1], pose.rotation[3 * row + 2],
                     pose.position[row]);
    }
    text += '\n';
  }
  return io::write_file(path, text);
}

}  // namespace flagstone::app
