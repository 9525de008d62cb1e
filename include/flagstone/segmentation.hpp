// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "flagstone/ground_surface.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patch.hpp"

namespace flagstone {

/// The result of segmenting one scan. Keep one and hand it in again: its buffers are reused, so
/// that after the first scans nothing is allocated. What an earlier scan left in it has no
/// influence.
class Segmentation {
 public:
  /// One label per input point, in input order.
  [[nodiscard]] std::span<const Label> labels() const noexcept { return labels_; }

  /// The bins that hold at least one point, ordered by zone, ring and sector; those of `surface`
  /// nearest to the sensor first.
  /// Empty for methods that do not work on patches.
  [[nodiscard]] std::span<const Patch> patches() const noexcept { return patches_; }

  /// Height of each input point above the local ground, metres, in input order; NaN where no ground
  /// is known and for points that are invalid or out of range. Empty for methods that make no
  /// surface.
  [[nodiscard]] std::span<const float> heights() const noexcept {
    return {heights_.data(), std::min(height_count_, heights_.size())};  // none if moved from
  }

  /// The ground itself. Empty for methods that make no surface.
  [[nodiscard]] const GroundSurface& surface() const noexcept { return surface_; }

  /// How many points have this label. Over all labels the counts add up to labels().size().
  [[nodiscard]] std::size_t count(Label label) const noexcept {
    return counts_[static_cast<std::size_t>(label)];
  }

  /// @name For those who write a Segmenter
  /// Buffers keep their capacity; growing them may throw std::bad_alloc.
  /// @{

  /// No labels, no patches, no heights, no surface.
  void clear() noexcept {
    patches_.clear();
    labels_.clear();
    height_count_ = 0;
    surface_.clear();
    counts_ = {};
  }

  /// Starts a result of `points` labels, all nonground, without patches. Returns the labels to
  /// fill.
  std::span<Label> start(std::size_t points) {
    clear();
    labels_.assign(points, Label::nonground);
    return labels_;
  }

  /// The patches to fill.
  [[nodiscard]] std::vector<Patch>& mutable_patches() noexcept { return patches_; }

  /// The heights to fill, one for each label; what they hold is left from before.
  std::span<float> start_heights() {
    if (heights_.size() < labels_.size()) heights_.resize(labels_.size());
    height_count_ = labels_.size();
    return {heights_.data(), height_count_};
  }

  /// The surface to fill.
  [[nodiscard]] GroundSurface& mutable_surface() noexcept { return surface_; }

  /// Counts the labels; call it once they are final.
  void finish() noexcept {
    counts_ = {};
    for (const Label label : labels_) ++counts_[static_cast<std::size_t>(label)];
  }

  /// The same for those who have counted while they wrote them: how many have each label, together
  /// no more than there are labels. What is given for nonground is not looked at: all others have
  /// it.
  void finish(std::array<std::size_t, label_count> counts) noexcept {
    counts_ = counts;
    std::size_t others = labels_.size();
    for (std::size_t code = 1; code < label_count; ++code) others -= counts[code];
    counts_[static_cast<std::size_t>(Label::nonground)] = others;
  }

  /// @}

 private:
  std::vector<Label> labels_;
  std::vector<Patch> patches_;
  std::vector<float> heights_;  // as many as the largest scan has had
  std::size_t height_count_ = 0;
  GroundSurface surface_;
  std::array<std::size_t, label_count> counts_{};
};

}  // namespace flagstone
