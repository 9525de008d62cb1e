// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures the cost of mapping a run live, per scan and step, in addition to the segmentation: CPU
// time of one thread. Prints one JSON object with medians over the scans, milliseconds.
//
//   live_map RUN POSES SENSOR_HEIGHT

#include <time.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <flagstone/ground_map.hpp>
#include <flagstone/label_vote.hpp>
#include <flagstone/moving_points.hpp>
#include <flagstone/surface.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/mapping/run_mapper.hpp"
#include "app/run_poses.hpp"
#include "app/scan_files.hpp"
#include "files/io/read_cloud.hpp"
#include "library/moving_points/moving_labels.hpp"
#include "timing.hpp"

namespace flagstone::performance {
namespace {

/// CPU time of this thread, milliseconds.
double cpu_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void throw_unless_ok(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

struct Step {
  std::string_view name;
  std::vector<double> times{};  // milliseconds, per scan

  template <class Work>
  void time(const Work& work) {
    const double start = cpu_time();
    throw_unless_ok(work());
    times.push_back(cpu_time() - start);
  }
};

/// The steps that RunMapper takes with live labels.
class Steps {
 public:
  void add(app::RunScan& scan) {
    const CloudView cloud = scan.level.cloud();
    const Pose& pose = scan.level.pose();
    scan.labels.resize(cloud.size());
    const double start = cpu_time();
    level_.time([&] { return map_.level(cloud, scan.result, pose, scan.levelling); });
    moving_points_.time([&] {
      return moving_.add(cloud, scan.result, pose, scan.levelling, scan.time, scan.moving);
    });
    add_.time([&] { return map_.add_levelled(); });
    labels_.time([&] {
      label_moving_points(scan.moving, Label::out_of_range, scan.result.mutable_labels());
      return vote_.add(cloud, scan.result, pose, scan.levelling, scan.labels);
    });
    above_map_.time([&] {
      label_moving_points(scan.moving, Label::nonground, scan.result.mutable_labels());
      label_moving_points(scan.moving, Label::nonground, scan.labels);
      return map_.relabel(cloud, scan.result, pose, scan.levelling, scan.labels);
    });
    mapping_.times.push_back(cpu_time() - start);
  }

  [[nodiscard]] std::array<const Step*, 6> all() const {
    return {&mapping_, &level_, &moving_points_, &add_, &labels_, &above_map_};
  }

 private:
  GroundMap map_;
  LabelVote vote_;
  MovingPoints moving_{{.delay = 0}};
  Step mapping_{"mapping"};
  Step level_{"level"};
  Step moving_points_{"moving_points"};
  Step add_{"add_to_map"};
  Step labels_{"vote"};
  Step above_map_{"compare_with_map"};
};

void run(const std::string& directory, const std::string& pose_file, float sensor_height) {
  const auto inputs = app::find_scans({directory + "/velodyne"});
  const app::RunPoses poses = app::read_run_poses(directory, inputs, pose_file);
  const std::vector<double> times = poses.times();
  SurfaceConfig config;
  config.sensor_height = sensor_height;
  Surface surface(config);
  Steps steps;
  Step segmentation{"segmentation"};
  app::RunScan scan;  // its memory is used again
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    scan.time = times.at(i);
    throw_unless_ok(io::read_cloud(inputs[i].file, {}, scan.cloud));
    segmentation.time([&] { return surface.segment(scan.cloud.view(), scan.result); });
    scan.level.set(scan.cloud.view(), {}, poses.scans[i].pose.value());
    steps.add(scan);
  }
  nlohmann::ordered_json medians;
  medians["scans"] = inputs.size();
  const auto add = [&](const Step& step) { medians[step.name] = quantile(step.times, 0.5); };
  add(segmentation);
  for (const Step* const step : steps.all()) add(*step);
  std::printf("%s\n", medians.dump().c_str());
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: live_map RUN POSES SENSOR_HEIGHT\n", stderr);
    return 2;
  }
  try {
    flagstone::performance::run(argv[1], argv[2], std::strtof(argv[3], nullptr));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "live_map: %s\n", error.what());
    return 1;
  }
  return 0;
}
