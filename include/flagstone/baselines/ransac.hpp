// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of Ransac. The paper does not give values; these are common for fitting a plane to a
/// scan.
struct RansacConfig {
  /// Error tolerance, section II-A: points at most this far above or below the plane are in its
  /// consensus set. Metres, above 0, up to 100.
  float distance_threshold = 0.2f;

  /// z, section II-B: required probability that at least one trial draws three ground points. Above
  /// 0, up to 0.999999.
  float confidence = 0.99f;

  /// Maximum number of trials, 1 to 1,000,000.
  int max_trials = 1000;

  /// t, section II-C: minimum size of the consensus set of a plane, 3 to 1,000,000. The paper
  /// requires the n = 3 points of a sample and 5 more.
  int min_consensus = 8;

  /// Seed of the random numbers, 0 to 1,000,000,000. The same seed draws the same samples from the
  /// same scan.
  int seed = 0;

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;
};

/// Random sample consensus: the plane with the largest consensus set in the scan is the ground. Not
/// thread-safe: use one instance per thread.
///
/// M. A. Fischler, R. C. Bolles, "Random Sample Consensus: A Paradigm for Model Fitting with
/// Applications to Image Analysis and Automated Cartography", Communications of the ACM 24(6),
/// 1981.
///
/// Each trial draws three points and counts all points of the scan within the tolerance of their
/// plane. The number of trials, section II-B, is k = log(1 - z) / log(1 - w^3). It is computed
/// again whenever a larger consensus set increases the inlier ratio w. The plane is then fitted by
/// least squares to its consensus set, and once more to the points within the tolerance of that
/// fit.
///
/// The method has no up direction. A wall with more points than the ground is mistaken for the
/// ground. Points within the tolerance on either side of the plane are ground; all others are
/// `nonground`, never `noise`. The samples depend on the seed and on the order of the input.
class Ransac final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  explicit Ransac(RansacConfig config = {});
  ~Ransac() override;
  Ransac(Ransac&&) noexcept;
  Ransac& operator=(Ransac&&) noexcept;

  /// See Segmenter::segment. result.patches() contains one patch for the whole scan, with its plane
  /// (status `ground`) or without a plane (`no_plane`), or no patch if no point is usable. The
  /// terms of the likelihood are zero.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration passed to the constructor.
  [[nodiscard]] const RansacConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
