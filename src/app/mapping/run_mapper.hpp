// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "app/level_scan.hpp"
#include "app/pose_checks.hpp"
#include "files/io/cloud.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/moving_points.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// Which scans determine the labels of a scan.
enum class LabelSource {
  live,     ///< the scan itself and the scans before it
  delayed,  ///< also the scans of a fixed time after it
  offline,  ///< all scans of the run
};

/// A segmented scan of a run on its way through RunMapper.
struct RunScan {
  std::size_t index = 0;  ///< in the run
  double time = 0;        ///< seconds
  io::Cloud cloud;
  Segmentation result;
  LevelScan level;      ///< with the pose
  Levelling levelling;  ///< of the pose; set by RunMapper
  MovingMask moving;    ///< set by RunMapper
  /// Labels with the votes of the scans so far, and `nonground` for points above the map and
  /// all moving points; set by RunMapper. Empty for LabelSource::offline.
  std::vector<Label> labels;
  /// False: the ground of the scan does not fit the map, and the scan was not used.
  bool fits = true;
};

/// Settings of a RunMapper.
struct RunMapperConfig {
  LabelSource labels = LabelSource::offline;
  double delay = 2;  ///< for LabelSource::delayed, seconds, 0 to 10
  GroundMapConfig map{};
  std::shared_ptr<TileStore> tiles{};  ///< for a limit of the map's memory; null: none
  LabelVoteConfig vote{};
  MovingPointsConfig moving{};

  /// Throws std::invalid_argument if a value is out of its range.
  void check() const;
};

/// Maps the scans of a run, one after another: levels each to the map, finds its moving points,
/// and adds the ground to the map and its labels to the vote, without the moving points.
///
/// A scan is finished when the scans of the delay after it have been added: none with live labels,
/// 8.5 s with offline labels. Not thread-safe.
class RunMapper {
 public:
  using Use = std::function<void(RunScan& scan)>;
  /// Reads a scan again: the same cloud, result, pose and time as when it was added. `scan.index`
  /// is set, but may be damaged.
  using Reread = std::function<Status(RunScan& scan)>;

  /// Throws std::invalid_argument if the configuration is invalid.
  explicit RunMapper(const RunMapperConfig& config);

  /// Adds a scan, in order of time, and calls `finished` for each scan that is finished, in order;
  /// a scan that does not fit the map is finished when those before it are. Errors of GroundMap,
  /// MovingPoints and LabelVote; the scan is then not used and not finished.
  Status add(std::unique_ptr<RunScan> scan, const Use& finished);

  /// Finishes the remaining scans.
  Status finish(const Use& finished);

  /// Writes labels of a finished scan with the votes and the map of all scans so far, for
  /// LabelSource::offline.
  /// Several threads may call it at the same time.
  Status relabel(const RunScan& scan, std::vector<Label>& labels) const;

  /// Heights of the points of a finished scan above the ground of the map and of the scan, see
  /// GroundMap::heights(). Several threads may call it at the same time.
  Status heights(const RunScan& scan, std::vector<float>& heights) const;

  /// True after finish().
  [[nodiscard]] bool is_finished() const noexcept { return is_finished_; }

  /// Writes the state to files in a directory, which must exist: map, votes, and, if the run is not
  /// finished, everything that add() needs except the clouds of the unfinished scans. Errors of
  /// io::save().
  [[nodiscard]] Status save(const std::filesystem::path& directory) const;

  /// Replaces the state by a saved one. Later calls give the same results as without the break.
  /// `reread` is called for each unfinished scan. Errors of io::load() and `reread`; the state is
  /// then unspecified.
  Status load(const std::filesystem::path& directory, const Reread& reread);

  [[nodiscard]] const GroundMap& map() const noexcept { return map_; }
  [[nodiscard]] const LabelVote& vote() const noexcept { return vote_; }
  [[nodiscard]] const MovingPoints& moving() const noexcept { return moving_; }

  /// The settings, with the delay in use.
  [[nodiscard]] const RunMapperConfig& config() const noexcept { return config_; }

 private:
  Status vote_for(RunScan& scan);
  Status correct(const RunScan& scan, std::vector<Label>& labels) const;
  Status finish_first(const Use& finished);

  RunMapperConfig config_;
  GroundMap map_;
  LabelVote vote_;
  MovingPoints moving_;
  LevellingJudge judge_;
  std::deque<std::unique_ptr<RunScan>> open_;  // added, not finished
  bool is_finished_ = false;
};

}  // namespace flagstone::app
