// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/moving_labels.hpp"

#include <cstddef>
#include <cstdint>

namespace flagstone {

void label_moving_points(const MovingMask& moving, Label label, std::span<Label> labels) noexcept {
  if (moving.objects.empty()) return;
  const std::uint32_t* const objects = moving.objects_of_points.data();
  Label* const to = labels.data();
  for (std::size_t i = 0; i < labels.size(); ++i) to[i] = objects[i] != 0 ? label : to[i];
}

}  // namespace flagstone
