// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "app/doctor/examination.hpp"

namespace flagstone::doctor {

/// The axis is taken for up unless the ground says otherwise by more than this, degrees: a street
/// is cambered, a hill is not a tilted mount.
inline constexpr double least_tilt = 5;

/// How the frame of several scans stands to their ground, as most of them say.
struct CommonOrientation {
  std::size_t scans = 0;     ///< those that say so
  Vector3f axis{0, 0, 1};    ///< the axis of the cloud that is nearest to up
  Vector3f up{0, 0, 1};      ///< up in the cloud's frame, unit length
  double tilt = 0;           ///< degrees between the two
  double ground = 0;         ///< along the axis from the cloud's origin, metres: the median
  double lowest_ground = 0;  ///< of all scans
  double highest_ground = 0;

  /// Is up another direction than the axis?
  [[nodiscard]] bool is_tilted() const noexcept { return tilt >= least_tilt; }
};

/// What several scans of one sensor show together: medians, and shares of all points.
struct Summary {
  std::size_t scans = 0;
  double points = 0;
  double usable = 0;
  double zero = 0;        ///< share of points, 0 to 1
  double not_finite = 0;  ///< the same
  double repeated = 0;    ///< the same, of usable ones

  /// Whether there are points to look at; without them the rest says nothing.
  bool has_enough_points = false;
  double metres = 1;         ///< a unit
  Vector3f middle{};         ///< of the points, in the file's units
  bool is_far_away = false;  ///< they lie all on one side of the origin, far away
  bool is_from_many_places = false;
  double reach = 0;     ///< metres: 99 in 100 points are nearer
  double farthest = 0;  ///< metres

  std::optional<CommonOrientation> orientation{};  ///< empty: no scan shows its ground
  MountDecision refusal{};                         ///< why, in the first scan
  bool shows_beam_origin = false;         ///< Do the points show where the beams come from?
  std::optional<Vector3f> beam_origin{};  ///< metres in the cloud's frame turned so that the axis
                                          ///< is z; empty if it is the origin or is not shown
  RingSource rings = RingSource::none;
  FieldOfView view{};
  double growth = 0;  ///< Downsampling::growth
  bool is_voxel_averaged = false;
  EgoVehicle vehicle{};

  /// Can the points be read as one sensor's scan at all?
  [[nodiscard]] bool is_scan() const noexcept {
    return has_enough_points && !is_far_away && !is_from_many_places;
  }
};

/// At least one scan.
Summary summarise(std::span<const Examination> scans);

}  // namespace flagstone::doctor
