// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/label_files.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "files/io/rows.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

constexpr std::uint8_t kitti_road = 40;
constexpr std::uint32_t kitti_class_bits = 0xffff;

/// The numbers that represent `labels`. The branch is outside the loops so that they vectorize.
template <class T>
void number(std::span<const Label> labels, LabelMap map, T* to) {
  if (map == LabelMap::flagstone) {
    for (std::size_t i = 0; i < labels.size(); ++i) to[i] = static_cast<T>(labels[i]);
  } else {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      to[i] = labels[i] == Label::ground ? T{kitti_road} : T{0};
    }
  }
}

/// bad_file unless there is one label per point. The labels begin at byte `begin`, and each has
/// `item` bytes.
Status check_count(std::size_t begin, std::size_t labels, std::size_t item,
                   std::size_t expected_points) {
  if (labels == expected_points) return {};
  const std::size_t first_wrong = begin + std::min(labels, expected_points) * item;
  return bad_byte(first_wrong,
                  "the file contains {} labels, but the scan has {} points (expected one label per "
                  "point; check whether the file belongs to this scan)",
                  labels, expected_points);
}

Status parse_label(std::span<const std::byte> bytes, std::size_t expected_points,
                   std::vector<std::uint32_t>& classes) {
  constexpr std::size_t item = sizeof(std::uint32_t);
  if (const std::size_t rest = bytes.size() % item; rest != 0) {
    return bad_byte(
        bytes.size() - rest,
        "{} bytes are not a whole number of labels (expected {} bytes: {} points, {} bytes each)",
        bytes.size(), expected_points * item, expected_points, item);
  }
  const std::size_t labels = bytes.size() / item;
  if (Status status = check_count(0, labels, item, expected_points); !status.ok()) return status;
  std::vector<std::uint32_t> read(labels);
  for (std::size_t i = 0; i < labels; ++i) {
    read[i] = load<std::uint32_t>(bytes.data() + i * item) & kitti_class_bits;
  }
  classes = std::move(read);
  return {};
}

Status parse_lidarseg(std::span<const std::byte> bytes, std::size_t expected_points,
                      std::vector<std::uint32_t>& classes) {
  Status status = check_count(0, bytes.size(), 1, expected_points);
  if (!status.ok()) return status;
  std::vector<std::uint32_t> read(bytes.size());
  for (std::size_t i = 0; i < read.size(); ++i) read[i] = std::to_integer<std::uint32_t>(bytes[i]);
  classes = std::move(read);
  return status;
}

/// Checks for one integer per point.
Status check_label_array(const NpyHeader& header) {
  const auto& shape = header.shape;
  if (header.is_structured || shape.empty() || shape.size() > 2 ||
      (shape.size() == 2 && shape[1] != 1)) {
    return bad_byte(header.shape_offset,
                    "the array has the wrong shape (expected N or N x 1: one label per point)");
  }
  const FieldType type = header.fields[0].field.type;
  if (!is_integer(type)) {
    return bad_byte(header.descr_offset, "the labels are {} (expected integers)", to_string(type));
  }
  return {};
}

/// The number at `bytes`, or nothing if it is not a valid class.
template <class T>
std::optional<std::uint32_t> class_at(std::span<const std::byte> bytes, bool big_endian) {
  std::array<std::byte, sizeof(T)> number;
  if (big_endian) {
    std::ranges::reverse_copy(bytes, number.begin());
  } else {
    std::ranges::copy(bytes, number.begin());
  }
  if constexpr (std::is_integral_v<T>) {
    const T value = load<T>(number.data());
    if (std::in_range<std::uint32_t>(value)) return static_cast<std::uint32_t>(value);
  }
  return std::nullopt;
}

Status parse_npy(std::span<const std::byte> bytes, std::size_t expected_points,
                 std::vector<std::uint32_t>& classes) {
  NpyHeader header;
  if (Status status = read_npy_header(as_text(bytes), header); !status.ok()) return status;
  if (Status status = check_label_array(header); !status.ok()) return status;
  const std::size_t labels = header.shape[0];
  const FieldType type = header.fields[0].field.type;
  const std::size_t item = size_of(type);
  if (labels != (bytes.size() - header.size) / item || (bytes.size() - header.size) % item != 0) {
    return bad_byte(header.shape_offset,
                    "the header specifies {} labels of {} bytes, but {} bytes follow", labels, item,
                    bytes.size() - header.size);
  }
  Status status = check_count(header.size, labels, item, expected_points);
  if (!status.ok()) return status;
  std::vector<std::uint32_t> read(labels);
  for (std::size_t i = 0; i < labels; ++i) {
    const std::size_t offset = header.size + i * item;
    const auto number = visit_type(type, [&]<class T>() {
      return class_at<T>(bytes.subspan(offset, item), header.fields[0].big_endian);
    });
    if (!number) {
      return bad_byte(offset, "the label of point {} is out of range (expected 0 to {})", i,
                      std::numeric_limits<std::uint32_t>::max());
    }
    read[i] = *number;
  }
  classes = std::move(read);
  return status;
}

std::optional<ClassFormat> class_format_of(const std::filesystem::path& path) {
  const PathText name = file_name(path);
  if (ends_with(name, ".label")) return ClassFormat::label;
  if (ends_with(name, ".bin")) return ClassFormat::lidarseg;
  if (ends_with(name, ".npy")) return ClassFormat::npy;
  return std::nullopt;
}

}  // namespace

Status parse_reference(std::span<const std::byte> bytes, ClassFormat format,
                       std::size_t expected_points, std::vector<std::uint32_t>& classes) {
  return within_memory([&] {
    switch (format) {
      case ClassFormat::label: return parse_label(bytes, expected_points, classes);
      case ClassFormat::lidarseg: return parse_lidarseg(bytes, expected_points, classes);
      case ClassFormat::npy: return parse_npy(bytes, expected_points, classes);
    }
    return Status(StatusCode::invalid_argument, "unknown format");
  });
}

Status read_reference(const std::filesystem::path& path, std::size_t expected_points,
                      std::vector<std::uint32_t>& classes) {
  const std::optional<ClassFormat> format = class_format_of(path);
  if (!format) {
    return refuse(path, "unknown file extension (expected .label, .bin or .npy)");
  }
  std::vector<std::byte> file;
  Status status = load_bytes(path, file);
  if (!status.ok()) return status;
  return with_path(path, parse_reference(file, *format, expected_points, classes));
}

Status read_labels(const std::filesystem::path& path, std::size_t expected_points,
                   std::vector<Label>& labels) {
  std::vector<std::uint32_t> codes;
  if (Status status = read_reference(path, expected_points, codes); !status.ok()) return status;
  return with_path(path, within_memory([&] {
                     std::vector<Label> read(codes.size());
                     for (std::size_t i = 0; i < codes.size(); ++i) {
                       if (codes[i] >= label_count) {
                         return Status(StatusCode::bad_file,
                                       fmt::format("the label of point {} is {} (expected 0 to {}; "
                                                   "the file may use another label map)",
                                                   i, codes[i], label_count - 1));
                       }
                       read[i] = static_cast<Label>(codes[i]);
                     }
                     labels = std::move(read);
                     return Status();
                   }));
}

Status write_class_file(const std::filesystem::path& path, std::span<const std::uint32_t> classes) {
  return write_file(path, std::as_bytes(classes));
}

Status LabelWriter::write_label_file(const std::filesystem::path& path,
                                     std::span<const Label> labels) {
  Status status = within_memory([&] {
    numbers_.resize(labels.size());
    number(labels, map_, numbers_.data());
    return Status();
  });
  if (!status.ok()) return with_path(path, std::move(status));
  return write_class_file(path, numbers_);
}

Status LabelWriter::write_label_npy(const std::filesystem::path& path,
                                    std::span<const Label> labels) {
  Status status = within_memory([&] {
    const std::string header = npy_header(FieldType::uint8, labels.size());
    npy_.assign(header);  // a copy keeps the memory of npy_, a move would replace it
    npy_.resize(header.size() + labels.size());
    number(labels, map_, npy_.data() + header.size());
    return Status();
  });
  if (!status.ok()) return with_path(path, std::move(status));
  return write_file(path, npy_);
}

Status write_label_file(const std::filesystem::path& path, std::span<const Label> labels,
                        LabelMap map) {
  return LabelWriter(map).write_label_file(path, labels);
}

}  // namespace flagstone::io
