// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/cloud.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/rows.hpp"

namespace flagstone::io {
namespace {

void convert_to_float(std::span<const std::byte> rows, std::size_t stride, const Field& field,
                      float* to) {
  visit_type(field.type, [&]<class T>() {
    const std::byte* from = rows.data() + field.offset;
    for (std::size_t i = 0; i < rows.size() / stride; ++i) {
      to[3 * i] = static_cast<float>(load<T>(from + i * stride));
    }
  });
}

/// `cloud` with the field `added` after the others, filled from `values`. Replaces an existing
/// field of that name.
Status with_field(const Cloud& cloud, Field added, std::span<const std::byte> values, Cloud& out) {
  const Field* const old = cloud.find(added.name);
  std::vector<Field> fields(cloud.fields().begin(), cloud.fields().end());
  if (old != nullptr) fields.erase(fields.begin() + (old - cloud.fields().data()));

  const std::size_t size = added.size();
  const std::size_t before = old != nullptr ? old->offset : cloud.stride();
  const std::size_t after = old != nullptr ? cloud.stride() - old->offset - old->size() : 0;
  const std::size_t stride = before + after + size;
  std::vector<std::byte> rows(cloud.size() * stride);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::byte* from = cloud.bytes().data() + i * cloud.stride();
    std::byte* to = rows.data() + i * stride;
    std::memcpy(to, from, before);
    std::memcpy(to + before, from + cloud.stride() - after, after);
    std::memcpy(to + before + after, values.data() + i * size, size);
  }
  fields.push_back(std::move(added));
  return Cloud::from_rows(std::move(fields), std::move(rows), out);
}

}  // namespace

std::size_t size_of(FieldType type) noexcept {
  return visit_type(type, []<class T>() { return sizeof(T); });
}

const char* to_string(FieldType type) noexcept {
  switch (type) {
    case FieldType::int8: return "int8";
    case FieldType::uint8: return "uint8";
    case FieldType::int16: return "int16";
    case FieldType::uint16: return "uint16";
    case FieldType::int32: return "int32";
    case FieldType::uint32: return "uint32";
    case FieldType::int64: return "int64";
    case FieldType::uint64: return "uint64";
    case FieldType::float32: return "float32";
    case FieldType::float64: return "float64";
  }
  return "unknown";
}

bool is_integer(FieldType type) noexcept {
  return visit_type(type, []<class T>() { return std::is_integral_v<T>; });
}

Status Cloud::from_rows(std::vector<Field> fields, std::vector<std::byte> rows, Cloud& out) {
  return within_memory([&] {
    std::size_t stride = 0;
    if (Status status = lay_out(fields, stride); !status.ok()) return status;
    if (rows.size() % stride != 0) {
      return invalid("{} bytes are not a whole number of rows (expected {} bytes per row)",
                     rows.size(), stride);
    }
    Cloud cloud;
    cloud.fields_ = std::move(fields);
    cloud.rows_ = std::move(rows);
    cloud.stride_ = stride;
    cloud.size_ = cloud.rows_.size() / stride;
    const std::array xyz{cloud.find("x"), cloud.find("y"), cloud.find("z")};
    if (std::ranges::all_of(xyz, [](const Field* f) { return f->type == FieldType::float32; })) {
      const auto at = [](const Field* f) { return static_cast<std::ptrdiff_t>(f->offset); };
      cloud.layout_ = {static_cast<std::ptrdiff_t>(stride), at(xyz[0]), at(xyz[1]), at(xyz[2])};
    } else {
      cloud.xyz_.resize(3 * cloud.size_);
      for (std::size_t axis = 0; axis < 3 && cloud.size_ > 0; ++axis) {
        convert_to_float(cloud.rows_, stride, *xyz[axis], cloud.xyz_.data() + axis);
      }
    }
    out = std::move(cloud);
    return Status();
  });
}

Status Cloud::from_floats(std::span<const float> values, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (floats_per_point < 3 || floats_per_point > max_fields) {
      return invalid("{} floats per point (expected 3 to {})", floats_per_point, max_fields);
    }
    const auto bytes = std::as_bytes(values);
    return from_rows(unnamed_fields(floats_per_point, FieldType::float32),
                     {bytes.begin(), bytes.end()}, out);
  });
}

std::vector<std::byte> Cloud::release_rows() noexcept {
  std::vector<std::byte> rows = std::move(rows_);
  *this = Cloud();
  return rows;
}

const Field* Cloud::find(std::string_view name) const noexcept {
  const auto found = std::ranges::find(fields_, name, &Field::name);
  return found == fields_.end() ? nullptr : &*found;
}

CloudView Cloud::view() const noexcept {
  if (!xyz_.empty()) return {xyz_.data(), size_};
  return size_ == 0 ? CloudView() : CloudView(rows_.data(), size_, layout_);
}

double Cloud::value(std::size_t i, const Field& field, std::size_t element) const noexcept {
  const std::byte* from = rows_.data() + i * stride_ + field.offset + element * size_of(field.type);
  return visit_type(field.type, [&]<class T>() { return static_cast<double>(load<T>(from)); });
}

std::vector<Field> unnamed_fields(std::size_t columns, FieldType type) {
  constexpr std::array names{"x", "y", "z", "intensity", "ring"};
  std::vector<Field> fields;
  fields.reserve(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    const std::size_t offset = i * size_of(type);
    fields.push_back({i < names.size() ? names[i] : fmt::format("c{}", i), type, 1, offset});
  }
  return fields;
}

Status with_labels(const Cloud& cloud, std::span<const Label> labels, Cloud& out) {
  return within_memory([&] {
    if (labels.size() != cloud.size()) {
      return invalid("{} labels for {} points (expected one per point)", labels.size(),
                     cloud.size());
    }
    return with_field(cloud, {std::string(label_name), FieldType::uint8}, std::as_bytes(labels),
                      out);
  });
}

Status with_heights(const Cloud& cloud, std::span<const float> heights, Cloud& out) {
  return within_memory([&] {
    if (heights.size() != cloud.size()) {
      return invalid("{} heights for {} points (expected one per point)", heights.size(),
                     cloud.size());
    }
    return with_field(cloud, {std::string(height_name), FieldType::float32}, std::as_bytes(heights),
                      out);
  });
}

Status select(const Cloud& cloud, std::span<const std::size_t> indices, Cloud& out) {
  return within_memory([&] {
    const std::size_t stride = cloud.stride();
    std::vector<std::byte> rows(indices.size() * stride);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] >= cloud.size()) {
        return invalid("index {} is out of range (the cloud has {} points)", indices[i],
                       cloud.size());
      }
      std::memcpy(rows.data() + i * stride, cloud.bytes().data() + indices[i] * stride, stride);
    }
    return Cloud::from_rows({cloud.fields().begin(), cloud.fields().end()}, std::move(rows), out);
  });
}

Status select_where(const Cloud& cloud, std::span<const std::uint8_t> mask, Cloud& out) {
  return within_memory([&] {
    if (mask.size() != cloud.size()) {
      return invalid("a mask of size {} for {} points (expected one value per point)", mask.size(),
                     cloud.size());
    }
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] != 0) indices.push_back(i);
    }
    return select(cloud, indices, out);
  });
}

}  // namespace flagstone::io
