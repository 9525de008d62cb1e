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

/// The number types of fields. In memory they are always little-endian.
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

/// Size of one number of this type in bytes: 1, 2, 4 or 8.
[[nodiscard]] std::size_t size_of(FieldType type) noexcept;

/// The name of the type as in FieldType, for example "float32".
[[nodiscard]] const char* to_string(FieldType type) noexcept;

/// Whether the type is an integer type.
[[nodiscard]] bool is_integer(FieldType type) noexcept;

/// The name of padding fields, which only keep other fields at their offsets. It is the only name
/// that may occur more than once.
inline constexpr std::string_view padding_name = "_";

/// One field of every point: `count` numbers of one type, `offset` bytes from the start of the row.
struct Field {
  std::string name;
  FieldType type = FieldType::float32;
  std::size_t count = 1;
  std::size_t offset = 0;  ///< set by Cloud, which packs the fields in order

  /// Size of the whole field in bytes.
  [[nodiscard]] std::size_t size() const noexcept { return count * size_of(type); }
  [[nodiscard]] bool is_padding() const noexcept { return name == padding_name; }

  friend bool operator==(const Field&, const Field&) = default;
};

/// Limits of a cloud: number of fields, bytes per row, characters per field name.
inline constexpr std::size_t max_fields = 1024;
inline constexpr std::size_t max_stride = 65536;
inline constexpr std::size_t max_name_length = 255;

/// A point cloud in memory: a table with one row per point and every field of its file. The rows
/// are contiguous, and the fields are in the order of the file without gaps. A cloud that is not
/// default-constructed always has x, y and z.
class Cloud {
 public:
  /// No points, no fields.
  Cloud() = default;

  /// Makes a cloud from `rows`, whose layout `fields` describe in order; computes the offsets of
  /// the fields. Changes `out` only on success. out_of_memory, or invalid_argument if
  /// - x, y or z is missing or is not a single number,
  /// - a name occurs twice,
  /// - a name is not 1 to 255 printable ASCII characters without spaces, quotes and backslashes,
  /// - there are more than max_fields fields, or a row is longer than max_stride,
  /// - `rows` is not a whole number of rows.
  static Status from_rows(std::vector<Field> fields, std::vector<std::byte> rows, Cloud& out);

  /// Makes a cloud from packed 32-bit floats, `floats_per_point` (3 to max_fields) per point, with
  /// the names of unnamed_fields(). Errors as from_rows().
  static Status from_floats(std::span<const float> values, std::size_t floats_per_point,
                            Cloud& out);

  /// Moves the rows out, so that their memory can be reused. The cloud then has no points and no
  /// fields.
  [[nodiscard]] std::vector<std::byte> release_rows() noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

  /// Size of one row in bytes.
  [[nodiscard]] std::size_t stride() const noexcept { return stride_; }

  /// The fields in the order of the file, including padding.
  [[nodiscard]] std::span<const Field> fields() const noexcept { return fields_; }

  /// The rows: size() * stride() bytes, little-endian.
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return rows_; }

  /// The field of this name, or null.
  [[nodiscard]] const Field* find(std::string_view name) const noexcept;

  /// x, y and z as 32-bit floats. If they are float32, this is a view of the rows; otherwise of a
  /// copy, converted when the cloud was made. Valid until the cloud is destroyed or assigned to.
  [[nodiscard]] CloudView view() const noexcept;

  /// Number `element` of `field` (one of fields()) of point `i`. The arguments are not checked.
  /// 64-bit integers beyond 2^53 are rounded.
  [[nodiscard]] double value(std::size_t i, const Field& field,
                             std::size_t element = 0) const noexcept;

 private:
  std::vector<Field> fields_;
  std::vector<std::byte> rows_;
  std::vector<float> xyz_;  // packed x, y, z; empty if they are float32 in the rows
  std::size_t size_ = 0;
  std::size_t stride_ = 0;
  CloudLayout layout_{};
};

/// The fields of a table without field names: x, y, z, intensity, ring, then c5, c6, ... by column.
[[nodiscard]] std::vector<Field> unnamed_fields(std::size_t columns, FieldType type);

/// The name of the field that with_labels() adds.
inline constexpr std::string_view label_name = "label";

/// `cloud` with its labels in an added last field, `label`. Its type is uint8, which every format
/// supports. Replaces an existing field of that name. invalid_argument if labels.size() is not
/// cloud.size(); out_of_memory. `out` may be `cloud`.
Status with_labels(const Cloud& cloud, std::span<const Label> labels, Cloud& out);

/// The name of the field that with_heights() adds.
inline constexpr std::string_view height_name = "height";

/// `cloud` with one height per point in an added last field, `height`, float32. As with_labels().
Status with_heights(const Cloud& cloud, std::span<const float> heights, Cloud& out);

/// The points of `cloud` at `indices`, in that order, with all fields. invalid_argument if an index
/// is not below cloud.size(); out_of_memory. `out` may be `cloud`.
Status select(const Cloud& cloud, std::span<const std::size_t> indices, Cloud& out);

/// The points of `cloud` whose value in `mask` is not 0, in their order, with all fields.
/// invalid_argument if mask.size() is not cloud.size(); out_of_memory. `out` may be `cloud`.
Status select_where(const Cloud& cloud, std::span<const std::uint8_t> mask, Cloud& out);

}  // namespace flagstone::io
