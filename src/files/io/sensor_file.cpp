// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/sensor_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::io {
namespace {

constexpr std::array<std::string_view, 14> keys = {
    "name",       "title",     "beams",       "elevation_top", "elevation_bottom",
    "elevations", "firings",   "rosette",     "azimuth_begin", "azimuth_end",
    "min_range",  "max_range", "range_sigma", "height"};

constexpr double most_beams = 1024;

/// The keys of one file. An invalid key or value throws std::invalid_argument with its position.
class Fields {
 public:
  Fields(const toml::table& table, std::string_view source) : table_(table), source_(source) {
    for (const auto& [key, node] : table) {
      if (std::ranges::find(keys, key.str()) != keys.end()) continue;
      const std::string_view closest = closest_name(key.str(), keys);
      const std::string hint = closest.empty() ? "" : fmt::format("; did you mean '{}'?", closest);
      refuse(node, fmt::format("{} is not a key of a sensor (expected one of {}{})",
                               quote(key.str()), fmt::join(keys, ", "), hint));
    }
  }

  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }

  [[noreturn]] void refuse(const toml::node& node, const std::string& reason) const {
    const toml::source_position at = node.source().begin;
    throw std::invalid_argument(
        fmt::format("{}: line {}, column {}: {}", source_, at.line, at.column, reason));
  }
  [[noreturn]] void refuse(std::string_view key, const std::string& reason) const {
    const toml::node* node = table_.get(key);
    refuse(node == nullptr ? static_cast<const toml::node&>(table_) : *node, reason);
  }

  void read(std::string_view key, std::string& value) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    const auto text = node->value_exact<std::string>();
    if (!text || text->empty() || printable(*text) != *text) {
      refuse(*node, fmt::format("{} must be a string on one line", key));
    }
    value = *text;
  }

  void read(std::string_view key, double& value) const {
    if (const toml::node* node = table_.get(key)) value = number(key, *node);
  }

  void read(std::string_view key, int& value) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    const auto whole = node->value_exact<std::int64_t>();
    if (!whole) refuse(*node, fmt::format("{} must be an integer", key));
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    value = static_cast<int>(std::clamp(*whole, -most, most));
  }

  void read(std::string_view key, std::vector<double>& values) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr) refuse(*node, fmt::format("{} must be an array of numbers", key));
    values.clear();
    for (const toml::node& element : *array) values.push_back(number(key, element));
  }

 private:
  double number(std::string_view key, const toml::node& node) const {
    if (!node.is_number()) refuse(node, fmt::format("{} must be a number", key));
    return node.value_or(0.0);
  }

  const toml::table& table_;
  std::string_view source_;
};

/// An angle that the short form of elevations requires.
double angle_of(const Fields& fields, std::string_view key) {
  double angle = std::numeric_limits<double>::quiet_NaN();
  fields.read(key, angle);
  if (!(std::abs(angle) <= 90)) {
    fields.refuse(key, fmt::format("{} is missing or out of range (expected -90 to 90 degrees; set "
                                   "beams, elevation_top and elevation_bottom, or elevations with "
                                   "one value per beam)",
                                   key));
  }
  return angle;
}

/// elevations = [...], or the short form.
std::vector<double> elevations_of(const Fields& fields, bool draws_rosette) {
  std::vector<double> elevations;
  const bool is_short =
      fields.has("beams") || fields.has("elevation_top") || fields.has("elevation_bottom");
  if (fields.has("elevations")) {
    if (is_short) {
      fields.refuse("elevations",
                    "elevations cannot be combined with beams, elevation_top or elevation_bottom "
                    "(remove one or the other)");
    }
    fields.read("elevations", elevations);
    return elevations;
  }
  const double top = angle_of(fields, "elevation_top");
  const double bottom = angle_of(fields, "elevation_bottom");
  int beams = draws_rosette ? 2 : 0;
  fields.read("beams", beams);
  if (beams < 1 || beams > most_beams) {
    fields.refuse("beams",
                  fmt::format("beams is missing or out of range (expected 1 to {})", most_beams));
  }
  if (beams == 1 ? top != bottom : !(top > bottom)) {
    fields.refuse(
        "elevation_top",
        fmt::format("elevation_top = {} (expected a value above elevation_bottom = {}, or "
                    "equal to it with one beam)",
                    top, bottom));
  }
  for (int i = 0; i < beams; ++i) {
    elevations.push_back(beams == 1 ? top : top - (top - bottom) * i / (beams - 1));
  }
  return elevations;
}

/// The key of the value that Sensor::check() rejected: the longest key in its message.
std::string_view key_in(std::string_view complaint, const Fields& fields) {
  std::string_view found = "name";
  for (const std::string_view key : keys) {
    const bool is_named = fields.has(key) && complaint.find(key) != std::string_view::npos;
    if (is_named && (found == "name" || key.size() > found.size())) found = key;
  }
  return found;
}

Sensor sensor_of(const Fields& fields, const std::string& name) {
  Sensor sensor{.name = name,
                .title = {},
                .elevations = {},
                .min_range = 0.5,
                .max_range = 100,
                .range_sigma = 0.02};
  fields.read("name", sensor.name);
  sensor.title = sensor.name;
  fields.read("title", sensor.title);
  fields.read("rosette", sensor.rosette);
  sensor.elevations = elevations_of(fields, sensor.draws_rosette());
  fields.read("azimuth_begin", sensor.azimuth_begin);
  fields.read("azimuth_end", sensor.azimuth_end);
  constexpr double firings_a_degree = 5;
  constexpr int points_of_rosette = 24000;
  const double width = std::clamp(sensor.azimuth_end - sensor.azimuth_begin, 0.0, 360.0);
  sensor.firings = sensor.draws_rosette()
                       ? points_of_rosette
                       : std::max(1, static_cast<int>(std::lround(firings_a_degree * width)));
  fields.read("firings", sensor.firings);
  fields.read("min_range", sensor.min_range);
  fields.read("max_range", sensor.max_range);
  fields.read("range_sigma", sensor.range_sigma);
  if (!fields.has("height")) {
    fields.refuse("height", "height is missing (expected metres above the ground, 0 to 100)");
  }
  fields.read("height", sensor.height);
  try {
    sensor.check();
  } catch (const std::invalid_argument& error) {
    fields.refuse(key_in(std::string_view(error.what()).substr(sensor.name.size()), fields),
                  error.what());
  }
  return sensor;
}

}  // namespace

Status parse_sensor(std::string_view text, std::string_view source, Sensor& out) {
  return within_memory([&] {
    try {
      const toml::table table = toml::parse(text, source);
      out = sensor_of(Fields(table, source), std::filesystem::path(source).stem().string());
      return Status();
    } catch (const toml::parse_error& error) {
      const toml::source_position at = error.source().begin;
      return Status(StatusCode::bad_file,
                    printable(fmt::format("{}: line {}, column {}: {}", source, at.line, at.column,
                                          error.description())));
    } catch (const std::invalid_argument& error) {
      return Status(StatusCode::bad_file, printable(error.what()));
    }
  });
}

Status read_sensor(const std::filesystem::path& path, Sensor& out) {
  return within_memory([&] {
    std::vector<std::byte> bytes;
    Status status = load_bytes(path, bytes);
    if (!status.ok()) return status;
    return parse_sensor({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string(),
                        out);
  });
}

Status find_sensor(const std::string& name_or_file, Sensor& out) {
  if (std::filesystem::path(name_or_file).extension() == ".toml") {
    return read_sensor(name_or_file, out);
  }
  try {
    out = Sensor::named(name_or_file);
    return {};
  } catch (const std::invalid_argument& error) {
    std::string message = error.what();
    message.insert(message.size() - (message.ends_with(')') ? 1 : 0), "; or name a .toml file");
    return Status(StatusCode::invalid_argument, printable(message));
  }
}

}  // namespace flagstone::io
