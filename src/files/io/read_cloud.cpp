// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/read_cloud.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "files/io/cloud_reader.hpp"
#include "files/io/file_name.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/io/raw_points.hpp"

namespace flagstone::io {
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
  constexpr std::array<std::string_view, 6> beside_scans = {
      "_lidarseg.bin", ".label.npy", ".heights.npy", ".surface.npy", ".ground.npy", ".echo.npy"};
  return format_of(path) && !name.starts_with('.') &&
         std::ranges::none_of(beside_scans,
                              [&](std::string_view ending) { return ends_with(name, ending); });
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
  CloudReader reader(options);
  Status status = reader.read(path);
  if (status.ok()) out = reader.release();
  return status;
}

}  // namespace flagstone::io
