// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/html.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flagstone::report {

std::string escaped(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char character : text) {
    switch (character) {
      case '&': html += "&amp;"; break;
      case '<': html += "&lt;"; break;
      case '>': html += "&gt;"; break;
      case '"': html += "&quot;"; break;
      case '\'': html += "&#39;"; break;
      default: html += character;
    }
  }
  return html;
}

std::string script_json(const nlohmann::ordered_json& value) {
  const std::string json =
      value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(json.size());
  // In JSON, '<' occurs within strings only.
  for (const char character : json)
    if (character == '<')
      safe += "\\u003c";
    else
      safe += character;
  return safe;
}

std::string percent_text(const nlohmann::ordered_json& share) {
  if (!share.is_number()) return std::string(no_number);
  return fmt::format("{:.2f}", 100 * share.get<double>());
}

std::string centimetre_text(const nlohmann::ordered_json& metres) {
  if (!metres.is_number()) return std::string(no_number);
  return fmt::format("{:.2f}", 100 * metres.get<double>());
}

std::string number_text(const nlohmann::ordered_json& number) {
  if (!number.is_number()) return std::string(no_number);
  const double value = number.get<double>();
  const bool whole = number.is_number_integer() || std::abs(value) >= 1000;
  return fmt::format("{:.{}f}", value, whole ? 0 : 1);
}

}  // namespace flagstone::report
