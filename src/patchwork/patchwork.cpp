// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "core/segment_scan.hpp"
#include "patchwork/bin_batch.hpp"
#include "patchwork/bin_groups.hpp"
#include "patchwork/bin_labels.hpp"
#include "patchwork/concentric_zones.hpp"
#include "patchwork/ground_likelihood.hpp"
#include "patchwork/plane_fit.hpp"
#include "patchwork/scan_points.hpp"
#include "patchwork/stage_clock.hpp"

namespace flagstone {

using patchwork::BinBatch;
using patchwork::BinGroups;
using patchwork::BinLabels;
using patchwork::ConcentricZones;
using patchwork::GroundLikelihood;
using patchwork::LabelCounts;
using patchwork::PlaneFit;
using patchwork::Ring;
using patchwork::ScanPoints;
using patchwork::StageClock;

namespace {

/// Points by label, as Segmentation::finish takes them.
using LabelTotals = std::array<std::size_t, label_count>;

PatchworkConfig checked(PatchworkConfig config) {
  config.check();
  return config;
}

std::array<float, 3> to_floats(const Vector3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

/// Patchwork, top to bottom: points into bins, a plane for each bin, a verdict for each plane,
/// labels.
struct Patchwork::Pipeline {
  explicit Pipeline(PatchworkConfig settings)
      : config(checked(std::move(settings))),
        zones(config),
        fit(config),
        likelihood(config, zones.rings()) {}

  void reserve(std::size_t point_count, Segmentation& result) {
    scan.reserve(point_count);
    groups.reserve(point_count, zones.group_count());
    batch.reserve(point_count);
    fit.reserve(point_count);
    bin_labels.reserve(point_count);
    result.mutable_patches().reserve(zones.bin_count());
    patch_bins.reserve(zones.bin_count());
  }

  LabelTotals segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    StageClock clock(stage_times);

    // Concentric Zone Model (III-B)
    for (std::size_t chunk = 0; chunk < ScanPoints::chunk_count(cloud.size()); ++chunk) {
      scan.read(cloud, chunk, zones);
    }
    clock.end(Stage::bin);
    groups.group(scan, cloud.size(), zones.group_count());
    totals = {};
    label_binless(labels);
    list_patches(result.mutable_patches());
    clock.end(Stage::group);

    const std::span<Patch> patches = result.mutable_patches();
    for (std::size_t next = 0; next < patches.size();) {
      next = fill_batch(patches, next, labels);
      segment_batch(patches, labels, clock);
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
    totals[static_cast<std::size_t>(label)] += count;
    return count;
  }

  /// One patch for each bin that holds points.
  void list_patches(std::vector<Patch>& patches) noexcept {
    for (std::size_t r = 0; r < zones.rings().size(); ++r) {
      const Ring& ring = zones.rings()[r];
      for (std::uint16_t sector = 0; sector < ring.sectors; ++sector) {
        const std::uint32_t points = groups.size(ring.first_bin + sector);
        if (points == 0) continue;
        patch_bins.data()[patches.size()] = {.bin = ring.first_bin + sector,
                                             .ring = static_cast<std::uint32_t>(r)};
        Patch patch{.zone = ring.zone, .ring = ring.ring, .sector = sector};
        patch.point_count = points;
        patches.push_back(patch);  // within what was reserved
      }
    }
  }

  /// Takes the next bins to fit, from patch `next` on; returns where to go on.
  std::size_t fill_batch(std::span<Patch> patches, std::size_t next,
                         std::span<Label> labels) noexcept {
    batch.clear();
    for (; next < patches.size() && batch.count() < batch_size; ++next) {
      Patch& patch = patches[next];
      const std::uint32_t bin = patch_bins.data()[next].bin;
      if (patch.point_count >= static_cast<std::uint32_t>(config.min_points)) {
        batch_patches[batch.count()] = next;
        batch_zones[batch.count()] = patch.zone;
        batch.add(bin, patch.point_count);
      } else if (config.few_points_are_ground) {
        patch.ground_count = fill(bin, Label::ground, labels);
      }
    }
    return next;
  }

  void segment_batch(std::span<Patch> patches, std::span<Label> labels,
                     StageClock& clock) noexcept {
    // Region-wise Ground Plane Fitting (III-C)
    batch.gather(scan, groups);
    clock.end(Stage::gather);
    fit.fit(batch, batch_zones, clock, fitted);

    // Ground Likelihood Estimation (III-D)
    for (std::size_t i = 0; i < batch.count(); ++i) {
      judge(i, patches[batch_patches[i]], patch_bins.data()[batch_patches[i]].ring);
    }
    clock.end(Stage::solve);

    // The final ground set, eq. (6) of the last plane, less the noise below it. All other points
    // stay nonground.
    for (std::size_t i = 0; i < batch.count(); ++i) {
      Patch& patch = patches[batch_patches[i]];
      if (!patch.is_ground()) continue;
      const LabelCounts counts = bin_labels.write(batch, i, fitted.sets[i], groups, labels);
      patch.ground_count = counts.ground;
      totals[static_cast<std::size_t>(Label::ground)] += counts.ground;
      totals[static_cast<std::size_t>(Label::noise)] += counts.noise;
    }
    clock.end(Stage::label);
  }

  void judge(std::size_t i, Patch& patch, std::size_t ring) const noexcept {
    if ((fitted.exists >> i & 1U) == 0) {
      patch.verdict = Verdict::no_plane;
      return;
    }
    const Plane plane = fitted.judged[i].moved_by(fitted.origins[i]);
    patch.mean = to_floats(plane.mean);
    patch.normal = to_floats(plane.normal);
    patch.d = static_cast<float>(plane.d);
    patch.eigenvalues = to_floats(plane.eigenvalues);
    likelihood.judge(plane, ring, patch);
  }

  struct PatchBin {
    std::uint32_t bin;
    std::uint32_t ring;  ///< counted over all zones
  };

  PatchworkConfig config;
  ConcentricZones zones;
  ScanPoints scan;
  BinGroups groups;
  Buffer<PatchBin> patch_bins;  ///< of each patch
  PlaneFit fit;
  GroundLikelihood likelihood;
  LabelTotals totals{};
  StageTimes* stage_times = nullptr;

  BinBatch batch;
  std::array<std::size_t, batch_size> batch_patches{};
  std::array<std::uint16_t, batch_size> batch_zones{};
  PlaneFit::Result fitted;
  BinLabels bin_labels;
};

Patchwork::Patchwork(PatchworkConfig config, unsigned /*threads*/)
    : pipeline_(std::make_unique<Pipeline>(std::move(config))) {}
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
