// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace flagstone {

/// Working memory that only grows and is never initialised, so that pages that a scan does not
/// touch take no memory. Aligned to a cache line.
template <class T>
class Buffer {
  static_assert(std::is_trivially_destructible_v<T>);
  static constexpr std::align_val_t alignment{64};

 public:
  Buffer() = default;
  ~Buffer() { release(); }
  Buffer(Buffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), capacity_(std::exchange(other.capacity_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }

  /// Reserves memory for `count` elements. The contents are lost if the buffer has to grow. May
  /// throw std::bad_alloc.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    release();  // first, so that old and new memory are never allocated together
    data_ = static_cast<T*>(::operator new(count * sizeof(T), alignment));
    capacity_ = count;
  }

  [[nodiscard]] T* data() noexcept { return data_; }
  [[nodiscard]] const T* data() const noexcept { return data_; }

 private:
  void release() noexcept {
    ::operator delete(data_, alignment);
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace flagstone
