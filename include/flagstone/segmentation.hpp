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

/// The result of segmenting one scan.
///
/// Pass the same object to every call: its buffers are reused, so nothing is allocated after the
/// first scans. Previous contents have no influence on a new result. Spans and references returned
/// by the accessors stay valid until the next call of segment() with this object. Not thread-safe
/// while it is being filled; afterwards several threads can read it.
class Segmentation {
 public:
  /// The label of each input point, in input order.
  [[nodiscard]] std::span<const Label> labels() const noexcept { return labels_; }

  /// The bins that contain at least one point, ordered by zone, ring and sector. `surface` orders
  /// them by distance from the sensor, nearest first. Empty for methods without patches.
  [[nodiscard]] std::span<const Patch> patches() const noexcept { return patches_; }

  /// Height of each input point above the local ground, metres, in input order. NaN if the ground
  /// height is unknown there, and for points that are invalid or out of range. Empty for methods
  /// without a ground surface.
  [[nodiscard]] std::span<const float> heights() const noexcept {
    return {heights_.data(), std::min(height_count_, heights_.size())};  // none if moved from
  }

  /// The ground as a continuous surface. Empty for methods that do not compute one.
  [[nodiscard]] const GroundSurface& surface() const noexcept { return surface_; }

  /// Number of points with this label. The counts of all labels add up to labels().size().
  [[nodiscard]] std::size_t count(Label label) const noexcept {
    return counts_[static_cast<std::size_t>(label)];
  }

  /// @name For implementations of Segmenter
  /// Buffers keep their capacity. Growing a buffer may throw std::bad_alloc.
  /// @{

  /// Removes all labels, patches, heights and the surface.
  void clear() noexcept {
    patches_.clear();
    labels_.clear();
    height_count_ = 0;
    surface_.clear();
    counts_ = {};
  }

  /// Starts a result with `points` labels, all `nonground`, without patches. Returns the labels to
  /// fill.
  std::span<Label> start(std::size_t points) {
    clear();
    labels_.assign(points, Label::nonground);
    return labels_;
  }

  /// The labels, to change some of them. Call finish() afterwards if the counts change.
  [[nodiscard]] std::span<Label> mutable_labels() noexcept { return labels_; }

  /// The patches to fill.
  [[nodiscard]] std::vector<Patch>& mutable_patches() noexcept { return patches_; }

  /// The heights to fill, one per label. Their initial values are unspecified.
  std::span<float> start_heights() {
    if (heights_.size() < labels_.size()) heights_.resize(labels_.size());
    height_count_ = labels_.size();
    return {heights_.data(), height_count_};
  }

  /// The surface to fill.
  [[nodiscard]] GroundSurface& mutable_surface() noexcept { return surface_; }

  /// Counts the labels. Call it when the labels are final.
  void finish() noexcept {
    counts_ = {};
    for (const Label label : labels_) ++counts_[static_cast<std::size_t>(label)];
  }

  /// Overload for callers that counted the labels while writing them. `counts` contains the number
  /// of points per label. The sum without `nonground` must not exceed labels().size(). The entry
  /// for `nonground` is ignored: it is computed as the remainder.
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
  std::vector<float> heights_;  // never shrinks; the first height_count_ belong to this scan
  std::size_t height_count_ = 0;
  GroundSurface surface_;
  std::array<std::size_t, label_count> counts_{};
};

}  // namespace flagstone
