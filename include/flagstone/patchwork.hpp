// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"

namespace flagstone {

/// Patchwork: concentric zone-based region-wise ground segmentation with ground likelihood
/// estimation. Comments give the numbers of the paper's equations: (2) and (3) zones and bins,
/// (4) planes, (5) and (6) ground sets, (7) to (11) likelihood, (12) the ground.
///
/// H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with
/// Ground Likelihood Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021.
class Patchwork final : public Segmenter {
 public:
  /// `threads` work on one scan together, 1 to 1,024; the result does not depend on how many. All
  /// but the caller's are started here (fewer if the system has no more), and again by the
  /// child of a fork() when it first segments. It holds 52 bytes for each point
  /// of its largest scan, and 17 more for each thread but the first. Throws std::invalid_argument
  /// naming the field, its value and the range allowed, or std::bad_alloc.
  explicit Patchwork(PatchworkConfig config = {}, unsigned threads = 1);
  ~Patchwork() override;
  Patchwork(Patchwork&&) noexcept;
  Patchwork& operator=(Patchwork&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const PatchworkConfig& config() const noexcept;

  /// From now on adds to `*times`, which must live as long, the seconds that the calling thread
  /// spent on each stage of a scan; waiting for other threads belongs to none. nullptr stops that.
  /// Taking times costs about 1 % of a scan.
  void time_stages(StageTimes* times) noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
