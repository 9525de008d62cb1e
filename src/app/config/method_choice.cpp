// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/method_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "app/config/config_toml.hpp"
#include "files/io/sensor_file.hpp"
#include "flagstone/baselines.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/methods/method.hpp"

namespace flagstone::config {
namespace {

std::optional<float> number_of(std::string_view text) {
  float number = 0;
  const char* const end = std::to_address(text.end());
  const auto [rest, error] = std::from_chars(std::to_address(text.begin()), end, number);
  if (error != std::errc() || rest != end) return {};
  return number;
}

/// "0,0.17,0.98"
std::optional<std::array<float, 3>> direction_of(std::string_view text) {
  std::array<float, 3> direction{};
  for (std::size_t i = 0; i < direction.size(); ++i) {
    const std::size_t comma = text.find(',');
    const bool is_last = i + 1 == direction.size();
    if ((comma == std::string_view::npos) != is_last) return {};
    const auto number = number_of(text.substr(0, comma));
    if (!number) return {};
    direction[i] = *number;
    if (!is_last) text.remove_prefix(comma + 1);
  }
  return direction;
}

/// Do settings of `owner` also apply to this method?
bool includes(std::string_view owner, const Method& method) {
  return owner == method.name || owner == method.starts_from;
}

/// Turns a choice into the settings of each of its methods.
class Resolver {
 public:
  explicit Resolver(const MethodChoice& choice) : choice_(choice) {
    for (const std::string& name : listed_methods(choice.methods)) {
      methods_.push_back(&find_method(name));
    }
    if (!choice.config_file.empty()) file_ = parse_toml_file(choice.config_file);
    sensor_ = chosen_sensor(choice);
    check_preset();
    for (const GivenSettings& given : choice.settings) check_owner(given);
    check_file();
  }

  ResolvedMethod resolve(const Method& method) const {
    ResolvedMethod resolved = sensor_
                                  ? at_own_height(method, *sensor_)
                                  : overlaid(method, preset_config(method.name, choice_.preset));
    resolved.config.check();
    resolved.mount.check();
    return resolved;
  }

  [[nodiscard]] std::vector<ResolvedMethod> resolve_all() const {
    std::vector<ResolvedMethod> all;
    all.reserve(methods_.size());
    for (const Method* method : methods_) all.push_back(resolve(*method));
    return all;
  }

 private:
  void check_preset() const {
    const auto has_presets = [](const Method* method) {
      return method->preset != nullptr || !method->starts_from.empty();
    };
    if (choice_.preset == "default" || std::ranges::any_of(methods_, has_presets)) return;
    static_cast<void>(
        preset_config("patchwork", choice_.preset));  // throws if there is no such preset
    throw std::invalid_argument(
        fmt::format("{0}preset {1}: {2} {3} no presets (expected {0}method patchwork or czm+...)",
                    choice_.option_prefix, choice_.preset, fmt::join(choice_.methods, ", "),
                    methods_.size() == 1 ? "has" : "have"));
  }

  void check_owner(const GivenSettings& given) const {
    const auto is_owned = [&](const Method* method) { return includes(given.method, *method); };
    if (given.method.empty() || std::ranges::any_of(methods_, is_owned)) return;
    throw std::invalid_argument(fmt::format("{}: {} is not one of the methods in {}methods",
                                            given.source, given.method, choice_.option_prefix));
  }

  void check_file() const {
    if (!file_) return;
    const auto fits = [&](const Method* method) { return file_fits(*method); };
    if (methods_.size() == 1 || std::ranges::any_of(methods_, fits)) return;
    MethodConfig config = default_config(methods_.front()->name);
    MountSettings mount;
    apply(*file_, config, mount);  // throws for a key that is not a setting
    throw std::invalid_argument(fmt::format("{}: applies to none of the methods {}",
                                            choice_.config_file, fmt::join(choice_.methods, ", ")));
  }

  [[nodiscard]] bool file_fits(const Method& method) const {
    if (methods_.size() == 1) return true;
    const bool is_variant = !includes(method.type->name, method);  // r_gpf
    return !is_variant && file_ && has_settings_of(*file_, default_config(method.name));
  }

  /// `config`, overridden by the user's settings.
  [[nodiscard]] ResolvedMethod overlaid(const Method& method, MethodConfig config) const {
    MountSettings mount;
    if (file_ && file_fits(method)) {
      apply(*file_, config, mount);
    } else if (file_ && file_->find("mount") != nullptr) {
      apply({.held = Value::Table{{"mount", *file_->find("mount")}}}, config, mount);
    }
    const auto apply_given = [&](std::string_view owner) {
      for (const GivenSettings& given : choice_.settings) {
        if (given.method == owner) apply(given.table, config, mount);
      }
    };
    if (method.derive) {
      apply_given(method.starts_from);
      config = method.derive(config);
    }
    apply_given(method.name);
    apply_given("");
    apply_mount(config, mount);
    return {.name = std::string(method.name), .config = std::move(config), .mount = mount};
  }

  /// Sets height and tilt. Afterwards both results have the same sensor height.
  void apply_mount(MethodConfig& config, MountSettings& mount) const {
    const MountChoice& chosen = choice_.mount;
    if (chosen.sensor_height) set_sensor_height(*chosen.sensor_height, config);
    mount.mount.sensor_height =
        sensor_height_of(config, chosen.sensor_height.value_or(mount.mount.sensor_height));
    if (chosen.height) mount.height = *chosen.height;
    if (chosen.tilt) mount.tilt = *chosen.tilt;
    if (chosen.up) mount.mount.up = *chosen.up;
  }

  /// Settings derived for the sensor at the height that results from the settings themselves.
  [[nodiscard]] ResolvedMethod at_own_height(const Method& method, Sensor sensor) const {
    const auto settings_at = [&](const Sensor& at) {
      return overlaid(
          method,
          default_config(method.starts_from.empty() ? method.name : method.starts_from, at));
    };
    ResolvedMethod resolved = settings_at(sensor);
    const auto usual = static_cast<float>(sensor.height);
    const float height = sensor_height_of(resolved.config, usual);
    // At 0 or below, the origin of the frame is not at the sensor: use its usual height.
    if (height == usual || !(height > 0)) return resolved;
    sensor.height = height;
    return settings_at(sensor);
  }

  const MethodChoice& choice_;
  std::vector<const Method*> methods_;
  std::optional<Value> file_;
  std::optional<Sensor> sensor_;
};

void refuse_sensor(const Value& table, const std::string& source) {
  if (table.find("sensor") == nullptr) return;
  throw std::invalid_argument(
      source + ": cannot set the sensor (use --sensor, or the key 'sensor' in a --config file)");
}

}  // namespace

void MountChoice::set_height(float metres) {
  sensor_height = metres;
  height = HeightSource::fixed;
}

void MountChoice::set_height(std::string_view text) {
  if (text == to_string(HeightSource::estimate)) {
    height = HeightSource::estimate;
  } else if (text == to_string(HeightSource::track)) {
    height = HeightSource::track;
  } else if (const auto metres = number_of(text)) {
    set_height(*metres);
  } else {
    throw std::invalid_argument(
        fmt::format("'{}' is not a height (expected metres, estimate or track)", text));
  }
}

void MountChoice::set_tilt(const std::array<float, 3>& direction) {
  tilt = TiltSource::fixed;
  up = direction;
}

void MountChoice::set_tilt(std::string_view text) {
  if (text == to_string(TiltSource::off)) {
    tilt = TiltSource::off;
  } else if (text == to_string(TiltSource::estimate)) {
    tilt = TiltSource::estimate;
  } else if (const auto direction = direction_of(text)) {
    set_tilt(*direction);
  } else {
    throw std::invalid_argument(
        fmt::format("'{}' is not a tilt (expected off, estimate or the up direction X,Y,Z)", text));
  }
}

GivenSettings parse_setting(const std::string& text) {
  const std::string source = "--set " + text;
  GivenSettings given{.method = {}, .table = parse_toml(text, source), .source = source};
  refuse_sensor(given.table, source);
  return given;
}

GivenSettings parse_setting_of_method(const std::string& text) {
  if (text.starts_with("mount.")) return parse_setting(text);
  const std::size_t dot = text.find('.');
  const std::string method = text.substr(0, dot);
  if (dot == std::string::npos) {
    throw std::invalid_argument(fmt::format(
        "--set {}: has no method (expected METHOD.KEY=VALUE, e.g. gpf.segments=5)", text));
  }
  if (std::ranges::find(method_names(), method) == method_names().end()) {
    throw std::invalid_argument(
        fmt::format("--set {}: {}", text, no_such("method", method, method_names())));
  }
  const std::string source = "--set " + text;
  GivenSettings given{
      .method = method, .table = parse_toml(text.substr(dot + 1), source), .source = source};
  refuse_sensor(given.table, source);
  return given;
}

std::span<const std::string_view> method_names() {
  register_baselines();
  return flagstone::method_names();
}

std::vector<std::string> listed_methods(std::span<const std::string> list) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name) {
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  };
  for (const std::string& entry : list) {
    if (entry == "all") {
      std::ranges::for_each(method_names(), add);
    } else if (entry == "table1") {
      std::ranges::for_each(table_1_methods(), add);
    } else if (entry != "none") {
      add(entry);
    }
  }
  return names;
}

std::vector<ResolvedMethod> resolve(const MethodChoice& choice) {
  register_baselines();
  return Resolver(choice).resolve_all();
}

ResolvedMethod resolve_one(const MethodChoice& choice) {
  // "all" and "table1" are lists, not methods.
  register_baselines();
  for (const std::string& name : choice.methods) find_method(name);
  std::vector<ResolvedMethod> methods = resolve(choice);
  if (methods.size() != 1) throw std::invalid_argument("no method given (expected one)");
  return std::move(methods.front());
}

void check_threads(const MountSettings& mount, unsigned threads) {
  if (!mount.tracks() || threads <= 1) return;
  throw std::invalid_argument(fmt::format(
      "--threads {}: a tracked sensor height needs one thread (remove --threads, or use "
      "--sensor-height estimate)",
      threads));
}

std::optional<Sensor> chosen_sensor(const MethodChoice& choice) {
  std::optional<std::string> in_file;
  if (!choice.config_file.empty()) in_file = sensor_named_in(parse_toml_file(choice.config_file));
  if (choice.sensor.empty() && !in_file) return std::nullopt;
  const std::string option = fmt::format("{}sensor", choice.option_prefix);
  if (!choice.sensor.empty() && in_file) {
    throw std::invalid_argument(fmt::format("{} {}: {} also sets a sensor (expected one of them)",
                                            option, choice.sensor, choice.config_file));
  }
  const std::string origin = in_file ? choice.config_file + ": sensor" : option;
  if (choice.preset != "default") {
    throw std::invalid_argument(fmt::format("{}: cannot be combined with {}preset {}", origin,
                                            choice.option_prefix, choice.preset));
  }
  std::string name = in_file ? *in_file : choice.sensor;
  const bool is_beside_file = in_file && std::filesystem::path(name).extension() == ".toml";
  if (is_beside_file) {
    name = (std::filesystem::path(choice.config_file).parent_path() / name).string();
  }
  Sensor sensor;
  const Status status = io::find_sensor(name, sensor);
  if (!status.ok()) throw std::invalid_argument(fmt::format("{}: {}", origin, status.message()));
  return sensor;
}

}  // namespace flagstone::config
