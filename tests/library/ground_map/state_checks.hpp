// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Requirements on the saved state of every class with to_bytes() and from_bytes().
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <vector>

#include "flagstone/status.hpp"
#include "library/core/random.hpp"
#include "library/ground_map/state_bytes.hpp"

namespace flagstone {

using Bytes = std::vector<std::byte>;

template <class State>
Bytes bytes_of(const State& state) {
  Bytes bytes;
  EXPECT_TRUE(state.to_bytes(bytes).ok());
  return bytes;
}

/// With the right checksum, so that other checks are reached.
inline Bytes sealed(Bytes bytes) {
  bytes.resize(bytes.size() - 8);
  StateWriter(bytes).finish();
  return bytes;
}

/// `state` rejects each truncated or damaged state and stays as it is.
template <class State>
void expect_damage_is_rejected(const Bytes& good, State& state) {
  const Bytes before = bytes_of(state);
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    const std::size_t at = i < 40 ? static_cast<std::size_t>(i) : random.bits() % good.size();
    Bytes damaged = good;
    damaged[at] ^= static_cast<std::byte>(1U << (random.bits() % 8));
    for (const Status& status :
         {state.from_bytes(std::span(good).first(at)), state.from_bytes(damaged)}) {
      EXPECT_EQ(status.code(), StatusCode::bad_file);
      EXPECT_THAT(status.message(), testing::MatchesRegex("byte [0-9]+: .* \\(expected .*\\)"));
    }
    ASSERT_EQ(bytes_of(state), before);
  }
}

/// With any number changed, most often in the first `header` bytes, a state is rejected, or it is
/// loaded and saved as the bytes that it came from. Calls `use(state)` for those that are loaded.
template <class State, class Use>
void expect_changes_are_rejected_or_kept(const Bytes& good, std::size_t header, const Use& use) {
  Random random(5);
  std::size_t loaded = 0;
  for (int i = 0; i < 300; ++i) {
    Bytes changed = good;
    const std::size_t range = i < 200 ? header : good.size() - 8;
    for (std::size_t k = 0; k <= random.bits() % 2; ++k) {
      changed[random.bits() % range] = static_cast<std::byte>(random.bits());
    }
    changed = sealed(changed);
    State state;

    const Status status = state.from_bytes(changed);

    if (!status.ok()) {
      EXPECT_EQ(status.code(), StatusCode::bad_file);
      continue;
    }
    ++loaded;
    ASSERT_EQ(bytes_of(state), changed);
    use(state);
  }
  EXPECT_GT(loaded, 0U);
}

}  // namespace flagstone
