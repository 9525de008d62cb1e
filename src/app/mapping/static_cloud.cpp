// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/static_cloud.hpp"

#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "files/io/cloud.hpp"
#include "files/io/write_cloud.hpp"

namespace flagstone::app {

std::size_t StaticCloud::Hash::operator()(const Voxel& voxel) const noexcept {
  const std::uint64_t mixed = static_cast<std::uint64_t>(voxel.x) * 0x9E3779B97F4A7C15U ^
                              static_cast<std::uint64_t>(voxel.y) * 0xC2B2AE3D27D4EB4FU ^
                              static_cast<std::uint64_t>(voxel.z) * 0x165667B19E3779F9U;
  return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
}

void StaticCloud::add(const std::vector<StaticPoint>& points) {
  const auto index = [&](double metres) {
    return static_cast<std::int64_t>(std::floor(metres / voxel_));
  };
  for (const StaticPoint& point : points) {
    const Voxel voxel{.x = index(point.x), .y = index(point.y), .z = index(point.z)};
    if (taken_.insert(voxel).second) points_.push_back(point);
  }
}

Status StaticCloud::write(const std::filesystem::path& path) const {
  constexpr std::size_t row_size = 3 * sizeof(double) + sizeof(float) + 1;
  io::Cloud cloud;
  try {
    std::vector<std::byte> rows(points_.size() * row_size);
    std::byte* to = rows.data();
    const auto append = [&](const auto& value) {
      std::memcpy(to, &value, sizeof value);
      to += sizeof value;
    };
    for (const StaticPoint& point : points_) {
      append(point.x);
      append(point.y);
      append(point.z);
      append(point.height);
      append(static_cast<std::uint8_t>(point.label));
    }
    using enum io::FieldType;
    const Status status = io::Cloud::from_rows({{.name = "x", .type = float64},
                                                {.name = "y", .type = float64},
                                                {.name = "z", .type = float64},
                                                {.name = "height", .type = float32},
                                                {.name = "label", .type = uint8}},
                                               std::move(rows), cloud);
    if (!status.ok()) return status;
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  return io::write_cloud(path, cloud);
}

}  // namespace flagstone::app
