// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Patchwork: concentric zone-based region-wise ground segmentation with ground likelihood
/// estimation.
///
/// H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with
/// Ground Likelihood Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021.
class Patchwork final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit Patchwork(PatchworkConfig config = {});
  ~Patchwork() override;
  Patchwork(Patchwork&&) noexcept;
  Patchwork& operator=(Patchwork&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const PatchworkConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
