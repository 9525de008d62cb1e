// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>

namespace flagstone::io {

/// A program with counted_allocation.cpp counts the memory that operator new allocates.
inline constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
inline std::size_t allocated = 0;  ///< bytes allocated since it was set to 0, including freed ones
inline std::size_t allowed = unlimited;  ///< allocations fail if `allocated` would exceed this
inline std::atomic<std::ptrdiff_t> blocks = 0;  ///< blocks allocated and not freed

}  // namespace flagstone::io
