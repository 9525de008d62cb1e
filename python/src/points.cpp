// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "points.hpp"

#include <bit>
#include <cstring>
#include <string_view>

namespace flagstone::python {
namespace {

template <class Number>
void copy_column(const Column& column, float* to) {
  const std::byte* from = column.data();
  for (std::size_t i = 0; i < column.size(); ++i, from += column.stride(), to += 3) {
    Number number;
    std::memcpy(&number, from, sizeof number);  // any alignment
    *to = static_cast<float>(number);
  }
}

/// Format of the numbers in a buffer, without the prefix for native byte order. NumPy uses "=f" for
/// unaligned fields of records.
std::string_view format_of(const Py_buffer& buffer) {
  std::string_view format = buffer.format == nullptr ? "B" : buffer.format;
  constexpr bool is_little = std::endian::native == std::endian::little;
  if (format.starts_with('=') || format.starts_with('@') ||
      format.starts_with(is_little ? '<' : '>')) {
    format.remove_prefix(1);
  }
  return format;
}

}  // namespace

Column::Column(nanobind::handle object) {
  if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
    throw nanobind::python_error();
  }
  const std::string_view format = format_of(buffer_);
  if (buffer_.ndim != 1 || (format != "f" && format != "d")) {
    PyBuffer_Release(&buffer_);
    throw nanobind::type_error("a column must be a one-dimensional array of float32 or float64");
  }
}

Column::~Column() { PyBuffer_Release(&buffer_); }

Rows::Rows(nanobind::handle object) noexcept {
  if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
    PyErr_Clear();
    return;
  }
  constexpr Py_ssize_t few_rows = 8;
  constexpr Py_ssize_t many_columns = 8;
  are_points_ = buffer_.ndim == 2 && format_of(buffer_) == "f" && buffer_.shape[1] >= 3 &&
                (buffer_.shape[0] > few_rows || buffer_.shape[1] <= many_columns);
}

Rows::~Rows() { PyBuffer_Release(&buffer_); }

CloudView Rows::view(const std::vector<float>& /*unused*/) const noexcept {
  const std::ptrdiff_t column = buffer_.strides[1];
  return {buffer_.buf,
          static_cast<std::size_t>(buffer_.shape[0]),
          {buffer_.strides[0], 0, column, 2 * column}};
}

Points::Points(nanobind::handle x, nanobind::handle y, nanobind::handle z) : x_(x), y_(y), z_(z) {
  if (x_.size() != y_.size() || x_.size() != z_.size()) {
    throw nanobind::value_error("x, y and z have different lengths");
  }
}

bool Points::are_zero_copy() const noexcept {
  if (x_.is_double() || y_.is_double() || z_.is_double()) return false;
  return x_.size() < 2 || (x_.stride() == y_.stride() && x_.stride() == z_.stride());
}

CloudView Points::view(std::vector<float>& copy) const {
  if (are_zero_copy()) {
    return {x_.data(), x_.size(), {x_.stride(), 0, y_.data() - x_.data(), z_.data() - x_.data()}};
  }
  if (copy.size() < 3 * x_.size()) copy.resize(3 * x_.size());
  float* to = copy.data();
  for (const Column* column : columns()) {
    if (column->is_double()) {
      copy_column<double>(*column, to++);
    } else {
      copy_column<float>(*column, to++);
    }
  }
  return {copy.data(), x_.size()};
}

}  // namespace flagstone::python
