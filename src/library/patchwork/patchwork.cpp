// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/segment_scan.hpp"
#include "library/core/thread_pool.hpp"
#include "library/patchwork/bin_labels.hpp"
#include "library/patchwork/concentric_zones.hpp"
#include "library/patchwork/fit_settings.hpp"
#include "library/patchwork/ground_likelihood.hpp"
#include "library/patchwork/read_scan.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/plane_fit.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/plane_fits/stage_clock.hpp"

namespace flagstone {

using patchwork::BinLabels;
using patchwork::ConcentricZones;
using patchwork::GroundLikelihood;
using patchwork::LabelCounts;
using patchwork::read_chunk;
using patchwork::Ring;
using plane_fits::BinBatch;
using plane_fits::BinGroups;
using plane_fits::PlaneFit;
using plane_fits::ScanPoints;
using plane_fits::StageClock;

namespace {

/// Points by label, as Segmentation::finish takes them.
using LabelTotals = std::array<std::size_t, label_count>;

PatchworkConfig checked(PatchworkConfig config) {
  config.check();
  return config;
}

}  // namespace

namespace patchwork {

/// What one thread needs to fit bins.
struct Fitter {
  explicit Fitter(const PatchworkConfig& config) : fit(fit_settings(config)) {
    seeds.counts.fill(static_cast<std::uint32_t>(config.seed_count));
  }

  void reserve(std::size_t point_count) {
    batch.reserve(point_count);
    fit.reserve(point_count);
    bin_labels.reserve(point_count);
  }

  BinBatch batch;
  plane_fits::Seeds seeds{};
  PlaneFit fit;
  PlaneFit::Result fitted;
  BinLabels bin_labels;
  LabelTotals totals{};
};

}  // namespace patchwork

/// Patchwork, top to bottom: points into bins, a plane for each bin, a verdict for each plane,
/// labels.
struct Patchwork::Pipeline {
  Pipeline(PatchworkConfig settings, unsigned threads)
      : config(checked(std::move(settings))),
        zones(config),
        likelihood(config, zones.rings()),
        seed_floors(patchwork::seed_floors(config)),
        pool(checked_threads("patchwork", threads)) {
    for (std::size_t i = 0; i < pool.size(); ++i) fitters.emplace_back(config);
  }

  void reserve(std::size_t point_count, Segmentation& result) {
    scan.reserve(point_count);
    groups.reserve(point_count, zones.group_count());
    for (patchwork::Fitter& fitter : fitters) fitter.reserve(point_count);
    result.mutable_patches().reserve(zones.bin_count());
    fitted_bins.reserve(zones.bin_count());
  }

  LabelTotals segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    const ScopedFloatingPointMode own;
    StageClock clock(stage_times);

    // Concentric Zone Model (III-B)
    pool.run(ScanPoints::chunk_count(cloud.size()),
             [&](std::size_t, std::size_t chunk) { read_chunk(cloud, chunk, zones, scan); });
    clock.end(Stage::bin);
    groups.group(scan, cloud.size(), zones.group_count());
    for (patchwork::Fitter& fitter : fitters) fitter.totals = {};
    label_binless(labels);
    list_patches(result.mutable_patches(), labels);
    clock.end(Stage::group);

    // Planes and verdicts (III-C, III-D), sixteen bins at a time
    const std::span<Patch> patches = result.mutable_patches();
    const std::size_t batches = (fitted_count + batch_size - 1) / batch_size;
    pool.run(batches, [&](std::size_t worker, std::size_t batch) {
      StageClock no_clock(nullptr);
      segment_batch(batch, patches, labels, fitters[worker], worker == 0 ? clock : no_clock);
    });

    LabelTotals totals{};
    for (const patchwork::Fitter& fitter : fitters) {
      for (std::size_t i = 0; i < label_count; ++i) totals[i] += fitter.totals[i];
    }
    return totals;
  }

  /// Points that have no bin.
  void label_binless(std::span<Label> labels) noexcept {
    fill(zones.noise(), Label::noise, labels);
    fill(zones.out_of_range(), Label::out_of_range, labels);
    fill(zones.invalid(), Label::invalid, labels);
  }

  /// Gives all points of a bin one label.
  std::uint32_t fill(std::uint32_t bin, Label label, std::span<Label> labels) noexcept {
    const std::uint32_t count = BinLabels::fill(groups, bin, label, labels);
    fitters.front().totals[static_cast<std::size_t>(label)] += count;
    return count;
  }

  /// One patch for each bin that holds points; those with enough points are to be fitted.
  void list_patches(std::vector<Patch>& patches, std::span<Label> labels) noexcept {
    fitted_count = 0;
    for (std::size_t r = 0; r < zones.rings().size(); ++r) {
      const Ring& ring = zones.rings()[r];
      for (std::uint16_t sector = 0; sector < ring.sectors; ++sector) {
        const std::uint32_t bin = ring.first_bin + sector;
        if (groups.size(bin) == 0) continue;
        Patch patch{.zone = ring.zone, .ring = ring.ring, .sector = sector};
        patch.point_count = groups.size(bin);
        if (patch.point_count >= static_cast<std::uint32_t>(config.min_points)) {
          fitted_bins.data()[fitted_count++] = {.bin = bin,
                                                .patch = static_cast<std::uint32_t>(patches.size()),
                                                .ring = static_cast<std::uint32_t>(r)};
        } else if (config.sparse_bins_are_ground) {
          patch.ground_count = fill(bin, Label::ground, labels);
        }
        patches.push_back(patch);  // within what was reserved
      }
    }
  }

  void segment_batch(std::size_t index, std::span<Patch> patches, std::span<Label> labels,
                     patchwork::Fitter& fitter, StageClock& clock) noexcept {
    const std::size_t first = index * batch_size;
    const std::span<const FittedBin> bins(fitted_bins.data() + first,
                                          std::min(batch_size, fitted_count - first));
    fitter.batch.clear();
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const Patch& patch = patches[bins[i].patch];
      fitter.seeds.floors[i] = seed_floors[patch.zone];
      fitter.batch.add(bins[i].bin, patch.point_count);
    }

    // Region-wise Ground Plane Fitting (III-C)
    fitter.batch.gather(scan, groups);
    clock.end(Stage::gather);
    fitter.fit.fit(fitter.batch, fitter.seeds, clock, fitter.fitted);

    // Ground Likelihood Estimation (III-D)
    for (std::size_t i = 0; i < bins.size(); ++i) {
      judge(fitter.fitted, i, bins[i].ring, patches[bins[i].patch]);
    }
    clock.end(Stage::solve);

    // The final ground set, eq. (6) of the last plane, less what lies far below it: that is noise,
    // or ground in a plane of its own. All other points stay nonground.
    for (std::size_t i = 0; i < bins.size(); ++i) {
      Patch& patch = patches[bins[i].patch];
      if (!patch.is_ground()) continue;
      const LabelCounts counts =
          fitter.bin_labels.write(fitter.batch, i, set_to_label(fitter.fitted.sets[i]),
                                  std::isfinite(config.lower_plane_margin), groups, labels);
      patch.ground_count = counts.ground;
      patch.lower_ground_count = counts.sunken;
      fitter.totals[static_cast<std::size_t>(Label::ground)] += counts.ground;
      fitter.totals[static_cast<std::size_t>(Label::noise)] += counts.noise;
    }
    clock.end(Stage::label);
  }

  /// The part of a ground set that needs no plane of its own.
  [[nodiscard]] plane_fits::GroundSet set_to_label(plane_fits::GroundSet set) const noexcept {
    const float depth = config.lower_plane_margin + config.distance_margin;
    set.bottom = std::max(set.bottom, set.top - depth);
    return set;
  }

  void judge(const PlaneFit::Result& fitted, std::size_t i, std::size_t ring,
             Patch& patch) const noexcept {
    if ((fitted.exists >> i & 1U) == 0) {
      patch.verdict = Verdict::no_plane;
      return;
    }
    const Plane plane = fitted.judged[i].moved_by(fitted.origins[i]);
    set_plane(plane, patch);
    likelihood.judge(plane, ring, patch);
  }

  struct FittedBin {
    std::uint32_t bin;
    std::uint32_t patch;  ///< its index
    std::uint32_t ring;   ///< counted over all zones
  };

  PatchworkConfig config;
  ConcentricZones zones;
  GroundLikelihood likelihood;
  std::vector<double> seed_floors;  ///< of each zone, metres
  ScanPoints scan;
  BinGroups groups;
  Buffer<FittedBin> fitted_bins;
  std::size_t fitted_count = 0;
  StageTimes* stage_times = nullptr;
  std::vector<patchwork::Fitter> fitters;  ///< one per thread
  ThreadPool pool;
};

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
