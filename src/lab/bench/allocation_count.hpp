// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::bench {

/// Counts of operator new and delete so far, in all threads.
struct AllocationCount {
  std::size_t calls = 0;  ///< calls of operator new
  std::size_t bytes = 0;  ///< allocated and not yet freed
};

/// The current counts. They change only in programs that link flagstone_counting_new. Thread-safe.
[[nodiscard]] AllocationCount allocation_count() noexcept;

/// Whether this program links flagstone_counting_new, determined by a test allocation.
[[nodiscard]] bool allocations_are_counted();

/// @name Used by counting_new.cpp
/// @{
void count_new(std::size_t bytes) noexcept;
void count_delete(std::size_t bytes) noexcept;
/// @}

}  // namespace flagstone::bench
