// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/labelled_scans.hpp"

#include <stdexcept>

#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

std::vector<std::uint32_t> made_up_classes(const io::Cloud& scan) {
  std::vector<std::uint32_t> classes;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float z = scan.view()[i].z;
    const bool is_labelled = i % 50 != 0;
    classes.push_back(!is_labelled ? 0 : z < -1.6f ? 40 : z < -1 ? 70 : 50);
  }
  return classes;
}

void put_labelled(const fs::path& folder, const std::string& name, const io::Cloud& scan) {
  put_scan(folder / "velodyne" / (name + ".bin"), scan);
  fs::create_directories(folder / "labels");
  const Status status =
      io::write_class_file(folder / "labels" / (name + ".label"), made_up_classes(scan));
  if (!status.ok()) throw std::runtime_error(status.message());
}

void put_lidarseg(const fs::path& folder, const std::string& name, const io::Cloud& scan) {
  std::vector<float> values;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Point p = scan.view()[i];
    values.insert(values.end(), {p.x, p.y, p.z, 0, 0});
  }
  io::Cloud five;
  const Status status = io::Cloud::from_floats(values, 5, five);
  if (!status.ok()) throw std::runtime_error(status.message());
  put_scan(folder / (name + ".pcd.bin"), five);
  std::string ids;
  for (const std::uint32_t id : made_up_classes(scan)) ids += id == 40 ? '\x18' : '\x1e';
  io::put_file(folder / (name + "_lidarseg.bin"), ids);
}

nlohmann::json json_of(const fs::path& file) {
  return nlohmann::json::parse(io::contents_of(file));
}

nlohmann::json without_times(nlohmann::json results) {
  for (const char* key : {"milliseconds", "threads", "date"}) results.erase(key);
  for (nlohmann::json& method : results["methods"]) {
    method.erase("hz");
    method.erase("hz_slowest_1_percent");
    for (nlohmann::json& scan : method["per_scan"]) scan.erase("milliseconds");
  }
  return results;
}

}  // namespace flagstone::cli
