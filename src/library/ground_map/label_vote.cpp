// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/label_vote.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "library/core/setting.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/voxel_sums.hpp"

namespace flagstone {

void LabelVoteConfig::check() const {
  constexpr const char* name = "label vote";
  check_number(name, "voxel", voxel, {.low = 0.05, .high = 2, .unit = "m"});
  check_number(name, "voxel_height", voxel_height, {.low = 0.01, .high = 1, .unit = "m"});
  check_number(name, "min_height", min_height, {.low = -10, .high = 10, .unit = "m"});
  check_number(name, "max_height", max_height, {.low = -10, .high = 10, .unit = "m"});
  check_number(name, "max_range", max_range, {.low = 5, .high = 200, .unit = "m"});
  if (window != 0) {
    check_number(name, "window", window,
                 {.low = 100, .high = 1e6, .unit = "m", .remark = ", or 0 to forget nothing"});
  }
}

namespace {

constexpr unsigned horizontal_bits = 25;
constexpr unsigned vertical_bits = 12;

// The indices wrap around: voxels 245 m above each other, or thousands of kilometres apart, share a
// key with the default sizes.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) noexcept {
  constexpr std::uint64_t horizontal = (std::uint64_t{1} << horizontal_bits) - 1;
  constexpr std::uint64_t vertical = (std::uint64_t{1} << vertical_bits) - 1;
  return (static_cast<std::uint64_t>(x) & horizontal) << (horizontal_bits + vertical_bits) |
         (static_cast<std::uint64_t>(y) & horizontal) << vertical_bits |
         (static_cast<std::uint64_t>(z) & vertical);
}

// The horizontal index in a key, as the nearest one to `near`.
std::int64_t index_in(std::uint64_t key, unsigned shift, std::int64_t near) noexcept {
  constexpr std::int64_t period = std::int64_t{1} << horizontal_bits;
  const auto wrapped = static_cast<std::int64_t>(key >> shift) & (period - 1);
  const std::int64_t ahead = (wrapped - near) & (period - 1);
  return near + (ahead < period / 2 ? ahead : ahead - period);
}

/// A scan in the world frame after levelling.
class LevelledScan {
 public:
  LevelledScan(const LabelVoteConfig& config, CloudView cloud, const Segmentation& result,
               const Pose& pose, const Levelling& levelling) noexcept
      : config_(config), cloud_(cloud), result_(result), pose_(pose), levelling_(levelling) {}

  /// The voxel of a point, or nothing if the point does not take part in votes.
  struct Voxel {
    std::int64_t x, y, z;
  };
  [[nodiscard]] std::optional<Voxel> voxel(std::size_t i) const noexcept {
    const Label label = result_.labels()[i];
    if (label != Label::ground && label != Label::nonground) return std::nullopt;
    const float height = result_.heights()[i];
    const bool is_near_ground = height > config_.min_height && height < config_.max_height;
    if (!is_near_ground) return std::nullopt;  // also without a height
    const Point point = cloud_[i];
    const auto reach = static_cast<float>(config_.max_range);
    if (!(point.x * point.x + point.y * point.y < reach * reach)) return std::nullopt;
    const WorldVector from_sensor = rotated(pose_, point.x, point.y, point.z);
    const double z = pose_.position[2] + from_sensor.z - levelling_.offset -
                     levelling_.slope_x * from_sensor.x - levelling_.slope_y * from_sensor.y;
    return Voxel{.x = index_of(pose_.position[0] + from_sensor.x, config_.voxel),
                 .y = index_of(pose_.position[1] + from_sensor.y, config_.voxel),
                 .z = index_of(z, config_.voxel_height)};
  }

  static std::int64_t index_of(double metres, double size) noexcept {
    return static_cast<std::int64_t>(std::floor(metres / size));
  }

 private:
  const LabelVoteConfig& config_;
  CloudView cloud_;
  const Segmentation& result_;
  const Pose& pose_;
  const Levelling& levelling_;
};

Status check_scan(CloudView cloud, const Segmentation& result, const Pose& pose) {
  if (cloud.size() != result.labels().size() || result.heights().size() != cloud.size()) {
    return Status(StatusCode::invalid_argument,
                  "label vote: the result has no heights of this cloud (expected the result of a "
                  "method such as surface for the same cloud)");
  }
  return is_valid(pose) ? Status() : invalid_pose();
}

}  // namespace

class LabelVote::Votes {
 public:
  /// Points of one scan in a voxel.
  struct PointCounts {
    std::int32_t x = 0, y = 0;  ///< voxel, relative to the sensor's
    std::uint32_t ground = 0, all = 0;
  };

  LabelVoteConfig config;
  VoxelSums<std::int32_t> sums;             // of votes
  VoxelSums<PointCounts> of_scan;           // working memory
  double forgotten_x = 0, forgotten_y = 0;  // position when voxels were forgotten last

  [[nodiscard]] std::int32_t vote(const PointCounts& counts) const noexcept;
  void forget_beyond(double x, double y);
};

// w (g - 0.5) with g the fraction of ground and w = 1 / (1 + (r / 15 m)^2), as an integer.
std::int32_t LabelVote::Votes::vote(const PointCounts& counts) const noexcept {
  constexpr double unit = 4096;
  constexpr double half_weight_range = 15;  // metres
  const double share = static_cast<double>(counts.ground) / counts.all;
  const double dx = (counts.x + 0.5) * config.voxel;
  const double dy = (counts.y + 0.5) * config.voxel;
  const double weight = 1 / (1 + (dx * dx + dy * dy) / (half_weight_range * half_weight_range));
  return static_cast<std::int32_t>(std::lround(unit * weight * (share - 0.5)));
}

// Copies the voxels that remain. Done when the sensor has moved a quarter of the window, so that
// its time is spread over many scans.
void LabelVote::Votes::forget_beyond(double x, double y) {
  if (std::hypot(x - forgotten_x, y - forgotten_y) < config.window / 4) return;
  const std::int64_t centre_x = LevelledScan::index_of(x, config.voxel);
  const std::int64_t centre_y = LevelledScan::index_of(y, config.voxel);
  const double reach = config.window / config.voxel;
  VoxelSums<std::int32_t> remaining;
  sums.for_each([&](std::uint64_t key, std::int32_t sum) {
    const std::int64_t dx = index_in(key, horizontal_bits + vertical_bits, centre_x) - centre_x;
    const std::int64_t dy = index_in(key, vertical_bits, centre_y) - centre_y;
    if (std::hypot(static_cast<double>(dx), static_cast<double>(dy)) <= reach) {
      remaining.at(key) = sum;
    }
  });
  std::swap(sums, remaining);
  forgotten_x = x;
  forgotten_y = y;
}

LabelVote::LabelVote(const LabelVoteConfig& config) : votes_(std::make_unique<Votes>()) {
  config.check();
  votes_->config = config;
}

LabelVote::~LabelVote() = default;
LabelVote::LabelVote(LabelVote&&) noexcept = default;
LabelVote& LabelVote::operator=(LabelVote&&) noexcept = default;

Status LabelVote::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                      const Levelling& levelling) {
  if (Status status = check_scan(cloud, result, pose); !status.ok()) return status;
  Votes& votes = *votes_;
  const LevelledScan scan(votes.config, cloud, result, pose, levelling);
  const std::int64_t sensor_x = LevelledScan::index_of(pose.position[0], votes.config.voxel);
  const std::int64_t sensor_y = LevelledScan::index_of(pose.position[1], votes.config.voxel);
  try {
    votes.of_scan.clear();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto voxel = scan.voxel(i);
      if (!voxel) continue;
      Votes::PointCounts& counts = votes.of_scan.at(key_of(voxel->x, voxel->y, voxel->z));
      counts.x = static_cast<std::int32_t>(voxel->x - sensor_x);
      counts.y = static_cast<std::int32_t>(voxel->y - sensor_y);
      counts.ground += result.labels()[i] == Label::ground ? 1U : 0U;
      ++counts.all;
    }
    votes.sums.reserve_more(votes.of_scan.size());
    votes.of_scan.for_each([&](std::uint64_t key, const Votes::PointCounts& counts) {
      votes.sums.at(key) += votes.vote(counts);
    });
    if (votes.config.window > 0) votes.forget_beyond(pose.position[0], pose.position[1]);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  return {};
}

Status LabelVote::relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, std::span<Label> labels) const {
  if (Status status = check_scan(cloud, result, pose); !status.ok()) return status;
  if (labels.size() != cloud.size()) return Status(StatusCode::invalid_argument);
  const LevelledScan scan(votes_->config, cloud, result, pose, levelling);
  std::ranges::copy(result.labels(), labels.begin());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto voxel = scan.voxel(i);
    if (!voxel) continue;
    const std::int32_t* const sum = votes_->sums.find(key_of(voxel->x, voxel->y, voxel->z));
    if (sum != nullptr && *sum != 0) labels[i] = *sum > 0 ? Label::ground : Label::nonground;
  }
  return {};
}

std::size_t LabelVote::voxels() const noexcept { return votes_->sums.size(); }

std::size_t LabelVote::bytes() const noexcept {
  return votes_->sums.bytes() + votes_->of_scan.bytes();
}

}  // namespace flagstone
