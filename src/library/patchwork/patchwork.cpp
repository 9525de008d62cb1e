// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/mounting_height.hpp"
#include "library/core/segment_scan.hpp"
#include "library/core/thread_pool.hpp"
#include "library/patchwork/bin_labels.hpp"
#include "library/patchwork/concentric_zones.hpp"
#include "library/patchwork/ground_likelihood.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/fitters.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/plane_fits/stage_clock.hpp"

namespace flagstone {

using patchwork::BinLabels;
using patchwork::ConcentricZones;
using patchwork::GroundLikelihood;
using patchwork::LabelCounts;
using patchwork::Ring;
using plane_fits::BinGroups;
using plane_fits::FitSettings;
using plane_fits::ScanPoints;
using plane_fits::StageClock;

/// Patchwork from top to bottom: sort points into bins, fit a plane to each bin, decide which
/// planes are ground, write labels.
struct Patchwork::Pipeline {
  Pipeline(PatchworkConfig given, unsigned threads);

  void reserve(std::size_t point_count, Segmentation& result);
  LabelTotals segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept;

  /// A bin with enough points for a plane.
  struct FittedBin {
    std::uint32_t bin;
    std::uint32_t patch;  ///< index of its patch
    std::uint32_t ring;   ///< counted over all zones
  };

  /// Working memory of one thread.
  struct Fitter : plane_fits::Fitter {
    explicit Fitter(const PatchworkConfig& config);
    void reserve(std::size_t points);
    BinLabels bin_labels;
  };

  void label_points_without_bin(std::span<Label> labels) noexcept;
  std::span<FittedBin> list_patches(std::vector<Patch>& patches, std::span<Label> labels) noexcept;
  std::uint32_t fill(std::uint32_t bin, Label label, std::span<Label> labels) noexcept;
  void gather(std::span<const FittedBin> bins, Fitter& fitter) noexcept;

  PatchworkConfig config;
  ConcentricZones zones;
  GroundLikelihood likelihood;
  ScanPoints scan;
  BinGroups groups;
  Buffer<FittedBin> fitted_bins;
  StageTimes* stage_times = nullptr;
  ThreadPool pool;
  plane_fits::Fitters<Fitter> fitters;
};

LabelTotals Patchwork::Pipeline::segment(CloudView cloud, Segmentation& result,
                                         std::span<Label> labels) noexcept {
  const ScopedFloatingPointMode mode;
  StageClock scan_clock(stage_times);
  std::vector<Patch>& patches = result.mutable_patches();
  fitters.clear_totals();

  // Concentric Zone Model (III-B): find the bin of each point, eqs. (2) and (3)
  pool.run(plane_fits::chunk_count(cloud.size()), [&](std::size_t, std::size_t chunk) {
    patchwork::read_chunk(cloud, chunk, zones, scan);
  });
  scan_clock.end(Stage::bin);
  groups.group(scan, cloud.size(), zones.group_count());
  label_points_without_bin(labels);
  const std::span<FittedBin> all_bins = list_patches(patches, labels);
  scan_clock.end(Stage::group);

  const auto segment_bins = [&](std::span<FittedBin> bins, Fitter& fitter, StageClock& clock) {
    // Region-wise Ground Plane Fitting (III-C): seeds, eq. (5), and planes, eqs. (4) and (6)
    gather(bins, fitter);
    clock.end(Stage::gather);
    fitter.fit.fit(fitter.batch, fitter.seeds, clock, fitter.fitted);

    // Ground Likelihood Estimation (III-D): uprightness, elevation and flatness, eqs. (8) to (11)
    for (std::size_t i = 0; i < bins.size(); ++i) {
      Patch& patch = patches[bins[i].patch];
      patch.verdict = Verdict::no_plane;
      if (!fitter.fitted.has_plane(i)) continue;
      const Plane plane = fitter.fitted.plane(i);
      set_plane(plane, patch);
      likelihood.judge(plane, bins[i].ring, patch);
    }
    clock.end(Stage::solve);

    // The ground, eq. (12): the final ground sets of the patches that the likelihood accepts
    for (std::size_t i = 0; i < bins.size(); ++i) {
      Patch& patch = patches[bins[i].patch];
      if (!patch.is_ground()) continue;
      const LabelCounts counts =
          fitter.bin_labels.write(fitter.batch, i, fitter.fitted.sets[i], groups, labels);
      patch.ground_count = counts.ground;
      patch.lower_ground_count = counts.lower_ground;
      fitter.totals[static_cast<std::size_t>(Label::ground)] += counts.ground;
      fitter.totals[static_cast<std::size_t>(Label::noise)] += counts.noise;
    }
    clock.end(Stage::label);
  };
  fitters.run(pool, all_bins, scan_clock, segment_bins);
  return fitters.totals();
}

namespace {

FitSettings fit_settings(const PatchworkConfig& config) {
  return {.seed_height = config.seed_height,
          .distance_margin = config.distance_margin,
          .noise_margin = config.noise_margin,
          .iterations = config.iterations,
          .keep_below_floor = config.keep_below_margin,
          .evaluate_final_set = config.evaluate_final_set,
          .height_without_seeds = sensor_z(config.sensor_height)};
}

}  // namespace

Patchwork::Pipeline::Pipeline(PatchworkConfig given, unsigned threads)
    : config(checked(std::move(given))),
      zones(config),
      likelihood(config, zones.rings()),
      pool(checked_threads("patchwork", threads)),
      fitters(pool.size(), config) {}

Patchwork::Pipeline::Fitter::Fitter(const PatchworkConfig& config)
    : plane_fits::Fitter(fit_settings(config)), bin_labels(config) {
  seeds.counts.fill(static_cast<std::uint32_t>(config.seed_count));
}

void Patchwork::Pipeline::Fitter::reserve(std::size_t points) {
  plane_fits::Fitter::reserve(points);
  bin_labels.reserve(points);
}

void Patchwork::Pipeline::reserve(std::size_t point_count, Segmentation& result) {
  scan.reserve(point_count);
  groups.reserve(point_count, zones.group_count());
  fitters.reserve(point_count);
  result.mutable_patches().reserve(zones.bin_count());
  fitted_bins.reserve(zones.bin_count());
}

void Patchwork::Pipeline::label_points_without_bin(std::span<Label> labels) noexcept {
  fill(zones.noise(), Label::noise, labels);
  fill(zones.out_of_range(), Label::out_of_range, labels);
  fill(zones.invalid(), Label::invalid, labels);
}

/// Gives all points of a bin the same label. Returns the number of points.
std::uint32_t Patchwork::Pipeline::fill(std::uint32_t bin, Label label,
                                        std::span<Label> labels) noexcept {
  const std::uint32_t count = BinLabels::fill(groups, bin, label, labels);
  fitters.totals_of(0)[static_cast<std::size_t>(label)] += count;
  return count;
}

/// Adds one patch per bin with points. Returns the bins with enough points for a plane.
std::span<Patchwork::Pipeline::FittedBin> Patchwork::Pipeline::list_patches(
    std::vector<Patch>& patches, std::span<Label> labels) noexcept {
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < zones.rings().size(); ++r) {
    const Ring& ring = zones.rings()[r];
    for (std::uint16_t sector = 0; sector < ring.sectors; ++sector) {
      const std::uint32_t bin = ring.first_bin + sector;
      if (groups.size(bin) == 0) continue;
      Patch patch{.zone = ring.zone, .ring = ring.ring, .sector = sector};
      patch.point_count = groups.size(bin);
      if (patch.point_count >= static_cast<std::uint32_t>(config.min_points)) {
        const auto index = static_cast<std::uint32_t>(patches.size());
        fitted_bins.data()[count++] = {.bin = bin, .patch = index, .ring = r};
      } else if (config.sparse_bins_are_ground) {
        patch.ground_count = fill(bin, Label::ground, labels);
      }
      patches.push_back(patch);  // within the reserved memory
    }
  }
  return {fitted_bins.data(), count};
}

void Patchwork::Pipeline::gather(std::span<const FittedBin> bins, Fitter& fitter) noexcept {
  fitter.batch.clear();
  for (std::size_t i = 0; i < bins.size(); ++i) {
    fitter.seeds.floors[i] = zones.rings()[bins[i].ring].seed_floor;
    fitter.batch.add(bins[i].bin, groups.size(bins[i].bin));
  }
  fitter.batch.gather(scan, groups);
}

Patchwork::Patchwork(PatchworkConfig config, unsigned threads)
    : pipeline_(std::make_unique<Pipeline>(std::move(config), threads)) {}
Patchwork::~Patchwork() = default;
Patchwork::Patchwork(Patchwork&&) noexcept = default;
Patchwork& Patchwork::operator=(Patchwork&&) noexcept = default;

const PatchworkConfig& Patchwork::config() const noexcept { return pipeline_->config; }

void Patchwork::time_stages(StageTimes* times) noexcept { pipeline_->stage_times = times; }

Status Patchwork::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    pipeline_->reserve(cloud.size(), result);
    return pipeline_->segment(cloud, result, labels);
  });
}

}  // namespace flagstone
