// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/plane_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flagstone::plane_fits {
namespace {

/// The smallest float that is not below `value`.
float round_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                         : nearest;
}

/// The nearest height on the grid of ExactGrid.
float on_grid(double height) {
  return static_cast<float>(std::nearbyint(height / ExactGrid::z_step)) * ExactGrid::z_step;
}

BinMask all_of(const BinBatch& batch) { return (BinMask{1} << batch.count()) - 1; }

}  // namespace

void PlaneFit::fit(BinBatch& batch, const Seeds& seeds, StageClock& clock,
                   Result& result) noexcept {
  // z-bar_init, eq. (5)
  std::array<float, batch_size> floors{};
  for (std::size_t i = 0; i < batch.count(); ++i) floors[i] = round_up(seeds.floors[i]);
  Batch initial_heights;
  seed_heights_.find(batch, floors, seeds.counts, initial_heights, settings_.height_without_seeds);
  clock.end(Stage::seed);

  // G^0, eq. (5), without the points below the floor if the settings exclude them. Afterwards,
  // heights are relative to z-bar_init, or to the first point if there was no seed. Heights on a
  // grid stay on it.
  GroundSets& sets = result.sets;
  std::array<FirstSet, batch_size> first_sets{};
  for (std::size_t i = 0; i < batch.count(); ++i) {
    auto origin = static_cast<float>(initial_heights[i]);
    if (settings_.exact) {
      origin = on_grid(initial_heights[i]);
    } else if (initial_heights[i] == settings_.height_without_seeds) {
      origin = batch.z(i)[0];
    }
    const double floor =
        settings_.keep_below_floor ? -std::numeric_limits<double>::infinity() : seeds.floors[i];
    const double bottom = std::max(floor, initial_heights[i] - settings_.seed_depth) - origin;
    const double top = initial_heights[i] + settings_.seed_height - origin;
    first_sets[i] = {origin, round_up(bottom), round_up(top)};
    sets[i] = {0, 0, 1, first_sets[i].bottom, first_sets[i].top};
    const BinBatch::Origin& packed = batch.origin(i);
    result.origins[i] = {packed.x, packed.y, double{packed.z} + double{origin}};
  }
  const Precision precision = settings_.exact ? Precision::exact : Precision::single;
  sum_first_moments(batch, first_sets, precision, moments_);

  // Planes, eq. (4), of sets from noise_margin below to M_d above the previous plane, eq. (6).
  PlaneBatch& planes = result.judged;
  result.exists = fit_sets(batch, sets, all_of(batch), clock, planes);
  for (int l = 1; l < settings_.iterations; ++l) {
    choose_next_sets(planes, sets);
    sum_moments(batch, sets, result.exists, precision, moments_);
    result.exists = fit_sets(batch, sets, result.exists, clock, planes);
  }
  choose_next_sets(planes, sets);
  if (settings_.evaluate_final_set) {
    sum_moments(batch, sets, result.exists, precision, moments_);
    result.exists = fit_sets(batch, sets, result.exists, clock, planes);
  }
}

/// Eq. (4) for the bins in `wanted`, whose moments are known. Returns the bins with a plane.
BinMask PlaneFit::fit_sets(const BinBatch& batch, const GroundSets& sets, BinMask wanted,
                           StageClock& clock, PlaneBatch& planes) noexcept {
  clock.end(Stage::moments);
  const BinMask doubtful = fit_planes(moments_, planes) & wanted;
  clock.end(Stage::solve);
  if (doubtful != 0 && !settings_.exact) {
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

/// G^(l+1), eq. (6): d^l - d-hat_k < M_d is n . p_k < M_d - d^l.
void PlaneFit::choose_next_sets(const PlaneBatch& planes, GroundSets& sets) const noexcept {
  for (std::size_t i = 0; i < batch_size; ++i) {
    sets[i] = {.normal_x = static_cast<float>(planes.normal[0][i]),
               .normal_y = static_cast<float>(planes.normal[1][i]),
               .normal_z = static_cast<float>(planes.normal[2][i]),
               .bottom = static_cast<float>(-settings_.noise_margin - planes.d[i]),
               .top = static_cast<float>(settings_.distance_margin - planes.d[i])};
  }
}

}  // namespace flagstone::plane_fits
