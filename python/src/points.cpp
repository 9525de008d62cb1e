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

}  // namespace

Column::Column(nanobind::handle object) {
  if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
    throw nanobind::python_error();
  }
  std::string_view format = buffer_.format == nullptr ? "B" : buffer_.format;
  // NumPy says "=f" for fields of records that are not aligned.
  constexpr bool is_little = std::endian::native == std::endian::little;
  if (format.starts_with('=') || format.starts_with('@') ||
      format.starts_with(is_little ? '<' : '>')) {
    format.remove_prefix(1);
  }
  if (buffer_.ndim != 1 || (format != "f" && format != "d")) {
    PyBuffer_Release(&buffer_);
    throw nanobind::type_error("a column is one row of float32 or float64");
  }
}

Column::~Column() { PyBuffer_Release(&buffer_); }

Points::Points(nanobind::handle x, nanobind::handle y, nanobind::handle z) : x_(x), y_(y), z_(z) {
  if (x_.size() != y_.size() || x_.size() != z_.size()) {
    throw nanobind::value_error("x, y and z differ in length");
  }
}

bool Points::lie_in_place() const noexcept {
  if (x_.is_double() || y_.is_double() || z_.is_double()) return false;
  return x_.size() < 2 || (x_.stride() == y_.stride() && x_.stride() == z_.stride());
}

CloudView Points::view(std::vector<float>& copy) const {
  if (lie_in_place()) {
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
