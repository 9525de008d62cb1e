// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"
#include "flagstone/surface_config.hpp"

namespace flagstone {

/// The method `surface`: it fits planes to square patches, merges the ground patches into one
/// continuous surface, refines the surface with the points, and labels each point by its height
/// above the surface. See docs/explanation/surface.md.
///
/// The result does not depend on the order of the points. If they are permuted, labels and heights
/// are permuted in the same way, and patches and surface are bit-identical.
///
/// Not thread-safe: use one instance per thread.
class Surface final : public Segmenter {
 public:
  /// `threads` is the number of threads that process one scan together, 1 to 1,024, including the
  /// calling thread; see Patchwork::Patchwork. The result does not depend on it. Throws
  /// std::invalid_argument naming the field, its value and the allowed range, or std::bad_alloc.
  explicit Surface(SurfaceConfig config = {}, unsigned threads = 1);
  ~Surface() override;
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches(), result.heights() and result.surface().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration passed to the constructor.
  [[nodiscard]] const SurfaceConfig& config() const noexcept;

  /// See Patchwork::time_stages.
  void time_stages(StageTimes* times) noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
