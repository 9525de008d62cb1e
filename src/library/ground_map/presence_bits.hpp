// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "library/ground_map/state_bytes.hpp"

namespace flagstone {

/// Which of `count` elements a state contains: one bit each, in words of 64 bits.
template <std::size_t count>
class PresenceBits {
 public:
  /// Size in a state.
  static constexpr std::size_t bytes = (count + 63) / 64 * sizeof(std::uint64_t);

  PresenceBits() = default;

  /// `is_present(k)` for each element.
  template <class IsPresent>
  explicit PresenceBits(const IsPresent& is_present) {
    for (std::size_t k = 0; k < count; ++k)
      words_[k / 64] |= std::uint64_t{is_present(k)} << k % 64;
  }

  void write(StateWriter& writer) const {
    for (const std::uint64_t word : words_) writer.add(word);
  }

  /// False if the bytes end, or bits after the last element are set.
  [[nodiscard]] bool read(StateReader& reader) noexcept {
    for (std::uint64_t& word : words_) word = reader.read<std::uint64_t>();
    const bool has_others = count % 64 != 0 && words_.back() >> count % 64 != 0;
    return !reader.failed() && !has_others;
  }

  [[nodiscard]] bool operator[](std::size_t k) const noexcept {
    return (words_[k / 64] >> k % 64 & 1U) != 0;
  }
  [[nodiscard]] bool any() const noexcept {
    return std::ranges::any_of(words_, [](std::uint64_t word) { return word != 0; });
  }

 private:
  std::array<std::uint64_t, (count + 63) / 64> words_{};
};

}  // namespace flagstone
