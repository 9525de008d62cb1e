// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <optional>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::cli {

/// The options that say how the sensor stands, shared by all commands that segment.
struct MountOptions {
  std::optional<float> sensor_height{};  ///< metres
  std::optional<HeightSource> height{};  ///< `estimate` or `track`
  std::optional<TiltSource> tilt{};
  std::optional<std::array<float, 3>> up{};

  /// Adds --sensor-height and --tilt to a command.
  void add_to(CLI::App& command);

  /// Writes what the options say over what configurations said before. A method's height is the
  /// mount's from then on.
  void apply_to(MethodConfig& config, MountSettings& settings) const;
};

}  // namespace flagstone::cli
