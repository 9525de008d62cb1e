// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Whether a file's bytes from `offset` on can be the `points` rows of `stride` bytes its header
/// announces: bad_file where there are fewer, and where a row or more is left over if nothing else
/// may follow them (`points_are_last`).
Status check_binary_rows(std::span<const std::byte> bytes, std::size_t offset, std::size_t points,
                         std::size_t stride, bool points_are_last);

}  // namespace flagstone::io
