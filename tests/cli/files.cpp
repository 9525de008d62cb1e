// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/files.hpp"

#include <cstring>
#include <limits>
#include <stdexcept>

#include "files/io/file_contents.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/write_cloud.hpp"
#include "flagstone/surface.hpp"
#include "random_cloud.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

namespace {

void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

}  // namespace

io::Cloud small_scan(std::size_t points, std::uint32_t seed) {
  std::vector<Point> cloud = tests::random_cloud(points, seed);
  if (points >= 100) {
    cloud[10] = {6, 6, -9};    // far below any ground
    cloud[20] = {500, 0, -1};  // beyond the last ring
    cloud[30] = {0, 0, 0};     // missing return
    cloud[40] = {5, 5, std::numeric_limits<float>::quiet_NaN()};
  }
  std::vector<float> values;
  for (const Point& p : cloud) {
    values.insert(values.end(), {p.x, p.y, p.z, static_cast<float>(values.size() % 256) / 256});
  }
  io::Cloud scan;
  must(io::Cloud::from_floats(values, 4, scan));
  return scan;
}

void put_scan(const fs::path& file, const io::Cloud& scan) {
  fs::create_directories(file.parent_path());
  must(io::write_cloud(file, scan));
}

io::Cloud scan_of(const fs::path& file) {
  io::Cloud scan;
  must(io::read_cloud(file, {}, scan));
  return scan;
}

std::vector<Label> labels_of(const io::Cloud& scan) {
  Surface surface;
  Segmentation result;
  must(surface.segment(scan.view(), result));
  return {result.labels().begin(), result.labels().end()};
}

std::vector<std::uint32_t> codes_of(const fs::path& file) {
  const std::string bytes = io::contents_of(file);
  std::vector<std::uint32_t> codes(bytes.size() / sizeof(std::uint32_t));
  if (!codes.empty()) std::memcpy(codes.data(), bytes.data(), codes.size() * sizeof codes[0]);
  return codes;
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).string()] = io::contents_of(entry.path());
  }
  return files;
}

std::vector<std::string> names_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, contents] : files_below(folder)) names.push_back(name);
  return names;
}

}  // namespace flagstone::cli
