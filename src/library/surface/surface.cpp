// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/surface.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/mounting_height.hpp"
#include "library/core/segment_scan.hpp"
#include "library/core/thread_pool.hpp"
#include "library/plane_fits/fitters.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/plane_fits/stage_clock.hpp"
#include "library/surface/coarse_samples.hpp"
#include "library/surface/coarse_surface.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/lower_ground.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/patch_judge.hpp"
#include "library/surface/point_heights.hpp"
#include "library/surface/residual_pyramid.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone {

using plane_fits::Fitter;
using plane_fits::StageClock;
using surface::AcceptedPatches;
using surface::CoarseSamples;
using surface::CoarseSurface;
using surface::FittedPatch;
using surface::LowerGround;
using surface::PackedPoints;
using surface::PatchJudge;
using surface::PointHeights;
using surface::PullPush;
using surface::ResidualPyramid;
using surface::SquareCells;
using surface::SquarePatch;
using surface::SquarePatches;

namespace {

/// Patches with fewer points are not fitted.
constexpr std::size_t fewest_points = 11;

/// Within this range, metres, points lower than this above the expected ground are not used to
/// choose the seeds: they are reflections of cars.
constexpr float reflection_range = 10;
constexpr float seed_floor = -0.5f;

/// Heights are relative to SquareCells::packed_zero().
plane_fits::FitSettings fit_settings(const SurfaceConfig& config, const SquareCells& cells) {
  return {.seed_height = 0.5,
          .seed_depth = 1.0,
          .distance_margin = 0.125,
          .noise_margin = 0.375,
          .iterations = 3,
          .keep_below_floor = true,
          .evaluate_final_set = false,
          .exact = true,
          .height_without_seeds = sensor_z(config.sensor_height) - cells.packed_zero()};
}

/// Number of lowest points of a patch whose mean height selects the seeds.
std::uint32_t seed_count(std::size_t points) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(points / 5, 3, 20));
}

}  // namespace

/// The pipeline in order: pack the points and sort them by cell, fit a plane to each patch of
/// cells, merge the ground planes into one surface, refine the surface, label points by their
/// height above it. No step depends on the order of the points.
struct Surface::Pipeline {
  Pipeline(const SurfaceConfig& given, unsigned threads);

  void reserve(std::size_t point_count, Segmentation& result);
  LabelTotals segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept;

  /// A patch with enough points for a plane.
  struct FittedSquare {
    const SquarePatch* square;
    std::uint32_t patch;  ///< index of the Patch
    Plane plane;          ///< in the sensor frame; unset for `no_plane`
  };

  std::span<FittedSquare> list_patches(std::vector<Patch>& patches) noexcept;
  void gather(std::span<const FittedSquare> squares, Fitter& fitter) noexcept;
  void judge_alone(std::span<FittedSquare> squares, const Fitter& fitter,
                   std::span<Patch> patches) const noexcept;
  void join(std::span<const FittedSquare> squares, std::span<Patch> patches) noexcept;

  SurfaceConfig config;
  SquareCells cells;
  SquarePatches square_patches;
  PatchJudge judge;
  ResidualPyramid pyramid;
  CoarseSurface coarse;
  PullPush pull_push;
  PointHeights point_heights;
  LowerGround lower_ground;
  PackedPoints points;
  CoarseSamples samples;
  Buffer<FittedSquare> fitted_squares;
  AcceptedPatches accepted;
  StageTimes* stage_times = nullptr;
  ThreadPool pool;
  plane_fits::Fitters<Fitter> fitters;
};

LabelTotals Surface::Pipeline::segment(CloudView cloud, Segmentation& result,
                                       std::span<Label> labels) noexcept {
  const ScopedFloatingPointMode mode;
  StageClock scan_clock(stage_times);
  const std::size_t chunks = plane_fits::chunk_count(cloud.size());
  std::vector<Patch>& patches = result.mutable_patches();

  // Sort the points into cells
  pool.run(chunks, [&](std::size_t, std::size_t chunk) { points.read(cloud, chunk, cells); });
  scan_clock.end(Stage::bin);
  points.sort(cloud.size(), cells);
  samples.take(points);
  const std::span<FittedSquare> all_squares = list_patches(patches);
  scan_clock.end(Stage::group);

  // Fit a plane to each patch and decide whether it can be ground
  const auto fit_squares = [&](std::span<FittedSquare> squares, Fitter& fitter, StageClock& clock) {
    gather(squares, fitter);
    clock.end(Stage::gather);
    fitter.fit.fit(fitter.batch, fitter.seeds, clock, fitter.fitted);
    judge_alone(squares, fitter, patches);
    clock.end(Stage::solve);
  };
  fitters.run(pool, all_squares, scan_clock, fit_squares);

  // Merge the consistent planes into the surface, then correct it in cells of 2 m down to 0.25 m
  coarse.clear();
  join(all_squares, patches);
  coarse.finish(pull_push);
  scan_clock.end(Stage::join);
  pyramid.refine(points, samples, pull_push, pool);
  pyramid.finish(result.mutable_surface());
  scan_clock.end(Stage::refine);

  // Compute the heights of all points above the surface, and label the points by their height
  const surface::PointHeights::Results results{.heights = result.start_heights(), .labels = labels};
  point_heights.set_surface(pyramid.grids());
  fitters.clear_totals();
  pool.run(chunks, [&](std::size_t worker, std::size_t chunk) {
    point_heights.measure(cloud, points.unusual(), chunk, results, fitters.totals_of(worker));
  });
  scan_clock.end(Stage::measure);

  // Label the points whose label depends on obstacles. Points below the surface that form a
  // separate plane are ground, too.
  pool.run(chunks, [&](std::size_t worker, std::size_t chunk) {
    point_heights.label(chunk, results, fitters.totals_of(worker));
  });
  LabelTotals totals = fitters.totals();
  const std::size_t lower = lower_ground.find(cloud, labels);
  totals[static_cast<std::size_t>(Label::ground)] += lower;
  totals[static_cast<std::size_t>(Label::noise)] -= lower;
  scan_clock.end(Stage::label);
  return totals;
}

Surface::Pipeline::Pipeline(const SurfaceConfig& given, unsigned threads)
    : config(checked(given)),
      cells(config),
      square_patches(config, cells),
      judge(config),
      pyramid(config, cells),
      coarse(pyramid.grids().front(), config.sensor_height),
      pull_push(pyramid.most_cells_along()),
      point_heights(config, cells, pyramid.grids()),
      lower_ground(cells),
      samples(cells),
      pool(checked_threads("surface", threads)),
      fitters(pool.size(), fit_settings(config, cells)) {
  fitters.reserve(batch_size * plane_fits::ExactGrid::most_points);
  fitted_squares.reserve(square_patches.list().size());
  accepted.reserve(square_patches.list().size());
}

void Surface::Pipeline::reserve(std::size_t point_count, Segmentation& result) {
  points.reserve(point_count, cells);
  samples.reserve(point_count);
  point_heights.reserve(point_count);
  result.mutable_patches().reserve(square_patches.list().size());
  result.start_heights();
  pyramid.reserve(result.mutable_surface());
}

/// Adds one patch for each square that contains points. Returns the squares with enough points for
/// a plane, nearest to the sensor first.
std::span<Surface::Pipeline::FittedSquare> Surface::Pipeline::list_patches(
    std::vector<Patch>& patches) noexcept {
  std::size_t count = 0;
  for (const SquarePatch& square : square_patches.list()) {
    const std::size_t held = points.points(square.cells.first, square.cells.last).size();
    if (held == 0) continue;
    Patch patch{.zone = square.size_class, .ring = square.row, .sector = square.column};
    patch.point_count = static_cast<std::uint32_t>(held);
    if (held >= fewest_points) {
      const auto index = static_cast<std::uint32_t>(patches.size());
      fitted_squares.data()[count++] = {.square = &square, .patch = index, .plane = {}};
    }
    patches.push_back(patch);  // within the reserved capacity
  }
  return {fitted_squares.data(), count};
}

void Surface::Pipeline::gather(std::span<const FittedSquare> squares, Fitter& fitter) noexcept {
  fitter.batch.clear();
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const SquarePatch& square = *squares[i].square;
    samples.add_patch(square, fitter.batch);
    const bool near =
        square.x * square.x + square.y * square.y < reflection_range * reflection_range;
    fitter.seeds.floors[i] = near ? seed_floor - config.sensor_height - cells.packed_zero()
                                  : -std::numeric_limits<float>::infinity();
    fitter.seeds.counts[i] = seed_count(fitter.batch.size(i));
  }
}

/// Evaluates each patch without its neighbours.
void Surface::Pipeline::judge_alone(std::span<FittedSquare> squares, const Fitter& fitter,
                                    std::span<Patch> patches) const noexcept {
  const auto counts = surface::count_slabs(fitter.batch, fitter.fitted.judged);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    Patch& patch = patches[squares[i].patch];
    patch.verdict = Verdict::no_plane;
    if (!fitter.fitted.has_plane(i)) continue;
    Plane& plane = squares[i].plane;
    plane = fitter.fitted.plane(i);
    patch.verdict = judge.judge_alone(plane, counts[i]);
    if (patch.verdict == Verdict::no_plane) continue;
    set_plane(plane, patch);
    const double share = plane.count / static_cast<double>(fitter.batch.size(i));
    patch.ground_count = static_cast<std::uint32_t>(share * patch.point_count);
  }
}

/// Evaluates the patches from the sensor outward: each must match the height that nearer patches
/// predict. Then removes those that the patches around them contradict, and adds the others to the
/// coarse surface.
void Surface::Pipeline::join(std::span<const FittedSquare> squares,
                             std::span<Patch> patches) noexcept {
  accepted.clear();
  for (const FittedSquare& fitted : squares) {
    Patch& patch = patches[fitted.patch];
    if (patch.verdict != Verdict::ground) continue;
    const FittedPatch seen = FittedPatch::of(fitted.plane);
    patch.verdict = judge.judge_step(seen, accepted);
    if (patch.verdict == Verdict::ground) accepted.add(seen);
  }
  for (const FittedSquare& fitted : squares) {
    Patch& patch = patches[fitted.patch];
    if (patch.verdict == Verdict::ground) {
      patch.verdict = judge.judge_among(FittedPatch::of(fitted.plane), accepted);
    }
    if (patch.verdict == Verdict::ground) {
      coarse.add(fitted.plane, fitted.square->size);
    } else {
      patch.ground_count = 0;
    }
  }
}

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
