// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/point_field.hpp"

#include <algorithm>

namespace flagstone::ros {

std::optional<io::FieldType> number_type(PointFieldType type) noexcept {
  switch (type) {
    case PointFieldType::int8: return io::FieldType::int8;
    case PointFieldType::uint8:
    case PointFieldType::boolean: return io::FieldType::uint8;
    case PointFieldType::int16: return io::FieldType::int16;
    case PointFieldType::uint16: return io::FieldType::uint16;
    case PointFieldType::int32: return io::FieldType::int32;
    case PointFieldType::uint32: return io::FieldType::uint32;
    case PointFieldType::float32: return io::FieldType::float32;
    case PointFieldType::float64: return io::FieldType::float64;
    case PointFieldType::int64: return io::FieldType::int64;
    case PointFieldType::uint64: return io::FieldType::uint64;
  }
  return std::nullopt;
}

std::size_t size_of(PointFieldType type) noexcept {
  const std::optional<io::FieldType> number = number_type(type);
  return number ? io::size_of(*number) : 0;
}

const PointField* find(std::span<const PointField> fields, std::string_view name) noexcept {
  const auto found = std::ranges::find(fields, name, &PointField::name);
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace flagstone::ros
