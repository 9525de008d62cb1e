// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"

namespace flagstone {

/// Patchwork: concentric zone-based region-wise ground segmentation with ground likelihood
/// estimation.
///
/// H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with
/// Ground Likelihood Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021.
class Patchwork final : public Segmenter {
 public:
  /// `threads` work on one scan together, 1 to 1,024; the result does not depend on how many.
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit Patchwork(PatchworkConfig config = {}, unsigned threads = 1);
  ~Patchwork() override;
  Patchwork(Patchwork&&) noexcept;
  Patchwork& operator=(Patchwork&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const PatchworkConfig& config() const noexcept;

  /// From now on adds to `*times` what each stage of a scan took on the calling thread; nullptr
  /// stops that. Taking times costs about 1 % of a scan.
  void time_stages(StageTimes* times) noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
