// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "app/doctor/beam_origin.hpp"
#include "app/doctor/beam_rings.hpp"
#include "app/doctor/downsampling.hpp"
#include "app/doctor/ego_vehicle.hpp"
#include "app/doctor/extent.hpp"
#include "app/doctor/field_of_view.hpp"
#include "app/doctor/frame_orientation.hpp"
#include "files/io/cloud.hpp"

namespace flagstone::doctor {

/// What one scan shows.
struct Examination {
  std::size_t points = 0;
  std::size_t zero = 0;
  std::size_t not_finite = 0;
  std::size_t repeated = 0;

  /// Points that have a place. The rest is not looked at where they are too few.
  [[nodiscard]] std::size_t usable() const noexcept { return points - zero - not_finite; }
  [[nodiscard]] bool has_enough_points() const noexcept { return usable() >= 1000; }

  Extent extent{};
  Downsampling downsampling{};
  FrameOrientation orientation{};  ///< not looked for where the points lie far away
  RingSource rings = RingSource::none;
  std::optional<BeamOrigin> origin{};  ///< where rings are known
  FieldOfView view{};
  OwnVehicle vehicle{};
};

/// Looks at one scan. Any bit pattern is allowed in its coordinates.
Examination examine(const io::Cloud& cloud);

}  // namespace flagstone::doctor
