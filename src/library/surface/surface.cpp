// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/segment_scan.hpp"
#include "library/core/thread_pool.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/plane_fit.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/plane_fits/stage_clock.hpp"
#include "library/surface/accepted_patches.hpp"
#include "library/surface/coarse_surface.hpp"
#include "library/surface/lower_ground.hpp"
#include "library/surface/patch_judge.hpp"
#include "library/surface/point_heights.hpp"
#include "library/surface/pull_push.hpp"
#include "library/surface/read_scan.hpp"
#include "library/surface/residual_pyramid.hpp"
#include "library/surface/slab_counts.hpp"
#include "library/surface/square_cells.hpp"
#include "library/surface/square_patches.hpp"

namespace flagstone {

using plane_fits::BinBatch;
using plane_fits::BinGroups;
using plane_fits::PlaneFit;
using plane_fits::ScanPoints;
using plane_fits::StageClock;
using surface::AcceptedPatches;
using surface::CoarseSurface;
using surface::FittedPatch;
using surface::LabelTotals;
using surface::LowerGround;
using surface::PatchJudge;
using surface::PointHeights;
using surface::PullPush;
using surface::ResidualPyramid;
using surface::SquareCells;
using surface::SquarePatch;
using surface::SquarePatches;

namespace {

/// Patches of fewer points are not fitted.
constexpr std::size_t fewest_points = 11;

/// Points of a patch that its plane is fitted to, evenly from all of them: a plane needs no more.
constexpr std::size_t most_samples = 128;

/// Where confidence is less, nothing supports the surface.
constexpr float min_confidence = 1.0f / 16;

/// Within this range patches have no seed lower than `seed_floor` below the ground that the
/// sensor's height lets expect, metres: reflections of cars stand below them.
constexpr float reflection_range = 10;
constexpr float seed_floor = 0.5f;

constexpr plane_fits::FitSettings fit_settings{.seed_height = 0.5,
                                               .seed_depth = 1.0,
                                               .distance_margin = 0.125,
                                               .noise_margin = 0.375,
                                               .iterations = 3,
                                               .keep_below_floor = true,
                                               .evaluate_final_set = false};

SurfaceConfig checked(SurfaceConfig config) {
  config.check();
  return config;
}

/// The lowest of that many points are seeds.
std::uint32_t seed_count(std::size_t points) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(points / 5, 3, 20));
}

/// A patch as its neighbours see it. Only for patches that are upright.
FittedPatch seen_by_neighbours(const Plane& plane) {
  return {.x = static_cast<float>(plane.mean[0]),
          .y = static_cast<float>(plane.mean[1]),
          .z = static_cast<float>(plane.mean[2]),
          .slope_x = static_cast<float>(-plane.normal[0] / plane.normal[2]),
          .slope_y = static_cast<float>(-plane.normal[1] / plane.normal[2]),
          .points = static_cast<float>(plane.count)};
}

}  // namespace

namespace surface {

/// What one thread needs to fit patches.
struct Fitter {
  Fitter() : fit(fit_settings) {
    batch.reserve(batch_size * most_samples);
    fit.reserve(batch_size * most_samples);
  }

  BinBatch batch;
  plane_fits::Seeds seeds;
  PlaneFit fit;
  PlaneFit::Result fitted;
  LabelTotals totals{};
};

}  // namespace surface

/// The method, top to bottom: points into cells, a plane for each patch of them, one surface of the
/// planes that are ground, that surface refined, points by their height above it.
struct Surface::Pipeline {
  Pipeline(SurfaceConfig settings, unsigned threads)
      : config(checked(settings)),
        cells(config),
        square_patches(config, cells),
        judge(config),
        pyramid(config, cells),
        coarse(pyramid.grids().front(), config.sensor_height),
        pull_push(pyramid.grids().front().width),
        point_heights(config, cells),
        lower_ground(cells),
        groups(plane_fits::Listing::points),
        pool(checked_threads("surface", threads)) {
    for (const surface::Grid& grid : pyramid.grids()) widest = std::max(widest, grid.width);
    pull_push = PullPush(widest);
    for (std::size_t i = 0; i < pool.size(); ++i) fitters.emplace_back();
    fitted_patches.reserve(square_patches.list().size());
    planes.reserve(square_patches.list().size());
    accepted.reserve(square_patches.list().size());
  }

  void reserve(std::size_t point_count, Segmentation& result) {
    scan.reserve(point_count);
    groups.reserve(point_count, cells.group_count());
    result.mutable_patches().reserve(square_patches.list().size());
    result.start_heights();
    reserve_surface(result.mutable_surface());
  }

  void reserve_surface(GroundSurface& made) const {
    std::vector<GroundSurface::Grid>& grids = made.start();
    grids.resize(pyramid.grids().size());
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const surface::Grid& grid = pyramid.grids()[i];
      grids[i].cell = grid.cell;
      grids[i].width = grid.width;
      grids[i].heights.resize(grid.size());
      grids[i].confidences.resize(grid.size());
    }
  }

  LabelTotals segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    const ScopedFloatingPointMode own;
    StageClock clock(stage_times);
    const std::size_t chunks = ScanPoints::chunk_count(cloud.size());
    pool.run(chunks, [&](std::size_t, std::size_t chunk) {
      surface::read_chunk(cloud, chunk, cells, scan);
    });
    clock.end(Stage::bin);
    groups.group(scan, cloud.size(), cells.group_count());
    list_patches(result.mutable_patches());
    clock.end(Stage::group);

    // Planes, sixteen patches at a time
    const std::span<Patch> found = result.mutable_patches();
    const std::size_t batches = (fitted_count + batch_size - 1) / batch_size;
    pool.run(batches, [&](std::size_t worker, std::size_t batch) {
      StageClock no_clock(nullptr);
      fit_batch(batch, found, fitters[worker], worker == 0 ? clock : no_clock);
    });

    // The surface
    coarse.clear();
    join(found);
    coarse.finish(pull_push);
    clock.end(Stage::join);
    pyramid.refine(groups, pull_push, pool);
    copy_to(result.mutable_surface());
    clock.end(Stage::refine);

    // Points
    const std::span<float> heights = result.start_heights();
    point_heights.set_surface(pyramid.grids());
    pool.run(chunks,
             [&](std::size_t, std::size_t chunk) { point_heights.measure(scan, chunk, heights); });
    clock.end(Stage::measure);
    for (surface::Fitter& fitter : fitters) fitter.totals = {};
    pool.run(chunks, [&](std::size_t worker, std::size_t chunk) {
      point_heights.label(scan, chunk, heights, labels, fitters[worker].totals);
    });
    LabelTotals totals{};
    for (const surface::Fitter& fitter : fitters) {
      for (std::size_t i = 0; i < label_count; ++i) totals[i] += fitter.totals[i];
    }
    const std::size_t sunken = lower_ground.find(scan, labels);
    totals[static_cast<std::size_t>(Label::ground)] += sunken;
    totals[static_cast<std::size_t>(Label::noise)] -= sunken;
    clock.end(Stage::label);
    return totals;
  }

  /// One for each that holds points; those with enough points are to be fitted.
  void list_patches(std::vector<Patch>& found) noexcept {
    fitted_count = 0;
    const std::span<const SquarePatch> squares = square_patches.list();
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const SquarePatch& square = squares[i];
      const std::size_t points = groups.points(square.cells.first, square.cells.last).size();
      if (points == 0) continue;
      Patch patch{.zone = square.size_class, .ring = square.row, .sector = square.column};
      patch.point_count = static_cast<std::uint32_t>(points);
      if (points >= fewest_points) {
        fitted_patches.data()[fitted_count++] = {.square = static_cast<std::uint32_t>(i),
                                                 .patch = static_cast<std::uint32_t>(found.size())};
      }
      found.push_back(patch);  // within what was reserved
    }
  }

  void fit_batch(std::size_t index, std::span<Patch> found, surface::Fitter& fitter,
                 StageClock& clock) noexcept {
    const std::size_t first = index * batch_size;
    const std::span<const FittedSquare> batch(fitted_patches.data() + first,
                                              std::min(batch_size, fitted_count - first));
    fitter.batch.clear();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const SquarePatch& square = square_patches.list()[batch[i].square];
      fitter.batch.add_sample(batch[i].square, groups.points(square.cells.first, square.cells.last),
                              most_samples);
      const bool near =
          square.x * square.x + square.y * square.y < reflection_range * reflection_range;
      fitter.seeds.floors[i] =
          near ? -config.sensor_height - seed_floor : -std::numeric_limits<float>::infinity();
      fitter.seeds.counts[i] = seed_count(fitter.batch.size(i));
    }
    clock.end(Stage::gather);
    fitter.fit.fit(fitter.batch, fitter.seeds, clock, fitter.fitted);

    const PlaneFit::Result& fitted = fitter.fitted;
    const auto counts = surface::count_slabs(fitter.batch, fitted.judged);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      Patch& patch = found[batch[i].patch];
      if ((fitted.exists >> i & 1U) == 0) {
        patch.verdict = Verdict::no_plane;
        continue;
      }
      Plane& plane = planes.data()[first + i];
      plane = fitted.judged[i].moved_by(fitted.origins[i]);
      patch.verdict = judge.judge_alone(plane, counts[i]);
      if (patch.verdict == Verdict::no_plane) continue;
      set_plane(plane, patch);
      const double share = plane.count / static_cast<double>(fitter.batch.size(i));
      patch.ground_count = static_cast<std::uint32_t>(share * patch.point_count);
    }
    clock.end(Stage::solve);
  }

  /// From the sensor outward: what nearer patches let expect decides.
  void join(std::span<Patch> found) noexcept {
    accepted.clear();
    for (std::size_t i = 0; i < fitted_count; ++i) {
      Patch& patch = found[fitted_patches.data()[i].patch];
      if (patch.verdict == Verdict::ground) {
        const Plane& plane = planes.data()[i];
        const FittedPatch seen = seen_by_neighbours(plane);
        patch.verdict = judge.judge_step(seen, accepted);
        if (patch.verdict == Verdict::ground) {
          accepted.add(seen);
          coarse.add(plane, square_patches.list()[fitted_patches.data()[i].square].size);
          continue;
        }
      }
      patch.ground_count = 0;
    }
  }

  void copy_to(GroundSurface& made) const noexcept {
    std::vector<GroundSurface::Grid>& grids = made.start();
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const surface::Grid& grid = pyramid.grids()[i];
      for (std::size_t k = 0; k < grid.size(); ++k) {
        if (grid.confidences[k] >= min_confidence) continue;
        grid.heights[k] = std::numeric_limits<float>::quiet_NaN();
        grid.confidences[k] = 0;
      }
      std::copy_n(grid.heights, grid.size(), grids[i].heights.data());
      std::copy_n(grid.confidences, grid.size(), grids[i].confidences.data());
    }
  }

  struct FittedSquare {
    std::uint32_t square;  ///< its index
    std::uint32_t patch;   ///< its index
  };

  SurfaceConfig config;
  SquareCells cells;
  SquarePatches square_patches;
  PatchJudge judge;
  ResidualPyramid pyramid;
  CoarseSurface coarse;
  std::size_t widest = 0;
  PullPush pull_push;
  PointHeights point_heights;
  LowerGround lower_ground;
  ScanPoints scan;
  BinGroups groups;
  Buffer<FittedSquare> fitted_patches;
  Buffer<Plane> planes;
  std::size_t fitted_count = 0;
  AcceptedPatches accepted;
  StageTimes* stage_times = nullptr;
  std::vector<surface::Fitter> fitters;  ///< one per thread
  ThreadPool pool;
};

Surface::Surface(SurfaceConfig config, unsigned threads)
    : pipeline_(std::make_unique<Pipeline>(config, threads)) {}
Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

const SurfaceConfig& Surface::config() const noexcept { return pipeline_->config; }

void Surface::time_stages(StageTimes* times) noexcept { pipeline_->stage_times = times; }

Status Surface::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    pipeline_->reserve(cloud.size(), result);
    return pipeline_->segment(cloud, result, labels);
  });
}

}  // namespace flagstone
