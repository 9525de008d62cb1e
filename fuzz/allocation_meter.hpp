// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::fuzz {

/// Adds up what is allocated during its life, freed again or not.
class AllocationMeter {
 public:
  AllocationMeter() noexcept;

  /// Aborts where more was allocated than `factor` times the file's size and what any file may
  /// cost: a reader must not allocate on a header's word.
  void require_at_most(std::size_t factor, std::size_t file_size) const;
};

/// Bytes a reader may allocate, all in all, for a byte of the file. Rows are at most 4 times an
/// ascii file's size and 88 times a compressed stream's, which are held by columns and by rows;
/// converted coordinates are at most 4 times the rows.
inline constexpr std::size_t plain_factor = 32;
inline constexpr std::size_t compressed_factor = 528;  // 88 * (1 + 1 + 4)

}  // namespace flagstone::fuzz
