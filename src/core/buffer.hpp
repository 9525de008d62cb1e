// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace flagstone {

/// Working memory that only grows and is never initialised: pages a scan does not touch cost
/// nothing.
template <class T>
class Buffer {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  /// Makes room for `count` elements; what was there is lost if it has to grow. May throw
  /// std::bad_alloc.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    data_.reset();  // before the new one, so that both are never held
    capacity_ = 0;
    data_ =
        std::make_unique_for_overwrite<T[]>(count);  // NOLINT(modernize-avoid-c-arrays): as data_
    capacity_ = count;
  }

  [[nodiscard]] T* data() noexcept { return data_.get(); }
  [[nodiscard]] const T* data() const noexcept { return data_.get(); }

 private:
  std::unique_ptr<T[]> data_;  // NOLINT(modernize-avoid-c-arrays): the type for a run of objects
  std::size_t capacity_ = 0;
};

}  // namespace flagstone
