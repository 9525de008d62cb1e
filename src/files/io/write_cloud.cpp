// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/write_cloud.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/io/read_cloud.hpp"

namespace flagstone::io {
namespace {

Status bytes_of(CloudFormat format, const Cloud& cloud, std::vector<std::byte>& out) {
  switch (format) {
    case CloudFormat::raw: return write_raw_points(cloud, out);
    case CloudFormat::pcd: return write_pcd(cloud, out);
    case CloudFormat::ply: return write_ply(cloud, out);
    case CloudFormat::npy: return write_npy(cloud, out);
  }
  return Status(StatusCode::invalid_argument, "unknown format");
}

}  // namespace

Status write_cloud(const std::filesystem::path& path, CloudFormat format, const Cloud& cloud) {
  std::vector<std::byte> bytes;
  Status status = bytes_of(format, cloud, bytes);
  if (!status.ok()) return with_path(path, std::move(status));
  return write_file(path, bytes);
}

Status write_cloud(const std::filesystem::path& path, const Cloud& cloud) {
  const std::optional<CloudFormat> format = format_of(path);
  if (!format) return refuse(path, "unknown file extension (expected .bin, .pcd, .ply or .npy)");
  return write_cloud(path, *format, cloud);
}

}  // namespace flagstone::io
