// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/field_convention.hpp"

#include <array>
#include <initializer_list>
#include <string_view>

namespace flagstone::ros {
namespace {

using enum PointFieldType;

constexpr double one_second = 1;
constexpr double one_nanosecond = 1e-9;

/// The field of this name if it is one number of this type, otherwise null.
const PointField* find_one(std::span<const PointField> fields, std::string_view name,
                           PointFieldType type) noexcept {
  const PointField* const field = find(fields, name);
  return field != nullptr && field->type == type && field->numbers() == 1 ? field : nullptr;
}

/// The first of these fields that exists as one number of any known type, otherwise null.
const PointField* find_any(std::span<const PointField> fields,
                           std::initializer_list<std::string_view> names) noexcept {
  for (const std::string_view name : names) {
    const PointField* const field = find(fields, name);
    if (field != nullptr && field->size() > 0 && field->numbers() == 1) return field;
  }
  return nullptr;
}

bool has_all(std::span<const PointField> fields,
             std::initializer_list<std::string_view> names) noexcept {
  for (const std::string_view name : names) {
    if (find_any(fields, {name}) == nullptr) return false;
  }
  return true;
}

struct Match {
  Convention convention;
  const PointField* time;
  double seconds_per_unit;
  TimeReference reference;
};

/// The convention, from the fields that distinguish it.
Match match(std::span<const PointField> fields) noexcept {
  using enum TimeReference;
  if (!has_all(fields, {"x", "y", "z"})) return {Convention::none, nullptr, 0, header_stamp};
  if (find_one(fields, "tag", uint8) != nullptr && find_one(fields, "line", uint8) != nullptr) {
    if (const PointField* const offset = find_one(fields, "offset_time", uint32)) {
      return {Convention::livox, offset, one_nanosecond, header_stamp};
    }
    return {Convention::livox, find_one(fields, "timestamp", float64), one_nanosecond, clock};
  }
  const PointField* const t = find_one(fields, "t", uint32);
  if (t != nullptr && find_any(fields, {"range"}) != nullptr) {
    return {Convention::ouster, t, one_nanosecond, header_stamp};
  }
  if (find_one(fields, "channel", uint16) != nullptr &&
      find_one(fields, "return_type", uint8) != nullptr) {
    return {Convention::autoware, find_one(fields, "time_stamp", uint32), one_nanosecond,
            header_stamp};
  }
  if (find_one(fields, "ring", uint16) != nullptr) {
    if (const PointField* const time = find_one(fields, "time", float32)) {
      return {Convention::velodyne, time, one_second, header_stamp};
    }
    if (const PointField* const timestamp = find_one(fields, "timestamp", float64)) {
      return {Convention::hesai, timestamp, one_second, clock};
    }
  }
  return {Convention::xyz, nullptr, 0, header_stamp};
}

}  // namespace

const char* to_string(Convention convention) noexcept {
  switch (convention) {
    case Convention::none: return "none";
    case Convention::xyz: return "xyz";
    case Convention::velodyne: return "velodyne";
    case Convention::ouster: return "ouster";
    case Convention::hesai: return "hesai";
    case Convention::livox: return "livox";
    case Convention::autoware: return "autoware";
  }
  return "unknown";
}

FieldConvention recognize(std::span<const PointField> fields) noexcept {
  const Match matched = match(fields);
  FieldConvention result{.convention = matched.convention,
                         .time = matched.time,
                         .seconds_per_unit = matched.time != nullptr ? matched.seconds_per_unit : 0,
                         .time_reference = matched.reference};
  switch (matched.convention) {
    case Convention::none: break;
    case Convention::livox:
      result.ring = find(fields, "line");
      result.intensity = find_any(fields, {"intensity", "reflectivity"});
      break;
    case Convention::autoware:
      result.ring = find(fields, "channel");
      result.intensity = find_any(fields, {"intensity"});
      break;
    case Convention::ouster:
      result.ring = find_any(fields, {"ring"});
      result.intensity = find_any(fields, {"intensity", "signal", "reflectivity"});
      break;
    default:
      result.ring = find_any(fields, {"ring"});
      result.intensity = find_any(fields, {"intensity"});
  }
  return result;
}

}  // namespace flagstone::ros
