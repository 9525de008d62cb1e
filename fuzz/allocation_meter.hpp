// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::fuzz {

/// Counts the bytes allocated since its construction, including freed ones.
class AllocationMeter {
 public:
  AllocationMeter() noexcept;

  /// Aborts if more was allocated than `factor` times the size of the file plus a constant: a
  /// reader must not trust the sizes in a header.
  void require_at_most(std::size_t factor, std::size_t file_size) const;
};

/// Bytes that a reader may allocate in total per byte of the file. Rows have at most 4 times the
/// size of an ascii file, or 88 times the size of a compressed stream, which is stored by columns
/// and by rows. Converted coordinates have at most 4 times the size of the rows.
inline constexpr std::size_t plain_factor = 32;
inline constexpr std::size_t compressed_factor = 528;  // 88 * (1 + 1 + 4)

}  // namespace flagstone::fuzz
