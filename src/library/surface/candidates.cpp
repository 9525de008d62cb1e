// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::surface {
namespace {

/// Corrections are similar if they differ by at most this, metres.
constexpr float agreement = 0.2f;

/// Number of times that candidates are compared with their neighbours.
constexpr int rounds = 2;

bool is_confirmed(const Candidate& candidate, const Corrections& corrections) {
  const std::size_t row = candidate.place / corrections.width;
  const std::size_t column = candidate.place % corrections.width;
  const auto begin = [](std::size_t index) { return index > 0 ? index - 1 : 0; };
  const auto end = [&](std::size_t index) { return std::min(index + 2, corrections.width); };
  int similar = 0;
  int lower = 0;
  for (std::size_t r = begin(row); r < end(row); ++r) {
    for (std::size_t c = begin(column); c < end(column); ++c) {
      const std::size_t place = r * corrections.width + c;
      if (place == candidate.place || corrections.weights[place] <= 0) continue;
      const float above = candidate.correction - corrections.values[place];
      similar += static_cast<int>(std::abs(above) <= agreement);
      lower += static_cast<int>(above > agreement);
    }
  }
  return similar > 0 && similar >= lower;
}

}  // namespace

void accept(std::span<const Candidate> candidates, const Corrections& corrections) noexcept {
  for (const Candidate& candidate : candidates) {
    if (candidate.weight <= 0) continue;
    corrections.values[candidate.place] = candidate.correction;
    corrections.weights[candidate.place] = candidate.weight;
  }
}

void accept_confirmed(std::span<Candidate> candidates, const Corrections& corrections) noexcept {
  const auto split = [&](const auto& condition) {
    const auto rest = std::partition(candidates.begin(), candidates.end(), condition);
    const auto count = static_cast<std::size_t>(rest - candidates.begin());
    const std::span<Candidate> front = candidates.first(count);
    candidates = candidates.subspan(count);
    return front;
  };
  split([](const Candidate& candidate) { return candidate.weight <= 0; });
  for (int round = 0; round < rounds; ++round) {
    accept(split([&](const Candidate& c) { return is_confirmed(c, corrections); }), corrections);
  }
}

}  // namespace flagstone::surface
