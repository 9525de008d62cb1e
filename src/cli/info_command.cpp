// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/info_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cli/histogram.hpp"
#include "cli/print_error.hpp"
#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "library/core/point_validity.hpp"

namespace flagstone::cli {
namespace {

struct InfoOptions {
  std::vector<std::string> scans;
  int columns = 0;
};

/// Counts and values of the points that have a place.
struct Survey {
  std::size_t not_finite = 0;
  std::size_t zero = 0;  ///< all three coordinates 0: no echo
  std::vector<float> ranges;
  std::vector<float> heights;
};

Survey survey(CloudView cloud) {
  Survey found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    if (!is_finite(p)) {
      ++found.not_finite;
    } else if (is_missing_return(p)) {
      ++found.zero;
    } else {
      found.ranges.push_back(std::hypot(p.x, p.y));
      found.heights.push_back(p.z);
    }
  }
  return found;
}

void print_field(const io::Cloud& cloud, const io::Field& field) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t k = 0; k < field.count; ++k) {
      const double value = cloud.value(i, field, k);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const std::string type = field.count == 1
                               ? std::string(io::to_string(field.type))
                               : fmt::format("{}[{}]", io::to_string(field.type), field.count);
  const std::string bounds =
      low <= high ? fmt::format("{:g} .. {:g}", low, high) : "no finite value";
  fmt::print("  {:<18} {:<10} {}\n", field.name, type, bounds);
}

void print_count(const char* what, std::size_t count, std::size_t all) {
  const double share = all == 0 ? 0 : 100.0 * static_cast<double>(count) / static_cast<double>(all);
  fmt::print("{:<20} {} ({:.1f} %)\n", what, count, share);
}

void print_info(const std::string& file, const io::Cloud& cloud) {
  const Survey found = survey(cloud.view());
  fmt::print("{}\n", file);
  fmt::print("{:<20} {}, {} bytes each\n", "points", cloud.size(), cloud.stride());
  print_count("not finite", found.not_finite, cloud.size());
  print_count("all zero (no echo)", found.zero, cloud.size());

  fmt::print("\nfields               type       bounds\n");
  for (const io::Field& field : cloud.fields()) {
    if (!field.is_padding()) print_field(cloud, field);
  }

  constexpr std::array range_edges = {0.0f,  2.0f,  5.0f,  10.0f, 20.0f,
                                      30.0f, 40.0f, 60.0f, 80.0f, 120.0f};
  fmt::print("\nrange from the sensor, in the x-y plane\n{}",
             histogram_text(found.ranges, range_edges));
  fmt::print("\nheight z above the sensor\n{}\n",
             histogram_text(found.heights, round_edges(found.heights, 16)));
}

int info(const InfoOptions& options) {
  int exit_code = 0;
  for (const std::string& scan : options.scans) {
    io::Cloud cloud;
    const Status status = io::read_cloud(scan, {.columns = options.columns}, cloud);
    if (status.ok()) {
      print_info(scan, cloud);
    } else {
      print_error(status.message());
      exit_code = 1;
    }
  }
  return exit_code;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      app.add_subcommand("info",
                         "Show what a scan file holds: fields, bounds, histograms.\n\n"
                         "Example:  flagstone info scan.pcd\n");
  command->add_option("scans", options->scans, "Scan files")->required()->type_name("SCAN...");
  command
      ->add_option("--columns", options->columns,
                   "Floats a point in .bin files. Default: 5 for .pcd.bin, else 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
  command->callback([options, &exit_code] { exit_code = info(*options); });
}

}  // namespace flagstone::cli
