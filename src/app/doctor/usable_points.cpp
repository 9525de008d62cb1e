// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/usable_points.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace flagstone::doctor {
namespace {

std::size_t count_repeated(std::vector<Vector3f> places) {
  std::ranges::sort(places);
  const auto repeated = std::ranges::unique(places);
  return static_cast<std::size_t>(std::ranges::distance(repeated));
}

bool are_ring_numbers(const std::vector<int>& rings) {
  constexpr std::size_t most_rings = 1024;
  std::set<int> different;
  for (const int ring : rings) {
    different.insert(ring);
    if (ring < 0 || different.size() > most_rings) return false;
  }
  return different.size() >= 2;
}

}  // namespace

UsablePoints usable_points(const io::Cloud& cloud) {
  UsablePoints usable;
  const CloudView view = cloud.view();
  const io::Field* const ring = cloud.find("ring");
  bool has_rings = ring != nullptr && ring->count == 1;
  usable.given = view.size();
  for (std::size_t i = 0; i < view.size(); ++i) {
    const auto [x, y, z] = view[i];
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      ++usable.not_finite;
    } else if (x == 0 && y == 0 && z == 0) {
      ++usable.zero;
    } else {
      usable.places.push_back({x, y, z});
      if (!has_rings) continue;
      const double number = cloud.value(i, *ring);
      has_rings = std::abs(number) < 1e6 && number == std::floor(number);
      usable.rings.push_back(has_rings ? static_cast<int>(number) : 0);
    }
  }
  if (!has_rings || !are_ring_numbers(usable.rings)) usable.rings.clear();
  usable.repeated = count_repeated(usable.places);
  return usable;
}

}  // namespace flagstone::doctor
