// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/read_cloud.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/io/rows.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

/// Checks that `size` bytes are a whole number of points.
Status check_size(std::size_t size, std::size_t floats_per_point) {
  if (floats_per_point < 3 || floats_per_point > max_fields) {
    return invalid("{} floats per point (expected 3 to {} columns)", floats_per_point, max_fields);
  }
  const std::size_t stride = floats_per_point * sizeof(float);
  const std::size_t rest = size % stride;
  if (rest == 0) return {};
  return bad_byte(size - rest,
                  "{} bytes are not a whole number of points (expected {} floats, {} bytes each; "
                  "check the number of columns, and whether the file is truncated)",
                  size, floats_per_point, stride);
}

}  // namespace

Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (Status status = check_size(bytes.size(), floats_per_point); !status.ok()) return status;
    return adopt_raw_points({bytes.begin(), bytes.end()}, floats_per_point, out);
  });
}

Status adopt_raw_points(std::vector<std::byte> bytes, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (Status status = check_size(bytes.size(), floats_per_point); !status.ok()) return status;
    return Cloud::from_rows(unnamed_fields(floats_per_point, FieldType::float32), std::move(bytes),
                            out);
  });
}

Status write_raw_points(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    const auto fields = cloud.fields();
    for (const Field& field : fields) {
      if (field.type != FieldType::float32) {
        return invalid(
            "field {} is {} (expected float32 in raw files; write PCD, PLY or NPY instead)",
            quote(field.name), to_string(field.type));
      }
    }
    constexpr std::array<std::string_view, 3> first_three{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (fields.size() <= i || fields[i].name != first_three[i]) {
        return invalid(
            "the fields are in a different order (expected x, y and z first in raw files; write "
            "PCD, PLY or NPY instead)");
      }
    }
    out.assign(cloud.bytes().begin(), cloud.bytes().end());
    return Status();
  });
}

std::optional<CloudFormat> format_of(const std::filesystem::path& path) noexcept {
  const PathText name = file_name(path);
  if (ends_with(name, ".bin")) return CloudFormat::raw;
  if (ends_with(name, ".pcd")) return CloudFormat::pcd;
  if (ends_with(name, ".ply")) return CloudFormat::ply;
  if (ends_with(name, ".npy")) return CloudFormat::npy;
  return std::nullopt;
}

bool is_scan_name(const std::filesystem::path& path) noexcept {
  const PathText name = file_name(path);
  constexpr std::array<std::string_view, 9> beside_scans = {
      "_lidarseg.bin", ".label.npy",  ".heights.npy", ".surface.npy", ".ground.npy",
      ".return.npy",   ".motion.npy", ".time.npy",    ".moving.npy"};
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
    return refuse(path, "unknown file extension (expected .bin, .pcd.bin, .pcd, .ply or .npy)");
  }
  const int columns = options_.columns;
  if (columns != 0 && (columns < 3 || columns > static_cast<int>(max_fields))) {
    return refuse(path,
                  fmt::format("{} floats per point (expected 3 to {} columns, or 0 to choose by "
                              "file extension)",
                              columns, max_fields));
  }
  // After raw points the memory of the file belongs to the cloud; after other formats it is here.
  if (bytes_.capacity() == 0) bytes_ = cloud_.release_rows();
  if (Status status = load_bytes(path, bytes_); !status.ok()) return status;
  file_size_ = bytes_.size();
  const std::size_t floats = columns == 0 ? usual_floats(path) : static_cast<std::size_t>(columns);
  return with_path(path, *format == CloudFormat::raw
                             ? adopt_raw_points(std::exchange(bytes_, {}), floats, cloud_)
                             : parse_cloud(bytes_, *format, floats, cloud_));
}

}  // namespace flagstone::io
