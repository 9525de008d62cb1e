// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/pose_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "library/core/rotation.hpp"
#include "library/ground_map/poses.hpp"

namespace flagstone::app {
namespace {

using Vector = std::array<double, 3>;

constexpr double degrees = 180 / std::numbers::pi;
constexpr double max_tilt = 45;          // degrees
constexpr double max_speed = 70;         // m/s
constexpr double max_acceleration = 12;  // m/s^2, of a vehicle that brakes on a dry road

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector scaled(double factor, const Vector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector up_of(const Pose& pose) { return {pose.rotation[2], pose.rotation[5], pose.rotation[8]}; }

double angle_between(const Vector& a, const Vector& b) {
  return degrees * std::acos(std::clamp(dot(a, b) / (norm(a) * norm(b)), -1.0, 1.0));
}

/// The middle of the values; the lower one of two. There must be at least one.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// From one pose to a later one, in the frame halfway between them, in which a vehicle in a curve
/// moves straight ahead.
struct Step {
  Vector move{};        // metres
  Vector turn{};        // axis times angle, degrees
  double duration = 1;  // seconds, or number of scans if times are unknown
  // The part of the duration in which the motion may change. Shorter if poses in between are
  // skipped on trial, so that a small jump is not hidden by the time that passes.
  double free = 1;
};

/// The steps that a step is compared with: per axis, the range of their velocities without the most
/// extreme ones.
struct Range {
  Vector low{}, high{};
  double spread = 0;  ///< median difference to the median: large on rough ground

  /// How far a step is outside, per axis.
  [[nodiscard]] Vector excess(const Vector& moved, const Step& step) const {
    const Vector middle = centre();
    Vector out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = moved[i] - middle[i] * step.duration;
      const double allowed = (high[i] - low[i]) / 2 * step.free;
      out[i] = off - std::clamp(off, -allowed, allowed);
    }
    return out;
  }
  /// The largest velocity in it.
  [[nodiscard]] double largest() const {
    Vector far{};
    for (std::size_t i = 0; i < 3; ++i) far[i] = std::max(std::abs(low[i]), std::abs(high[i]));
    return norm(far);
  }
  [[nodiscard]] Vector centre() const {
    return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  }
};

Range range_of(const std::vector<Step>& steps, Vector Step::* quantity) {
  // A single wrong pose makes two wrong steps.
  const std::size_t trimmed = steps.size() >= 6 ? 2 : (steps.size() >= 4 ? 1 : 0);
  Range range;
  Vector spreads{};
  std::vector<double> values;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const Step& step : steps) values.push_back((step.*quantity)[axis] / step.duration);
    std::ranges::sort(values);
    range.low[axis] = values[trimmed];
    range.high[axis] = values[values.size() - 1 - trimmed];
    const double middle = median(values);
    for (double& value : values) value = std::abs(value - middle);
    spreads[axis] = median(values);
  }
  range.spread = norm(spreads);
  return range;
}

enum class StepFault { none, position, rotation };

class RunCheck {
 public:
  RunCheck(std::span<const std::optional<Pose>> poses, std::span<const double> times,
           bool from_camera)
      : poses_(poses), from_camera_(from_camera) {
    result_.scans.resize(poses.size());
    values_.reserve(poses.size());
    for (const std::optional<Pose>& each : poses) values_.push_back(each.value_or(Pose{}));
    check_each();
    has_times_ = are_increasing(times);
    if (has_times_) times_ = times;
  }

  PoseChecks check() {
    if (!usable_.empty()) {
      check_tilt();
      check_speed();
      if (!is_rejected_) split();
      if (!is_rejected_) check_axes();
    }
    finish();
    return std::move(result_);
  }

 private:
  const Pose& pose(std::size_t scan) const { return values_[scan]; }

  void report(PoseProblemKind kind, std::size_t first, std::size_t last, std::string message) {
    result_.problems.push_back(
        {.kind = kind, .first = first, .last = last, .message = std::move(message)});
  }

  /// Reports consecutive scans as one problem.
  void report_scan(PoseProblemKind kind, std::size_t scan, std::string_view message) {
    auto& problems = result_.problems;
    if (!problems.empty() && problems.back().kind == kind && problems.back().last + 1 == scan) {
      problems.back().last = scan;
    } else {
      report(kind, scan, scan, std::string(message));
    }
  }

  void reject_all(PoseProblemKind kind, std::string message) {
    report(kind, usable_.front(), usable_.back(), std::move(message));
    is_rejected_ = true;
  }

  void check_each() {
    for (std::size_t scan = 0; scan < poses_.size(); ++scan) {
      if (!poses_[scan]) continue;
      const auto is_near = [](double value) { return std::abs(value) <= max_world_position; };
      const auto is_finite = [](double value) { return std::isfinite(value); };
      if (!std::ranges::all_of(pose(scan).position, is_near) ||
          !std::ranges::all_of(pose(scan).rotation, is_finite)) {
        report_scan(PoseProblemKind::not_finite, scan,
                    "the pose is not finite or beyond 10,000 km (segmented alone)");
      } else if (!is_valid(pose(scan))) {
        report_scan(PoseProblemKind::not_a_rotation, scan,
                    "the pose has no valid rotation (segmented alone)");
      } else {
        usable_.push_back(scan);
      }
    }
  }

  bool are_increasing(std::span<const double> times) const {
    if (times.size() != poses_.size() || usable_.empty()) return false;
    for (std::size_t i = 0; i < usable_.size(); ++i) {
      if (!std::isfinite(times[usable_[i]])) return false;
      if (i > 0 && !(times[usable_[i]] > times[usable_[i - 1]])) return false;
    }
    return true;
  }

  void check_tilt() {
    std::array<std::vector<double>, 3> axes;
    for (const std::size_t scan : usable_) {
      for (std::size_t i = 0; i < 3; ++i) axes[i].push_back(up_of(pose(scan))[i]);
    }
    median_up_ = {median(axes[0]), median(axes[1]), median(axes[2])};
    std::vector<std::size_t> upright;
    for (const std::size_t scan : usable_) {
      if (!(norm(median_up_) > 0.1) || angle_between(up_of(pose(scan)), median_up_) > max_tilt) {
        continue;
      }
      upright.push_back(scan);
    }
    constexpr double max_fraction = 0.1;
    const auto tilted = static_cast<double>(usable_.size() - upright.size());
    const auto count = static_cast<double>(usable_.size());
    if (2 * tilted >= count || tilted > std::max(3.0, max_fraction * count)) {
      reject_all(PoseProblemKind::calibration,
                 fmt::format("the up axis of the sensor changes by more than {} degrees (expected "
                             "poses of the sensor with z up; {})",
                             max_tilt, axes_hint()));
      return;
    }
    for (const std::size_t scan : usable_) {
      if (std::ranges::binary_search(upright, scan)) continue;
      report_scan(PoseProblemKind::tilt, scan,
                  fmt::format("the pose is tilted by {:.0f} degrees against the others (expected "
                              "at most {}; segmented alone)",
                              angle_between(up_of(pose(scan)), median_up_), max_tilt));
    }
    usable_ = std::move(upright);
  }

  std::string axes_hint() const {
    return from_camera_
               ? "if the file contains poses of the sensor, rename calib.txt"
               : "if the file contains poses of a camera, put calib.txt with 'Tr:' next to "
                 "them; quaternions are in the order x, y, z, w";
  }

  double duration(std::size_t from, std::size_t to) const {
    return has_times_ ? times_[to] - times_[from] : static_cast<double>(to - from);
  }

  Step step(std::size_t from, std::size_t to) const {
    const Quaternion start = quaternion_of(pose(from).rotation);
    const Quaternion end = quaternion_of(pose(to).rotation);
    const RotationMatrix halfway = matrix_of(between(start, end, 0.5));
    const Vector moved = difference(pose(to).position, pose(from).position);
    Step out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 3; ++k) out.move[axis] += halfway[3 * k + axis] * moved[k];
    }
    out.turn = scaled(degrees,
                      rotation_vector(product(transposed(pose(from).rotation), pose(to).rotation)));
    out.duration = duration(from, to);
    out.free = out.duration;
    return out;
  }

  void check_speed() {
    if (!has_times_ || is_rejected_ || usable_.size() < 3) return;
    std::vector<double> speeds;
    for (std::size_t i = 1; i < usable_.size(); ++i) {
      const Step each = step(usable_[i - 1], usable_[i]);
      speeds.push_back(norm(each.move) / each.duration);
    }
    if (const double speed = median(speeds); speed > max_speed) {
      reject_all(PoseProblemKind::speed,
                 fmt::format("the sensor moves at {:.0f} m/s (expected at most {}; positions must "
                             "be in metres and times in seconds)",
                             speed, max_speed));
    }
  }

  /// The seconds that a step takes. Without times, a vehicle at 10 m/s is assumed, which
  /// only limits how much can change between two scans.
  double seconds(const Step& of, double usual_length) const {
    if (has_times_) return of.free;
    constexpr double usual_speed = 10;
    return std::clamp(usual_length / usual_speed, 0.05, 1.0);
  }

  /// Compares a step with the steps before and after.
  StepFault fault_of(const Step& tested, std::size_t to) const {
    if (has_times_ && norm(tested.move) / tested.duration > max_speed) return StepFault::position;
    std::vector<Step> others(accepted_.begin(), accepted_.end());
    const std::size_t before = others.size();
    const auto at = std::ranges::lower_bound(usable_, to) - usable_.begin();
    for (auto i = static_cast<std::size_t>(at); i + 1 < usable_.size(); ++i) {
      if (others.size() == before + neighbours) break;
      others.push_back(step(usable_[i], usable_[i + 1]));
    }
    const std::size_t after = others.size() - before;
    if (others.size() < 2) return StepFault::none;
    if (moves_like(tested, others, before < 2 || after < 2)) {
      return turns_like(tested, others) ? StepFault::none : StepFault::rotation;
    }
    return StepFault::position;
  }

  bool moves_like(const Step& tested, const std::vector<Step>& others, bool is_at_end) const {
    const Range range = range_of(others, &Step::move);
    const Vector excess = range.excess(tested.move, tested);
    const double length = range.largest() * tested.free;
    const Vector centre = range.centre();
    const double along =
        norm(centre) > 0 ? std::abs(dot(excess, centre)) / norm(centre) : norm(excess);
    const double across = std::sqrt(std::max(0.0, dot(excess, excess) - along * along));
    const double physical = has_times_ ? 2 * max_acceleration * tested.free * tested.free : length;
    constexpr double noise = 0.3;  // metres: errors of odometry and of interpolated poses
    const double least = noise + 2 * range.spread * tested.free;
    // With steps on one side only, a vehicle that brakes or starts looks like a jump.
    const double allowance = is_at_end ? 2 : 1;
    return along <= least + allowance * std::min(0.5 * length, physical) &&
           across <= least + allowance * std::min(0.2 * length, physical);
  }

  bool turns_like(const Step& tested, const std::vector<Step>& others) const {
    const Range range = range_of(others, &Step::turn);
    const Vector excess = range.excess(tested.turn, tested);
    const double time = seconds(tested, range_of(others, &Step::move).largest() * tested.free);
    constexpr double bumps = 5;  // degrees: also the gait of walking robots
    const double least = bumps + 2 * range.spread * tested.free;
    const double yaw = least + std::min(60.0, 60 * time * time);
    const double pitch_and_roll = least + std::min(10.0, 10 * time);
    return std::abs(excess[2]) <= yaw && std::hypot(excess[0], excess[1]) <= pitch_and_roll;
  }

  void accept(std::size_t scan, const Step* from_previous) {
    if (from_previous != nullptr) {
      accepted_.push_back(*from_previous);
      if (accepted_.size() > neighbours) accepted_.pop_front();
    }
    result_.scans[scan] = {.usable = true, .part = part_};
  }

  void split() {
    constexpr std::size_t most_skipped = 3;
    accept(usable_.front(), nullptr);
    for (std::size_t i = 0; i + 1 < usable_.size();) {
      const std::size_t from = usable_[i];
      const Step direct = step(from, usable_[i + 1]);
      const StepFault fault = fault_of(direct, usable_[i + 1]);
      std::size_t next = i + 1;
      if (fault == StepFault::none) {
        accept(usable_[next], &direct);
      } else if (const std::size_t skipped = fitting_after(i, most_skipped); skipped > 0) {
        for (std::size_t k = i + 1; k <= i + skipped; ++k) report_outlier(from, usable_[k], fault);
        next = i + skipped + 1;
        const Step wide = step(from, usable_[next]);
        accept(usable_[next], &wide);
      } else {
        report_jump(from, usable_[next], direct, fault);
        ++part_;
        accepted_.clear();
        accept(usable_[next], nullptr);
      }
      i = next;
    }
  }

  /// The number of poses after `i` to skip until one fits; 0 if none of the next ones does.
  std::size_t fitting_after(std::size_t i, std::size_t most) const {
    for (std::size_t skipped = 1; skipped <= most && i + skipped + 1 < usable_.size(); ++skipped) {
      const std::size_t to = usable_[i + skipped + 1];
      Step over = step(usable_[i], to);
      over.free /= static_cast<double>(skipped + 1);
      // The path must also jump back to where it was.
      if (fault_of(over, to) == StepFault::none &&
          fault_of(step(usable_[i + skipped], to), to) != StepFault::none) {
        return skipped;
      }
    }
    return 0;
  }

  void report_outlier(std::size_t from, std::size_t scan, StepFault fault) {
    const bool is_position = fault == StepFault::position;
    report_scan(
        is_position ? PoseProblemKind::position : PoseProblemKind::rotation, scan,
        fmt::format("the {} does not fit the scans before and after ({}; segmented alone)",
                    is_position ? "position" : "rotation", described(step(from, scan), fault)));
  }

  std::string described(const Step& of, StepFault fault) const {
    if (fault == StepFault::rotation) return fmt::format("it turns {:.1f} degrees", norm(of.turn));
    if (!has_times_) return fmt::format("it moves {:.2f} m", norm(of.move));
    return fmt::format("it moves {:.2f} m in {:.2f} s", norm(of.move), of.duration);
  }

  void report_jump(std::size_t from, std::size_t to, const Step& of, StepFault fault) {
    const bool is_position = fault == StepFault::position;
    report(is_position ? PoseProblemKind::position : PoseProblemKind::rotation, from, to,
           fmt::format("the {} jumps ({}; the scans before and after are mapped separately)",
                       is_position ? "position" : "rotation", described(of, fault)));
  }

  /// The direction of motion shows whether the poses have the axes of the sensor.
  void check_axes() {
    if (const double angle = angle_between(median_up_, {0, 0, 1}); angle > max_tilt) {
      reject_all(PoseProblemKind::world_frame,
                 fmt::format("the z axis of the sensor is {:.0f} degrees from that of the world "
                             "frame (expected both up; {})",
                             angle, axes_hint()));
      return;
    }
    std::vector<double> from_sensor_plane;
    std::vector<double> from_world_plane;
    constexpr double baseline = 1;  // metres, so that small errors of positions do not matter
    std::size_t j = 0;
    for (std::size_t i = 0; i < usable_.size(); ++i) {
      j = std::max(j, i + 1);
      while (j < usable_.size() && is_same_part(i, j) && distance(i, j) < baseline) ++j;
      if (j == usable_.size()) break;
      if (!is_same_part(i, j)) continue;
      const Vector moved = difference(pose(usable_[j]).position, pose(usable_[i]).position);
      from_sensor_plane.push_back(90 - angle_to_line(up_of(pose(usable_[i])), moved));
      from_world_plane.push_back(90 - angle_to_line({0, 0, 1}, moved));
    }
    constexpr std::size_t least = 3;
    constexpr double max_angle = 30;
    if (from_sensor_plane.size() < least) return;
    if (const double angle = median(from_sensor_plane); angle > max_angle) {
      reject_all(PoseProblemKind::calibration,
                 fmt::format("the path leaves the x-y plane of the sensor by {:.0f} degrees "
                             "(expected poses of the sensor with z up; {})",
                             angle, axes_hint()));
    } else if (const double slope = median(from_world_plane); slope > max_angle) {
      reject_all(PoseProblemKind::world_frame,
                 fmt::format("the path climbs by {:.0f} degrees (expected a world frame with z up; "
                             "{})",
                             slope, axes_hint()));
    }
  }

  bool is_same_part(std::size_t i, std::size_t j) const {
    return result_.scans[usable_[i]].part == result_.scans[usable_[j]].part;
  }
  double distance(std::size_t i, std::size_t j) const {
    return norm(difference(pose(usable_[j]).position, pose(usable_[i]).position));
  }
  static double angle_to_line(const Vector& a, const Vector& line) {
    const double angle = angle_between(a, line);
    return std::min(angle, 180 - angle);
  }

  void finish() {
    result_.parts = 0;
    for (PoseUse& use : result_.scans) {
      if (is_rejected_) use = {};
      if (use.usable) result_.parts = part_ + 1;
    }
    std::ranges::sort(result_.problems, {}, [](const PoseProblem& problem) {
      return std::pair(problem.first, problem.kind);
    });
  }

  static constexpr std::size_t neighbours = 4;

  std::span<const std::optional<Pose>> poses_;
  std::vector<Pose> values_;  // of poses_; the identity if missing
  std::span<const double> times_;
  bool from_camera_;
  bool has_times_ = false;
  bool is_rejected_ = false;
  std::vector<std::size_t> usable_;
  Vector median_up_{0, 0, 1};
  std::deque<Step> accepted_;  // the last steps of this part
  std::size_t part_ = 0;
  PoseChecks result_;
};

}  // namespace

std::string to_line(const PoseProblem& problem, std::span<const std::string> scan_names) {
  if (problem.first == problem.last) {
    return fmt::format("scan {}: {}", scan_names[problem.first], problem.message);
  }
  return fmt::format("scans {} to {}: {}", scan_names[problem.first], scan_names[problem.last],
                     problem.message);
}

PoseChecks check_poses(std::span<const std::optional<Pose>> poses, std::span<const double> times,
                       bool from_camera) {
  return RunCheck(poses, times, from_camera).check();
}

namespace {

// True if a levelling differs little from the median of others.
bool is_like(const Levelling& levelling, const std::deque<Levelling>& others) {
  constexpr double max_offset = 0.3;  // metres
  constexpr double max_slope = 0.07;  // m/m
  const auto usual = [&](double Levelling::* quantity) {
    std::vector<double> values;
    values.reserve(others.size());
    for (const Levelling& each : others) values.push_back(each.*quantity);
    return values.empty() ? 0 : median(values);
  };
  const double offset = levelling.offset - usual(&Levelling::offset);
  const double slope = std::hypot(levelling.slope_x - usual(&Levelling::slope_x),
                                  levelling.slope_y - usual(&Levelling::slope_y));
  return std::abs(offset) <= max_offset && slope <= max_slope;
}

}  // namespace

bool LevellingJudge::fits(const Levelling& levelling) {
  constexpr std::size_t min_cells = 100;
  constexpr std::size_t window = 10;
  if (levelling.cells < min_cells) return true;
  if (levelling.applied && is_like(levelling, state_.fitting)) {
    state_.misfits.clear();
    state_.fitting.push_back(levelling);
    if (state_.fitting.size() > window) state_.fitting.pop_front();
    return true;
  }
  const bool continues = levelling.applied && is_like(levelling, state_.misfits);
  if (!continues) state_.misfits.clear();
  if (levelling.applied) state_.misfits.push_back(levelling);
  if (state_.misfits.size() < window) return false;
  state_.fitting = std::exchange(state_.misfits, {});
  return true;
}

}  // namespace flagstone::app
