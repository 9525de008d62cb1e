// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/plot_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <unordered_map>

namespace flagstone::report {
namespace {

using Json = nlohmann::ordered_json;

// Where each scan stands in the list of all, in the order of its first appearance.
class ScanList {
 public:
  explicit ScanList(const Json& methods) {
    for (const Json& method : methods)
      for (const Json& scan : method.at("per_scan")) add(scan.at("scan").get<std::string>());
  }

  [[nodiscard]] const Json& names() const noexcept { return names_; }
  [[nodiscard]] std::size_t place(const Json& scan) const {
    return place_.at(scan.at("scan").get<std::string>());
  }

 private:
  void add(const std::string& name) {
    if (place_.try_emplace(name, names_.size()).second) names_.push_back(name);
  }

  Json names_ = Json::array();
  std::unordered_map<std::string, std::size_t> place_;
};

// A plot shows no more than five decimals of a share, and a report may hold 200,000 of them.
Json rounded(const Json& share) {
  if (!share.is_number()) return nullptr;
  return std::round(share.get<double>() * 1e5) / 1e5;
}

Json method_data(const Json& method, const ScanList& scans) {
  Json by_range = Json::array();
  for (const Json& band : method.at("by_range")) by_range.push_back(band.at("f1"));
  std::vector<Json> f1_of_scan(scans.names().size());
  for (const Json& scan : method.at("per_scan"))
    f1_of_scan[scans.place(scan)] = rounded(scan.at("f1"));
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

}  // namespace

Json eval_plot_data(const Json& results) {
  const ScanList scans(results.at("methods"));
  Json methods = Json::array();
  for (const Json& method : results.at("methods")) methods.push_back(method_data(method, scans));
  return {{"scans", scans.names()}, {"bands", range_bands(results)}, {"methods", methods}};
}

std::string band_text(const Json& band) {
  return fmt::format("{:g}–{:g} m", band.at("from").get<double>(), band.at("to").get<double>());
}

std::vector<std::string> range_bands(const Json& results) {
  std::vector<std::string> bands;
  for (const Json& method : results.at("methods")) {
    if (!bands.empty()) break;
    for (const Json& band : method.at("by_range")) bands.push_back(band_text(band));
  }
  return bands;
}

}  // namespace flagstone::report
