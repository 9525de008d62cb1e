// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/segmenter.hpp"

namespace flagstone::python {

/// What the user of Python says of a method.
struct MethodChoice {
  std::string method = "surface";
  std::string preset = "default";
  std::string sensor{};       ///< name or .toml file; empty for none
  std::string config_file{};  ///< TOML, as `flagstone config` prints; empty for none
  std::string settings{};     ///< TOML too, laid over those of the file
  /// Metres, or `estimate` or `track`; none as the settings have it.
  std::variant<std::monostate, float, std::string> sensor_height{};
  /// Where up is, or `off` or `estimate`; none as the settings have it.
  std::variant<std::monostate, std::array<float, 3>, std::string> tilt{};
};

/// The settings it comes to, checked: preset or sensor, then file, then settings, then height and
/// tilt; as the command has it. How the sensor stands is written to `mount`. Throws
/// std::invalid_argument with one line that says what is wrong.
MethodConfig resolve(const MethodChoice& choice, MountSettings& mount);

/// The method, `threads` working on one scan together. Throws std::invalid_argument where the
/// method has one thread only and more are asked for.
std::unique_ptr<Segmenter> make_method(const std::string& name, const MethodConfig& config,
                                       unsigned threads);

}  // namespace flagstone::python
