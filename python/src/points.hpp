// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone::python {

/// One coordinate of every point, read where it lies: memory of a Python object that speaks the
/// buffer protocol, held for as long as this lives.
class Column {
 public:
  /// Throws nanobind::python_error, or nanobind::type_error where the object is not one row of
  /// numbers of 32 or 64-bit floats in the byte order of this machine.
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

/// Points that are rows of an array, read where they lie: the usual case, looked at in one step.
class Rows {
 public:
  /// Looks whether the object speaks the buffer protocol and has N rows of 3 or more 32-bit floats,
  /// and not so few rows of so many that rows and columns were exchanged. Python holds no error
  /// afterwards.
  explicit Rows(nanobind::handle object) noexcept;
  ~Rows();
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  Rows(Rows&&) = delete;
  Rows& operator=(Rows&&) = delete;

  [[nodiscard]] bool are_points() const noexcept { return are_points_; }

  /// The points; only if they are.
  [[nodiscard]] CloudView view(const std::vector<float>& unused) const noexcept;

 private:
  Py_buffer buffer_{};
  bool are_points_ = false;
};

/// The points that three columns make. Where they are 32-bit floats with one stride, as columns of
/// one array are, they are viewed where they lie.
class Points {
 public:
  /// Throws as Column does, and nanobind::value_error where they are not equally long.
  Points(nanobind::handle x, nanobind::handle y, nanobind::handle z);

  /// Can the points be viewed where they lie?
  [[nodiscard]] bool lie_in_place() const noexcept;

  /// The points: where they lie, or copied to `copy`, which is enlarged as needed. No Python object
  /// is touched. May throw std::bad_alloc.
  [[nodiscard]] CloudView view(std::vector<float>& copy) const;

 private:
  [[nodiscard]] std::array<const Column*, 3> columns() const noexcept { return {&x_, &y_, &z_}; }

  Column x_, y_, z_;
};

}  // namespace flagstone::python
