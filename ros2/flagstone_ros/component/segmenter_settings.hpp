// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/config/method_choice.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"

namespace flagstone_ros {

/// A value of a ROS parameter, of one of the types that the declaration uses.
using ParameterValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;
using ParameterValues = std::map<std::string, ParameterValue, std::less<>>;

/// A setting of a method or of the mounting pose, as a parameter under its own name.
struct SettingParameter {
  std::string name;
  ParameterValue value;  ///< in use
  std::string description;
  std::string constraints;  ///< the allowed values in words
  double low = 0;           ///< of a number
  double high = 0;
  bool is_number = false;
};

/// The settings of a segmenter. They follow from the parameters that the user gave: those that are
/// not given have the value of the config file, the sensor, the preset or the method, in this
/// order.
class SegmenterSettings {
 public:
  /// `given`: parameters of the declaration and settings; unknown names are ignored, because nodes
  /// also have parameters of ROS. Throws std::invalid_argument with one line, which begins with the
  /// name of the parameter if a single one is the reason.
  explicit SegmenterSettings(const ParameterValues& given);

  /// The settings as parameters, in the order of `flagstone config`. They do not include zones and
  /// what `sensor_height` and `tilt` set.
  [[nodiscard]] std::vector<SettingParameter> settings() const;

  /// The values in use of `sensor_height`, `tilt` and all settings, by name.
  [[nodiscard]] ParameterValues values() const;

  /// Throws std::invalid_argument or std::bad_alloc.
  [[nodiscard]] std::unique_ptr<flagstone::GravityAlignedSegmenter> make() const;

  /// Whether the up direction comes from an IMU.
  [[nodiscard]] bool uses_imu() const noexcept { return uses_imu_; }

  /// Whether height or tilt are estimated from the clouds.
  [[nodiscard]] bool estimates_mount() const noexcept { return method_.mount.estimates(); }

  /// Metres per unit of the clouds.
  [[nodiscard]] double scale() const noexcept {
    return static_cast<double>(method_.mount.mount.scale);
  }

 private:
  bool uses_imu_ = false;
  flagstone::config::ResolvedMethod method_;
  unsigned threads_ = 1;
};

/// The names of the parameters that SegmenterSettings reads, except the settings of methods.
[[nodiscard]] bool is_segmenter_parameter(std::string_view name);

}  // namespace flagstone_ros
