// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/moving_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <new>
#include <numbers>
#include <string_view>
#include <utility>

#include "library/core/setting.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/moving_points/beam_spacing.hpp"
#include "library/moving_points/directions.hpp"
#include "library/moving_points/levelled_pose.hpp"
#include "library/moving_points/looks.hpp"
#include "library/moving_points/moving_objects.hpp"
#include "library/moving_points/occupied_columns.hpp"
#include "library/moving_points/scan_view_bytes.hpp"

namespace flagstone {

void MovingPointsConfig::check() const {
  constexpr const char* name = "moving points";
  if (beam_spacing != 0) {
    check_number(name, "beam_spacing", beam_spacing,
                 {.low = 0.1, .high = 5, .unit = "degrees", .remark = ", or 0 to measure it"});
  }
  check_number(name, "max_range", max_range, {.low = 5, .high = 100, .unit = "m"});
  check_number(name, "min_height", min_height, {.low = 0, .high = 2, .unit = "m"});
  check_number(name, "max_height", max_height, {.low = 1, .high = 100, .unit = "m"});
  check_number(name, "delay", delay, {.low = 0, .high = 10, .unit = "s"});
  if (window != 0) {
    check_number(name, "window", window,
                 {.low = 100, .high = 1e6, .unit = "m", .remark = ", or 0 to forget nothing"});
  }
}

namespace {

using Evidence = MovingObjects::Evidence;

/// A scan with everything that is known about it.
struct Scan {
  CloudView cloud;
  std::span<const Label> labels;
  std::span<const float> heights;
  const Pose& pose;
  LevelledPose levelled;
  double time;
  std::array<float, 6> to_world;  ///< first two rows of the rotation

  /// From the sensor to a point along the x and y axes of the world frame, metres.
  [[nodiscard]] std::pair<float, float> offset(const Point& p) const noexcept {
    const auto& m = to_world;
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z, m[3] * p.x + m[4] * p.y + m[5] * p.z};
  }
};

Scan scan_of(CloudView cloud, const Segmentation& result, const Pose& pose,
             const Levelling& levelling, double time) noexcept {
  std::array<float, 6> to_world{};
  std::ranges::transform(std::span(pose.rotation).first(to_world.size()), to_world.begin(),
                         [](double value) { return static_cast<float>(value); });
  return {.cloud = cloud,
          .labels = result.labels(),
          .heights = result.heights(),
          .pose = pose,
          .levelled = LevelledPose(pose, levelling),
          .time = time,
          .to_world = to_world};
}

Status check_scan(CloudView cloud, const Segmentation& result, const Pose& pose) {
  if (cloud.size() != result.labels().size() || cloud.size() != result.heights().size()) {
    return Status(StatusCode::invalid_argument,
                  "moving points: the result has no heights of this cloud (expected the result of "
                  "a method such as surface for the same cloud)");
  }
  return is_valid(pose) ? Status() : invalid_pose();
}

// One row per beam; `spacing` in degrees.
float rows_per_radian(double spacing) noexcept {
  return static_cast<float>(180 / (std::numbers::pi * spacing));
}

// Higher points can be parts of bridges or trees above a road.
constexpr float max_standing_height = 2.2F;  // metres

// A hash of the coordinates, 32 bits: samples do not depend on the order of the points.
std::uint64_t hash_of(const Point& p) noexcept {
  std::uint32_t hash = std::bit_cast<std::uint32_t>(p.x) * 0x9E3779B1U;
  hash = (hash ^ std::bit_cast<std::uint32_t>(p.y)) * 0x85EBCA77U;
  hash = (hash ^ (hash >> 15U) ^ std::bit_cast<std::uint32_t>(p.z)) * 0xC2B2AE3DU;
  return hash ^ (hash >> 16U);
}

// Moving if several looks saw through the point, even if others saw an object there: a long
// vehicle, and traffic behind it, occupies its own track.
bool is_moving(const LookCounts& counts) noexcept {
  constexpr int min_through = 2;
  return counts.through >= min_through &&
         20 * counts.through > 7 * (counts.through + counts.occupied);
}

}  // namespace

class MovingPoints::Finder {
 public:
  explicit Finder(const MovingPointsConfig& config) : config_(config) {}

  Status add(const Scan& scan, MovingMask& mask);
  Status find_again(const Scan& scan, MovingMask& mask);
  void to_bytes(std::vector<std::byte>& bytes) const;
  Status from_bytes(std::span<const std::byte> bytes);

  [[nodiscard]] double beam_spacing() const noexcept {
    return scans_.empty() ? 0 : 180 / (std::numbers::pi * double{grid_.rows_per_radian});
  }
  [[nodiscard]] std::size_t scans() const noexcept { return scans_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct ObjectLooks {
    std::size_t through = 0, all = 0;
  };

  void measure_grid(const Scan& scan);
  void select_candidates(const Scan& scan);
  void select_samples(const Scan& scan);
  void look(const Scan& scan);
  void judge();
  void describe(const Scan& scan, MovingMask& mask);
  void find(const Scan& scan, MovingMask& mask);
  void build_image(const Scan& scan, const MovingMask& mask, RangeImage& image);
  void count_columns(const Scan& scan, const MovingMask& mask);

  MovingPointsConfig config_;
  PixelGrid grid_;
  std::deque<ScanView> scans_;
  OccupiedColumns columns_;
  std::array<double, 2> forgotten_{};  // position when columns were forgotten last

  // Working memory for one scan. Candidates are the points that could move, samples a part of them.
  PointArrays points_;
  std::vector<std::uint32_t> indices_;  // of the candidates in the scan
  std::vector<std::uint32_t> object_columns_;
  std::vector<MovingObjects::Sample> samples_;
  std::vector<std::uint32_t> looked_;  // indices of the samples that need looks
  std::vector<LookCounts> counts_;     // of these samples
  std::vector<const ScanView*> views_;
  std::vector<std::uint8_t> is_object_;
  Directions directions_;
  MovingObjects objects_;
  std::vector<ObjectLooks> looks_;
};

void MovingPoints::Finder::measure_grid(const Scan& scan) {
  double spacing = config_.beam_spacing;
  if (spacing == 0) {
    points_.start(scan.cloud.size());
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
      if (scan.labels[i] != Label::invalid) points_.push_back(scan.cloud[i]);
    }
    points_.finish();
    spacing = measured_beam_spacing(points_);
  }
  grid_.rows_per_radian = rows_per_radian(spacing);
}

void MovingPoints::Finder::select_candidates(const Scan& scan) {
  indices_.clear();
  object_columns_.clear();
  const auto max_range = static_cast<float>(config_.max_range);
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    if (scan.labels[i] != Label::nonground) continue;
    const float height = scan.heights[i];
    if (height <= config_.min_height || height > config_.max_height) continue;  // known heights
    const Point p = scan.cloud[i];
    if (!(p.x * p.x + p.y * p.y + p.z * p.z < max_range * max_range)) continue;
    const auto [dx, dy] = scan.offset(p);
    const std::uint32_t column = MovingObjects::column_of(dx, dy);
    if (column == MovingObjects::outside) continue;
    indices_.push_back(static_cast<std::uint32_t>(i));
    object_columns_.push_back(column);
  }
}

// Only a part of the points of each column needs evidence. Those in columns that are always
// occupied need no looks: they do not move.
void MovingPoints::Finder::select_samples(const Scan& scan) {
  objects_.start(object_columns_);
  columns_.look_around(scan.pose.position[0], scan.pose.position[1]);
  samples_.clear();
  looked_.clear();
  points_.start(indices_.size());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    const Point p = scan.cloud[indices_[k]];
    const std::uint32_t column = object_columns_[k];
    if ((hash_of(p) * objects_.points_per_sample(column)) >> 32U != 0) continue;
    const auto [dx, dy] = scan.offset(p);
    const bool is_fixed = columns_.is_occupied(dx, dy);
    samples_.push_back({.column = column, .evidence = is_fixed ? Evidence::fixed : Evidence::none});
    if (is_fixed) continue;
    looked_.push_back(static_cast<std::uint32_t>(samples_.size() - 1));
    points_.push_back(p);
  }
  points_.finish();
}

void MovingPoints::Finder::look(const Scan& scan) {
  counts_.assign(looked_.size(), {});
  select_views(scans_, scan.time, views_);
  for (const ScanView* const view : views_) {
    directions_.compute(points_, scan.levelled.to(view->pose), grid_);
    add_looks(view->image, directions_, counts_);
  }
}

void MovingPoints::Finder::judge() {
  for (std::size_t k = 0; k < looked_.size(); ++k) {
    const LookCounts& counts = counts_[k];
    samples_[looked_[k]].evidence = is_moving(counts)     ? Evidence::moving
                                    : counts.occupied > 0 ? Evidence::fixed
                                                          : Evidence::none;
  }
}

void MovingPoints::Finder::describe(const Scan& scan, MovingMask& mask) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  mask.objects.assign(objects_.count(), {.min = {infinity, infinity, infinity},
                                         .max = {-infinity, -infinity, -infinity}});
  looks_.assign(mask.objects.size(), {});
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    const std::uint32_t number = objects_.object_in(object_columns_[k]);
    if (number == 0) continue;
    mask.objects_of_points[indices_[k]] = number;
    MovingObject& object = mask.objects[number - 1];
    ++object.points;
    const Point point = scan.cloud[indices_[k]];
    const std::array<float, 3> p{point.x, point.y, point.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      object.min[axis] = std::min(object.min[axis], p[axis]);
      object.max[axis] = std::max(object.max[axis], p[axis]);
    }
  }
  for (std::size_t k = 0; k < looked_.size(); ++k) {
    const std::uint32_t number = objects_.object_in(samples_[looked_[k]].column);
    if (number == 0) continue;
    looks_[number - 1].through += counts_[k].through;
    looks_[number - 1].all += std::size_t{counts_[k].through} + counts_[k].occupied;
  }
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    mask.objects[k].confidence =
        static_cast<float>(looks_[k].through) / static_cast<float>(looks_[k].all);
  }
}

void MovingPoints::Finder::find(const Scan& scan, MovingMask& mask) {
  mask.objects_of_points.assign(scan.cloud.size(), 0);
  select_candidates(scan);
  select_samples(scan);
  look(scan);
  judge();
  objects_.find(samples_);
  describe(scan, mask);
}

// Without moving points: where they were, another vehicle may pass.
void MovingPoints::Finder::build_image(const Scan& scan, const MovingMask& mask,
                                       RangeImage& image) {
  points_.start(scan.cloud.size());
  is_object_.clear();
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Label label = scan.labels[i];
    if (label == Label::invalid || label == Label::noise) continue;
    points_.push_back(scan.cloud[i]);
    is_object_.push_back(label == Label::nonground && mask.objects_of_points[i] == 0 ? 1 : 0);
  }
  points_.finish();
  directions_.compute(points_, identity_transform, grid_);
  image.build(directions_, is_object_);
}

void MovingPoints::Finder::count_columns(const Scan& scan, const MovingMask& mask) {
  constexpr float max_range = 40;  // metres; farther away, a scan does not see all objects
  constexpr float min_standing_height = 0.25F;  // metres
  columns_.start(scan.pose.position[0], scan.pose.position[1]);
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const float height = scan.heights[i];
    const bool is_ground = scan.labels[i] == Label::ground;
    const bool is_object = scan.labels[i] == Label::nonground && height > min_standing_height &&
                           height < max_standing_height && mask.objects_of_points[i] == 0;
    if (!is_ground && !is_object) continue;
    const Point p = scan.cloud[i];
    if (!(p.x * p.x + p.y * p.y < max_range * max_range)) continue;
    const auto [dx, dy] = scan.offset(p);
    // Shorter than the range if the sensor is upright, otherwise possibly a little longer.
    constexpr float reach = OccupiedColumns::reach;
    if (std::max(std::abs(dx), std::abs(dy)) > reach) continue;
    columns_.add(dx, dy, is_object);
  }
  columns_.finish();
  if (config_.window > 0) {
    const double x = scan.pose.position[0];
    const double y = scan.pose.position[1];
    if (std::hypot(x - forgotten_[0], y - forgotten_[1]) < config_.window / 4) return;
    columns_.forget_beyond(x, y, config_.window);
    forgotten_ = {x, y};
  }
}

Status MovingPoints::Finder::add(const Scan& scan, MovingMask& mask) {
  if (!std::isfinite(scan.time) || (!scans_.empty() && !(scan.time > scans_.back().time))) {
    return Status(StatusCode::invalid_argument,
                  "moving points: the time of the scan is not later than that of the scan before");
  }
  if (grid_.rows_per_radian == 0) measure_grid(scan);
  find(scan, mask);
  ScanView view;
  while (!scans_.empty() && scans_.front().time < scan.time - reach - config_.delay) {
    std::swap(view, scans_.front());  // its memory is used again
    scans_.pop_front();
  }
  view.time = scan.time;
  view.pose = scan.levelled;
  build_image(scan, mask, view.image);
  scans_.push_back(std::move(view));
  count_columns(scan, mask);
  return {};
}

Status MovingPoints::Finder::find_again(const Scan& scan, MovingMask& mask) {
  const auto same = std::ranges::find(scans_, scan.time, &ScanView::time);
  if (same == scans_.end()) {
    return Status(StatusCode::invalid_argument,
                  "moving points: no scan of this time is in memory (add it first)");
  }
  find(scan, mask);
  build_image(scan, mask, same->image);
  return {};
}

namespace {

constexpr std::string_view moving_magic = "fsmove01";

}  // namespace

void MovingPoints::Finder::to_bytes(std::vector<std::byte>& bytes) const {
  StateWriter writer(bytes);
  writer.start(moving_magic);
  writer.add(grid_.rows_per_radian);
  for (const double coordinate : forgotten_) writer.add(coordinate);
  writer.add(std::uint64_t{scans_.size()});
  for (const ScanView& scan : scans_) write_view(scan, writer);
  columns_.write(writer);
  writer.finish();
}

Status MovingPoints::Finder::from_bytes(std::span<const std::byte> bytes) {
  StateReader reader(bytes);
  if (Status status = reader.open(moving_magic, "the state of moving points"); !status.ok()) {
    return status;
  }
  PixelGrid grid;
  grid.rows_per_radian = reader.read<float>();
  std::array<double, 2> forgotten{};
  for (double& coordinate : forgotten) coordinate = reader.read<double>();
  const auto count = reader.read<std::uint64_t>();
  if (reader.failed()) return bad_state(reader.offset(), "the header is incomplete", "36 bytes");
  const auto is_position = [](double metres) { return std::abs(metres) <= max_world_position; };
  const bool has_grid = grid.rows_per_radian > rows_per_radian(5.1) &&  // degrees
                        grid.rows_per_radian < rows_per_radian(0.09);
  if (!std::ranges::all_of(forgotten, is_position) ||
      (count > 0 ? !has_grid : std::bit_cast<std::uint32_t>(grid.rows_per_radian) != 0)) {
    return bad_state(moving_magic.size(), "an impossible number in the header",
                     "a beam spacing of 0.1 to 5 degrees and positions up to 10,000 km");
  }
  if (config_.beam_spacing != 0 && count > 0 &&
      grid.rows_per_radian != rows_per_radian(config_.beam_spacing)) {
    return bad_state(moving_magic.size(), "the beam spacing differs", "the setting `beam_spacing`");
  }
  std::deque<ScanView> scans;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::size_t offset = reader.offset();
    ScanView& scan = scans.emplace_back();
    if (Status status = read_view(reader, scan); !status.ok()) return status;
    if (k > 0 && !(scan.time > scans[k - 1].time)) {
      return bad_state(offset, "the times of the scans do not increase", "increasing times");
    }
  }
  OccupiedColumns columns;
  if (Status status = columns.read(reader); !status.ok()) return status;
  if (reader.left() > 0) {
    return bad_state(reader.offset(), "bytes after the last tile", "the end");
  }
  grid_ = grid;
  forgotten_ = forgotten;
  scans_ = std::move(scans);
  columns_ = std::move(columns);
  return {};
}

std::size_t MovingPoints::Finder::bytes() const noexcept {
  std::size_t sum = columns_.bytes();
  for (const ScanView& scan : scans_) sum += scan.image.bytes();
  return sum;
}

MovingPoints::MovingPoints(const MovingPointsConfig& config) {
  config.check();
  finder_ = std::make_unique<Finder>(config);
}

MovingPoints::~MovingPoints() = default;
MovingPoints::MovingPoints(MovingPoints&&) noexcept = default;
MovingPoints& MovingPoints::operator=(MovingPoints&&) noexcept = default;

Status MovingPoints::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                         const Levelling& levelling, double time, MovingMask& mask) {
  if (Status status = check_scan(cloud, result, pose); !status.ok()) return status;
  try {
    return finder_->add(scan_of(cloud, result, pose, levelling, time), mask);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status MovingPoints::find(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, double time, MovingMask& mask) {
  if (Status status = check_scan(cloud, result, pose); !status.ok()) return status;
  try {
    return finder_->find_again(scan_of(cloud, result, pose, levelling, time), mask);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status MovingPoints::to_bytes(std::vector<std::byte>& bytes) const {
  bytes.clear();
  try {
    finder_->to_bytes(bytes);
    return {};
  } catch (const std::bad_alloc&) {
    bytes.clear();
    return Status(StatusCode::out_of_memory);
  }
}

Status MovingPoints::from_bytes(std::span<const std::byte> bytes) {
  try {
    return finder_->from_bytes(bytes);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

double MovingPoints::beam_spacing() const noexcept { return finder_->beam_spacing(); }
std::size_t MovingPoints::scans() const noexcept { return finder_->scans(); }
std::size_t MovingPoints::bytes() const noexcept { return finder_->bytes(); }

}  // namespace flagstone
