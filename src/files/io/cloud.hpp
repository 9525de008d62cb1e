// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// The number types a field can have; in memory always little-endian.
enum class FieldType {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
};

/// Bytes of one number of this type: 1, 2, 4 or 8.
[[nodiscard]] std::size_t size_of(FieldType type) noexcept;

/// The type's name as this enumeration spells it, e.g. "float32".
[[nodiscard]] const char* to_string(FieldType type) noexcept;

/// Whether the type holds integers.
[[nodiscard]] bool is_integer(FieldType type) noexcept;

/// The name of fields that hold nothing: they only keep other fields at their place. The one name
/// that may occur more than once.
inline constexpr std::string_view padding_name = "_";

/// One field of every point: `count` numbers of one type, `offset` bytes from the row's start.
struct Field {
  std::string name;
  FieldType type = FieldType::float32;
  std::size_t count = 1;
  std::size_t offset = 0;  ///< set by Cloud, which packs the fields in their order

  /// Bytes of the whole field in a row.
  [[nodiscard]] std::size_t size() const noexcept { return count * size_of(type); }
  [[nodiscard]] bool is_padding() const noexcept { return name == padding_name; }

  friend bool operator==(const Field&, const Field&) = default;
};

/// The most fields a cloud may have, the most bytes a row, and the longest field name.
inline constexpr std::size_t max_fields = 1024;
inline constexpr std::size_t max_stride = 65536;
inline constexpr std::size_t max_name_length = 255;

/// A point cloud in memory: a table of points with every field of the file it came from, rows one
/// after the other, fields in the file's order without gaps. x, y and z are always there.
class Cloud {
 public:
  /// No points, no fields.
  Cloud() = default;

  /// Makes a cloud of `rows` whose layout `fields` describe in order; their offsets are computed.
  /// invalid_argument where x, y or z is missing or not a single number, a name occurs twice or is
  /// not 1 to 255 printable ASCII characters without space, quotes and backslash, there are more
  /// than max_fields or a row is longer than max_stride, or `rows` is not a whole number of rows;
  /// out_of_memory. `out` is only changed on success.
  static Status from_rows(std::vector<Field> fields, std::vector<std::byte> rows, Cloud& out);

  /// Makes a cloud of packed 32-bit floats, `floats_per_point` (3 or more) a point, which are named
  /// as unnamed_fields() says. Errors as from_rows().
  static Status from_floats(std::span<const float> values, std::size_t floats_per_point,
                            Cloud& out);

  /// Gives away the memory of the rows, so that it can hold those of another cloud. This one has
  /// no points and no fields then.
  [[nodiscard]] std::vector<std::byte> release_rows() noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

  /// Bytes of one row.
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }

  /// The fields in the order of the file, padding included.
  [[nodiscard]] std::span<const Field> fields() const noexcept { return fields_; }

  /// The rows: size() * stride() bytes, little-endian.
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return rows_; }

  /// The field of this name, or null.
  [[nodiscard]] const Field* find(std::string_view name) const noexcept;

  /// x, y and z as 32-bit floats: the rows themselves where they are float32, else a copy converted
  /// when the cloud was made. Valid while the cloud lives and is not assigned to.
  [[nodiscard]] CloudView view() const noexcept;

  /// Number `element` of `field` (one of fields()) of point `i`; not checked. 64-bit integers
  /// beyond 2^53 are rounded.
  [[nodiscard]] double value(std::size_t i, const Field& field,
                             std::size_t element = 0) const noexcept;

 private:
  std::vector<Field> fields_;
  std::vector<std::byte> rows_;
  std::vector<float> xyz_;  // packed x, y, z; only where the rows do not hold them as float32
  std::size_t size_ = 0;
  std::size_t stride_ = 0;
  CloudLayout layout_{};
};

/// The fields of a table without names: x, y, z, intensity, ring, then c5, c6, ... by column.
[[nodiscard]] std::vector<Field> unnamed_fields(std::size_t columns, FieldType type);

/// The name of the field with_labels() adds.
inline constexpr std::string_view label_name = "label";

/// `cloud` with its labels as last field: `label`, uint8, because five codes need no more and every
/// format has that type. A field of that name that was there before is dropped.
/// invalid_argument where labels.size() is not cloud.size(); out_of_memory. `out` may be `cloud`.
Status with_labels(const Cloud& cloud, std::span<const Label> labels, Cloud& out);

/// The name of the field with_heights() adds.
inline constexpr std::string_view height_name = "height";

/// `cloud` with a height for each point as last field: `height`, float32. As with_labels().
Status with_heights(const Cloud& cloud, std::span<const float> heights, Cloud& out);

/// The points of `cloud` at `indices`, in that order, with all fields.
/// invalid_argument where an index is not below cloud.size(); out_of_memory. `out` may be `cloud`.
Status select(const Cloud& cloud, std::span<const std::size_t> indices, Cloud& out);

/// The points of `cloud` whose place in `mask` is not 0, in their order, with all fields.
/// invalid_argument where mask.size() is not cloud.size(); out_of_memory. `out` may be `cloud`.
Status select_where(const Cloud& cloud, std::span<const std::uint8_t> mask, Cloud& out);

}  // namespace flagstone::io
