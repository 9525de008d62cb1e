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
#include <numeric>
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
#include "library/moving_points/scan_points.hpp"
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
};

Scan scan_of(CloudView cloud, const Segmentation& result, const Pose& pose,
             const Levelling& levelling, double time) noexcept {
  return {.cloud = cloud,
          .labels = result.labels(),
          .heights = result.heights(),
          .pose = pose,
          .levelled = LevelledPose(pose, levelling),
          .time = time};
}

// One row per beam; `spacing` in degrees.
float rows_per_radian(double spacing) noexcept {
  return static_cast<float>(180 / (std::numbers::pi * spacing));
}

// Moving if several looks saw through the point, even if others saw an object there: a long
// vehicle, and traffic behind it, occupies its own track.
bool is_moving(const LookCounts& counts) noexcept {
  constexpr int min_through = 2;
  return counts.through >= min_through &&
         20 * counts.through > 7 * (counts.through + counts.occupied);
}

// Four looks agree: more of them nearly never change the result.
bool is_clear(const LookCounts& counts) noexcept {
  constexpr int min_looks = 4;
  return counts.through + counts.occupied >= min_looks &&
         (counts.through == 0 || counts.occupied == 0);
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
  void read(const Scan& scan);
  void select_samples();
  void look(const Scan& scan);
  void close_clear_points();
  void judge();
  void describe(MovingMask& mask);
  void find(const Scan& scan, MovingMask& mask);
  void build_image(RangeImage& image);
  void count_columns(const Scan& scan);

  MovingPointsConfig config_;
  PixelGrid grid_;
  std::deque<ScanView> scans_;
  OccupiedColumns columns_;
  std::array<double, 2> forgotten_{};  // position when columns were forgotten last

  // Working memory for one scan. Samples are a part of the points that could move.
  std::array<float, 6> to_world_{};  // first two rows of the rotation
  ScanPoints points_;
  std::vector<MovingObjects::Sample> samples_;
  std::vector<std::uint32_t> looked_;  // indices of the samples that need looks
  std::vector<LookCounts> counts_;     // of these samples
  std::vector<std::uint32_t> open_;    // indices in looked_ of those that need more looks
  PointArrays looked_points_;          // of these
  std::vector<LookCounts> open_counts_;
  std::vector<const ScanView*> views_;
  Directions directions_;
  MovingObjects objects_;
  std::vector<ObjectLooks> looks_;
};

void MovingPoints::Finder::measure_grid(const Scan& scan) {
  double spacing = config_.beam_spacing;
  if (spacing == 0) {
    PointArrays points;
    points.start(scan.cloud.size());
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
      if (scan.labels[i] != Label::invalid) points.push_back(scan.cloud[i]);
    }
    points.finish();
    spacing = measured_beam_spacing(points);
  }
  grid_.rows_per_radian = rows_per_radian(spacing);
}

void MovingPoints::Finder::read(const Scan& scan) {
  columns_.start(scan.pose.position[0], scan.pose.position[1]);
  columns_.look_around(scan.pose.position[0], scan.pose.position[1]);
  std::ranges::transform(std::span(scan.pose.rotation).first(to_world_.size()), to_world_.begin(),
                         [](double value) { return static_cast<float>(value); });
  points_.read(scan.cloud, scan.labels, scan.heights,
               {.to_world = to_world_,
                .max_range = static_cast<float>(config_.max_range),
                .min_height = config_.min_height,
                .max_height = config_.max_height,
                .objects = MovingObjects::grid,
                .columns = columns_.grid(),
                .surroundings = columns_.surroundings()});
}

// Only a part of the points of each column needs evidence, chosen by hashes, which do not depend on
// the order of the points. Those in columns that are always occupied need no looks: they do not
// move.
void MovingPoints::Finder::select_samples() {
  const std::span<const std::uint32_t> candidates = points_.candidates();
  const std::span<const std::uint32_t> columns = points_.candidate_columns();
  const std::span<const std::uint32_t> surroundings = points_.candidate_surroundings();
  const std::span<const std::uint32_t> hashes = points_.candidate_hashes();
  objects_.start(columns);
  samples_.clear();
  looked_.clear();
  looked_points_.start(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const std::uint64_t points_per_sample = objects_.points_per_sample(columns[k]);
    if ((hashes[k] * points_per_sample) >> 32U != 0) continue;
    const bool is_fixed = columns_.is_occupied(surroundings[k]);
    samples_.push_back(
        {.column = columns[k], .evidence = is_fixed ? Evidence::fixed : Evidence::none});
    if (is_fixed) continue;
    looked_.push_back(static_cast<std::uint32_t>(samples_.size() - 1));
    looked_points_.push_back(points_.points()[candidates[k]]);
  }
  looked_points_.finish();
}

// The first quarter of the scans is spread over all times before and after the scan. Points on
// which these agree need no more looks.
void MovingPoints::Finder::look(const Scan& scan) {
  constexpr std::size_t step = 4;
  constexpr std::size_t first_quarter = 1;
  select_views(scans_, scan.time, views_);
  counts_.assign(looked_.size(), {});
  open_.resize(looked_.size());
  std::iota(open_.begin(), open_.end(), 0U);
  open_counts_.assign(looked_.size(), {});
  for (const std::size_t quarter :
       {first_quarter, std::size_t{3}, std::size_t{0}, std::size_t{2}}) {
    for (std::size_t k = quarter; k < views_.size(); k += step) {
      directions_.compute(looked_points_, scan.levelled.to(views_[k]->pose), grid_);
      add_looks(views_[k]->image, directions_, open_counts_);
      if (quarter != first_quarter) close_clear_points();
    }
    if (quarter == first_quarter) close_clear_points();
  }
}

// Saves the counts of all open points.
void MovingPoints::Finder::close_clear_points() {
  std::size_t left = 0;
  for (std::size_t k = 0; k < open_.size(); ++k) {
    counts_[open_[k]] = open_counts_[k];
    if (is_clear(open_counts_[k])) continue;
    open_[left] = open_[k];
    open_counts_[left] = open_counts_[k];
    looked_points_.replace(left, looked_points_[k]);
    ++left;
  }
  open_.resize(left);
  open_counts_.resize(left);
  looked_points_.shorten(left);
}

void MovingPoints::Finder::judge() {
  for (std::size_t k = 0; k < looked_.size(); ++k) {
    const LookCounts& counts = counts_[k];
    samples_[looked_[k]].evidence = is_moving(counts)     ? Evidence::moving
                                    : counts.occupied > 0 ? Evidence::fixed
                                                          : Evidence::none;
  }
}

void MovingPoints::Finder::describe(MovingMask& mask) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  mask.objects.assign(objects_.count(), {.min = {infinity, infinity, infinity},
                                         .max = {-infinity, -infinity, -infinity}});
  looks_.assign(mask.objects.size(), {});
  const std::span<const std::uint32_t> candidates = points_.candidates();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const std::uint32_t number = objects_.object_in(points_.candidate_columns()[k]);
    if (number == 0) continue;
    mask.objects_of_points[candidates[k]] = number;
    points_.mark_moving(candidates[k]);
    MovingObject& object = mask.objects[number - 1];
    ++object.points;
    const Point point = points_.points()[candidates[k]];
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
  read(scan);
  select_samples();
  look(scan);
  judge();
  objects_.find(samples_);
  describe(mask);
}

// Without moving points: where they were, another vehicle may pass.
void MovingPoints::Finder::build_image(RangeImage& image) {
  directions_.compute(points_.points(), identity_transform, grid_);
  image.build(directions_, points_.is_object());
}

void MovingPoints::Finder::count_columns(const Scan& scan) {
  columns_.add(points_.in_columns());
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
  build_image(view.image);
  scans_.push_back(std::move(view));
  count_columns(scan);
  return {};
}

Status MovingPoints::Finder::find_again(const Scan& scan, MovingMask& mask) {
  const auto same = std::ranges::find(scans_, scan.time, &ScanView::time);
  if (same == scans_.end()) {
    return Status(StatusCode::invalid_argument,
                  "moving points: no scan of this time is in memory (add it first)");
  }
  find(scan, mask);
  build_image(same->image);
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
  if (Status status = check_scan("moving points", cloud, result, pose); !status.ok()) return status;
  try {
    return finder_->add(scan_of(cloud, result, pose, levelling, time), mask);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status MovingPoints::find(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, double time, MovingMask& mask) {
  if (Status status = check_scan("moving points", cloud, result, pose); !status.ok()) return status;
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
