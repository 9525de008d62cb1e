// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/label_vote.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/setting.hpp"
#include "library/ground_map/levelled_scan.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/scan_voxels.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/tile_indices.hpp"
#include "library/ground_map/voxel_tiles.hpp"

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

Status check_labels(CloudView cloud, std::span<const Label> labels) {
  if (labels.size() == cloud.size()) return {};
  return Status(StatusCode::invalid_argument,
                "label vote: the number of labels to write differs from the number of points "
                "(expected one label per point)");
}

Label winner(std::int32_t sum, Label own) noexcept {
  if (sum == 0) return own;
  return sum > 0 ? Label::ground : Label::nonground;
}

// The vote of the points of one scan in a voxel: w (g - 0.5) with g the fraction of ground and
// w = 1 / (1 + (r / 15 m)^2), as an integer.
std::int32_t vote_of(const LevelledScan& scan, const ScanVoxels::Voxel& voxel) noexcept {
  constexpr double unit = 4096;
  constexpr double half_weight_range = 15;  // metres
  constexpr double half_weight = half_weight_range * half_weight_range;
  const double majority = 2.0 * voxel.ground - voxel.all;  // 2 all (g - 0.5)
  const double vote = unit * half_weight * majority /
                      (2.0 * voxel.all * (half_weight + scan.squared_range(voxel.at)));
  return static_cast<std::int32_t>(vote + std::copysign(0.5, vote));  // rounded
}

}  // namespace

class LabelVote::Votes {
 public:
  LabelVoteConfig config;
  VoxelTiles tiles;

  void count(const LevelledScan& scan, std::span<const Label> labels);
  void add(const LevelledScan& scan);
  void write(std::span<const Label> own, std::span<Label> labels) const noexcept;
  void forget_beyond(const Pose& pose) noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct VotingPoint {
    std::uint32_t point, voxel;
  };

  struct Vote {
    VoxelTile* tile;
    std::uint32_t key;
    std::int32_t vote;
  };

  // Working memory for one scan.
  ScanVoxels of_scan_;
  std::vector<VotingPoint> points_;
  std::vector<VoxelTile*> tile_of_place_;  // null: not looked up yet
  std::vector<Vote> votes_;                // of the voxels of the scan
  std::vector<std::int32_t> sums_;         // of the same voxels, after the votes
};

// Counts the points of a scan in each voxel.
void LabelVote::Votes::count(const LevelledScan& scan, std::span<const Label> labels) {
  of_scan_.clear();
  points_.resize(labels.size());
  std::size_t count = 0;
  GridPoints voters;
  for (std::size_t begin = 0; begin < labels.size(); begin += GridPoints::capacity) {
    scan.read(begin, voters);
    of_scan_.reserve(voters.count);
    for (std::size_t k = 0; k < voters.count; ++k) {
      const auto point = static_cast<std::uint32_t>(voters.point[k]);
      const bool is_ground = labels[point] == Label::ground;
      points_[count++] = {.point = point, .voxel = of_scan_.count(GridVoxel(voters, k), is_ground)};
    }
  }
  points_.resize(count);
}

// Adds the votes of the counted scan. If memory runs out, it removes them again.
void LabelVote::Votes::add(const LevelledScan& scan) {
  const std::span<const ScanVoxels::Voxel> voxels = of_scan_.voxels();
  tile_of_place_.assign(scan.tiles(), nullptr);
  votes_.resize(voxels.size());
  sums_.resize(voxels.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const VotePlace place = scan.place_of(voxels[i].at);
    VoxelTile*& tile = tile_of_place_[place.tile];
    if (tile == nullptr) tile = &tiles[scan.tile_at(place.tile)];
    votes_[i] = {.tile = tile, .key = place.key, .vote = vote_of(scan, voxels[i])};
  }
  constexpr std::size_t ahead = 16;
  std::size_t done = 0;
  try {
    for (; done < votes_.size(); ++done) {
      if (done + ahead < votes_.size()) {
        const Vote& next = votes_[done + ahead];
        next.tile->prefetch(next.key);
      }
      const auto& [tile, key, vote] = votes_[done];
      sums_[done] = tile->add(key, vote);
    }
  } catch (const std::bad_alloc&) {
    while (done-- > 0) votes_[done].tile->add(votes_[done].key, -votes_[done].vote);
    throw;
  }
}

// The labels of the scan that was added last.
void LabelVote::Votes::write(std::span<const Label> own, std::span<Label> labels) const noexcept {
  std::ranges::copy(own, labels.begin());
  for (const VotingPoint& each : points_) {
    labels[each.point] = winner(sums_[each.voxel], own[each.point]);
  }
}

void LabelVote::Votes::forget_beyond(const Pose& pose) noexcept {
  const double width = static_cast<double>(VoxelTile::width) * config.voxel;
  std::erase_if(tiles, [&](const auto& tile) {
    const double dx = (static_cast<double>(tile.first.x) + 0.5) * width - pose.position[0];
    const double dy = (static_cast<double>(tile.first.y) + 0.5) * width - pose.position[1];
    return std::hypot(dx, dy) > config.window;
  });
}

std::size_t LabelVote::Votes::bytes() const noexcept {
  std::size_t sum = tiles.bucket_count() * sizeof(void*) + of_scan_.bytes() +
                    points_.capacity() * sizeof(VotingPoint) + votes_.capacity() * sizeof(Vote) +
                    sums_.capacity() * sizeof(std::int32_t) +
                    tile_of_place_.capacity() * sizeof(void*);
  constexpr std::size_t of_node = 32;  // of the table of tiles
  for (const auto& [index, tile] : tiles) sum += sizeof(tile) + of_node + tile.bytes();
  return sum;
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
  return add_scan(cloud, result, pose, levelling, nullptr);
}

Status LabelVote::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                      const Levelling& levelling, std::span<Label> labels) {
  if (Status status = check_labels(cloud, labels); !status.ok()) return status;
  return add_scan(cloud, result, pose, levelling, &labels);
}

Status LabelVote::add_scan(CloudView cloud, const Segmentation& result, const Pose& pose,
                           const Levelling& levelling, const std::span<Label>* labels) {
  if (Status status = check_scan("label vote", cloud, result, pose); !status.ok()) return status;
  const ScopedFloatingPointMode mode;
  const LevelledScan scan(votes_->config, cloud, result, pose, levelling);
  try {
    votes_->count(scan, result.labels());
    votes_->add(scan);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  if (labels != nullptr) votes_->write(result.labels(), *labels);
  if (votes_->config.window > 0) votes_->forget_beyond(pose);
  return {};
}

Status LabelVote::relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, std::span<Label> labels) const {
  if (Status status = check_scan("label vote", cloud, result, pose); !status.ok()) return status;
  if (Status status = check_labels(cloud, labels); !status.ok()) return status;
  const ScopedFloatingPointMode mode;
  const LevelledScan scan(votes_->config, cloud, result, pose, levelling);
  std::vector<const VoxelTile*> tile_of_place;
  const VoxelTile no_votes;
  try {
    tile_of_place.assign(scan.tiles(), &no_votes);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  for (std::size_t place = 0; place < tile_of_place.size(); ++place) {
    const auto tile = votes_->tiles.find(scan.tile_at(place));
    if (tile != votes_->tiles.end()) tile_of_place[place] = &tile->second;
  }
  std::ranges::copy(result.labels(), labels.begin());
  GridPoints voters;
  std::array<VotePlace, GridPoints::capacity> places;
  for (std::size_t begin = 0; begin < cloud.size(); begin += GridPoints::capacity) {
    scan.read(begin, voters);
    for (std::size_t k = 0; k < voters.count; ++k) {
      places[k] = scan.place_of(GridVoxel(voters, k));
      tile_of_place[places[k].tile]->prefetch(places[k].key);
    }
    for (std::size_t k = 0; k < voters.count; ++k) {
      Label& label = labels[static_cast<std::size_t>(voters.point[k])];
      label = winner(tile_of_place[places[k].tile]->sum(places[k].key), label);
    }
  }
  return {};
}

namespace {

constexpr std::string_view vote_magic = "fsvote01";

}  // namespace

Status LabelVote::to_bytes(std::vector<std::byte>& bytes) const {
  bytes.clear();
  try {
    std::vector<TileIndex> indices;
    for (const auto& [index, tile] : votes_->tiles) {
      if (tile.size() > 0) indices.push_back(index);
    }
    sort_tiles(indices);
    StateWriter writer(bytes);
    writer.start(vote_magic);
    writer.add(votes_->config.voxel);
    writer.add(votes_->config.voxel_height);
    writer.add(std::uint64_t{indices.size()});
    for (const TileIndex index : indices) {
      const std::vector<VoxelTile::Entry> voxels = votes_->tiles.at(index).sorted();
      write_index(index, writer);
      writer.add(std::uint64_t{voxels.size()});
      for (const VoxelTile::Entry& voxel : voxels) {
        writer.add(voxel.key);
        writer.add(voxel.sum);
      }
    }
    writer.finish();
    return {};
  } catch (const std::bad_alloc&) {
    bytes.clear();
    return Status(StatusCode::out_of_memory);
  }
}

namespace {

// Reads the voxels of a tile, sorted by key.
Status read_voxels(StateReader& reader, VoxelTile& tile) {
  const auto count = reader.read<std::uint64_t>();
  constexpr std::size_t bytes_per_voxel = 8;
  if (reader.failed() || count == 0 || count > reader.left() / bytes_per_voxel) {
    return bad_state(reader.offset(), "the number of voxels does not fit the size",
                     "8 bytes per voxel, and at least one voxel");
  }
  std::int64_t last = -1;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::size_t offset = reader.offset();
    const auto key = reader.read<std::uint32_t>();
    const auto sum = static_cast<std::int32_t>(reader.read<std::uint32_t>());
    if (std::int64_t{key} <= last || key > VoxelKey::largest ||
        std::abs(std::int64_t{sum}) > VoxelTile::largest_sum) {
      return bad_state(offset, "an impossible voxel",
                       "keys in ascending order and sums up to 2^30");
    }
    last = key;
    tile.add(key, sum);
  }
  return {};
}

}  // namespace

Status LabelVote::from_bytes(std::span<const std::byte> bytes) {
  try {
    StateReader reader(bytes);
    if (Status status = reader.open(vote_magic, "the state of a label vote"); !status.ok())
      return status;
    const auto voxel = reader.read<double>();
    const auto voxel_height = reader.read<double>();
    const auto count = reader.read<std::uint64_t>();
    if (reader.failed()) return bad_state(reader.offset(), "the header is incomplete", "32 bytes");
    if (voxel != votes_->config.voxel || voxel_height != votes_->config.voxel_height) {
      return bad_state(vote_magic.size(), "the size of the voxels differs",
                       "the settings `voxel` and `voxel_height` of this vote");
    }
    VoxelTiles tiles;
    TileIndexReader indices(static_cast<double>(VoxelTile::width) * voxel);
    for (std::uint64_t k = 0; k < count; ++k) {
      TileIndex index;
      if (Status status = indices.read(reader, index); !status.ok()) return status;
      if (Status status = read_voxels(reader, tiles[index]); !status.ok()) return status;
    }
    if (reader.left() > 0) {
      return bad_state(reader.offset(), "bytes after the last tile", "the end");
    }
    votes_->tiles = std::move(tiles);
    return {};
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

std::size_t LabelVote::voxels() const noexcept {
  std::size_t sum = 0;
  for (const auto& [index, tile] : votes_->tiles) sum += tile.size();
  return sum;
}

std::size_t LabelVote::bytes() const noexcept { return votes_->bytes(); }

}  // namespace flagstone
