// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/config/setting_values.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/sensor.hpp"

/// Turns the choices of a user into methods with settings, for the command line and for Python.
namespace flagstone::config {

/// Height and tilt of the sensor, as chosen by the user.
struct MountChoice {
  std::optional<float> sensor_height{};  ///< metres
  std::optional<HeightSource> height{};
  std::optional<TiltSource> tilt{};
  std::optional<std::array<float, 3>> up{};

  /// Metres, "estimate" or "track". Throws std::invalid_argument for anything else.
  void set_height(std::string_view text);
  /// "off", "estimate" or up as "X,Y,Z". Throws std::invalid_argument for anything else.
  void set_tilt(std::string_view text);
  void set_height(float metres);
  void set_tilt(const std::array<float, 3>& up);
};

/// Settings given by name.
struct GivenSettings {
  std::string method{};  ///< owner; empty for the only method and for `mount`
  Value table{};
  std::string source{};  ///< "--set gpf.segments=5", for messages
};

/// Parses "KEY=VALUE", with the value in TOML. Throws std::invalid_argument.
GivenSettings parse_setting(const std::string& text);
/// Parses "METHOD.KEY=VALUE" or "mount.KEY=VALUE". Throws std::invalid_argument.
GivenSettings parse_setting_of_method(const std::string& text);

/// The methods in a list, each once. The list may contain names, `table1` (the nine methods of the
/// paper's Table I), `all` and `none`. Unknown names are kept.
std::vector<std::string> listed_methods(std::span<const std::string> list);

/// The choices of a user. They are applied in this order, and later ones win: preset or sensor,
/// file, given settings, height and tilt.
struct MethodChoice {
  std::vector<std::string> methods = {"surface"};  ///< see listed_methods()
  std::string preset = "default";                  ///< of patchwork and czm+...
  std::string sensor{};       ///< name or .toml file to derive settings from; empty for none
  std::string config_file{};  ///< TOML, as `flagstone config` prints; empty for none
  std::vector<GivenSettings> settings{};
  MountChoice mount{};
  std::string_view option_prefix = "--";  ///< before option names in messages; "" in Python
};

/// A method with its final settings.
struct ResolvedMethod {
  std::string name;
  MethodConfig config;
  MountSettings mount{};
};

/// The names of all methods, baselines included.
std::span<const std::string_view> method_names();

/// The methods with their settings, checked, in the order of the list.
///
/// - Settings derived from a sensor are derived for the sensor height that results from the user's
///   settings.
/// - One method: every setting in the file must be a setting of this method.
/// - Several methods: the file applies to each method that has all of its settings; there must be
/// at
///   least one. It does not apply to r_gpf and r_gpf+u, whose settings change only if they are
///   given for these methods. The table `mount` applies to all methods.
/// - Settings of `patchwork` also apply to the ablation rows, czm+..., except which terms are
/// enabled.
///
/// Throws std::invalid_argument with one line.
std::vector<ResolvedMethod> resolve(const MethodChoice& choice);

/// resolve() for exactly one method; throws std::invalid_argument for none or several.
ResolvedMethod resolve_one(const MethodChoice& choice);

/// Throws std::invalid_argument for several threads with a tracked mount, because each scan then
/// depends on the scans before it.
void check_threads(const MountSettings& mount, unsigned threads);

/// The sensor that settings are derived from, if any: MethodChoice::sensor, or the key `sensor` of
/// the configuration file (a file name is relative to that file). Throws like resolve().
std::optional<Sensor> chosen_sensor(const MethodChoice& choice);

}  // namespace flagstone::config
