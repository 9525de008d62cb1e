// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "files/io/cloud.hpp"

namespace flagstone::ros {

/// The number types of sensor_msgs/PointField, with the codes in its messages. Codes 9 to 11 are
/// constants of the message since 2025; PCL has always written them.
enum class PointFieldType : std::uint8_t {
  int8 = 1,
  uint8 = 2,
  int16 = 3,
  uint16 = 4,
  int32 = 5,
  uint32 = 6,
  float32 = 7,
  float64 = 8,
  int64 = 9,
  uint64 = 10,
  boolean = 11,
};

/// Size of one number of this type in bytes: 1, 2, 4 or 8. 0 if the code is not a PointFieldType.
[[nodiscard]] std::size_t size_of(PointFieldType type) noexcept;

/// The type of the numbers in memory; nothing if the code is not a PointFieldType. Booleans are
/// uint8.
[[nodiscard]] std::optional<io::FieldType> number_type(PointFieldType type) noexcept;

/// One field of the points of a message, as sensor_msgs/PointField describes it.
struct PointField {
  std::string_view name;
  std::uint32_t offset = 0;  ///< bytes from the start of a point
  PointFieldType type = PointFieldType::float32;
  std::uint32_t count = 1;  ///< numbers per point; some drivers write 0 for 1

  /// Numbers per point, at least 1.
  [[nodiscard]] std::size_t numbers() const noexcept { return count == 0 ? 1 : count; }

  /// Size in a point in bytes; 0 if the type is unknown.
  [[nodiscard]] std::size_t size() const noexcept { return numbers() * size_of(type); }

  friend bool operator==(const PointField&, const PointField&) = default;
};

/// The first field of this name, or null.
[[nodiscard]] const PointField* find(std::span<const PointField> fields,
                                     std::string_view name) noexcept;

}  // namespace flagstone::ros
