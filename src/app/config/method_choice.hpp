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

/// From what a user chooses to methods with their settings: the one way there is, for commands and
/// for Python.
namespace flagstone::config {

/// What the user says of the sensor's height and tilt.
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

/// Settings that the user gives by name.
struct GivenSettings {
  std::string method{};  ///< whose they are; empty: of the only method, and those of the mount
  Value table{};
  std::string source{};  ///< "--set gpf.segments=5", for messages
};

/// "KEY=VALUE", the value as in TOML. Throws std::invalid_argument.
GivenSettings parse_setting(const std::string& text);
/// "METHOD.KEY=VALUE" or "mount.KEY=VALUE". Throws std::invalid_argument.
GivenSettings parse_setting_of_method(const std::string& text);

/// The methods that a list names, each once: names, `table1` (the nine of the paper's Table I),
/// `all`, and `none`, which names none. Unknown names stay.
std::vector<std::string> listed_methods(std::span<const std::string> list);

/// What a user chooses. Later ones win: preset or sensor, file, given settings, height and tilt.
struct MethodChoice {
  std::vector<std::string> methods = {"surface"};  ///< as listed_methods() takes them
  std::string preset = "default";                  ///< of patchwork and czm+...
  std::string sensor{};       ///< name or .toml file to derive settings from; empty for none
  std::string config_file{};  ///< TOML, as `flagstone config` prints; empty for none
  std::vector<GivenSettings> settings{};
  MountChoice mount{};
  std::string_view option_prefix = "--";  ///< of the names of options in messages; "" in Python
};

/// A method with the settings it comes to.
struct ResolvedMethod {
  std::string name;
  MethodConfig config;
  MountSettings mount{};
};

/// The names of all methods, baselines included.
std::span<const std::string_view> method_names();

/// The methods with their settings, checked, in the order they are listed.
///
/// Settings derived from a sensor are derived for the height that the user's settings come to. With
/// one method, the file must be of that method. With several, it holds for each of them that has
/// all its settings, at least one, apart from r_gpf and r_gpf+u: their settings are fixed, and
/// change only where they are given for them. Its table `mount` holds for all. What holds for
/// `patchwork` also holds for the rows of the ablation, czm+..., except which terms are enabled.
///
/// Throws std::invalid_argument with one line that says what is wrong.
std::vector<ResolvedMethod> resolve(const MethodChoice& choice);

/// The same for a choice of one method; throws if it lists none or several.
ResolvedMethod resolve_one(const MethodChoice& choice);

/// Throws std::invalid_argument for several threads with a tracked mount: each scan depends on
/// those before.
void check_threads(const MountSettings& mount, unsigned threads);

/// The sensor that settings are derived from, if any: that of the choice or, beside its file, that
/// of the file's key `sensor`. Throws as resolve().
std::optional<Sensor> chosen_sensor(const MethodChoice& choice);

}  // namespace flagstone::config
