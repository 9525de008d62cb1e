// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"

namespace flagstone {

/// The method Patchwork: it fits a plane to each bin of a polar grid with concentric zones and uses
/// a ground likelihood to decide which bins are ground. Not thread-safe: use one instance per
/// thread.
///
/// Comments refer to the equations of the paper: (2) and (3) zones and bins, (4) planes, (5) and
/// (6) ground sets, (7) to (11) likelihood, (12) the ground.
///
/// H. Lim, M. Oh, H. Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation with
/// Ground Likelihood Estimation Using a 3D LiDAR Sensor", IEEE RA-L 6(4), 2021.
class Patchwork final : public Segmenter {
 public:
  /// `threads` is the number of threads that process one scan together, 1 to 1,024, including the
  /// calling thread. The result does not depend on it. The constructor starts the other threads, or
  /// fewer if the system cannot provide them. After a fork(), the child starts its own threads when
  /// it first calls segment().
  ///
  /// Memory: 52 bytes per point of the largest scan, plus 17 bytes per point for each additional
  /// thread. Throws std::invalid_argument naming the field, its value and the allowed range, or
  /// std::bad_alloc.
  explicit Patchwork(PatchworkConfig config = {}, unsigned threads = 1);
  ~Patchwork() override;
  Patchwork(Patchwork&&) noexcept;
  Patchwork& operator=(Patchwork&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration passed to the constructor.
  [[nodiscard]] const PatchworkConfig& config() const noexcept;

  /// Starts timing: every later call of segment() adds to `*times` the seconds that the calling
  /// thread spent in each stage. Waiting for other threads is not counted. `*times` must outlive
  /// this object; nullptr stops timing. Timing takes about 1 % of the time per scan.
  void time_stages(StageTimes* times) noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
