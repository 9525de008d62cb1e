// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/example_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace flagstone::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, const char*>, 9> names = {{
    {"ransac", "RANSAC"},
    {"gpf", "GPF"},
    {"line_fit", "LineFit"},
    {"cascaded", "CascadedSeg"},
    {"r_gpf", "R-GPF"},
    {"r_gpf_u", "R-GPF + U"},
    {"czm_u", "CZM + U"},
    {"czm_u_e", "CZM + U + E"},
    {"patchwork", "Patchwork"},
}};

// A ratio from 0.6 to 1 that depends on its position.
double ratio(std::size_t method, std::size_t position) {
  const double wave = std::sin(1.7 * static_cast<double>(position) + static_cast<double>(method));
  return 0.78 + 0.02 * static_cast<double>(method) + 0.04 * wave;
}

Json spread(double mean, std::size_t scans) {
  if (scans < 2) return {{"mean", mean}, {"std", nullptr}, {"ci95", nullptr}};
  return {{"mean", mean}, {"std", 0.03}, {"ci95", 0.012}};
}

Json scores(std::size_t method, std::size_t position) {
  return {{"precision", ratio(method, position)},
          {"recall", ratio(method, position + 1)},
          {"f1", ratio(method, position + 2)},
          {"accuracy", ratio(method, position + 3)},
          {"iou", ratio(method, position + 4)}};
}

std::string scan_name(std::size_t scan) {
  const std::string digits = std::to_string(scan);
  return "00/" + std::string(6 - digits.size(), '0') + digits;
}

Json by_range(std::size_t method) {
  Json bands = Json::array();
  constexpr std::array<int, 5> ends = {0, 10, 20, 40, 80};
  for (std::size_t band = 0; band + 1 < ends.size(); ++band) {
    Json scored = {{"from", ends[band]}, {"to", ends[band + 1]}};
    scored.update(scores(method, 3 * band));
    scored["points"] = 1000;
    bands.push_back(scored);
  }
  return bands;
}

Json method_results(std::size_t index, std::size_t scans) {
  const auto& [name, title] = names.at(index);
  Json method = {{"name", name}, {"title", title}};
  std::size_t position = 0;
  for (const char* metric : {"precision", "recall", "f1", "accuracy", "iou"})
    method[metric] = spread(ratio(index, position++), scans);
  method["pooled"] = scores(index, 5);
  method["pooled"]["points"] = 120000 * scans;
  method["by_range"] = by_range(index);
  method["by_area"] = scores(index, 6);
  method["by_area"]["cells"] = 40000 * scans;
  method["hz"] = 20.0 * std::pow(1.9, static_cast<double>(index));
  method["hz_slowest_1_percent"] = 15.0 * std::pow(1.85, static_cast<double>(index));
  method["worst"] = {scan_name(0)};
  method["per_scan"] = Json::array();
  for (std::size_t scan = 0; scan < scans; ++scan) {
    Json scored = {{"scan", scan_name(scan)}};
    scored.update(scores(index, scan));
    scored["milliseconds"] = 3.1;
    method["per_scan"].push_back(scored);
  }
  return method;
}

Json header(std::size_t scans) {
  return {{"flagstone", "0.1.0"},
          {"date", "2026-11-21"},
          {"machine", "Example CPU, 2 cores"},
          {"protocol", "patchwork"},
          {"datasets", {"kitti", "simulated"}},
          {"scans", scans}};
}

}  // namespace

Json example_eval(std::size_t methods, std::size_t scans) {
  Json results = header(scans);
  results["failed"] = Json::array();
  results["methods"] = Json::array();
  for (std::size_t method = 0; method < methods; ++method)
    results["methods"].push_back(method_results(method, scans));
  return results;
}

Json example_sweep(std::size_t first, std::size_t second, bool numeric) {
  Json results = header(10);
  results["method"] = "r_gpf";
  results["keys"] = {"bins"};
  if (second > 0) results["keys"].push_back("uprightness.angle");
  results["cells"] = Json::array();
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = 0; j < std::max<std::size_t>(second, 1); ++j) {
      const std::string rings = std::to_string(10 * (i + 1));
      Json values = {numeric ? rings : rings + "x36"};
      if (second > 0) values.push_back(std::to_string(30 + 5 * j));
      results["cells"].push_back({{"values", values},
                                  {"precision", spread(ratio(i, j), 10)},
                                  {"recall", spread(ratio(i, j + 1), 10)},
                                  {"f1", spread(ratio(i, j + 2), 10)}});
    }
  }
  results["winner"] = "20x36 won by 1.3 intervals";
  return results;
}

std::vector<std::byte> one_pixel_png() {
  constexpr std::array<unsigned char, 69> png = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
      0x9c, 0x63, 0x50, 0x68, 0x38, 0x00, 0x00, 0x02, 0x24, 0x01, 0x61, 0xdd, 0x14, 0x9a,
      0x90, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const auto bytes = std::as_bytes(std::span(png));
  return {bytes.begin(), bytes.end()};
}

}  // namespace flagstone::report
