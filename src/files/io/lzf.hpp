// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Computes the expanded size of an LZF stream without expanding it, so that a wrong size in a
/// header causes no allocation. Three bytes expand to at most 264, so the ratio is at most 88.
/// bad_file if the stream ends within an item or refers to bytes before its start; the reported
/// offset is relative to the file, in which the stream begins at `file_offset`.
Status measure_lzf(std::span<const std::byte> compressed, std::size_t file_offset,
                   std::size_t& expanded_size);

/// Expands a stream that measure_lzf() accepted into `out`, which must have the measured size.
void expand_lzf(std::span<const std::byte> compressed, std::span<std::byte> out) noexcept;

}  // namespace flagstone::io
