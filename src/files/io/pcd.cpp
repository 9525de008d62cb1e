// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pcd.hpp"

#include <string>
#include <utility>

#include "files/io/ascii_rows.hpp"
#include "files/io/binary_rows.hpp"
#include "files/io/field_type.hpp"
#include "files/io/lzf.hpp"
#include "files/io/message.hpp"
#include "files/io/pcd_header.hpp"
#include "files/io/row_layout.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

Status read_ascii(std::span<const std::byte> bytes, const PcdHeader& header,
                  std::vector<std::byte>& rows) {
  const std::string_view text = as_text(bytes);
  std::size_t offset = header.size;
  Status status = read_ascii_rows(text, header.fields, header.stride, header.points, offset, rows);
  if (!status.ok()) return status;
  return check_nothing_follows(text, offset, header.points);
}

Status read_binary(std::span<const std::byte> bytes, const PcdHeader& header,
                   std::vector<std::byte>& rows) {
  Status status = check_binary_rows(bytes, header.size, header.points, header.stride, true);
  if (!status.ok()) return status;
  const auto data = bytes.subspan(header.size, header.points * header.stride);
  rows.assign(data.begin(), data.end());
  return status;
}

/// Two uint32, the compressed and the expanded size, then a LZF stream of all points' first field,
/// all points' second, and so on.
Status read_compressed(std::span<const std::byte> bytes, const PcdHeader& header,
                       std::vector<std::byte>& rows) {
  constexpr std::size_t sizes = 2 * sizeof(std::uint32_t);
  if (bytes.size() - header.size < sizes) {
    return bad_byte(bytes.size(), "the file ends before the two sizes of its compressed data");
  }
  const auto data = bytes.subspan(header.size);
  const std::size_t compressed = load<std::uint32_t>(data.data());
  const std::size_t expanded = load<std::uint32_t>(data.data() + sizeof(std::uint32_t));
  if (expanded / header.stride != header.points || expanded % header.stride != 0) {
    return bad_byte(header.size + sizeof(std::uint32_t),
                    "the compressed data is said to expand to {} bytes, {} points of {} bytes need "
                    "another size",
                    expanded, header.points, header.stride);
  }
  if (compressed > data.size() - sizes) {
    return bad_byte(
        bytes.size(),
        "the compressed data is said to have {} bytes, there are {} (is the file cut off?)",
        compressed, data.size() - sizes);
  }
  const auto stream = data.subspan(sizes, compressed);
  std::size_t measured = 0;
  if (Status status = measure_lzf(stream, header.size + sizes, measured); !status.ok()) {
    return status;
  }
  if (measured != expanded) {
    return bad_byte(header.size + sizes, "the compressed data expands to {} bytes instead of {}",
                    measured, expanded);
  }
  std::vector<std::byte> columns(expanded);
  expand_lzf(stream, columns);
  rows = rows_from_columns(columns, header.fields, header.stride);
  return {};
}

Status read_rows(std::span<const std::byte> bytes, const PcdHeader& header,
                 std::vector<std::byte>& rows) {
  switch (header.data) {
    case PcdData::ascii: return read_ascii(bytes, header, rows);
    case PcdData::binary: return read_binary(bytes, header, rows);
    case PcdData::binary_compressed: return read_compressed(bytes, header, rows);
  }
  return {};
}

char type_letter(FieldType type) {
  switch (type) {
    case FieldType::float32:
    case FieldType::float64: return 'F';
    case FieldType::uint8:
    case FieldType::uint16:
    case FieldType::uint32:
    case FieldType::uint64: return 'U';
    default: return 'I';
  }
}

std::string header_of(const Cloud& cloud) {
  std::string names = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const Field& field : cloud.fields()) {
    names += fmt::format(" {}", field.name);
    sizes += fmt::format(" {}", size_of(field.type));
    types += fmt::format(" {}", type_letter(field.type));
    counts += fmt::format(" {}", field.count);
  }
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{}\n{}\n{}\n{}\nWIDTH {}\nHEIGHT "
      "1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      names, sizes, types, counts, cloud.size(), cloud.size());
}

}  // namespace

Status read_pcd(std::span<const std::byte> bytes, Cloud& out) {
  return within_memory([&] {
    PcdHeader header;
    if (Status status = read_pcd_header(as_text(bytes), header); !status.ok()) return status;
    std::vector<std::byte> rows;
    if (Status status = read_rows(bytes, header, rows); !status.ok()) return status;
    return Cloud::from_rows(std::move(header.fields), std::move(rows), out);
  });
}

Status write_pcd(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    const std::string header = header_of(cloud);
    const auto head = std::as_bytes(std::span(header));
    std::vector<std::byte> file;
    file.reserve(head.size() + cloud.bytes().size());
    file.assign(head.begin(), head.end());
    file.insert(file.end(), cloud.bytes().begin(), cloud.bytes().end());
    out = std::move(file);
    return Status();
  });
}

}  // namespace flagstone::io
