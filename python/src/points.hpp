// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone::python {

/// Zero-copy view of one coordinate of every point, in the memory of a Python object that supports
/// the buffer protocol. Keeps the buffer valid for its own lifetime.
class Column {
 public:
  /// Throws nanobind::python_error, or nanobind::type_error if the object is not a one-dimensional
  /// array of 32- or 64-bit floats in native byte order.
  explicit Column(nanobind::handle object);
  ~Column();
  Column(const Column&) = delete;
  Column& operator=(const Column&) = delete;
  Column(Column&&) = delete;
  Column& operator=(Column&&) = delete;

  [[nodiscard]] const std::byte* data() const noexcept {
    return static_cast<const std::byte*>(buffer_.buf);
  }
  [[nodiscard]] std::size_t size() const noexcept {
    return static_cast<std::size_t>(buffer_.shape[0]);
  }
  [[nodiscard]] std::ptrdiff_t stride() const noexcept { return buffer_.strides[0]; }
  [[nodiscard]] bool is_double() const noexcept { return buffer_.itemsize == sizeof(double); }

 private:
  Py_buffer buffer_{};
};

/// Zero-copy view of points that are rows of a float32 array: the most common input, checked in one
/// step.
class Rows {
 public:
  /// Checks whether the object supports the buffer protocol and has N rows of at least 3 32-bit
  /// floats. Arrays with few rows and many columns are not accepted, because they are probably
  /// transposed. Leaves no Python error set.
  explicit Rows(nanobind::handle object) noexcept;
  ~Rows();
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  Rows(Rows&&) = delete;
  Rows& operator=(Rows&&) = delete;

  [[nodiscard]] bool are_points() const noexcept { return are_points_; }

  /// The points. Call it only if are_points().
  [[nodiscard]] CloudView view(const std::vector<float>& unused) const noexcept;

 private:
  Py_buffer buffer_{};
  bool are_points_ = false;
};

/// Points from three columns. They are zero-copy if all columns are 32-bit floats with the same
/// stride, as columns of one array are.
class Points {
 public:
  /// Throws like Column, and nanobind::value_error if the columns have different lengths.
  Points(nanobind::handle x, nanobind::handle y, nanobind::handle z);

  /// Whether view() is zero-copy.
  [[nodiscard]] bool are_zero_copy() const noexcept;

  /// A view of the columns, or of a copy in `copy`, which is enlarged as needed. Does not access
  /// Python objects, so the GIL is not needed. May throw std::bad_alloc.
  [[nodiscard]] CloudView view(std::vector<float>& copy) const;

 private:
  [[nodiscard]] std::array<const Column*, 3> columns() const noexcept { return {&x_, &y_, &z_}; }

  Column x_, y_, z_;
};

}  // namespace flagstone::python
