// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "io/read_cloud.hpp"

#include <string_view>

#include "io/file_name.hpp"
#include "io/load_bytes.hpp"
#include "io/message.hpp"
#include "io/npy.hpp"
#include "io/pcd.hpp"
#include "io/ply.hpp"
#include "io/raw_points.hpp"

namespace flagstone::io {
namespace {

std::size_t usual_floats(const std::filesystem::path& path) {
  return ends_with(file_name(path), ".pcd.bin") ? 5 : 4;  // nuScenes, KITTI
}

}  // namespace

std::optional<CloudFormat> format_of(const std::filesystem::path& path) noexcept {
  const std::string_view name = file_name(path);
  if (ends_with(name, ".bin")) return CloudFormat::raw;
  if (ends_with(name, ".pcd")) return CloudFormat::pcd;
  if (ends_with(name, ".ply")) return CloudFormat::ply;
  if (ends_with(name, ".npy")) return CloudFormat::npy;
  return std::nullopt;
}

bool is_scan_name(const std::filesystem::path& path) noexcept {
  const std::string_view name = file_name(path);
  const bool is_label_file = ends_with(name, "_lidarseg.bin") || ends_with(name, ".label.npy");
  return format_of(path) && !name.starts_with('.') && !is_label_file;
}

Status parse_cloud(std::span<const std::byte> bytes, CloudFormat format,
                   std::size_t floats_per_point, Cloud& out) {
  switch (format) {
    case CloudFormat::raw: return read_raw_points(bytes, floats_per_point, out);
    case CloudFormat::pcd: return read_pcd(bytes, out);
    case CloudFormat::ply: return read_ply(bytes, out);
    case CloudFormat::npy: return read_npy(bytes, out);
  }
  return Status(StatusCode::invalid_argument, "unknown format");
}

Status read_cloud(const std::filesystem::path& path, const ReadOptions& options, Cloud& out) {
  const std::optional<CloudFormat> format = format_of(path);
  if (!format) {
    return refuse(path, "no format has this ending (allowed: .bin, .pcd.bin, .pcd, .ply, .npy)");
  }
  const int columns = options.columns;
  if (columns != 0 && (columns < 3 || columns > static_cast<int>(max_fields))) {
    return refuse(path, "--columns takes 3 to 1024 floats a point, or 0: by the name");
  }
  FileBytes file;
  Status status = load_bytes(path, file);
  if (!status.ok()) return status;
  const std::size_t floats = columns == 0 ? usual_floats(path) : static_cast<std::size_t>(columns);
  return with_path(path, parse_cloud(file.span(), *format, floats, out));
}

}  // namespace flagstone::io
