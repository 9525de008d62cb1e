// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>

namespace flagstone::io {

/// A program with counted_allocation.cpp in it counts what operator new hands out.
inline constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
inline std::size_t allocated = 0;        ///< bytes since it was set to 0, freed again or not
inline std::size_t allowed = unlimited;  ///< an allocation that would bring it beyond this fails
inline std::atomic<std::ptrdiff_t> blocks = 0;  ///< handed out and not given back

}  // namespace flagstone::io
