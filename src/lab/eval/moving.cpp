// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/moving.hpp"

#include <algorithm>

#include "files/io/label_files.hpp"
#include "lab/eval/protocol.hpp"

namespace flagstone::eval {
namespace {

/// 251 is the class of all moving points in predictions for SemanticKITTI's benchmark.
bool moves(std::uint32_t id) noexcept { return id >= 251 && id <= 259; }

/// Points are counted in groups: 3 * band + kind, and one group for points that are not scored.
enum PointKind : std::uint8_t { moving_point, obstacle_point, ground_point, point_kinds };
constexpr std::size_t not_scored_group = point_kinds * range_bands.size();

PointKind kind_of(std::uint32_t id) {
  if (moves(id)) return moving_point;
  const auto& ground_classes = simulation_protocol().ground;  // SemanticKITTI's six ground classes
  return std::ranges::find(ground_classes, id) == ground_classes.end() ? obstacle_point
                                                                       : ground_point;
}

}  // namespace

void MovingTruth::set(CloudView cloud, std::span<const std::uint32_t> classes) {
  groups_.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t band = band_of(cloud[i], range_bands);
    const bool is_scored = classes[i] > 1 && band < range_bands.size();
    groups_[i] = static_cast<std::uint8_t>(is_scored ? point_kinds * band + kind_of(classes[i])
                                                     : not_scored_group);
  }
}

MovingScore MovingTruth::score(std::span<const std::uint32_t> marks) const noexcept {
  std::array<std::array<std::uint64_t, 2>, not_scored_group + 1> points{};  // by group and mark
  for (std::size_t i = 0; i < marks.size(); ++i) ++points[groups_[i]][marks[i] == 0 ? 0 : 1];

  MovingScore score;
  for (std::size_t band = 0; band < range_bands.size(); ++band) {
    const auto count = [&](PointKind kind, std::size_t mark) {
      return static_cast<double>(points[point_kinds * band + kind][mark]);
    };
    score.by_range[band] = {
        .points = {.true_positives = count(moving_point, 1),
                   .false_positives = count(obstacle_point, 1) + count(ground_point, 1),
                   .false_negatives = count(moving_point, 0),
                   .true_negatives = count(obstacle_point, 0) + count(ground_point, 0)},
        .obstacles = count(obstacle_point, 0) + count(obstacle_point, 1),
        .kept = count(obstacle_point, 0)};
    score.all += score.by_range[band];
  }
  return score;
}

Status read_moving(const std::filesystem::path& file, std::size_t expected_points,
                   std::vector<std::uint32_t>& marks) {
  Status status = io::read_reference(file, expected_points, marks);
  if (status.ok() && file.extension() == ".label") {
    std::ranges::transform(marks, marks.begin(),
                           [](std::uint32_t id) { return moves(id) ? 1U : 0U; });
  }
  return status;
}

}  // namespace flagstone::eval
