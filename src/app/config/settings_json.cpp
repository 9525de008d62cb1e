// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/settings_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "library/core/setting.hpp"
#include "library/mount/mount_settings.hpp"

namespace flagstone::config {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(float number) {
  if (std::isfinite(number)) return number;
  return number > 0 ? "inf" : "-inf";
}

template <class Numbers>
Json json_of(const Numbers& numbers)
  requires std::ranges::range<Numbers>
{
  Json list = Json::array();
  for (const float number : numbers) list.push_back(json_of(number));
  return list;
}

Json json_of(int number) { return number; }
Json json_of(bool value) { return value; }

Json value_of(const Setting& setting) {
  if (const auto* choice = std::get_if<Choice>(&setting.value)) {
    return choice->names()[choice->index()];
  }
  return std::visit(
      [](const auto& value) -> Json {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(value)>>) {
          return json_of(*value);
        } else {
          return nullptr;
        }
      },
      setting.value);
}

void add_settings(const std::vector<Setting>& settings, Json& to) {
  for (const Setting& setting : settings) {
    const std::size_t dot = setting.key.find('.');
    if (dot == std::string_view::npos) {
      to[std::string(setting.key)] = value_of(setting);
    } else {
      to[std::string(setting.key.substr(0, dot))][std::string(setting.key.substr(dot + 1))] =
          value_of(setting);
    }
  }
}

}  // namespace

std::string to_json(ResolvedMethod method) {
  Json settings = Json::object();
  add_settings(method.config.settings(), settings);
  if (const auto* patchwork = method.config.get_if<PatchworkConfig>()) {
    for (const Zone& zone : patchwork->zones) {
      settings["zones"].push_back({{"ring_radii", json_of(zone.ring_radii)},
                                   {"sectors", zone.sectors},
                                   {"height_margin", json_of(zone.height_margin)}});
    }
  }
  add_settings(settings_of(method.mount), settings);
  return settings.dump();
}

}  // namespace flagstone::config
