// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::bench {

/// What operator new and delete have done so far, in all threads.
struct AllocationCount {
  std::size_t calls = 0;  ///< of operator new
  std::size_t bytes = 0;  ///< handed out and not given back
};

/// The count up to now. It moves only in programs that link flagstone_counting_new.
[[nodiscard]] AllocationCount allocation_count() noexcept;

/// Does this program link it? Found by trying.
[[nodiscard]] bool allocations_are_counted();

/// @name For counting_new.cpp
/// @{
void count_new(std::size_t bytes) noexcept;
void count_delete(std::size_t bytes) noexcept;
/// @}

}  // namespace flagstone::bench
