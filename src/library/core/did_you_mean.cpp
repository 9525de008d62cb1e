// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/did_you_mean.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace flagstone {
namespace {

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;  // the row before `last`
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

bool equal_but_for_case(std::string_view a, std::string_view b) noexcept {
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view closest_name(std::string_view name, std::span<const std::string_view> known) {
  constexpr std::size_t longest = 100;  // the time is proportional to the product of the lengths
  std::string_view closest;
  std::size_t least = std::min<std::size_t>(name.size(), 9) / 3 + 1;  // too many changes: 1 to 4
  for (const std::string_view candidate : known) {
    if (name.size() > longest || candidate.size() > longest) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= least) continue;
    least = distance;
    closest = candidate;
  }
  return closest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view closest = closest_name(name, known);
  return closest.empty() ? "" : " (did you mean '" + std::string(closest) + "'?)";
}

std::string no_such(std::string_view kind, std::string_view name,
                    std::span<const std::string_view> known) {
  std::string text = "no " + std::string(kind) + " is named '" + std::string(name) + "' (expected ";
  for (std::size_t i = 0; i < known.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::string(known[i]);
  }
  const std::string_view closest = closest_name(name, known);
  if (!closest.empty()) text += "; did you mean '" + std::string(closest) + "'?";
  return text + ")";
}

}  // namespace flagstone
