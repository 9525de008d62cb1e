// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "core/segment_scan.hpp"
#include "patchwork/bin_runs.hpp"
#include "patchwork/concentric_zones.hpp"
#include "patchwork/ground_likelihood.hpp"
#include "patchwork/packed_points.hpp"
#include "patchwork/plane_fit.hpp"

namespace flagstone {

using patchwork::BinRuns;
using patchwork::ConcentricZones;
using patchwork::GroundLikelihood;
using patchwork::PackedPoints;
using patchwork::Plane;
using patchwork::PlaneFit;
using patchwork::Ring;
using patchwork::Run;

namespace {

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
    runs.reserve(point_count, zones.bin_count());
    points.reserve(point_count);
    fit.reserve(point_count);
    result.mutable_patches().reserve(zones.bin_count());
  }

  void segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    // Concentric Zone Model (III-B)
    runs.collect(cloud, zones, labels);

    for (std::size_t r = 0; r < zones.rings().size(); ++r) {
      const Ring& ring = zones.rings()[r];
      for (std::uint16_t sector = 0; sector < ring.sectors; ++sector) {
        const std::uint32_t bin = ring.first_bin + sector;
        if (runs.points_in(bin) == 0) continue;
        Patch patch{.zone = ring.zone, .ring = ring.ring, .sector = sector};
        patch.point_count = runs.points_in(bin);
        segment_bin(cloud, bin, r, patch, labels);
        result.mutable_patches().push_back(patch);  // within what was reserved
      }
    }
  }

  void segment_bin(CloudView cloud, std::uint32_t bin, std::size_t ring, Patch& patch,
                   std::span<Label> labels) noexcept {
    const std::span<const Run> bin_runs = runs.of(bin);
    if (patch.point_count < static_cast<std::uint32_t>(config.min_points)) {
      patch.verdict = Verdict::too_few_points;
      if (config.few_points_are_ground) label_all_ground(bin_runs, patch, labels);
      return;
    }

    // Region-wise Ground Plane Fitting (III-C)
    points.gather(cloud, bin_runs);
    const float margin = config.zones[patch.zone].height_margin;  // M_h
    const double seed_cut = static_cast<double>(margin) * config.sensor_height;
    const PlaneFit::Result fitted = fit.fit(points, seed_cut);
    if (!fitted.last.exists()) {
      patch.verdict = Verdict::no_plane;
      return;
    }
    patch.mean = to_floats(fitted.judged.mean);
    patch.normal = to_floats(fitted.judged.normal);
    patch.d = static_cast<float>(fitted.judged.d);
    patch.eigenvalues = to_floats(fitted.judged.eigenvalues);

    // Ground Likelihood Estimation (III-D)
    likelihood.judge(fitted.judged, ring, patch);
    if (patch.is_ground()) label_ground_set(fitted.last, bin_runs, patch, labels);
  }

  /// The final ground set, eq. (6) of the last plane, less the noise below it. All other points
  /// stay nonground.
  void label_ground_set(const Plane& plane, std::span<const Run> bin_runs, Patch& patch,
                        std::span<Label> labels) const noexcept {
    const double top = config.distance_margin - plane.d;  // M_d
    const double bottom = -config.noise_margin - plane.d;
    const Vector3& n = plane.normal;
    std::size_t i = 0;
    for (const Run& run : bin_runs) {
      for (Label& label : labels.subspan(run.begin, run.length)) {
        const double height = n[0] * points.x()[i] + n[1] * points.y()[i] + n[2] * points.z()[i];
        label = height >= top ? Label::nonground : height >= bottom ? Label::ground : Label::noise;
        patch.ground_count += label == Label::ground;
        ++i;
      }
    }
  }

  static void label_all_ground(std::span<const Run> bin_runs, Patch& patch,
                               std::span<Label> labels) noexcept {
    for (const Run& run : bin_runs) {
      std::ranges::fill(labels.subspan(run.begin, run.length), Label::ground);
    }
    patch.ground_count = patch.point_count;
  }

  PatchworkConfig config;
  ConcentricZones zones;
  BinRuns runs;
  PackedPoints points;  // of one bin at a time
  PlaneFit fit;
  GroundLikelihood likelihood;
};

Patchwork::Patchwork(PatchworkConfig config, unsigned /*threads*/)
    : pipeline_(std::make_unique<Pipeline>(std::move(config))) {}
Patchwork::~Patchwork() = default;
Patchwork::Patchwork(Patchwork&&) noexcept = default;
Patchwork& Patchwork::operator=(Patchwork&&) noexcept = default;

const PatchworkConfig& Patchwork::config() const noexcept { return pipeline_->config; }

void Patchwork::time_stages(StageTimes* /*times*/) noexcept {}

Status Patchwork::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    pipeline_->reserve(cloud.size(), result);
    pipeline_->segment(cloud, result, labels);
  });
}

}  // namespace flagstone
