// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/run_poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/text.hpp"
#include "library/core/rotation.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view alone = "segmented alone";

std::string text_of(std::size_t count, std::string_view unit) {
  return fmt::format("{} {}{}", count, unit, count == 1 ? "" : "s");
}

/// The numbers that the names of all scans are; empty if a name is not a number below `end`.
std::vector<std::size_t> numbers_of(std::span<const ScanInput> scans, std::size_t end) {
  std::vector<std::size_t> numbers;
  for (const ScanInput& scan : scans) {
    const std::string name = scan.output_stem.filename().string();
    const auto number = io::whole_number<std::size_t>(name);
    if (!number || *number >= end) return {};
    if (!numbers.empty() && *number <= numbers.back()) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

/// For each scan, the index of its line in a file of `lines` lines; an index of at least `lines`
/// means that it has none.
std::vector<std::size_t> lines_of(std::span<const ScanInput> scans, std::size_t lines,
                                  bool& by_number) {
  by_number = false;
  if (lines != scans.size()) {
    std::vector<std::size_t> numbers = numbers_of(scans, std::max(lines, scans.size()));
    by_number = !numbers.empty();
    if (by_number) return numbers;
  }
  std::vector<std::size_t> in_order(scans.size());
  for (std::size_t i = 0; i < in_order.size(); ++i) in_order[i] = i;
  return in_order;
}

std::string reason_of(const io::PoseLine& line) {
  return fmt::format("the pose of line {} {}", line.number, io::to_text(line.fault));
}

void pair_by_order(const io::PoseFile& poses, std::span<const ScanInput> scans, RunPoses& out) {
  bool by_number = false;
  const std::vector<std::size_t> lines = lines_of(scans, poses.poses.size(), by_number);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (lines[i] >= poses.poses.size()) {
      out.scans[i].reason =
          fmt::format("the file contains only {}", text_of(poses.poses.size(), "pose"));
      continue;
    }
    const io::PoseLine& line = poses.poses[lines[i]];
    out.scans[i].pose = line.pose;
    if (!line.pose) out.scans[i].reason = reason_of(line);
  }
  const std::string counts = fmt::format("contains {} for {}", text_of(poses.poses.size(), "pose"),
                                         text_of(scans.size(), "scan"));
  if (by_number) {
    out.notes.push_back(counts + " (scans are paired with poses by the numbers in their names)");
  } else if (poses.poses.size() > scans.size()) {
    out.notes.push_back(counts + " (the last poses are not used)");
  } else if (poses.poses.size() < scans.size()) {
    out.notes.push_back(counts + fmt::format(" (the last scans are {})", alone));
  }
}

/// Poses in the order of their times.
class TimedPoses {
 public:
  explicit TimedPoses(const io::PoseFile& file) {
    for (const io::PoseLine& line : file.poses) {
      if (!line.time) continue;
      (line.pose ? good_ : bad_).push_back(&line);
    }
    for (auto* lines : {&good_, &bad_}) {
      was_sorted_ = std::ranges::is_sorted(*lines, {}, time) && was_sorted_;
      std::ranges::sort(
          *lines, {}, [](const io::PoseLine* line) { return std::pair(time(line), line->number); });
    }
  }

  [[nodiscard]] bool was_sorted() const noexcept { return was_sorted_; }
  [[nodiscard]] bool empty() const noexcept { return good_.empty(); }
  [[nodiscard]] double first() const noexcept { return time(good_.front()); }
  [[nodiscard]] double last() const noexcept { return time(good_.back()); }

  void find(double when, ScanPose& out) const {
    const auto after = std::ranges::lower_bound(good_, when, {}, time);
    const io::PoseLine* const next = after == good_.end() ? nullptr : *after;
    const io::PoseLine* const previous = after == good_.begin() ? nullptr : *std::prev(after);
    const bool next_is_nearer =
        next != nullptr && (previous == nullptr || time(next) - when <= when - time(previous));
    const io::PoseLine* const nearest = next_is_nearer ? next : previous;
    if (nearest != nullptr && std::abs(time(nearest) - when) <= same_time) {
      out.pose = nearest->pose;
    } else if (next != nullptr && previous != nullptr &&
               time(next) - time(previous) <= max_pose_gap) {
      const double fraction = (when - time(previous)) / (time(next) - time(previous));
      out.pose = interpolated(pose(previous), pose(next), fraction);
    } else {
      out.reason = reason(when, previous, next);
    }
  }

 private:
  static double time(const io::PoseLine* line) noexcept { return line->time.value_or(0); }

  static Pose pose(const io::PoseLine* line) { return line->pose.value_or(Pose{}); }

  static Pose interpolated(const Pose& from, const Pose& to, double fraction) {
    Pose pose{.rotation = matrix_of(
                  between(quaternion_of(from.rotation), quaternion_of(to.rotation), fraction))};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      pose.position[axis] = (1 - fraction) * from.position[axis] + fraction * to.position[axis];
    }
    return pose;
  }

  [[nodiscard]] std::string reason(double when, const io::PoseLine* previous,
                                   const io::PoseLine* next) const {
    const auto bad = std::ranges::lower_bound(bad_, when - max_pose_gap / 2, {}, time);
    if (bad != bad_.end() && time(*bad) <= when + max_pose_gap / 2) return reason_of(**bad);
    if (previous == nullptr) return "its time is before the first pose";
    if (next == nullptr) return "its time is after the last pose";
    return fmt::format("the poses before and after it are {:.2f} s apart (expected at most {} s)",
                       time(next) - time(previous), max_pose_gap);
  }

  std::vector<const io::PoseLine*> good_;
  std::vector<const io::PoseLine*> bad_;
  bool was_sorted_ = true;
};

void pair_by_time(const io::PoseFile& file, RunPoses& out) {
  const TimedPoses poses(file);
  if (!poses.was_sorted()) {
    out.notes.emplace_back("the poses are not in the order of their times (they were sorted)");
  }
  if (poses.empty()) {
    for (ScanPose& scan : out.scans) scan.reason = "the file contains no valid pose";
    return;
  }
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (ScanPose& scan : out.scans) {
    if (!scan.time) {
      scan.reason = "its time is unknown";
      continue;
    }
    first = std::min(first, *scan.time);
    last = std::max(last, *scan.time);
    poses.find(*scan.time, scan);
  }
  if (first > poses.last() + same_time || last < poses.first() - same_time) {
    out.notes.push_back(fmt::format(
        "the times of the poses, {:.3f} to {:.3f} s, do not match the times of the scans, {:.3f} "
        "to {:.3f} "
        "s (expected times of the same clock; remove the times of the run to pair by order)",
        poses.first(), poses.last(), first, last));
  }
}

void set_times(std::span<const ScanInput> scans, std::span<const double> times, RunPoses& out) {
  if (times.empty()) return;
  bool by_number = false;
  const std::vector<std::size_t> lines = lines_of(scans, times.size(), by_number);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (lines[i] < times.size() && std::isfinite(times[lines[i]])) {
      out.scans[i].time = times[lines[i]];
    }
  }
  if (times.size() != scans.size()) {
    out.notes.push_back(
        fmt::format("the run contains {} for {} ({})", text_of(times.size(), "time"),
                    text_of(scans.size(), "scan"),
                    by_number ? "scans are paired with times by the numbers in their names"
                              : "expected one "
                                "per scan"));
  }
}

void note_missing(RunPoses& out) {
  const auto missing = static_cast<std::size_t>(
      std::ranges::count_if(out.scans, [](const ScanPose& scan) { return !scan.pose; }));
  if (missing == 0) return;
  const auto first =
      std::ranges::find_if(out.scans, [](const ScanPose& scan) { return !scan.pose; });
  out.notes.push_back(
      fmt::format("{} without a pose: {} ({})", text_of(missing, "scan"), first->reason, alone));
}

/// The first of the files that exists; empty if none does.
fs::path first_existing(std::span<const fs::path> files) {
  std::error_code ignored;
  for (const fs::path& file : files) {
    if (fs::exists(file, ignored)) return file;
  }
  return {};
}

/// The directory itself and, for the directory of the scans alone, the one above.
std::vector<fs::path> folders_of(const fs::path& run) {
  std::error_code ignored;
  fs::path folder = fs::is_directory(run, ignored) ? run : run.parent_path();
  if (!folder.has_filename()) folder = folder.parent_path();
  std::vector<fs::path> folders = {folder};
  const std::string name = folder.filename().string();
  if (name.starts_with("velodyne")) folders.push_back(folder.parent_path());
  return folders;
}

void throw_unless_ok(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

}  // namespace

std::vector<double> RunPoses::times() const {
  std::vector<double> times;
  bool any = false;
  for (const ScanPose& scan : scans) {
    any = any || scan.time.has_value();
    times.push_back(scan.time.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (!any) times.clear();
  return times;
}

RunPoses pair_poses(const io::PoseFile& poses, std::span<const ScanInput> scans,
                    std::span<const double> scan_times) {
  RunPoses out;
  out.format = poses.format;
  out.scans.resize(scans.size());
  set_times(scans, scan_times, out);
  const bool scans_have_times =
      std::ranges::any_of(out.scans, [](const ScanPose& scan) { return scan.time.has_value(); });
  if (poses.has_times && scans_have_times) {
    pair_by_time(poses, out);
  } else {
    pair_by_order(poses, scans, out);
    // Each pose has the time of its scan.
    if (poses.has_times && poses.poses.size() == scans.size()) {
      for (std::size_t i = 0; i < scans.size(); ++i) out.scans[i].time = poses.poses[i].time;
    }
  }
  note_missing(out);
  return out;
}

RunPoses read_run_poses(const fs::path& run, std::span<const ScanInput> scans,
                        const fs::path& poses) {
  io::PoseFile file;
  throw_unless_ok(io::read_poses(poses, file));
  std::vector<fs::path> calibrations = {poses.parent_path() / "calib.txt"};
  std::vector<fs::path> time_files;
  for (const fs::path& folder : folders_of(run)) {
    calibrations.push_back(folder / "calib.txt");
    time_files.push_back(folder / "times.txt");
    time_files.push_back(folder / "timestamps.txt");
  }
  fs::path calibration;
  if (file.format == io::PoseFormat::kitti) {
    calibration = first_existing(calibrations);
    if (!calibration.empty()) {
      Pose sensor_to_camera;
      throw_unless_ok(io::read_sensor_to_camera(calibration, sensor_to_camera));
      io::convert_from_camera(sensor_to_camera, file.poses);
    }
  }
  std::vector<double> times;
  if (const fs::path found = first_existing(time_files); !found.empty()) {
    throw_unless_ok(io::read_times(found, times));
  }
  RunPoses out = pair_poses(file, scans, times);
  out.calibration = calibration;
  for (std::string& note : out.notes) note = fmt::format("{}: {}", io::printable(poses), note);
  return out;
}

}  // namespace flagstone::app
