// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patches/plane_fit.hpp"

#include <cmath>
#include <limits>

namespace flagstone::patches {
namespace {

/// The least float that is not below `value`.
float round_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                         : nearest;
}

BinMask all_of(const BinBatch& batch) { return (BinMask{1} << batch.count()) - 1; }

}  // namespace

PlaneFit::PlaneFit(const PatchworkConfig& config)
    : seed_height_(config.seed_height),
      distance_margin_(config.distance_margin),
      noise_margin_(config.noise_margin),
      iterations_(config.iterations),
      keep_below_margin_(config.keep_below_margin),
      judge_final_set_(config.judge_final_set),
      seed_heights_(static_cast<std::size_t>(config.seed_count)) {
  for (const Zone& zone : config.zones) {
    // No margin is none at any sensor height, though infinity * 0 is not a number.
    const double margin = zone.height_margin;
    seed_cuts_.push_back(std::isinf(margin) ? margin : margin * config.sensor_height);
  }
}

void PlaneFit::fit(BinBatch& batch, const std::array<std::uint16_t, batch_size>& zones,
                   StageClock& clock, Result& result) noexcept {
  // z-bar_init, eq. (4)
  std::array<float, batch_size> seed_cuts{};
  for (std::size_t i = 0; i < batch.count(); ++i) seed_cuts[i] = round_up(seed_cuts_[zones[i]]);
  Batch initial_heights;
  seed_heights_.find(batch, seed_cuts, initial_heights);
  clock.end(Stage::seed);

  // G^0, eq. (4), with the points below the margin kept out where the paper has it so. Heights are
  // seen from z-bar_init from now on; where there was no seed and it is 0, from the first point.
  GroundSets& sets = result.sets;
  std::array<FirstSet, batch_size> first_sets{};
  for (std::size_t i = 0; i < batch.count(); ++i) {
    const float origin =
        initial_heights[i] == 0 ? batch.z(i)[0] : static_cast<float>(initial_heights[i]);
    const double bottom = keep_below_margin_ ? -std::numeric_limits<double>::infinity()
                                             : seed_cuts_[zones[i]] - origin;
    const double top = initial_heights[i] + seed_height_ - origin;
    first_sets[i] = {origin, round_up(bottom), round_up(top)};
    sets[i] = {0, 0, 1, first_sets[i].bottom, first_sets[i].top};
    result.origins[i] = {batch.origin(i).x, batch.origin(i).y, origin};
  }
  sum_first_moments(batch, first_sets, moments_);

  // G^(l+1), eqs. (5) and (6): the points less than M_d above the plane of G^l, and not so far
  // below it that they are noise.
  PlaneBatch& planes = result.judged;
  result.exists = fit_sets(batch, sets, all_of(batch), clock, planes);
  for (int l = 1; l < iterations_; ++l) {
    choose_next_sets(planes, sets);
    sum_moments(batch, sets, result.exists, Precision::single, moments_);
    result.exists = fit_sets(batch, sets, result.exists, clock, planes);
  }
  choose_next_sets(planes, sets);
  if (judge_final_set_) {
    sum_moments(batch, sets, result.exists, Precision::single, moments_);
    result.exists = fit_sets(batch, sets, result.exists, clock, planes);
  }
}

/// Eq. (3) for the bins in `wanted`, whose moments are taken; returns those that have a plane.
BinMask PlaneFit::fit_sets(const BinBatch& batch, const GroundSets& sets, BinMask wanted,
                           StageClock& clock, PlaneBatch& planes) noexcept {
  clock.end(Stage::moments);
  const BinMask doubtful = fit_planes(moments_, planes) & wanted;
  clock.end(Stage::solve);
  if (doubtful != 0) {
    sum_moments(batch, sets, doubtful, Precision::full, moments_);
    clock.end(Stage::moments);
    fit_planes(moments_, planes);
    clock.end(Stage::solve);
  }

  BinMask exists = 0;
  for (std::size_t i = 0; i < batch.count(); ++i) {
    exists |= static_cast<BinMask>(planes.count[i] >= 3) << i;
  }
  return exists & wanted;
}

void PlaneFit::choose_next_sets(const PlaneBatch& planes, GroundSets& sets) const noexcept {
  for (std::size_t i = 0; i < batch_size; ++i) {
    sets[i] = {.normal_x = static_cast<float>(planes.normal[0][i]),
               .normal_y = static_cast<float>(planes.normal[1][i]),
               .normal_z = static_cast<float>(planes.normal[2][i]),
               .bottom = static_cast<float>(-noise_margin_ - planes.d[i]),
               .top = static_cast<float>(distance_margin_ - planes.d[i])};
  }
}

}  // namespace flagstone::patches
