// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/mount.hpp"
#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Wraps any method so that it accepts clouds with any mounting pose. The method receives each
/// cloud rotated so that z is up, in metres from the sensor, and shifted in z so that the ground is
/// at the height the method expects.
///
/// With `estimate` or `track`, the wrapper keeps state between scans: the result of a scan depends
/// on the scans since construction or reset(). Otherwise it is stateless. Not thread-safe: use one
/// instance per thread.
class GravityAlignedSegmenter final : public Segmenter {
 public:
  /// Takes ownership of `method`. `method_height` is the sensor height that `method` is configured
  /// with, metres, -100 to 100: it expects the ground below the sensor at z = -method_height. The
  /// value does not matter for methods without a sensor height. Throws std::invalid_argument if
  /// `method` is null or a value is out of range, or std::bad_alloc.
  GravityAlignedSegmenter(std::unique_ptr<Segmenter> method, float method_height,
                          const MountSettings& settings);
  ~GravityAlignedSegmenter() override;
  GravityAlignedSegmenter(GravityAlignedSegmenter&&) noexcept;
  GravityAlignedSegmenter& operator=(GravityAlignedSegmenter&&) noexcept;

  /// Estimates the mounting pose if the settings require it, and segments the scan with the pose in
  /// use, which includes the estimate of this scan. See also Segmenter::segment.
  ///
  /// - Labels are in input order. Points of `cloud` that are all zero or not finite are `invalid`.
  /// - Heights are in metres above the ground, along `up`.
  /// - Mean, normal and d of the patches are in the frame and the units of `cloud`. Normals point
  ///   up: their dot product with `up` is not negative. Eigenvalues stay in square metres.
  /// - The ground surface is in the level frame (see Mount), with heights relative to the sensor.
  ///
  /// If there is nothing to transform (level, in metres, origin at the sensor, height as configured
  /// in the method), the method receives `cloud` itself, without copying.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The mounting pose used for the last scan; before the first scan, the configured one.
  [[nodiscard]] const Mount& mount() const noexcept;

  /// The decision about the last scan. Its `verdict` is `fixed` if nothing was estimated from it.
  [[nodiscard]] const MountDecision& decision() const noexcept;

  /// Clears the state from previous scans.
  void reset() noexcept;

  /// The settings passed to the constructor.
  [[nodiscard]] const MountSettings& settings() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flagstone
