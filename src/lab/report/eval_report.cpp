// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/eval_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <unordered_map>

#include "lab/report/embedded_files.hpp"
#include "lab/report/html.hpp"
#include "lab/report/page.hpp"

namespace flagstone::report {
namespace {

using Json = nlohmann::ordered_json;

/// A range band as text: "0–10 m".
std::string band_text(const Json& band) {
  return fmt::format("{:g}–{:g} m", band.at("from").get<double>(), band.at("to").get<double>());
}

/// The range bands of the first method that has any.
std::vector<std::string> range_bands(const Json& results) {
  std::vector<std::string> bands;
  for (const Json& method : results.at("methods")) {
    if (!bands.empty()) break;
    for (const Json& band : method.at("by_range")) bands.push_back(band_text(band));
  }
  return bands;
}

// The names of all scans in order of first appearance, and the index of each.
class ScanList {
 public:
  explicit ScanList(const Json& methods) {
    for (const Json& method : methods)
      for (const Json& scan : method.at("per_scan")) add(scan.at("scan").get<std::string>());
  }

  [[nodiscard]] const Json& names() const noexcept { return names_; }
  [[nodiscard]] std::size_t index_of(const Json& scan) const {
    return index_.at(scan.at("scan").get<std::string>());
  }

 private:
  void add(const std::string& name) {
    if (index_.try_emplace(name, names_.size()).second) names_.push_back(name);
  }

  Json names_ = Json::array();
  std::unordered_map<std::string, std::size_t> index_;
};

// Five decimals are enough for a plot, and a report can contain 200,000 ratios.
Json rounded(const Json& share) {
  if (!share.is_number()) return nullptr;
  return std::round(share.get<double>() * 1e5) / 1e5;
}

Json method_data(const Json& method, const ScanList& scans) {
  Json by_range = Json::array();
  for (const Json& band : method.at("by_range")) by_range.push_back(band.at("f1"));
  std::vector<Json> f1_of_scan(scans.names().size());
  for (const Json& scan : method.at("per_scan"))
    f1_of_scan[scans.index_of(scan)] = rounded(scan.at("f1"));
  return {{"title", method.at("title")},
          {"precision", method.at("precision").at("mean")},
          {"recall", method.at("recall").at("mean")},
          {"f1", method.at("f1").at("mean")},
          {"ci95", method.at("f1").at("ci95")},
          {"hz", method.at("hz")},
          {"hz_slowest", method.at("hz_slowest_1_percent")},
          {"by_range", by_range},
          {"scans", f1_of_scan}};
}

/// The data of the plots, a small part of the results: the names of all scans once and, per method,
/// title, precision, recall, f1, ci95, hz, hz_slowest, by_range (F1 per band) and scans (F1 per
/// scan; null if the method has none).
Json plot_data(const Json& results) {
  const ScanList scans(results.at("methods"));
  Json methods = Json::array();
  for (const Json& method : results.at("methods")) methods.push_back(method_data(method, scans));
  return {{"scans", scans.names()}, {"bands", range_bands(results)}, {"methods", methods}};
}

// Table I of the paper, with further metrics per method.
std::string method_table(const Json& methods) {
  using enum Format;
  const std::array<Column, 13> columns = {{
      {"", "Method", "/title", text, false},
      {"Precision, %", "mean", "/precision/mean", percent, true},
      {"Precision, %", "σ", "/precision/std", percent, false},
      {"Recall, %", "mean", "/recall/mean", percent, true},
      {"Recall, %", "σ", "/recall/std", percent, false},
      {"F1, %", "mean", "/f1/mean", percent, true},
      {"F1, %", "σ", "/f1/std", percent, false},
      {"F1, %", "± 95 %", "/f1/ci95", percent, false},
      {"Mean, %", "Accuracy", "/accuracy/mean", percent, true},
      {"Mean, %", "IoU", "/iou/mean", percent, true},
      {"Per BEV cell, %", "F1", "/by_area/f1", percent, true},
      {"Speed, Hz", "mean", "/hz", number, true},
      {"Speed, Hz", "slowest 1 %", "/hz_slowest_1_percent", number, true},
  }};
  return table(methods, columns);
}

// The same metrics with other weights: each point counts once, or each BEV cell.
std::string pooled_table(const Json& results) {
  using enum Format;
  std::vector<Column> columns = {
      {"", "Method", "/title", text, false},
      {"Micro-average, %", "Precision", "/pooled/precision", percent, true},
      {"Micro-average, %", "Recall", "/pooled/recall", percent, true},
      {"Micro-average, %", "F1", "/pooled/f1", percent, true},
      {"Micro-average, %", "Accuracy", "/pooled/accuracy", percent, true},
      {"Micro-average, %", "IoU", "/pooled/iou", percent, true},
  };
  const std::vector<std::string> bands = range_bands(results);
  for (std::size_t band = 0; band < bands.size(); ++band)
    columns.push_back(
        {"F1 by range, %", bands[band], fmt::format("/by_range/{}/f1", band), percent, true});
  columns.push_back({"Per BEV cell, %", "Precision", "/by_area/precision", percent, true});
  columns.push_back({"Per BEV cell, %", "Recall", "/by_area/recall", percent, true});
  columns.push_back({"Per BEV cell, %", "F1", "/by_area/f1", percent, true});
  return table(results.at("methods"), columns);
}

// Height errors over one set of points, such as "ground" or "everywhere", in each range band.
std::string height_table(const Json& methods, const Json& bands, std::string_view points) {
  using enum Format;
  std::vector<Column> columns = {{"", "Method", "/title", text, false}};
  for (std::size_t band = 0; band < bands.size(); ++band) {
    const std::string group = fmt::format("{}, cm", band_text(bands[band]));
    const auto path = [&](std::string_view figure) {
      return fmt::format("/heights/{}/by_range/{}/{}", points, band, figure);
    };
    columns.push_back({group, "Median", path("median/mean"), length, true});
    columns.push_back({group, "95 %", path("percentile95/mean"), length, true});
    columns.push_back({group, "Bias", path("bias/mean"), length, false});
    columns.push_back({group, "Coverage, %", path("with_height"), percent, true});
  }
  return table(methods, columns);
}

// Tables of the points for which every method provides a height, if several methods have heights.
std::string common_height_tables(const Json& methods, const Json& bands) {
  const auto has_common = [](const Json& method) {
    return method.at("heights").contains("common_ground");
  };
  if (std::ranges::none_of(methods, has_common)) return {};
  return fmt::format(
      "<h3>Ground points for which every method provides a height</h3>\n{}"
      "<h3>All points for which every method provides a height</h3>\n{}",
      height_table(methods, bands, "common_ground"),
      height_table(methods, bands, "common_everywhere"));
}

std::string height_section(const Json& methods) {
  Json judged = Json::array();
  for (const Json& method : methods)
    if (method.contains("heights")) judged.push_back(method);
  if (judged.empty()) return {};
  const Json& bands = judged.front().at("heights").at("ground").at("by_range");
  return fmt::format(
      "<section>\n<h2>Heights above the ground</h2>\n<h3>Ground points</h3>\n{}"
      "<h3>All points</h3>\n{}{}"
      "<p class=\"note\">Estimated height minus true height, by distance from the sensor, averaged "
      "over the scans. Median and 95 %: median and 95th percentile of the absolute error. Bias: "
      "mean error; a positive bias means that the estimated ground is too low. Coverage: fraction "
      "of the points for which the method provides a height. All points: ground points and points "
      "on objects that hide the ground.</p>\n"
      "</section>\n",
      height_table(judged, bands, "ground"), height_table(judged, bands, "everywhere"),
      common_height_tables(judged, bands));
}

/// One row per source and range band; the last band of a source covers all bands.
Json moving_rows(const Json& sources) {
  Json rows = Json::array();
  for (const Json& source : sources) {
    const auto add = [&](const Json& figures, const std::string& band) {
      Json row = figures;
      row["title"] = fmt::format("{}, {}", source.at("name").get<std::string>(), band);
      rows.push_back(std::move(row));
    };
    for (const Json& band : source.at("by_range")) add(band, band_text(band));
    add(source, "all");
  }
  return rows;
}

std::string moving_section(const Json& results) {
  if (!results.contains("moving")) return {};
  using enum Format;
  const std::array<Column, 8> columns = {{
      {"", "Source and range", "/title", text, false},
      {"Micro-average, %", "IoU", "/iou", percent, false},
      {"Micro-average, %", "Recall", "/recall", percent, false},
      {"Micro-average, %", "Precision", "/precision", percent, false},
      {"Micro-average, %", "Kept", "/kept", percent, false},
      {"IoU over scans, %", "mean", "/mean_iou/mean", percent, false},
      {"IoU over scans, %", "± 95 %", "/mean_iou/ci95", percent, false},
      {"Points", "moving", "/moving_points", number, false},
  }};
  return fmt::format(
      "<section>\n<h2>Moving points</h2>\n{}"
      "<p class=\"note\">Moving points in the ground truth are those with the moving classes of "
      "SemanticKITTI. Kept: static points that are not ground and not marked as moving. IoU over "
      "scans: mean over the scans with moving points, and the half-width of its 95 % confidence "
      "interval. Points beyond the last range are not scored.</p>\n</section>\n\n",
      table(moving_rows(results.at("moving")), columns));
}

std::string f1_of_scan(const Json& method, const std::string& name) {
  for (const Json& scan : method.at("per_scan"))
    if (scan.at("scan") == name) return percent_text(scan.at("f1"));
  return std::string(no_number);
}

std::string worst_scans(const Json& methods) {
  std::string html;
  for (const Json& method : methods) {
    html += fmt::format("<div><h3>{}</h3>\n<ol>\n", escaped(method.at("title").get<std::string>()));
    for (const Json& scan : method.at("worst")) {
      const auto name = scan.get<std::string>();
      html += fmt::format("<li><code>{}</code> <span>{}</span></li>\n", escaped(name),
                          f1_of_scan(method, name));
    }
    html += "</ol></div>\n";
  }
  return html;
}

std::string failed_scans(const Json& failed) {
  if (failed.empty()) return {};
  std::string html =
      "<section>\n<h2>Failures</h2>\n<p>Scans that cannot be read are excluded from all results. "
      "If a method fails on a scan, that scan is excluded from the results of the method.</p>\n"
      "<ul class=\"failed\">\n";
  for (const Json& scan : failed)
    html +=
        fmt::format("<li><code>{}</code> {}</li>\n", escaped(scan.at("scan").get<std::string>()),
                    escaped(scan.at("error").get<std::string>()));
  return html + "</ul>\n</section>\n";
}

std::string picture_gallery(std::span<const ReportPicture> pictures) {
  if (pictures.empty()) return {};
  std::string html =
      "<section>\n<h2>Images</h2>\n<p>Bird's-eye views of scans, with x (forward) up. Green: "
      "ground labelled ground (true positives); blue: missed ground (false negatives); red: other "
      "points labelled ground (false positives); grey: other points (true negatives).</p>\n";
  for (const ReportPicture& picture : pictures) {
    const std::string title = escaped(picture.title);
    html += fmt::format(
        "<figure>\n<img loading=\"lazy\" alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n"
        "<figcaption>{0}</figcaption>\n</figure>\n",
        title, base64(picture.png));
  }
  return html + "</section>\n";
}

std::string title_of(const Json& results) {
  if (results.at("methods").empty()) {
    return fmt::format("Moving points of {} ({})", dataset_names(results), scan_count(results));
  }
  return fmt::format("Ground segmentation of {} ({}), protocol {}", dataset_names(results),
                     scan_count(results), results.at("protocol").get<std::string>());
}

}  // namespace

std::string eval_report(const Json& results, std::span<const ReportPicture> pictures) {
  const Json& methods = results.at("methods");
  const std::string title = title_of(results);
  const std::string heading = escaped(title);
  const std::string fact_list = facts(results);
  const std::string moving_html = moving_section(results);
  const std::string failed_html = failed_scans(results.at("failed"));
  if (methods.empty()) {
    return page(title,
                fmt::format("<h1>{}</h1>\n<dl class=\"facts\">\n{}</dl>\n\n{}{}", heading,
                            fact_list, moving_html, failed_html),
                Json::object(), "");
  }
  const std::string methods_html = method_table(methods);
  const std::string pooled_html = pooled_table(results);
  const std::string heights_html = height_section(methods);
  const std::string worst_html = worst_scans(methods);
  const std::string pictures_html = picture_gallery(pictures);
  const std::string rows = std::to_string(methods.size());
  const std::array slots = {
      Slot{"heading", heading},           Slot{"facts", fact_list},
      Slot{"method_table", methods_html}, Slot{"pooled_table", pooled_html},
      Slot{"heights", heights_html},      Slot{"moving", moving_html},
      Slot{"worst", worst_html},          Slot{"failed", failed_html},
      Slot{"pictures", pictures_html},    Slot{"rows", rows},
  };
  return page(title, fill(embedded::eval_html, slots), plot_data(results), embedded::eval_js);
}

}  // namespace flagstone::report
