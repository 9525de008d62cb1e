// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/derived_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "files/io/cloud.hpp"
#include "files/io/message.hpp"
#include "files/io/rows.hpp"
#include "files/ros/serialization.hpp"

namespace flagstone::ros {
namespace {

using io::invalid;
using io::quote;

constexpr std::size_t max_message_part = std::numeric_limits<std::uint32_t>::max();

// Points are copied in blocks that stay in the L1 cache while the added fields are written.
constexpr std::size_t block = 256;

/// 1 for each point of a block that is kept, otherwise 0.
using Kept = std::array<std::uint8_t, block>;

/// Copies of points. Only the first `size` bytes of each point are copied, and the rest of the
/// `step` bytes in the result is set to 0.
struct PointCopy {
  const std::byte* from;
  std::size_t stride;  // between points of the source
  std::byte* to;
  std::size_t step;  // between points of the result
  std::size_t size;
  std::size_t count;  // points of the source in this block
};

// Points of up to this many bytes are copied by code for exactly their size, without a call.
constexpr std::size_t max_inlined = 64;

// The bytes after a point of the source are set to 0 by one store of this size. It may reach into
// the next point of the result, which is written later.
constexpr std::size_t clearing = sizeof(std::uint64_t);

/// Copies one point and clears the bytes after it. With a `Size` of 0 the size is known at run time
/// only. `IsLast` must be true if no point follows, or if more than `clearing` bytes are cleared.
template <std::size_t Size, bool IsLast>
inline void copy_point(const PointCopy& copy, std::size_t i, std::byte* to) noexcept {
  const std::size_t size = Size > 0 ? Size : copy.size;
  std::memcpy(to, copy.from + i * copy.stride, size);
  if constexpr (IsLast) {
    std::memset(to + size, 0, copy.step - size);
  } else {
    io::store(to + size, std::uint64_t{0});
  }
}

/// Number of points at the end of a block that must be copied as the last one.
std::size_t points_copied_exactly(const PointCopy& copy, std::size_t total) noexcept {
  return copy.step - copy.size <= clearing && copy.step >= clearing
             ? std::min<std::size_t>(total, 1)
             : total;
}

/// Copies all points.
template <std::size_t Size>
void copy_all(const PointCopy& copy) noexcept {
  const std::size_t first_exact = copy.count - points_copied_exactly(copy, copy.count);
  std::size_t i = 0;
  for (; i < first_exact; ++i) copy_point<Size, false>(copy, i, copy.to + i * copy.step);
  for (; i < copy.count; ++i) copy_point<Size, true>(copy, i, copy.to + i * copy.step);
}

/// Copies the `kept` points without a branch per point: a point that is not kept is overwritten by
/// the next one. Stops after `total` points, so that it does not write past them.
template <std::size_t Size>
void copy_kept(const PointCopy& copy, const Kept& kept, std::size_t total) noexcept {
  std::byte* to = copy.to;
  std::byte* const end = to + total * copy.step;
  std::byte* const exact = end - points_copied_exactly(copy, total) * copy.step;
  std::size_t i = 0;
  for (; to != exact; ++i) {
    copy_point<Size, false>(copy, i, to);
    to += kept[i] * copy.step;
  }
  for (; to != end; ++i) {
    copy_point<Size, true>(copy, i, to);
    to += kept[i] * copy.step;
  }
}

template <std::size_t... Sizes>
constexpr auto functions_by_size(std::index_sequence<Sizes...> /*sizes*/) {
  struct Functions {
    void (*all)(const PointCopy&) noexcept;
    void (*kept)(const PointCopy&, const Kept&, std::size_t) noexcept;
  };
  return std::array{Functions{copy_all<Sizes>, copy_kept<Sizes>}...};
}

/// The functions for each size; those at 0 are for all larger sizes.
constexpr auto copies = functions_by_size(std::make_index_sequence<max_inlined + 1>());

const auto& copies_of(std::size_t size) noexcept { return copies[size <= max_inlined ? size : 0]; }

/// Writes one number for each point, or for each kept point.
template <class T, bool Swap>
void write_numbers(const std::byte* from, std::size_t count, std::byte* to, std::size_t step,
                   const Kept* kept, std::size_t total) noexcept {
  const auto number = [from](std::size_t i) {
    const T value = io::load<T>(from + i * sizeof(T));
    return Swap ? reversed(value) : value;
  };
  if (kept == nullptr) {
    for (std::size_t i = 0; i < count; ++i) io::store(to + i * step, number(i));
    return;
  }
  std::byte* const end = to + total * step;
  for (std::size_t i = 0; to != end; ++i) {
    io::store(to, number(i));
    to += (*kept)[i] * step;
  }
}

bool overlap(const PointField& a, const PointField& b) noexcept {
  return a.offset < b.offset + b.size() && b.offset < a.offset + a.size();
}

/// Whether the bytes of `field` belong to no other field. A field of an unknown type may have any
/// size.
bool is_alone(std::span<const PointField> fields, const PointField& field) noexcept {
  return std::ranges::all_of(fields, [&](const PointField& other) {
    return &other == &field || (other.size() > 0 && !overlap(other, field));
  });
}

/// The unsigned integer type of this size, to copy numbers of any type.
io::FieldType unsigned_type(std::size_t size) noexcept {
  switch (size) {
    case 1: return io::FieldType::uint8;
    case 2: return io::FieldType::uint16;
    case 4: return io::FieldType::uint32;
    default: return io::FieldType::uint64;
  }
}

std::size_t next_multiple(std::size_t number, std::size_t of) noexcept {
  return (number + of - 1) / of * of;
}

}  // namespace

AddedField label_field(std::span<const Label> labels) noexcept {
  return {io::label_name, PointFieldType::uint8, std::as_bytes(labels)};
}

AddedField height_field(std::span<const float> heights) noexcept {
  return {io::height_name, PointFieldType::float32, std::as_bytes(heights)};
}

Selection::Selection(std::span<const std::uint8_t> mask) noexcept
    : values_(std::as_bytes(mask)), is_mask_(true) {}

Selection::Selection(std::span<const Label> labels, std::initializer_list<Label> kept) noexcept
    : values_(std::as_bytes(labels)) {
  for (const Label label : kept) {
    const auto code = static_cast<std::size_t>(label);
    if (code < label_count) keeps_[code] = true;
  }
}

void Selection::get(std::size_t first, std::span<std::uint8_t> out) const noexcept {
  // Compilers compare whole vectors in these loops. A table of labels would take four times as
  // long.
  const std::byte* const values = values_.data() + first;
  if (is_mask_) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = values[i] != std::byte{0} ? 1 : 0;
    return;
  }
  std::ranges::fill(out, std::uint8_t{0});
  for (std::size_t code = 0; code < label_count; ++code) {
    if (!keeps_[code]) continue;
    const auto kept = static_cast<std::byte>(code);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<std::uint8_t>(out[i] | (values[i] == kept ? 1U : 0U));
    }
  }
}

std::size_t Selection::count() const noexcept {
  std::size_t count = 0;
  Kept kept{};
  for (std::size_t begin = 0; begin < values_.size(); begin += block) {
    const std::span part = std::span(kept).first(std::min(block, values_.size() - begin));
    get(begin, part);
    count += std::accumulate(part.begin(), part.end(), std::size_t{0});
  }
  return count;
}

Status DerivedCloud::append(const PointCloud2View& source, std::span<const AddedField> added) {
  return plan(source, added, nullptr);
}

Status DerivedCloud::select(const PointCloud2View& source, const Selection& selection,
                            std::span<const AddedField> added) {
  return plan(source, added, &selection);
}

Status DerivedCloud::plan(const PointCloud2View& source, std::span<const AddedField> added,
                          const Selection* selection) {
  Status status = io::within_memory([&] {
    columns_.clear();
    if (selection != nullptr && selection->size() != source.size()) {
      return invalid("the selection has {} values for {} points (expected one per point)",
                     selection->size(), source.size());
    }
    layout_ = source;  // reuses the memory of the fields
    layout_.data = {};
    layout_.padded_point_step = 0;
    std::size_t alignment = 1;
    for (const AddedField& field : added) {
      if (std::ranges::count(added, field.name, &AddedField::name) > 1) {
        return invalid("field {} is added twice", quote(field.name));
      }
      if (Status failed = add(field, source.size()); !failed.ok()) return failed;
      alignment = std::max(alignment, size_of(field.type));
    }
    std::size_t point_step = layout_.point_step;
    if (point_step != source.point_step) point_step = next_multiple(point_step, alignment);
    source_ = &source;
    selects_ = selection != nullptr;
    if (selects_) {
      selection_ = *selection;
      layout_.height = 1;
    }
    const std::size_t points = selects_ ? selection->count() : source.size();
    const std::size_t width = selects_ ? points : source.width;
    if (layout_.fields.size() > max_point_fields || point_step > max_message_part ||
        points > max_message_part / std::max<std::size_t>(point_step, 1) ||
        width * point_step > max_message_part) {
      return invalid(
          "{} points of {} bytes with {} fields do not fit in a message (expected at most {} bytes "
          "and {} fields)",
          points, point_step, layout_.fields.size(), max_message_part, max_point_fields);
    }
    layout_.width = static_cast<std::uint32_t>(width);
    layout_.point_step = static_cast<std::uint32_t>(point_step);
    layout_.row_step = static_cast<std::uint32_t>(width * point_step);
    return Status();
  });
  if (!status.ok()) {
    layout_ = PointCloud2View();
    columns_.clear();
    source_ = nullptr;
  }
  return status;
}

Status DerivedCloud::add(const AddedField& added, std::size_t points) {
  const std::size_t size = size_of(added.type);
  if (size == 0) {
    return invalid("field {} has datatype {} (expected 1 to 11)", quote(added.name),
                   static_cast<unsigned>(added.type));
  }
  if (added.values.size() != points * size) {
    return invalid("field {} has {} bytes for {} points (expected {} bytes per point)",
                   quote(added.name), added.values.size(), points, size);
  }
  std::vector<PointField>& fields = layout_.fields;
  const bool swap = layout_.is_bigendian != (std::endian::native == std::endian::big);
  const auto has_name = [&](const PointField& field) { return field.name == added.name; };
  const auto old = std::ranges::find_if(fields, has_name);
  if (old != fields.end() && old->type == added.type && old->numbers() == 1 &&
      is_alone(fields, *old)) {
    columns_.push_back({added.values.data(), size, old->offset, swap});
    fields.erase(std::remove_if(old + 1, fields.end(), has_name), fields.end());
    return {};
  }
  std::erase_if(fields, has_name);
  const std::size_t offset = next_multiple(layout_.point_step, size);
  if (offset + size > max_message_part) {
    return invalid("field {} does not fit in a point of {} bytes", quote(added.name),
                   layout_.point_step);
  }
  fields.push_back({added.name, static_cast<std::uint32_t>(offset), added.type, 1});
  layout_.point_step = static_cast<std::uint32_t>(offset + size);
  columns_.push_back({added.values.data(), size, offset, swap});
  return {};
}

void DerivedCloud::write_run(std::size_t first, std::size_t count, const std::byte* from,
                             std::byte*& to) const noexcept {
  const std::size_t step = layout_.point_step;
  const auto& copy_points = copies_of(source_->point_step);
  for (std::size_t begin = 0; begin < count; begin += block) {
    PointCopy copy{.from = from + begin * source_->point_stride(),
                   .stride = source_->point_stride(),
                   .to = to,
                   .step = step,
                   .size = source_->point_step,
                   .count = std::min(block, count - begin)};
    Kept kept{};
    std::size_t total = copy.count;
    if (selects_) {
      const std::span part = std::span(kept).first(copy.count);
      selection_.get(first + begin, part);
      total = std::accumulate(part.begin(), part.end(), std::size_t{0});
      copy_points.kept(copy, kept, total);
    } else {
      copy_points.all(copy);
    }
    for (const Column& column : columns_) {
      io::visit_type(unsigned_type(column.size), [&]<class T>() {
        if constexpr (std::is_unsigned_v<T>) {
          const auto write = column.swap ? write_numbers<T, true> : write_numbers<T, false>;
          write(column.values + (first + begin) * sizeof(T), copy.count, to + column.offset, step,
                selects_ ? &kept : nullptr, total);
        }
      });
    }
    to += total * step;
  }
}

void DerivedCloud::write_data(std::span<std::byte> to) const noexcept {
  if (source_ == nullptr || layout_.size() == 0) return;
  const PointCloud2View& source = *source_;
  std::byte* next = to.data();
  if (source.rows_are_contiguous()) {
    write_run(0, source.size(), source.data.data(), next);
    return;
  }
  for (std::size_t row = 0; row < source.height; ++row) {
    write_run(row * source.width, source.width, source.data.data() + row * source.row_stride(),
              next);
  }
}

void DerivedCloud::write_message(std::span<std::byte> to) const noexcept {
  write_data(serialize_around(layout_, data_size(), to));
}

Status DerivedCloud::write_message(std::vector<std::byte>& out) const {
  return io::within_memory([&] {
    out.resize(message_size());
    write_message(std::span<std::byte>(out));
    return Status();
  });
}

}  // namespace flagstone::ros
