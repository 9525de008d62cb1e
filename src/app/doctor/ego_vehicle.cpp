// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/ego_vehicle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace flagstone::doctor {

OwnVehicle find_own_vehicle(std::span<const Vector3f> places, double ground, double radius) {
  constexpr double over_ground = 0.3;
  constexpr double step = 0.1;
  constexpr double roof_share = 0.3;  // of what is around the sensor, in one layer
  std::array<std::size_t, 60> layers{};
  std::size_t around = 0;
  for (const Vector3f& place : places) {
    if (std::hypot(double{place[0]}, double{place[1]}) >= radius) continue;
    const double height = double{place[2]} - ground;
    if (height < over_ground) continue;
    ++around;
    const auto layer = static_cast<std::size_t>(height / step);
    if (layer < layers.size()) ++layers[layer];
  }
  OwnVehicle vehicle;
  if (around == 0) return vehicle;
  vehicle.share = static_cast<double>(around) / static_cast<double>(places.size());
  const auto most = std::ranges::max_element(layers);
  if (static_cast<double>(*most) > roof_share * static_cast<double>(around)) {
    vehicle.roof = step * (static_cast<double>(most - layers.begin()) + 0.5);
  }
  return vehicle;
}

}  // namespace flagstone::doctor
