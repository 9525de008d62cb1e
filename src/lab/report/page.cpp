// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "lab/report/embedded_files.hpp"
#include "lab/report/html.hpp"

namespace flagstone::report {
namespace {

std::string fact(std::string_view name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(value));
}

}  // namespace

std::string fill(std::string_view text, std::span<const Slot> slots) {
  std::string filled;
  for (;;) {
    const std::size_t open = text.find("{{");
    const std::size_t close = text.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos) break;
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto slot = std::ranges::find(slots, name, &Slot::name);
    if (slot == slots.end()) throw std::logic_error("no slot for {{" + std::string(name) + "}}");
    filled += text.substr(0, open);
    filled += slot->value;
    text.remove_prefix(close + 2);
  }
  return filled += text;
}

std::string page(std::string_view title, std::string_view body, const nlohmann::ordered_json& plots,
                 std::string_view script) {
  const std::string safe_title = escaped(title);
  const std::string safe_plots = script_json(plots);
  const std::array slots = {
      Slot{"title", safe_title},
      Slot{"style", embedded::style_css},
      Slot{"body", body},
      Slot{"data", safe_plots},
      Slot{"chart_js", embedded::chart_js},
      Slot{"plots_js", embedded::plots_js},
      Slot{"script", script},
  };
  return fill(embedded::page_html, slots);
}

std::string facts(const nlohmann::ordered_json& results) {
  return fact("Protocol", results.at("protocol").get<std::string>()) +
         fact("Scans", number_text(results.at("scans"))) +
         fact("Datasets", dataset_names(results)) +
         fact("Machine", results.at("machine").get<std::string>()) +
         fact("Date", results.at("date").get<std::string>()) +
         fact("flagstone", results.at("flagstone").get<std::string>());
}

std::string scan_count(const nlohmann::ordered_json& results) {
  const auto count = results.at("scans").get<std::size_t>();
  return fmt::format("{} {}", count, count == 1 ? "scan" : "scans");
}

std::string dataset_names(const nlohmann::ordered_json& results) {
  const auto names = results.at("datasets").get<std::vector<std::string>>();
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace flagstone::report
