// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/surface.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/pose_noise.hpp"

namespace flagstone {
namespace {

Pose pose_of(const sim::Frame& frame) {
  const auto& [o, f, l, u] = frame;
  return {.rotation = {f.x, l.x, u.x, f.y, l.y, u.y, f.z, l.z, u.z}, .position = {o.x, o.y, o.z}};
}

// A run through parked cars, segmented, with poses that an odometry measured.
class SimulatedRun {
 public:
  explicit SimulatedRun(const char* pose_noise) {
    const Sensor& sensor = Sensor::named("hdl-32e");
    const sim::Drive drive(*sim::find_scene_kind("parked_cars"), sensor, {.height = sensor.height},
                           2, {.rate = 3});
    const sim::Scene scene = drive.scene();
    Surface segmenter({.sensor_height = static_cast<float>(sensor.height)});
    results.resize(drive.poses().size());
    levellings.resize(results.size());
    for (const sim::Frame& frame :
         measured_poses(drive.poses(), *sim::find_pose_noise(pose_noise), 1)) {
      poses.push_back(pose_of(frame));
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
      scans.push_back(drive.scan(scene, sim::Noise{}, static_cast<int>(i)));
      ground.push_back(drive.ground_of(scans[i], static_cast<int>(i)));
      EXPECT_TRUE(segmenter.segment(view(i), results[i]).ok());
      EXPECT_TRUE(map.add(view(i), results[i], poses[i], levellings[i]).ok());
      EXPECT_TRUE(vote.add(view(i), results[i], poses[i], levellings[i]).ok());
    }
  }

  [[nodiscard]] CloudView view(std::size_t i) const {
    return {scans[i].xyzi.data(), scans[i].size(), 4};
  }

  std::vector<sim::SimulatedScan> scans;
  std::vector<std::vector<float>> ground;
  std::vector<Segmentation> results;
  std::vector<Pose> poses;
  std::vector<Levelling> levellings;
  GroundMap map;
  LabelVote vote;
};

// Wrong labels of a scan.
std::size_t errors(const sim::SimulatedScan& scan, std::span<const Label> labels) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    wrong += sim::is_ground(static_cast<sim::SemanticClass>(scan.classes[i])) !=
             (labels[i] == Label::ground);
  }
  return wrong;
}

TEST(SimulatedRun, TheVoteCorrectsLabels) {
  const SimulatedRun run("jitter");
  std::size_t own = 0;
  std::size_t voted = 0;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    std::vector<Label> labels(run.scans[i].size());
    ASSERT_TRUE(
        run.vote.relabel(run.view(i), run.results[i], run.poses[i], run.levellings[i], labels)
            .ok());
    own += errors(run.scans[i], run.results[i].labels());
    voted += errors(run.scans[i], labels);
  }

  EXPECT_LT(static_cast<double>(voted), 0.95 * static_cast<double>(own));
}

TEST(SimulatedRun, TheMapIsMoreAccurateThanTheScansBeyond20Metres) {
  SimulatedRun run("jitter");
  std::vector<double> of_scan;
  std::vector<double> of_map;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    Levelling levelling;
    ASSERT_TRUE(run.map.level(run.view(i), run.results[i], run.poses[i], levelling).ok());
    const auto& r = run.poses[i].rotation;
    const auto& p = run.poses[i].position;
    for (std::size_t k = 0; k < run.scans[i].size(); k += 5) {
      const float x = run.scans[i].xyzi[4 * k];
      const float y = run.scans[i].xyzi[4 * k + 1];
      const double truth = double{run.ground[i][k]};
      if (!sim::is_ground(static_cast<sim::SemanticClass>(run.scans[i].classes[k]))) continue;
      if (std::hypot(x, y) < 20) continue;
      const double world_x = p[0] + r[0] * double{x} + r[1] * double{y} + r[2] * truth;
      const double world_y = p[1] + r[3] * double{x} + r[4] * double{y} + r[5] * truth;
      const double world_z = p[2] + r[6] * double{x} + r[7] * double{y} + r[8] * truth;
      const double error =
          run.map.height(world_x, world_y) + levelling.at(world_x, world_y, p) - world_z;
      const double own = double{run.results[i].surface().height(x, y)} - truth;
      if (std::isnan(error) || std::isnan(own)) continue;
      of_map.push_back(std::abs(error));
      of_scan.push_back(std::abs(own));
    }
  }
  ASSERT_GT(of_map.size(), 1000U);
  const auto quantile = [](std::vector<double>& errors, double share) {
    const auto at = errors.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(errors.size() - 1));
    std::ranges::nth_element(errors, at);
    return *at;
  };

  EXPECT_LT(quantile(of_map, 0.5), quantile(of_scan, 0.5));
  EXPECT_LT(quantile(of_map, 0.95), quantile(of_scan, 0.95));
}

}  // namespace
}  // namespace flagstone
