// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

/// Settings of a LabelVote.
struct LabelVoteConfig {
  double voxel = 0.25;         ///< width of a voxel, metres, 0.05 to 2
  double voxel_height = 0.06;  ///< metres, 0.01 to 1
  /// Points lower than this above the ground of their scan keep their labels, metres, -10 to 10.
  float min_height = -0.4f;
  float max_height = 1;    ///< points higher than this keep their labels, metres, -10 to 10
  double max_range = 100;  ///< points farther from the sensor keep their labels, metres, 5 to 200
  /// After each scan, tiles of 128 x 128 voxels whose centre is farther from the sensor than this
  /// are forgotten, metres, 100 to 1e6. 0: nothing is forgotten.
  double window = 0;

  /// Throws std::invalid_argument if a value is out of its range.
  void check() const;
};

/// Better labels for the scans of a run: all scans that measured a voxel vote on whether it is
/// ground. Voxels are in the world frame after levelling, see GroundMap. A scan votes with
/// the fraction of its points in the voxel that it labelled ground; votes from nearby count more.
///
/// With the scans so far the labels are available at once; with later scans they are better. Remove
/// points that move before both calls, or label them `nonground`.
///
/// The result does not depend on the order of the points or of the scans. Not thread-safe while a
/// scan is added; otherwise several threads can call relabel().
class LabelVote {
 public:
  /// Throws std::invalid_argument if the configuration is invalid.
  explicit LabelVote(const LabelVoteConfig& config = {});
  ~LabelVote();
  LabelVote(LabelVote&&) noexcept;
  LabelVote& operator=(LabelVote&&) noexcept;

  /// Adds the votes of a scan. `result` is the segmentation of `cloud` by a method that computes
  /// heights; `levelling` is the result of GroundMap::add for this scan. invalid_argument if the
  /// sizes differ or the pose is invalid, see GroundMap; out_of_memory. Never throws.
  Status add(CloudView cloud, const Segmentation& result, const Pose& pose,
             const Levelling& levelling);

  /// Adds the votes of a scan and writes its labels after them to `labels`, which must have the
  /// size of the cloud: the same labels as relabel() afterwards, in less time.
  Status add(CloudView cloud, const Segmentation& result, const Pose& pose,
             const Levelling& levelling, std::span<Label> labels);

  /// Writes the labels of a scan after the votes so far to `labels`, which must have the size of
  /// the cloud. A point keeps its own label if its voxel has no votes or a tie, and labels other
  /// than `ground` and `nonground` never change. Errors as add().
  Status relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                 const Levelling& levelling, std::span<Label> labels) const;

  /// The votes as bytes, which from_bytes() reads on any machine. Does not contain settings other
  /// than the size of a voxel. out_of_memory; `bytes` is then empty. Never throws.
  Status to_bytes(std::vector<std::byte>& bytes) const;

  /// Replaces the votes. The bytes are checked, so they may come from anywhere: bad_file with the
  /// offset if they are damaged, of another version or of other voxels; out_of_memory; the votes
  /// are then as before. Never throws.
  Status from_bytes(std::span<const std::byte> bytes);

  /// Number of voxels with votes.
  [[nodiscard]] std::size_t voxels() const noexcept;

  /// Memory in use, bytes.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  class Votes;

  Status add_scan(CloudView cloud, const Segmentation& result, const Pose& pose,
                  const Levelling& levelling, const std::span<Label>* labels);

  std::unique_ptr<Votes> votes_;
};

}  // namespace flagstone
