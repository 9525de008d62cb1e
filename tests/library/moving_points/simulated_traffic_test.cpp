// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "flagstone/moving_points.hpp"
#include "flagstone/surface.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/pose_noise.hpp"

namespace flagstone {
namespace {

Pose pose_of(const sim::Frame& frame) {
  const auto& [o, f, l, u] = frame;
  return {.rotation = {f.x, l.x, u.x, f.y, l.y, u.y, f.z, l.z, u.z}, .position = {o.x, o.y, o.z}};
}

/// Counts of points that are not ground.
struct Score {
  double found = 0, missed = 0, false_alarms = 0, kept = 0;

  [[nodiscard]] double iou() const { return found / (found + missed + false_alarms); }
  [[nodiscard]] double fraction_kept() const { return kept / (kept + false_alarms); }

  void add(const sim::SimulatedScan& scan, const MovingMask& mask) {
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (scan.motions[i] == sim::Motion::later) continue;
      if (sim::is_ground(static_cast<sim::SemanticClass>(scan.classes[i]))) continue;
      const bool moves = scan.motions[i] == sim::Motion::now;
      const bool marked = mask.objects_of_points[i] != 0;
      ++(marked ? (moves ? found : false_alarms) : (moves ? missed : kept));
    }
  }
};

TEST(SimulatedTraffic, MostMovingPointsAreFoundDespiteErrorsOfThePoses) {
  const Sensor& sensor = Sensor::named("hdl-32e");
  const sim::Drive drive(*sim::find_scene_kind("crossroads"), sensor, {.height = sensor.height}, 3,
                         {.rate = 4});
  const sim::Scene scene = drive.scene();
  Surface segmenter({.sensor_height = static_cast<float>(sensor.height)});
  const std::vector<sim::Frame> measured =
      measured_poses(drive.poses(), *sim::find_pose_noise("jitter"), 1);
  const std::size_t count = measured.size();
  std::vector<sim::SimulatedScan> scans;
  std::vector<Segmentation> results(count);
  std::vector<Levelling> levellings(count);
  GroundMap map;
  MovingPoints moving({.delay = 10});
  MovingMask mask;
  Score live;
  for (std::size_t k = 0; k < count; ++k) {
    scans.push_back(drive.scan(scene, sim::Noise{}, static_cast<int>(k)));
    const CloudView cloud(scans[k].xyzi.data(), scans[k].size(), 4);
    const Pose pose = pose_of(measured[k]);
    const double time = static_cast<double>(k) / 4;
    ASSERT_TRUE(segmenter.segment(cloud, results[k]).ok());
    ASSERT_TRUE(map.add(cloud, results[k], pose, levellings[k]).ok());
    ASSERT_TRUE(moving.add(cloud, results[k], pose, levellings[k], time, mask).ok());
    if (time >= 2) live.add(scans[k], mask);
  }
  Score offline;
  for (std::size_t k = 0; k < count; ++k) {
    const CloudView cloud(scans[k].xyzi.data(), scans[k].size(), 4);
    const double time = static_cast<double>(k) / 4;
    ASSERT_TRUE(
        moving.find(cloud, results[k], pose_of(measured[k]), levellings[k], time, mask).ok());
    offline.add(scans[k], mask);
  }
  EXPECT_GT(live.iou(), 0.75);
  EXPECT_GT(offline.iou(), 0.85);
  EXPECT_GT(offline.fraction_kept(), 0.99);
}

}  // namespace
}  // namespace flagstone
