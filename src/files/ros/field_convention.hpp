// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "files/ros/point_field.hpp"

namespace flagstone::ros {

/// Conventions for the fields of a cloud. docs/reference/point-cloud2.md lists the fields and the
/// drivers, with sources.
enum class Convention : std::uint8_t {
  none,      ///< x, y or z is missing
  xyz,       ///< x, y and z; other fields are named by none of the conventions
  velodyne,  ///< ring uint16, time float32
  ouster,    ///< t uint32, range
  hesai,     ///< ring uint16, timestamp float64; RoboSense too
  livox,     ///< tag and line uint8
  autoware,  ///< channel uint16, return_type uint8
};

/// The name of the convention as in Convention, for example "velodyne".
[[nodiscard]] const char* to_string(Convention convention) noexcept;

/// What the time of a point is relative to.
enum class TimeReference : std::uint8_t {
  header_stamp,  ///< the time stamp of the message
  clock,         ///< the epoch of the sensor's clock: the time is absolute
};

/// The fields of a cloud that a convention describes. Pointers are into the fields that were
/// examined, or null.
struct FieldConvention {
  Convention convention = Convention::none;
  const PointField* time = nullptr;
  double seconds_per_unit = 0;  ///< of the time: 1 or 1e-9
  TimeReference time_reference = TimeReference::header_stamp;
  const PointField* ring = nullptr;  ///< index of the beam or laser
  const PointField* intensity =
      nullptr;  ///< strength of the return; its scale depends on the sensor
};

/// The convention that the fields match, by their names and types. Their order and offsets, and
/// additional fields, have no effect.
[[nodiscard]] FieldConvention recognize(std::span<const PointField> fields) noexcept;

}  // namespace flagstone::ros
