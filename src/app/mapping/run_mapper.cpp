// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/run_mapper.hpp"

#include <utility>

#include "library/core/setting.hpp"
#include "library/moving_points/moving_labels.hpp"

namespace flagstone::app {
namespace {

// Moving points take no part in a vote: they are out of range while this object exists.
class WithoutMovingPoints {
 public:
  explicit WithoutMovingPoints(RunScan& scan) : scan_(scan) { set(Label::out_of_range); }
  ~WithoutMovingPoints() { set(Label::nonground); }
  WithoutMovingPoints(const WithoutMovingPoints&) = delete;
  WithoutMovingPoints& operator=(const WithoutMovingPoints&) = delete;

 private:
  void set(Label label) noexcept {
    label_moving_points(scan_.moving, label, scan_.result.mutable_labels());
  }

  RunScan& scan_;
};

RunMapperConfig with_delay(RunMapperConfig config) {
  if (config.labels == LabelSource::live) config.delay = 0;
  if (config.labels == LabelSource::offline) config.delay = MovingPoints::reach;
  config.moving.delay = config.delay;
  return config;
}

}  // namespace

void RunMapperConfig::check() const {
  check_number("map", "delay", delay, {.low = 0, .high = 10, .unit = "s"});
  map.check();
  vote.check();
  moving.check();
}

RunMapper::RunMapper(const RunMapperConfig& config)
    : config_((config.check(), with_delay(config))),
      map_(config_.tiles ? GroundMap(config_.map, config_.tiles) : GroundMap(config_.map)),
      vote_(config_.vote),
      moving_(config_.moving) {}

// Live labels are known at once.
Status RunMapper::vote_for(RunScan& scan) {
  Status status;
  if (config_.labels == LabelSource::live) {
    scan.labels.resize(scan.cloud.size());
    {
      const WithoutMovingPoints excluded(scan);
      status = vote_.add(scan.level.cloud(), scan.result, scan.level.pose(), scan.levelling,
                         scan.labels);
    }
    return status.ok() ? correct(scan, scan.labels) : status;
  }
  const WithoutMovingPoints excluded(scan);
  return vote_.add(scan.level.cloud(), scan.result, scan.level.pose(), scan.levelling);
}

Status RunMapper::add(std::unique_ptr<RunScan> scan, const Use& finished) {
  const CloudView cloud = scan->level.cloud();
  const Pose& pose = scan->level.pose();
  Status status = map_.level(cloud, scan->result, pose, scan->levelling);
  if (!status.ok()) return status;
  scan->fits = judge_.fits(scan->levelling);
  if (scan->fits) {
    status = moving_.add(cloud, scan->result, pose, scan->levelling, scan->time, scan->moving);
    if (status.ok()) status = map_.add_levelled();
    // Offline, the labels come at the end, so votes can wait until the moving points are known.
    if (status.ok() && config_.labels != LabelSource::offline) status = vote_for(*scan);
    if (!status.ok()) return status;
  }
  const double now = scan->time;
  open_.push_back(std::move(scan));
  while (!open_.empty() && open_.front()->time <= now - config_.delay) {
    if (status = finish_first(finished); !status.ok()) return status;
  }
  return {};
}

Status RunMapper::finish(const Use& finished) {
  while (!open_.empty()) {
    if (Status status = finish_first(finished); !status.ok()) return status;
  }
  is_finished_ = true;
  return {};
}

Status RunMapper::finish_first(const Use& finished) {
  const std::unique_ptr<RunScan> scan = std::move(open_.front());
  open_.pop_front();
  Status status;
  if (scan->fits) {
    if (config_.delay > 0) {
      status = moving_.find(scan->level.cloud(), scan->result, scan->level.pose(), scan->levelling,
                            scan->time, scan->moving);
    }
    if (status.ok() && config_.labels == LabelSource::offline) status = vote_for(*scan);
  }
  const bool has_labels = config_.labels == LabelSource::live && scan->fits;
  if (status.ok() && !has_labels && config_.labels != LabelSource::offline) {
    status = relabel(*scan, scan->labels);
  }
  if (status.ok()) finished(*scan);
  return status;
}

Status RunMapper::relabel(const RunScan& scan, std::vector<Label>& labels) const {
  labels.assign(scan.result.labels().begin(), scan.result.labels().end());
  if (!scan.fits) return {};
  const Status status =
      vote_.relabel(scan.level.cloud(), scan.result, scan.level.pose(), scan.levelling, labels);
  return status.ok() ? correct(scan, labels) : status;
}

// Labels after the vote: neither points too far above the map nor moving points are ground.
Status RunMapper::correct(const RunScan& scan, std::vector<Label>& labels) const {
  label_moving_points(scan.moving, Label::nonground, labels);
  return map_.relabel(scan.level.cloud(), scan.result, scan.level.pose(), scan.levelling, labels);
}

Status RunMapper::heights(const RunScan& scan, std::vector<float>& heights) const {
  heights.assign(scan.result.heights().begin(), scan.result.heights().end());
  if (!scan.fits) return {};
  return map_.heights(scan.level.cloud(), scan.result, scan.level.pose(), scan.levelling, heights);
}

}  // namespace flagstone::app
