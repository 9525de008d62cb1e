// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::performance {

/// Bytes that operator new has handed out and not taken back, in all threads, as malloc rounds
/// them. Counted in programs that have live_memory.cpp in them.
std::size_t live_bytes() noexcept;

}  // namespace flagstone::performance
