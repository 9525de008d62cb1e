// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "real_scans.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace flagstone::tests {
namespace {

std::vector<std::string> split_at_commas(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

std::filesystem::path real_scan_folder() {
  const char* folder = std::getenv(
      "FLAGSTONE_DATA");  // NOLINT(concurrency-mt-unsafe): tests are single-threaded here
  if (folder != nullptr && *folder != '\0') return folder;
  return std::filesystem::path(FLAGSTONE_SOURCE_DIR) / ".." / "shared" / "data";
}

std::vector<RealScan> real_scans(const std::string& set) {
  const std::filesystem::path folder = real_scan_folder();
  std::ifstream index(folder / "index.csv");
  std::vector<RealScan> scans;
  std::string line;
  std::getline(index, line);  // names of the columns
  while (std::getline(index, line)) {
    const std::vector<std::string> cells = split_at_commas(line);
    if (cells.size() < 8 || (!set.empty() && cells[0] != set)) continue;
    scans.push_back({.set = cells[0],
                     .name = cells[1],
                     .points = folder / cells[2],
                     .labels = cells[3].empty() ? std::filesystem::path() : folder / cells[3],
                     .sensor_height = std::strtof(cells[6].c_str(), nullptr),
                     .point_count = std::stoul(cells[7])});
  }
  return scans;
}

}  // namespace flagstone::tests
