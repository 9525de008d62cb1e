// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/height_files.hpp"

#include <cstring>
#include <utility>

#include "files/io/field_type.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/npy_header.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

Status parse_heights(std::span<const std::byte> bytes, std::size_t expected_points,
                     std::vector<float>& heights) {
  NpyHeader header;
  if (Status status = read_npy_header(as_text(bytes), header); !status.ok()) return status;
  if (header.is_structured || header.shape.size() != 1) {
    return bad_byte(header.shape_offset, "the array has not one dimension (one height a point)");
  }
  const NpyField& item = header.fields[0];
  if (item.field.type != FieldType::float32 || item.big_endian) {
    return bad_byte(header.descr_offset, "the heights are no little-endian float32 ('<f4')");
  }
  const std::size_t count = header.shape[0];
  if (count != expected_points) {
    return bad_byte(header.shape_offset,
                    "the file holds {} heights, the scan has {} points (one height a point; does "
                    "the file belong to this scan?)",
                    count, expected_points);
  }
  const std::span<const std::byte> items = bytes.subspan(header.size);
  if (items.size() % sizeof(float) != 0 || items.size() / sizeof(float) != count) {
    return bad_byte(header.shape_offset,
                    "the header announces {} heights of {} bytes, {} bytes follow", count,
                    sizeof(float), items.size());
  }
  std::vector<float> read(count);
  if (count > 0) std::memcpy(read.data(), items.data(), items.size());
  heights = std::move(read);
  return {};
}

}  // namespace

std::size_t height_file_size(std::size_t points) {
  return npy_header(FieldType::float32, points).size() + points * sizeof(float);
}

Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights) {
  std::vector<std::byte> file;
  if (Status status = load_bytes(path, file); !status.ok()) return status;
  return with_path(path,
                   within_memory([&] { return parse_heights(file, expected_points, heights); }));
}

}  // namespace flagstone::io
