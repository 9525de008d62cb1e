// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/pose_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/run_poses.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/pose_noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/rotation.hpp"
#include "real_scans.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using Kind = PoseProblemKind;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

/// Poses of a run, and the times of its scans.
struct Path {
  std::vector<std::optional<Pose>> poses;
  std::vector<double> times;

  [[nodiscard]] PoseChecks checked() const { return check_poses(poses, times); }
};

RotationMatrix turn_about(std::size_t axis, double angle_degrees) {
  const double half = angle_degrees * std::numbers::pi / 360;
  Quaternion q{.w = std::cos(half)};
  (axis == 0 ? q.x : axis == 1 ? q.y : q.z) = std::sin(half);
  return matrix_of(q);
}

/// A vehicle at 10 m/s, measured ten times per second, in a curve with a radius of 50 m, with small
/// errors and times that vary.
Path curve(std::size_t count = 60) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0, 1);
  Path path;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = 0.1 * static_cast<double>(i) + 0.003 * error(random);
    const double yaw = time * 10 / 50;
    Pose pose;
    pose.rotation =
        product(turn_about(2, yaw * 180 / std::numbers::pi),
                product(turn_about(1, 0.5 * error(random)), turn_about(0, 0.5 * error(random))));
    pose.position = {50 * std::sin(yaw) + 0.02 * error(random),
                     50 - 50 * std::cos(yaw) + 0.02 * error(random), 0.02 * error(random)};
    path.poses.emplace_back(pose);
    path.times.push_back(time);
  }
  return path;
}

void move_from(Path& path, std::size_t first, std::size_t end, double dx, double dy) {
  for (std::size_t i = first; i < end; ++i) {
    path.poses[i]->position[0] += dx;
    path.poses[i]->position[1] += dy;
  }
}

void turn_from(Path& path, std::size_t first, std::size_t end, std::size_t axis, double angle) {
  for (std::size_t i = first; i < end; ++i) {
    auto& rotation = path.poses[i]->rotation;
    rotation = product(rotation, turn_about(axis, angle));
  }
}

auto is_problem(Kind kind, std::size_t first, std::size_t last) {
  return AllOf(Field("kind", &PoseProblem::kind, kind), Field("first", &PoseProblem::first, first),
               Field("last", &PoseProblem::last, last));
}

/// Indices of the scans that cannot be used.
std::vector<std::size_t> unusable(const PoseChecks& checks) {
  std::vector<std::size_t> scans;
  for (std::size_t i = 0; i < checks.scans.size(); ++i) {
    if (!checks.scans[i].usable) scans.push_back(i);
  }
  return scans;
}

/// With and without times.
std::vector<Path> with_and_without_times(const Path& path) {
  return {path, Path{.poses = path.poses, .times = {}}};
}

TEST(PoseChecks, FindNothingInAGoodRun) {
  for (const Path& path : with_and_without_times(curve())) {
    const PoseChecks checks = path.checked();

    EXPECT_THAT(checks.problems, IsEmpty());
    EXPECT_THAT(unusable(checks), IsEmpty());
    EXPECT_EQ(checks.parts, 1U);
  }
}

TEST(PoseChecks, AcceptNoPosesAndOnePose) {
  EXPECT_EQ(check_poses({}, {}).parts, 0U);
  EXPECT_EQ(curve(1).checked().parts, 1U);
  EXPECT_EQ(curve(2).checked().parts, 1U);
  EXPECT_EQ(check_poses(std::vector<std::optional<Pose>>(3), {}).parts, 0U);
}

TEST(PoseChecks, AJumpSplitsTheRun) {
  for (const auto& [dx, dy] : {std::pair{5.0, 0.0}, {0.0, 5.0}, {-5.0, 0.0}, {1.0, 1.0}}) {
    for (const std::size_t at :
         {std::size_t{1}, std::size_t{3}, std::size_t{30}, std::size_t{59}}) {
      SCOPED_TRACE(testing::Message() << dx << ", " << dy << " at " << at);
      Path jumping = curve();
      move_from(jumping, at, 60, dx, dy);

      const PoseChecks checks = jumping.checked();

      EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::position, at - 1, at)));
      EXPECT_THAT(unusable(checks), IsEmpty());
      EXPECT_EQ(checks.parts, 2U);
      EXPECT_EQ(checks.scans[at - 1].part, 0U);
      EXPECT_EQ(checks.scans[at].part, 1U);
      EXPECT_EQ(checks.scans[59].part, 1U);
    }
  }
}

TEST(PoseChecks, AJumpIsFoundWithoutTimes) {
  Path jumping = curve();
  jumping.times.clear();
  move_from(jumping, 30, 60, 0, 5);

  EXPECT_THAT(jumping.checked().problems, ElementsAre(is_problem(Kind::position, 29, 30)));
}

TEST(PoseChecks, AJumpIsFoundAtOneScanPerSecond) {
  Path jumping = curve();
  for (std::size_t i = 0; i < jumping.times.size(); ++i) {
    jumping.times[i] = static_cast<double>(i);  // 1 m/s
  }
  move_from(jumping, 30, 60, 0, 5);

  EXPECT_THAT(jumping.checked().problems, ElementsAre(is_problem(Kind::position, 29, 30)));
}

TEST(PoseChecks, ThreeJumpsMakeFourParts) {
  Path jumping = curve();
  for (const std::size_t at : {std::size_t{15}, std::size_t{25}, std::size_t{40}}) {
    move_from(jumping, at, 60, 20, 0);
  }

  const PoseChecks checks = jumping.checked();

  EXPECT_EQ(checks.problems.size(), 3U);
  EXPECT_EQ(checks.parts, 4U);
  EXPECT_EQ(checks.scans[59].part, 3U);
}

TEST(PoseChecks, AWrongPositionAffectsItsScansAlone) {
  for (const std::size_t length : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    for (const Path& good : with_and_without_times(curve())) {
      Path wrong = good;
      move_from(wrong, 20, 20 + length, 4, 3);

      const PoseChecks checks = wrong.checked();

      EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::position, 20, 19 + length)));
      EXPECT_EQ(unusable(checks).size(), length);
      EXPECT_EQ(checks.parts, 1U);
    }
  }
}

TEST(PoseChecks, AWrongRotationAffectsItsScanAlone) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    for (const Path& good : with_and_without_times(curve())) {
      SCOPED_TRACE(axis);
      Path wrong = good;
      turn_from(wrong, 20, 21, axis, 10);

      const PoseChecks checks = wrong.checked();

      EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::rotation, 20, 20)));
      EXPECT_THAT(unusable(checks), ElementsAre(20));
      EXPECT_EQ(checks.parts, 1U);
    }
  }
}

TEST(PoseChecks, ARotationFromOneScanOnSplitsTheRun) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    SCOPED_TRACE(axis);
    Path wrong = curve();
    turn_from(wrong, 20, 60, axis, 10);

    const PoseChecks checks = wrong.checked();

    EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::rotation, 19, 20)));
    EXPECT_THAT(unusable(checks), IsEmpty());
    EXPECT_EQ(checks.parts, 2U);
  }
}

TEST(PoseChecks, InvalidPosesAffectTheirScansAlone) {
  Path wrong = curve();
  wrong.poses[7]->position[1] = std::nan("");
  wrong.poses[8]->position[1] = std::numeric_limits<double>::infinity();
  wrong.poses[9].reset();
  wrong.poses[20]->rotation[0] = std::nan("");
  wrong.poses[40]->rotation = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  wrong.poses[50]->rotation = {1, 0, 0, 0, 1, 0, 0, 0, -1};

  const PoseChecks checks = wrong.checked();

  EXPECT_THAT(checks.problems,
              ElementsAre(is_problem(Kind::not_finite, 7, 8), is_problem(Kind::not_finite, 20, 20),
                          is_problem(Kind::not_a_rotation, 40, 40),
                          is_problem(Kind::not_a_rotation, 50, 50)));
  EXPECT_THAT(unusable(checks), ElementsAre(7, 8, 9, 20, 40, 50));
  EXPECT_EQ(checks.parts, 1U);
}

TEST(PoseChecks, APoseOnItsSideAffectsItsScanAlone) {
  Path wrong = curve();
  turn_from(wrong, 30, 31, 0, 90);

  EXPECT_THAT(wrong.checked().problems, ElementsAre(is_problem(Kind::tilt, 30, 30)));
}

TEST(PoseChecks, TwoPosesThatDisagreeOnTheUpAxisAreNotUsable) {
  Path path = curve(2);
  turn_from(path, 1, 2, 1, 88);

  const PoseChecks checks = path.checked();

  EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::calibration, 0, 1)));
  EXPECT_EQ(checks.parts, 0U);
}

TEST(PoseChecks, GapsWithoutPosesAreNotJumps) {
  Path path = curve();
  for (std::size_t i = 20; i < 28; ++i) path.poses[i].reset();

  for (const Path& each : with_and_without_times(path)) {
    EXPECT_THAT(each.checked().problems, IsEmpty());
  }
}

TEST(PoseChecks, StoppingStartingAndTurningInPlaceAreNotJumps) {
  Path path;
  double x = 0;
  double speed = 15;
  double yaw = 0;
  for (int i = 0; i < 200; ++i) {
    const bool brakes = i >= 20 && i < 60;
    const bool turns = i >= 80 && i < 120;
    const bool starts = i >= 140;
    speed = brakes ? std::max(0.0, speed - 0.9) : starts ? speed + 0.4 : speed;
    x += 0.1 * speed;
    if (turns) yaw += 12;  // a robot that turns at 120 degrees per second
    Pose pose;
    pose.rotation = turn_about(2, yaw);
    pose.position[0] = x;
    path.poses.emplace_back(pose);
    path.times.push_back(0.1 * i);
  }

  for (const Path& each : with_and_without_times(path)) {
    EXPECT_THAT(each.checked().problems, IsEmpty());
  }
}

TEST(PoseChecks, WrongUnitsMakeNothingUsable) {
  Path path = curve();
  for (auto& pose : path.poses) {
    for (double& coordinate : pose->position) coordinate *= 1000;
  }

  const PoseChecks checks = path.checked();

  EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::speed, 0, 59)));
  EXPECT_THAT(checks.problems[0].message, HasSubstr("expected at most 70; positions must be in"));
  EXPECT_EQ(checks.parts, 0U);
}

TEST(PoseChecks, PosesOfACameraMakeNothingUsable) {
  const RotationMatrix to_camera = {0, -1, 0, 0, 0, -1, 1, 0, 0};
  for (const Path& good : with_and_without_times(curve())) {
    Path path = good;
    for (auto& pose : path.poses) {
      pose->rotation = product(to_camera, product(pose->rotation, transposed(to_camera)));
      const auto [x, y, z] = pose->position;
      pose->position = {-y, -z, x};
    }

    const PoseChecks checks = path.checked();

    EXPECT_THAT(checks.problems, ElementsAre(is_problem(Kind::calibration, 0, 59)));
    EXPECT_THAT(checks.problems[0].message, HasSubstr("put calib.txt with 'Tr:' next to them"));
    EXPECT_EQ(checks.parts, 0U);
  }
}

// Poses of the sensor, converted with a calibration as if they were poses of a camera.
TEST(PoseChecks, ACalibrationTooManyMakesNothingUsable) {
  const RotationMatrix to_sensor = {0, 0, 1, -1, 0, 0, 0, -1, 0};
  Path path = curve(200);
  for (auto& pose : path.poses) {
    pose->rotation = product(to_sensor, product(pose->rotation, transposed(to_sensor)));
    const auto [x, y, z] = pose->position;
    pose->position = {z, -x, -y};
  }

  const PoseChecks checks = check_poses(path.poses, path.times, true);

  EXPECT_EQ(checks.parts, 0U);
  ASSERT_EQ(checks.problems.size(), 1U);
  EXPECT_THAT(checks.problems[0].message, HasSubstr("rename calib.txt"));
}

TEST(PoseChecks, AWorldFrameWithoutZUpMakesNothingUsable) {
  Path path = curve();
  const RotationMatrix upside_down = turn_about(0, 180);
  for (auto& pose : path.poses) pose->rotation = product(pose->rotation, upside_down);

  EXPECT_THAT(path.checked().problems, ElementsAre(is_problem(Kind::world_frame, 0, 59)));
}

TEST(PoseChecks, ASensorThatDoesNotMoveIsFine) {
  Path path = curve(20);
  for (auto& pose : path.poses) pose->position = {3, 4, 5};

  EXPECT_THAT(path.checked().problems, IsEmpty());
}

TEST(PoseChecks, LinesNameTheScans) {
  const std::vector<std::string> names = {"000000", "000001", "000002"};
  const PoseProblem one{.kind = Kind::tilt, .first = 1, .last = 1, .message = "is tilted"};
  const PoseProblem two{.kind = Kind::tilt, .first = 1, .last = 2, .message = "are tilted"};

  EXPECT_EQ(to_line(one, names), "scan 000001: is tilted");
  EXPECT_EQ(to_line(two, names), "scans 000001 to 000002: are tilted");
}

class RealRuns : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = tests::real_scan_folder() / "sequences" / GetParam();
    if (!fs::exists(folder_ / "poses.txt")) GTEST_SKIP() << "no real run in " << folder_;
    scans_ = find_scans({(folder_ / "velodyne").string()});
  }

  [[nodiscard]] static Path path_of(const RunPoses& run) {
    Path path;
    for (const ScanPose& scan : run.scans) path.poses.push_back(scan.pose);
    path.times = run.times();
    return path;
  }

  fs::path folder_;
  std::vector<ScanInput> scans_;
};

TEST_P(RealRuns, HaveNoPoseProblems) {
  const RunPoses run = read_run_poses(folder_, scans_, folder_ / "poses.txt");

  EXPECT_THAT(run.notes, IsEmpty());
  for (const Path& path : with_and_without_times(path_of(run))) {
    const PoseChecks checks = path.checked();
    EXPECT_THAT(checks.problems, IsEmpty());
    EXPECT_EQ(checks.parts, 1U);
  }
}

TEST_P(RealRuns, WithoutCalibrationAreReported) {
  const io::TemporaryFolder copy;
  fs::copy_file(folder_ / "poses.txt", copy / "poses.txt");

  const RunPoses run = read_run_poses(copy.path(), scans_, copy / "poses.txt");

  EXPECT_THAT(path_of(run).checked().problems,
              ElementsAre(Field("kind", &PoseProblem::kind, Kind::calibration)));
}

TEST_P(RealRuns, WithAJumpOrAWrongRotationAreReported) {
  const RunPoses run = read_run_poses(folder_, scans_, folder_ / "poses.txt");
  const std::size_t count = scans_.size();
  Path jumping = path_of(run);
  move_from(jumping, 5, count, 5, 0);
  Path turned = path_of(run);
  turn_from(turned, 5, 6, 1, 10);
  Path turning = path_of(run);
  turn_from(turning, 5, count, 2, 10);

  EXPECT_THAT(jumping.checked().problems, ElementsAre(is_problem(Kind::position, 4, 5)));
  EXPECT_THAT(turned.checked().problems, ElementsAre(is_problem(Kind::rotation, 5, 5)));
  EXPECT_THAT(turning.checked().problems, ElementsAre(is_problem(Kind::rotation, 4, 5)));
}

INSTANTIATE_TEST_SUITE_P(Sequences, RealRuns, testing::Values("00", "03", "05", "10"));

Path path_of(const std::vector<sim::Frame>& frames, double interval) {
  Path path;
  for (const sim::Frame& frame : frames) {
    const auto& [o, f, l, u] = frame;
    path.poses.emplace_back(Pose{.rotation = {f.x, l.x, u.x, f.y, l.y, u.y, f.z, l.z, u.z},
                                 .position = {o.x, o.y, o.z}});
    path.times.push_back(interval * static_cast<double>(path.times.size()));
  }
  return path;
}

TEST(PoseChecks, FindNothingInSimulatedRuns) {
  const Sensor& sensor = Sensor::named("hdl-64e");
  for (const sim::SceneKind& kind : sim::scene_kinds()) {
    for (const sim::Pace& pace :
         {sim::Pace{}, sim::Pace{.rate = 10, .speed = 8}, sim::Pace{.rate = 10, .speed = 1}}) {
      const sim::Drive run(kind, sensor, {.height = sensor.height}, 3, pace);
      for (const sim::PoseNoise& noise : sim::pose_noises()) {
        SCOPED_TRACE(testing::Message() << kind.name << ", " << pace.rate << " Hz, " << pace.speed
                                        << " m/s, " << noise.name);
        const Path path = path_of(sim::measured_poses(run.poses(), noise, 1), 1 / pace.rate);
        for (const Path& each : with_and_without_times(path)) {
          EXPECT_THAT(each.checked().problems, IsEmpty());
        }
      }
    }
  }
}

Levelling levelled(double offset, double slope = 0, std::size_t cells = 5000) {
  return {.applied = true, .cells = cells, .offset = offset, .slope_x = slope, .slope_y = 0};
}

Levelling not_levelled(std::size_t cells) {
  return {.applied = false, .cells = cells, .offset = 0, .slope_x = 0, .slope_y = 0};
}

TEST(LevellingJudge, AcceptsErrorsThatGrowSlowly) {
  LevellingJudge judge;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(judge.fits(levelled(0.03 * i, 0.005 * i + (i % 2 == 0 ? 0.01 : -0.01)))) << i;
  }
}

TEST(LevellingJudge, RejectsScansThatDifferFromTheLastOnes) {
  LevellingJudge judge;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(judge.fits(levelled(0.1)));

  EXPECT_FALSE(judge.fits(levelled(0.5)));
  EXPECT_FALSE(judge.fits(levelled(0.1, 0.1)));
  EXPECT_FALSE(judge.fits(not_levelled(100)));
  EXPECT_TRUE(judge.fits(levelled(0.1)));
}

TEST(LevellingJudge, CanBeContinued) {
  LevellingJudge judge;
  for (int i = 0; i < 12; ++i) judge.fits(levelled(0.03 * i));
  judge.fits(levelled(9));

  LevellingJudge copy(judge.state());

  EXPECT_FALSE(copy.fits(levelled(-0.2)));
  EXPECT_TRUE(copy.fits(levelled(0.45)));
}

TEST(LevellingJudge, AcceptsAnotherCorrectionAfterTenScansThatNeedIt) {
  LevellingJudge judge;
  for (int i = 0; i < 20; ++i) judge.fits(levelled(0));
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(judge.fits(levelled(0.6))) << i;
  EXPECT_TRUE(judge.fits(levelled(0.6)));
  EXPECT_TRUE(judge.fits(levelled(0.5)));
  EXPECT_FALSE(judge.fits(levelled(0)));
}

TEST(LevellingJudge, NeverAcceptsScansThatDoNotFitTogether) {
  LevellingJudge judge;
  for (int i = 0; i < 20; ++i) judge.fits(levelled(0));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(judge.fits(levelled(i % 2 == 0 ? 0.9 : -0.9))) << i;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(judge.fits(not_levelled(4000))) << i;
}

TEST(LevellingJudge, AcceptsScansBeyondTheMap) {
  LevellingJudge judge;
  EXPECT_TRUE(judge.fits(not_levelled(0)));
  EXPECT_TRUE(judge.fits(not_levelled(99)));
}

}  // namespace
}  // namespace flagstone::app
