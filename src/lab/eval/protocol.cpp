// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/protocol.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::eval {
namespace {

/// SemanticKITTI: road, parking, sidewalk, other ground, lane marking, terrain.
const std::vector<std::uint32_t> semantic_kitti_ground = {40, 44, 48, 49, 60, 72};

/// Maps class ids to ground truth: a table up to the largest id in the protocol.
class ClassTable {
 public:
  explicit ClassTable(const Protocol& protocol) {
    for (const Protocol::LowGround& low : protocol.low_ground) entry(low.id).below = low.height;
    for (const std::uint32_t id : protocol.ignored) entry(id) = {never, Truth::ignored};
    for (const std::uint32_t id : protocol.ground) entry(id) = {never, Truth::ground};
  }

  [[nodiscard]] Truth truth(std::uint32_t id, float z) const noexcept {
    if (id >= entries_.size()) return Truth::not_ground;
    return z < entries_[id].below ? Truth::ground : entries_[id].otherwise;
  }

 private:
  static constexpr float never = -std::numeric_limits<float>::infinity();
  struct Entry {
    float below = never;  // the class is ground below this height
    Truth otherwise = Truth::not_ground;
  };

  Entry& entry(std::uint32_t id) {
    if (id >= entries_.size()) entries_.resize(id + std::size_t{1});
    return entries_[id];
  }

  std::vector<Entry> entries_;
};

}  // namespace

const Protocol& patchwork_protocol() {
  static const Protocol protocol{"patchwork", semantic_kitti_ground, {}, {{70, -1.3f}}};
  return protocol;
}

const Protocol& patchwork_plusplus_protocol() {
  static const Protocol protocol{"patchwork++", semantic_kitti_ground, {0, 1, 70}, {}};
  return protocol;
}

const Protocol& lidarseg_protocol() {
  static const Protocol protocol{"lidarseg", {24, 25, 26, 27}, {0, 31}, {}};
  return protocol;
}

const Protocol& simulation_protocol() {
  static const Protocol protocol{"simulation", semantic_kitti_ground, {}, {}};
  return protocol;
}

std::span<const Protocol* const> known_protocols() noexcept {
  static const std::array protocols = {&patchwork_protocol(), &patchwork_plusplus_protocol(),
                                       &lidarseg_protocol(), &simulation_protocol()};
  return protocols;
}

std::vector<Truth> truth_of(const Protocol& protocol, CloudView cloud,
                            std::span<const std::uint32_t> classes) {
  std::vector<Truth> truth;
  truth_of(protocol, cloud, classes, truth);
  return truth;
}

void truth_of(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes,
              std::vector<Truth>& truth) {
  const ClassTable table(protocol);
  truth.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) truth[i] = table.truth(classes[i], cloud[i].z);
}

namespace {

using Json = nlohmann::json;
constexpr std::uint32_t last_id = 65535;

[[noreturn]] void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

/// Converts TOML to JSON, so that both formats share one reader.
Json to_json(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json object = Json::object();
    for (const auto& [key, value] : *table) object[std::string(key.str())] = to_json(value);
    return object;
  }
  if (const auto* array = node.as_array()) {
    Json list = Json::array();
    for (const toml::node& element : *array) list.push_back(to_json(element));
    return list;
  }
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  return {};
}

Json parse(std::string_view text, bool is_toml) {
  try {
    return is_toml ? to_json(toml::parse(text)) : Json::parse(text);
  } catch (const toml::parse_error& error) {
    refuse(fmt::format("line {}, column {}: {}", error.source().begin.line,
                       error.source().begin.column, error.description()));
  } catch (const Json::parse_error& error) {
    refuse(fmt::format("byte {}: invalid JSON", error.byte));
  } catch (const Json::out_of_range&) {
    refuse(
        "contains a number beyond the range of a double (expected class ids and heights in "
        "metres)");
  }
}

/// A short description of a value. Lists and tables can have any depth, so only their type is
/// named.
std::string text_of(const Json& value) {
  return value.is_primitive() ? value.dump() : std::string("an ") + value.type_name();
}

std::uint32_t id_of(const Json& value, const std::string& key) {
  const bool is_id = value.is_number_integer() && value >= 0 && value <= last_id;
  if (!is_id)
    refuse(
        fmt::format("{} contains {} (expected class ids, 0 to {})", key, text_of(value), last_id));
  return value.get<std::uint32_t>();
}

std::vector<std::uint32_t> ids_of(const Json& root, const std::string& key) {
  std::vector<std::uint32_t> ids;
  const auto found = root.find(key);
  if (found == root.end()) return ids;
  if (!found->is_array()) refuse(fmt::format("{} must be a list of class ids", key));
  for (const Json& id : *found) ids.push_back(id_of(id, key));
  return ids;
}

float height_of(const Json& value) {
  constexpr double most = 1000;
  const auto height = value.get<double>();
  if (!(std::abs(height) <= most)) {
    refuse(fmt::format("low_ground.height is {} (expected -{} to {} m)", height, most, most));
  }
  return static_cast<float>(height);
}

std::vector<Protocol::LowGround> low_ground_of(const Json& root) {
  std::vector<Protocol::LowGround> all;
  const auto found = root.find("low_ground");
  if (found == root.end()) return all;
  if (!found->is_array()) refuse("low_ground must be a list of {id, height}");
  for (const Json& low : *found) {
    if (!low.is_object() || !low.contains("id") || !low.contains("height") ||
        !low["height"].is_number()) {
      refuse(fmt::format("low_ground contains {} (expected {{id, height}}, height in metres)",
                         text_of(low)));
    }
    all.push_back({id_of(low["id"], "low_ground.id"), height_of(low["height"])});
  }
  return all;
}

/// Throws if an id is listed twice.
void check_lists(const Protocol& protocol, const std::vector<std::uint32_t>& not_ground) {
  std::vector<std::uint32_t> all = protocol.ground;
  all.insert(all.end(), protocol.ignored.begin(), protocol.ignored.end());
  all.insert(all.end(), not_ground.begin(), not_ground.end());
  for (const auto& low : protocol.low_ground) {
    if (std::ranges::find(not_ground, low.id) == not_ground.end()) all.push_back(low.id);
  }
  std::ranges::sort(all);
  const auto twice = std::ranges::adjacent_find(all);
  if (twice != all.end()) refuse(fmt::format("class {} is listed twice", *twice));
  if (protocol.ground.empty() && protocol.low_ground.empty()) {
    refuse("ground is missing or empty (list the class ids that are ground)");
  }
}

/// Rejects unknown keys, so that a misspelt key is not ignored.
void check_keys(const Json& root) {
  constexpr std::array known = {"name",       "ground", "ignored", "not_ground",
                                "low_ground", "labels", "names",   "note"};
  for (const auto& [key, value] : root.items()) {
    if (std::ranges::find(known, key) == known.end()) {
      refuse(fmt::format("{} is not a key of a protocol (expected one of {})", key,
                         fmt::join(known, ", ")));
    }
  }
}

/// Results are listed under the name of the protocol, so it must be one line and unique.
void check_name(const std::string& name) {
  if (name.empty() || io::printable(name) != name) {
    refuse("name is empty or contains unprintable characters");
  }
  for (const Protocol* known : known_protocols()) {
    if (known->name == name) {
      refuse(
          fmt::format("the name {} is taken by a built-in protocol (choose another name)", name));
    }
  }
}

Protocol protocol_of(const Json& root, std::string name) {
  if (!root.is_object()) refuse("must be a table with the key ground");
  Protocol protocol;
  check_keys(root);
  if (const auto own = root.find("name"); own != root.end()) {
    if (!own->is_string()) refuse(fmt::format("name must be a string, got {}", text_of(*own)));
    name = own->get<std::string>();
  }
  check_name(name);
  protocol.name = std::move(name);
  protocol.ground = ids_of(root, "ground");
  protocol.ignored = ids_of(root, "ignored");
  protocol.low_ground = low_ground_of(root);
  check_lists(protocol, ids_of(root, "not_ground"));
  return protocol;
}

}  // namespace

Status read_protocol(const std::filesystem::path& path, Protocol& out) {
  const bool is_toml = path.extension() == ".toml";
  if (!is_toml && path.extension() != ".json") {
    return io::refuse(path, "unknown file extension of a protocol (expected .toml or .json)");
  }
  std::vector<std::byte> bytes;
  if (Status status = io::load_bytes(path, bytes); !status.ok()) return status;
  try {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    out = protocol_of(parse(text, is_toml), path.stem().string());
  } catch (const std::invalid_argument& error) {
    return io::with_path(path, Status(StatusCode::bad_file, io::printable(error.what())));
  }
  return {};
}

Status find_protocol(const std::string& name_or_file, Protocol& out) {
  std::vector<std::string_view> names;
  for (const Protocol* protocol : known_protocols()) {
    if (protocol->name == name_or_file) {
      out = *protocol;
      return {};
    }
    names.push_back(protocol->name);
  }
  if (name_or_file.ends_with(".toml") || name_or_file.ends_with(".json")) {
    return read_protocol(name_or_file, out);
  }
  names.emplace_back("or a .toml or .json file");
  return io::invalid("{}", io::printable(no_such("protocol", name_or_file, names)));
}

}  // namespace flagstone::eval
