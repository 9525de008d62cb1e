// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/gravity_aligned_segmenter.hpp"

#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "library/core/setting.hpp"
#include "library/mount/expected_mount.hpp"
#include "library/mount/gravity_alignment.hpp"
#include "library/mount/mount_track.hpp"

namespace flagstone {

using mount::GravityAlignment;
using mount::MountTrack;

/// How the sensor stands, the cloud made level, the method, its results brought back.
struct GravityAlignedSegmenter::Impl {
  Impl(std::unique_ptr<Segmenter> inner, float method_height, const MountSettings& given)
      : settings(given),
        method(std::move(inner)),
        track(mount::expected_mount(settings), settings.height != HeightSource::fixed,
              settings.tilt == TiltSource::estimate, settings.tracking),
        levelling(method_height) {
    if (method == nullptr) throw std::invalid_argument("mount: there is no method to level for");
    settings.check();
    check_number("mount", "method_height", method_height, {.low = -100, .high = 100, .unit = "m"});
    if (settings.estimates()) estimator.emplace(settings);
    reset();
  }

  void reset() noexcept {
    track.reset();
    decision = {};
    decision.mount = track.mount();
    decision.tilt = mount::degrees_between(decision.mount.up, {0, 0, 1});
    levelling.set(track.mount());
  }

  /// Asks the scan if it is to be asked.
  void decide(CloudView cloud) noexcept {
    if (estimator && (settings.tracks() || !track.is_told())) {
      decision = estimator->estimate(cloud);
      track.take(decision);
      levelling.set(track.mount());
    } else if (estimator) {
      decision = {};
      decision.mount = track.mount();
      decision.tilt = mount::degrees_between(decision.mount.up, {0, 0, 1});
    }
  }

  MountSettings settings;
  std::unique_ptr<Segmenter> method;
  std::optional<MountEstimator> estimator;  // where the settings ask for estimates
  MountTrack track;
  GravityAlignment levelling;
  MountDecision decision;
};

GravityAlignedSegmenter::GravityAlignedSegmenter(std::unique_ptr<Segmenter> method,
                                                 float method_height, const MountSettings& settings)
    : workings_(std::make_unique<Impl>(std::move(method), method_height, settings)) {}
GravityAlignedSegmenter::~GravityAlignedSegmenter() = default;
GravityAlignedSegmenter::GravityAlignedSegmenter(GravityAlignedSegmenter&&) noexcept = default;
GravityAlignedSegmenter& GravityAlignedSegmenter::operator=(GravityAlignedSegmenter&&) noexcept =
    default;

Status GravityAlignedSegmenter::segment(CloudView cloud, Segmentation& result) noexcept {
  Impl& w = *workings_;
  const bool is_readable = cloud.data() != nullptr || cloud.empty();
  const bool is_possible = is_readable && cloud.size() <= std::numeric_limits<std::uint32_t>::max();
  if (!is_possible) return w.method->segment(cloud, result);  // which says what is wrong
  w.decide(cloud);
  if (w.levelling.is_identity()) return w.method->segment(cloud, result);
  CloudView level;
  try {
    level = w.levelling.apply(cloud);
  } catch (const std::bad_alloc&) {
    result.clear();
    return Status(StatusCode::out_of_memory);
  }
  Status status = w.method->segment(level, result);
  if (status.ok()) w.levelling.bring_back(result);
  return status;
}

const Mount& GravityAlignedSegmenter::mount() const noexcept { return workings_->track.mount(); }
const MountDecision& GravityAlignedSegmenter::decision() const noexcept {
  return workings_->decision;
}
void GravityAlignedSegmenter::reset() noexcept { workings_->reset(); }
const MountSettings& GravityAlignedSegmenter::settings() const noexcept {
  return workings_->settings;
}

}  // namespace flagstone
