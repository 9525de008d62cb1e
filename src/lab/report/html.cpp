// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

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
  // In JSON, '<' occurs only within strings.
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

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  while (!bytes.empty()) {
    // Three bytes are four digits of six bits each; n bytes need n + 1 digits, and the rest is
    // padding.
    const std::size_t taken = std::min<std::size_t>(bytes.size(), 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (i < taken ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= taken ? digits[bits >> (18 - 6 * i) & 0x3F] : '=';
    bytes = bytes.subspan(taken);
  }
  return text;
}

namespace {

using Json = nlohmann::ordered_json;

Json value_at(const Json& row, const std::string& path) {
  const Json::json_pointer pointer(path);
  return row.contains(pointer) ? row.at(pointer) : Json();
}

std::string shown(const Json& value, Format format) {
  switch (format) {
    case Format::text: return value.is_string() ? escaped(value.get<std::string>()) : "";
    case Format::percent: return percent_text(value);
    case Format::number: return number_text(value);
    case Format::length: return centimetre_text(value);
  }
  return {};
}

// The first row of headings, with one cell per group of columns.
std::string group_headings(std::span<const Column> columns) {
  std::string html;
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t end = first + 1;
    while (end < columns.size() && columns[end].group == columns[first].group) ++end;
    html += columns[first].group.empty()
                ? fmt::format(R"(<td colspan="{}"></td>)", end - first)
                : fmt::format(R"(<th colspan="{}" scope="colgroup">{}</th>)", end - first,
                              escaped(columns[first].group));
    first = end;
  }
  return "<tr>" + html + "</tr>\n";
}

std::string headings(std::span<const Column> columns) {
  std::string html;
  for (const Column& column : columns)
    html += fmt::format("<th scope=\"col\"{}>{}</th>",
                        column.format == Format::text ? " class=\"name\"" : "",
                        escaped(column.heading));
  return "<tr>" + html + "</tr>\n";
}

// The best value as it is shown, so that values that look equal count as equally good.
std::string best_shown(const Json& rows, const Column& column) {
  const bool low_is_good = column.format == Format::length;
  Json best;
  for (const Json& row : rows) {
    const Json value = value_at(row, column.path);
    if (!value.is_number()) continue;
    const bool is_better =
        best.is_null() || (low_is_good ? value.get<double>() < best.get<double>()
                                       : value.get<double>() > best.get<double>());
    if (is_better) best = value;
  }
  return best.is_null() ? "" : shown(best, column.format);
}

std::string cell(const Json& value, const Column& column, const std::string& best) {
  const std::string text = shown(value, column.format);
  if (column.format == Format::text) return fmt::format("<th scope=\"row\">{}</th>", text);
  return column.mark_best && text == best ? fmt::format("<td><b>{}</b></td>", text)
                                          : fmt::format("<td>{}</td>", text);
}

}  // namespace

std::string table(const Json& rows, std::span<const Column> columns) {
  std::string html = "<div class=\"scroll\"><table>\n<thead>\n";
  const auto has_group = [](const Column& column) { return !column.group.empty(); };
  if (std::ranges::any_of(columns, has_group)) html += group_headings(columns);
  html += headings(columns) + "</thead>\n<tbody>\n";

  // A single row has no best value.
  std::vector<std::string> best;
  for (const Column& column : columns)
    best.push_back(column.mark_best && rows.size() > 1 ? best_shown(rows, column) : "");
  for (const Json& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < columns.size(); ++i)
      html += cell(value_at(row, columns[i].path), columns[i], best[i]);
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

}  // namespace flagstone::report
