// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/cloud_reader.hpp"

#include <optional>

#include "files/io/file_name.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/raw_points.hpp"

namespace flagstone::io {
namespace {

std::size_t usual_floats(const std::filesystem::path& path) {
  return ends_with(file_name(path), ".pcd.bin") ? 5 : 4;  // nuScenes, KITTI
}

}  // namespace

Status CloudReader::read(const std::filesystem::path& path) {
  Status status = load(path);
  if (!status.ok()) {
    cloud_ = {};
    file_size_ = 0;
  }
  return status;
}

Status CloudReader::load(const std::filesystem::path& path) {
  const std::optional<CloudFormat> format = format_of(path);
  if (!format) {
    return refuse(path, "no format has this ending (allowed: .bin, .pcd.bin, .pcd, .ply, .npy)");
  }
  const int columns = options_.columns;
  if (columns != 0 && (columns < 3 || columns > static_cast<int>(max_fields))) {
    return refuse(path, "--columns takes 3 to 1024 floats a point, or 0: by the name");
  }
  // Raw points borrowed the memory of their file; other formats left it here.
  if (bytes_.capacity() == 0) bytes_ = cloud_.release_rows();
  if (Status status = load_bytes(path, bytes_); !status.ok()) return status;
  file_size_ = bytes_.size();
  const std::size_t floats = columns == 0 ? usual_floats(path) : static_cast<std::size_t>(columns);
  return with_path(path, *format == CloudFormat::raw
                             ? adopt_raw_points(std::exchange(bytes_, {}), floats, cloud_)
                             : parse_cloud(bytes_, *format, floats, cloud_));
}

}  // namespace flagstone::io
