// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/mount.hpp"
#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Any method on clouds of any mount: it hands the method each cloud turned so that z is up, in
/// metres from the sensor, and moved in z so that the ground lies where the method was told to
/// expect it.
///
/// It keeps state from scan to scan where the settings say `estimate` or `track`, and only there:
/// the result of a scan then depends on those before it, until reset().
class GravityAlignedSegmenter final : public Segmenter {
 public:
  /// `method` was configured with `method_height`: it expects the ground below the sensor at
  /// z = -method_height, metres, -100 to 100; of no meaning for methods that expect it nowhere.
  /// Throws std::invalid_argument for a null method and for settings out of range, and
  /// std::bad_alloc.
  GravityAlignedSegmenter(std::unique_ptr<Segmenter> method, float method_height,
                          const MountSettings& settings);
  ~GravityAlignedSegmenter() override;
  GravityAlignedSegmenter(GravityAlignedSegmenter&&) noexcept;
  GravityAlignedSegmenter& operator=(GravityAlignedSegmenter&&) noexcept;

  /// See Segmenter::segment. First, where the settings ask for it, finds out how the sensor stands;
  /// the scan itself is already segmented with what was found. Then:
  /// - labels are those of the points in input order; what is all zero or not finite in the cloud
  ///   given here is `invalid`;
  /// - heights are metres above the ground along `up`;
  /// - mean, normal and d of patches are in the frame and the units of the cloud given here
  /// (normals
  ///   point up: their product with `up` is not negative); eigenvalues stay square metres;
  /// - the surface is in the level frame, see Mount, its heights relative to the sensor.
  /// With a mount that leaves nothing to do (level, in metres, the origin in the sensor, the height
  /// as the method has it) the method gets the cloud itself.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The mount in use: the one of the last scan, before the first the given one.
  [[nodiscard]] const Mount& mount() const noexcept;

  /// What the last scan was found to say; `given` if it was not asked.
  [[nodiscard]] const MountDecision& decision() const noexcept;

  /// Forgets all scans: as newly made.
  void reset() noexcept;

  /// The settings it was made with.
  [[nodiscard]] const MountSettings& settings() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flagstone
