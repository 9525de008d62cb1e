// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of Ransac. The paper leaves the numbers to the problem; these are what a plane through
/// a scan is commonly searched with.
struct RansacConfig {
  /// Error tolerance, section II-A: points at most this far from the plane, above or below, are of
  /// its consensus set. Metres, above 0, up to 100.
  float distance_threshold = 0.2f;

  /// z, section II-B: probability wanted that at least one trial drew three points of the ground.
  /// Above 0, up to 0.999999.
  float confidence = 0.99f;

  /// Trials after which the search ends however few agree, 1 to 1,000,000.
  int max_trials = 1000;

  /// t, section II-C: a plane that fewer points agree on is none; 3 to 1,000,000. The paper asks
  /// for the n = 3 points of a sample and 5 more.
  int min_consensus = 8;

  /// Start of the random numbers, 0 to 1,000,000,000: the same seed draws the same samples from
  /// the same scan.
  int seed = 0;

  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  void check() const;
};

/// Random sample consensus: the one plane that most points of the scan agree on is the ground.
///
/// M. A. Fischler, R. C. Bolles, "Random Sample Consensus: A Paradigm for Model Fitting with
/// Applications to Image Analysis and Automated Cartography", Communications of the ACM 24(6),
/// 1981.
///
/// Every trial draws three points and counts all points of the scan within the tolerance of their
/// plane. The number of trials, eq. of section II-B, k = log(1 - z) / log(1 - w^3), is taken anew
/// whenever a larger consensus shows a larger share w. The plane is then fitted by least squares to
/// its consensus set, and once more with the points that agree with the fit.
///
/// The method knows no up: it takes a wall that holds more points than the ground for the ground,
/// and a point below the plane is as far from it as one above. Ground is what lies within the
/// tolerance on either side; all else is nonground, never noise. The order of the input decides
/// which points a seed draws.
class Ransac final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit Ransac(RansacConfig config = {});
  ~Ransac() override;
  Ransac(Ransac&&) noexcept;
  Ransac& operator=(Ransac&&) noexcept;

  /// See Segmenter::segment. result.patches() holds one patch, the whole scan with its plane
  /// (verdict ground) or without one (no_plane), or none if no point can be used. Nothing judges
  /// the plane: the terms of the likelihood stay zero.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const RansacConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
