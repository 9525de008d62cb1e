// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/run_tallies.hpp"

#include <algorithm>
#include <utility>

namespace flagstone::plane_fits {

void RunTallies::reserve(std::size_t bins) {
  const std::size_t blocks = bins / block_size + 1;
  if (blocks <= blocks_) return;
  blocks_ = 0;
  tallies_.reserve(blocks * block_size);
  block_firsts_.reserve(blocks + 1);
  block_marks_.reserve(blocks);
  blocks_ = blocks;
  std::fill_n(tallies_.data(), blocks * block_size, Tally{});
  std::fill_n(block_firsts_.data(), blocks + 1, Tally{});
  std::fill_n(block_marks_.data(), blocks, std::uint8_t{0});
}

Tally RunTallies::count(const ScanRuns& runs, std::size_t chunks, std::uint32_t bins) noexcept {
  Tally* const tallies = tallies_.data();
  for (std::size_t block = 0; block < used_blocks_; ++block) {  // counts of the previous scan
    if (is_empty(block)) continue;
    std::fill_n(tallies + block * block_size, block_size, Tally{});
  }
  std::uint8_t* const marks = block_marks_.data();
  runs.for_each(chunks, [=](std::uint32_t bin, std::uint32_t, std::uint32_t length) {
    tallies[bin].add(Tally::run_of(length));
    marks[bin / block_size] = 1;
  });

  // Replace the tally of each bin by the sum over the bins before it.
  used_blocks_ = bins / block_size + 1;
  Tally sum;
  for (std::size_t block = 0; block < used_blocks_; ++block) {
    block_firsts_.data()[block] = sum;
    if (std::exchange(marks[block], std::uint8_t{0}) == 0) continue;
    for (std::size_t bin = block * block_size; bin < (block + 1) * block_size; ++bin) {
      const Tally held = std::exchange(tallies[bin], sum);
      sum.add(held);
    }
  }
  block_firsts_.data()[used_blocks_] = sum;
  return sum;
}

}  // namespace flagstone::plane_fits
