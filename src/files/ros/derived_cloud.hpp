// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "files/ros/point_cloud2.hpp"
#include "flagstone/label.hpp"
#include "flagstone/status.hpp"

namespace flagstone::ros {

/// A field to add: one number per point of the source, contiguous, in the byte order of this
/// machine.
struct AddedField {
  std::string_view name;
  PointFieldType type = PointFieldType::uint8;
  std::span<const std::byte> values;
};

/// The field `label`, uint8: the code of each label.
[[nodiscard]] AddedField label_field(std::span<const Label> labels) noexcept;

/// The field `height`, float32: metres above the ground.
[[nodiscard]] AddedField height_field(std::span<const float> heights) noexcept;

/// Which points of a cloud are kept.
class Selection {
 public:
  /// The points whose value is not 0; one value per point.
  explicit Selection(std::span<const std::uint8_t> mask) noexcept;

  /// The points with one of these labels; one label per point.
  Selection(std::span<const Label> labels, std::initializer_list<Label> kept) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }

  /// Sets each element of `out` to 1 if the point is kept, otherwise to 0, beginning with point
  /// `first`.
  void get(std::size_t first, std::span<std::uint8_t> out) const noexcept;

  /// Number of points that are kept.
  [[nodiscard]] std::size_t count() const noexcept;

 private:
  std::span<const std::byte> values_;
  std::array<bool, label_count> keeps_{};  // by label code
  bool is_mask_ = false;
};

/// A cloud with the points of another cloud, the source: all of them with added fields (append()),
/// or some of them (select()). Every existing field is unchanged. The header, the byte orders, the
/// encoding and is_dense are copied from the source.
///
/// append() and select() compute the layout without copying points; the other functions then write
/// the result as often as needed, into memory of the caller. The source, its bytes and the added
/// values must outlive that. Reuses its memory: after the first messages nothing is allocated. Not
/// thread-safe while append() or select() runs; use one instance per thread.
///
/// Added fields follow the point of the source, each at the next multiple of its size. The new
/// point_step is a multiple of the largest of these sizes; bytes between are 0. A field of the
/// source with the name of an added field is replaced: in its position if it is one number of the
/// same type and no other field overlaps it; otherwise it is removed from the list of fields, and
/// its bytes remain in the points.
class DerivedCloud {
 public:
  /// All points of `source`, with the added fields. Keeps height and width; rows are not padded.
  /// `source` must satisfy check(). invalid_argument if a field does not have one value per point,
  /// has an unknown type or the name of another added field, or if the result exceeds the limits of
  /// a message (4 GiB, max_point_fields); out_of_memory. Never throws. On failure the result is
  /// empty.
  Status append(const PointCloud2View& source, std::span<const AddedField> added);

  /// The points of `source` in the selection, in their order, with the added fields, whose values
  /// are one per point of `source`. The result is not organized: height is 1. Errors as append();
  /// also invalid_argument if the selection does not have the size of `source`.
  Status select(const PointCloud2View& source, const Selection& selection,
                std::span<const AddedField> added = {});

  /// The members of the result, without data.
  [[nodiscard]] const PointCloud2View& layout() const noexcept { return layout_; }

  [[nodiscard]] std::size_t data_size() const noexcept {
    return layout_.size() * layout_.point_step;
  }

  /// Writes the data of the result to `to`, which must have data_size() bytes and must not overlap
  /// the source.
  void write_data(std::span<std::byte> to) const noexcept;

  /// Size of the serialized result in bytes.
  [[nodiscard]] std::size_t message_size() const noexcept {
    return serialized_size(layout_, data_size());
  }

  /// Writes the result as a message, in the format of the source, to `to`, which must have
  /// message_size() bytes and must not overlap the source.
  void write_message(std::span<std::byte> to) const noexcept;

  /// As the other overload, into a vector, which is resized.
  Status write_message(std::vector<std::byte>& out) const;

 private:
  /// Where a field is written in every point of the result.
  struct Column {
    const std::byte* values;
    std::size_t size;
    std::size_t offset;
    bool swap;  // the byte order of the result is not that of this machine
  };

  Status plan(const PointCloud2View& source, std::span<const AddedField> added,
              const Selection* selection);
  Status add(const AddedField& added, std::size_t points);
  void write_run(std::size_t first, std::size_t count, const std::byte* from,
                 std::byte*& to) const noexcept;

  const PointCloud2View* source_ = nullptr;
  PointCloud2View layout_;
  std::vector<Column> columns_;
  Selection selection_{std::span<const std::uint8_t>()};
  bool selects_ = false;
};

}  // namespace flagstone::ros
