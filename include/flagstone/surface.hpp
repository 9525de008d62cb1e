// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"
#include "flagstone/surface_config.hpp"

namespace flagstone {

/// The method `surface`: planes of square patches, those that are ground joined to one continuous
/// surface, that surface refined where points say more, and every point judged by its height above
/// it. See docs/explanation/surface.md.
///
/// One object serves one thread at a time; make one for each.
class Surface final : public Segmenter {
 public:
  /// `threads` work on one scan together, 1 to 1,024; the result does not depend on how many. See
  /// Patchwork::Patchwork. Throws std::invalid_argument naming the field, its value and the range
  /// allowed, or std::bad_alloc.
  explicit Surface(SurfaceConfig config = {}, unsigned threads = 1);
  ~Surface() override;
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;

  /// See Segmenter::segment. Also fills result.patches(), result.heights() and result.surface().
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const SurfaceConfig& config() const noexcept;

  /// See Patchwork::time_stages.
  void time_stages(StageTimes* times) noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone
