// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lab/report/html.hpp"

namespace flagstone::report {
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

// The first row of headings: one cell over the columns of a group.
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

// The best value as it is shown: what looks equal counts as equally good.
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

  // Of one row, nothing is the best.
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
