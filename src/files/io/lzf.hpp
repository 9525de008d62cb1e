// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// The size a LZF stream expands to, by walking it without writing: nothing is allocated on a
/// header's word. Three bytes stand for 264 at most, so the ratio is at most 88.
/// bad_file with the offset, counted from `file_offset` on, where the stream ends within an item or
/// refers to before its start.
Status measure_lzf(std::span<const std::byte> compressed, std::size_t file_offset,
                   std::size_t& expanded_size);

/// Expands a stream that measure_lzf() has found good into `out`, which has exactly the measured
/// size.
void expand_lzf(std::span<const std::byte> compressed, std::span<std::byte> out) noexcept;

}  // namespace flagstone::io
