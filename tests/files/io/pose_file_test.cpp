// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pose_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "library/core/rotation.hpp"

namespace flagstone::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

PoseFile poses_in(const std::string& text) {
  PoseFile file;
  EXPECT_THAT(parse_poses(text, file), is_ok());
  return file;
}

Status pose_refusal(const std::string& text) {
  PoseFile file;
  return parse_poses(text, file);
}

void expect_near(const RotationMatrix& found, const RotationMatrix& expected, double tolerance) {
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << i;
}

constexpr RotationMatrix quarter_turn = {0, -1, 0, 1, 0, 0, 0, 0, 1};

TEST(PoseFile, ReadsKitti) {
  const PoseFile file = poses_in("0 -1 0 1.5 1 0 0 -2 0 0 1 3e1\r\n\n1 0 0 0 0 1 0 0 0 0 1 0");

  EXPECT_EQ(file.format, PoseFormat::kitti);
  EXPECT_FALSE(file.has_times);
  ASSERT_EQ(file.poses.size(), 2U);
  EXPECT_EQ(file.poses[0].number, 1U);
  EXPECT_EQ(file.poses[1].number, 3U);
  EXPECT_FALSE(file.poses[0].time);
  expect_near(file.poses[0].pose->rotation, quarter_turn, 0);
  EXPECT_THAT(file.poses[0].pose->position, ElementsAre(1.5, -2, 30));
}

TEST(PoseFile, ReadsTumWithComments) {
  const PoseFile file =
      poses_in("# timestamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 0.7071068 0.7071068\n# end\n");

  EXPECT_EQ(file.format, PoseFormat::tum);
  EXPECT_TRUE(file.has_times);
  ASSERT_EQ(file.poses.size(), 1U);
  EXPECT_EQ(file.poses[0].time, 1.5);
  EXPECT_THAT(file.poses[0].pose->position, ElementsAre(1, 2, 3));
  expect_near(file.poses[0].pose->rotation, quarter_turn, 1e-15);
}

// Each header, and a line with time 2 s, position (1, 2, 3) and a quarter turn to the left.
TEST(PoseFile, ReadsTheCsvOfCommonTools) {
  const std::vector<std::string> files = {
      "timestamp,x,y,z,qx,qy,qz,qw\n2,1,2,3,0,0,1,1e-99\n",
      "t;x;y;z;qw;qx;qy;qz\n2;1;2;3;1e-99;0;0;1\n",
      "time, tx, ty, tz, qx, qy, qz, qw\r\n2, 1, 2, 3, 0, 0, 1, 0\r\n",
      "\xef\xbb\xbf\"time\",\"x [m]\",\"y [m]\",\"z [m]\",\"roll\",\"pitch\",\"yaw "
      "[deg]\"\n\"2\",1,2,3,0,0,180\n",
      "Time_ms,X,Y,Z,Yaw,Pitch,Roll\n2000,1,2,3,3.14159265358979,0,0\n",
      // EuRoC
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z "
      "[],v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],b_w_RS_S_x [rad s^-1]\n"
      "2000000000,1,2,3,0,0,0,1,9,9,9,9\n",
      // rostopic
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.pose.position.x,"
      "field.pose.pose.position.y,field.pose.pose.position.z,field.pose.pose.orientation.x,"
      "field.pose.pose.orientation.y,field.pose.pose.orientation.z,field.pose.pose.orientation.w,"
      "field.pose.covariance0,field.twist.twist.linear.x\n"
      "1700000000500000000,1,1700000002000000000,odom,1,2,3,0,0,1,0,7,8\n",
      // PlotJuggler
      "__time,/odom/header/stamp,/odom/pose/pose/position/x,/odom/pose/pose/position/y,"
      "/odom/pose/pose/position/z,/odom/pose/pose/orientation/x,/odom/pose/pose/orientation/y,"
      "/odom/pose/pose/orientation/z,/odom/pose/pose/orientation/w,/odom/twist/twist/angular/z\n"
      "1.0,1700000002,1,2,3,0,0,1,0,5\n",
      // Newer College
      "#sec,nsec,x,y,z,qx,qy,qz,qw\n1,1000000000,1,2,3,0,0,1,0\n",
      "header.stamp.sec,header.stamp.nanosec,pose.position.x,pose.position.y,pose.position.z,"
      "pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w\n"
      "2,0,1,2,3,0,0,1,0\n"};
  for (const std::string& text : files) {
    SCOPED_TRACE(text);
    const PoseFile file = poses_in(text);

    EXPECT_EQ(file.format, PoseFormat::csv);
    ASSERT_EQ(file.poses.size(), 1U);
    EXPECT_EQ(file.poses[0].number, 2U);
    ASSERT_TRUE(file.poses[0].time);
    EXPECT_NEAR(std::fmod(*file.poses[0].time, 1.7e9), 2, 1e-6);
    ASSERT_TRUE(file.poses[0].pose);
    EXPECT_THAT(file.poses[0].pose->position, ElementsAre(1, 2, 3));
    expect_near(file.poses[0].pose->rotation, {-1, 0, 0, 0, -1, 0, 0, 0, 1}, 1e-14);
  }
}

TEST(PoseFile, AnglesTurnAboutXThenYThenZ) {
  const PoseFile file = poses_in("x,y,z,roll,pitch,yaw\n0,0,0,0.3,0.2,0.1\n");

  const RotationMatrix expected =
      product(matrix_of({.z = std::sin(0.05), .w = std::cos(0.05)}),
              product(matrix_of({.x = 0, .y = std::sin(0.1), .z = 0, .w = std::cos(0.1)}),
                      matrix_of({.x = std::sin(0.15), .y = 0, .z = 0, .w = std::cos(0.15)})));
  expect_near(file.poses[0].pose->rotation, expected, 1e-15);
  EXPECT_FALSE(file.has_times);
}

TEST(PoseFile, TimesSince1970MayHaveAnyUnit) {
  const std::string pose = " 0 0 0 0 0 0 1\n";
  for (const std::string time :
       {"1700000000.25", "1700000000250", "1700000000250000", "1700000000250000000"}) {
    EXPECT_NEAR(*poses_in(time + pose).poses[0].time, 1700000000.25, 1e-6) << time;
  }
  EXPECT_EQ(poses_in("86400" + pose).poses[0].time, 86400);
}

TEST(PoseFile, NumbersThatAreNotFiniteAreOneBadPose) {
  const PoseFile file = poses_in(
      "0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n2 0 0 0 0 0 0 inf\n3 0 -1e999 0 0 0 0 1\n"
      "nan 0 0 0 0 0 0 1\n5 0 0 0 0 0 0 1\n");

  ASSERT_EQ(file.poses.size(), 6U);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_FALSE(file.poses[i].pose) << i;
    EXPECT_EQ(file.poses[i].fault, PoseFault::not_finite) << i;
  }
  EXPECT_EQ(file.poses[1].time, 1);
  EXPECT_FALSE(file.poses[4].time);
  EXPECT_TRUE(file.poses[0].pose && file.poses[5].pose);
  EXPECT_EQ(poses_in("nan nan nan nan nan nan nan nan nan nan nan nan\n").poses[0].fault,
            PoseFault::not_finite);
  EXPECT_EQ(poses_in("x,y,z,qx,qy,qz,qw\n,,,,,,\n").poses[0].fault, PoseFault::not_finite);
}

TEST(PoseFile, SlightlyWrongRotationsAreCorrectedAndOthersAreBadPoses) {
  const auto tum = [](const char* quaternion) {
    return poses_in(std::string("0 0 0 0 ") + quaternion).poses[0];
  };
  expect_near(tum("0 0 0.704 0.704").pose->rotation, quarter_turn, 1e-12);
  EXPECT_EQ(tum("0 0 0.69 0.69").fault, PoseFault::not_a_rotation);
  EXPECT_EQ(tum("0 0 0 0").fault, PoseFault::not_a_rotation);

  const auto kitti = [](const char* first) {
    return poses_in(std::string(first) + " 0 0 0 0 1 0 0 0 0 1 0").poses[0];
  };
  expect_near(kitti("1.0003").pose->rotation, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-15);
  EXPECT_EQ(kitti("1.001").fault, PoseFault::not_a_rotation);
  EXPECT_EQ(kitti("-1").fault, PoseFault::not_a_rotation);  // a reflection
}

TEST(PoseFile, PositionsBeyondTheLimitAreBadPoses) {
  EXPECT_EQ(poses_in("0 1e8 0 0 0 0 0 1").poses[0].fault, PoseFault::too_far);
}

TEST(PoseFile, ErrorsNameLineProblemAndExpectation) {
  const auto fails_with = [](const char* message) {
    return fails(StatusCode::bad_file, StartsWith(message));
  };
  EXPECT_THAT(pose_refusal(""),
              fails_with("contains no poses (expected 12 numbers per line (KITTI)"));
  EXPECT_THAT(pose_refusal("# only a comment\n"), fails_with("contains no poses"));
  EXPECT_THAT(pose_refusal("x,y,z,qx,qy,qz,qw\n"), fails_with("contains no poses"));
  EXPECT_THAT(pose_refusal("1 2 3\n"), fails_with("line 1: is not a pose (expected 12 numbers"));
  EXPECT_THAT(pose_refusal("time x y z qx qy qz qw\n"),
              fails_with("line 1: 'time' is not a number (expected 8 numbers)"));
  EXPECT_THAT(pose_refusal("0 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 0\n"),
              fails_with("line 3: has 7 numbers (expected 8"));
  EXPECT_THAT(pose_refusal("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1 5\n"),
              fails_with("line 2: has more than 8 numbers"));
  EXPECT_THAT(pose_refusal("0 0 0 0 0 0 0 1\n1 0 0 z\x01 0 0 0 1\n"),
              fails_with("line 2: 'z\\x01' is not a number"));
  EXPECT_THAT(pose_refusal("0,0,0,0,0,0,0,1\n"),
              fails_with("line 1: a header that names the columns is missing (expected x, y, z"));
  EXPECT_THAT(pose_refusal("t,x,y,z,qx,qy\n"),
              fails_with("line 1: the header does not name the columns qz, qw (expected"));
  EXPECT_THAT(pose_refusal("t,x,y,z,yaw\n"),
              fails_with("line 1: the header does not name the columns qx, qy, qz, qw"));
  EXPECT_THAT(pose_refusal("t,x,y,z,x\n"),
              fails_with("line 1: columns 2 and 5 have the same content, 'x' and 'x'"));
  EXPECT_THAT(pose_refusal("t [h],x,y,z\n"), fails_with("line 1: 't [h]' has an unknown unit"));
  EXPECT_THAT(pose_refusal("x,y,z,qx,qy,qz,qw\n1,2,3\n"),
              fails_with("line 2: has 3 cells (expected 7, as in the header)"));
  EXPECT_THAT(pose_refusal("x,y,z,qx,qy,qz,qw\n1,2,far,0,0,0,1\n"),
              fails_with("line 2: 'far' in column 3 is not a number"));
}

TEST(PoseFile, ErrorsOfFilesBeginWithThePathAndChangeNothing) {
  const TemporaryFolder folder;
  put_file(folder / "poses.txt", "0 0 0\n");
  PoseFile file = poses_in("0 0 0 0 0 0 0 1");

  EXPECT_THAT(read_poses(folder / "poses.txt", file),
              fails(StatusCode::bad_file, HasSubstr("poses.txt: line 1: is not a pose")));
  EXPECT_EQ(file.poses.size(), 1U);
  EXPECT_EQ(read_poses(folder / "none.txt", file).code(), StatusCode::not_found);
  EXPECT_EQ(read_poses(folder.path(), file).code(), StatusCode::unreadable);
}

// A camera that looks along x of the sensor: x right, y down, z forward, 0.3 m ahead.
constexpr const char* calibration = "P0: 1 2 3\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n";

TEST(PoseFile, CameraPosesBecomePosesOfTheSensor) {
  Pose to_camera;
  ASSERT_THAT(parse_sensor_to_camera(calibration, to_camera), is_ok());
  // The camera is 5 m ahead and 1 m to the right, and turned 90 degrees to the left.
  PoseFile file = poses_in("0 0 -1 1 0 1 0 0 1 0 0 5\n");

  convert_from_camera(to_camera, file.poses);

  expect_near(file.poses[0].pose->rotation, quarter_turn, 1e-15);
  // The sensor is 0.3 m behind the camera, which now looks along y; at the start the camera was at
  // x = 0.3.
  EXPECT_NEAR(file.poses[0].pose->position[0], 5.3, 1e-15);
  EXPECT_NEAR(file.poses[0].pose->position[1], -1.3, 1e-15);
  EXPECT_NEAR(file.poses[0].pose->position[2], 0, 1e-15);
}

TEST(PoseFile, CalibrationsAreOfOdometryOrOfObjects) {
  Pose pose;
  EXPECT_THAT(parse_sensor_to_camera("Tr_velo_to_cam: 1 0 0 1 0 1 0 2 0 0 1 3\n", pose), is_ok());
  EXPECT_THAT(pose.position, ElementsAre(1, 2, 3));
}

TEST(PoseFile, CalibrationsWithoutARotationAreErrors) {
  Pose pose;
  EXPECT_THAT(parse_sensor_to_camera("P0: 1 0 0 0\n", pose),
              fails(StatusCode::bad_file, StartsWith("contains no line 'Tr:'")));
  for (const char* numbers :
       {"", "1 0 0 0 0 1 0 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 0", "1 0 0 0 0 1 0 0 0 0 nan 0",
        "1 0 0 0 0 1 0 0 0 0 one 0", "2 0 0 0 0 1 0 0 0 0 1 0"}) {
    EXPECT_THAT(parse_sensor_to_camera(std::string("\nTr: ") + numbers, pose),
                fails(StatusCode::bad_file, StartsWith("line 2: Tr is not a rotation")))
        << numbers;
  }
}

TEST(PoseFile, TimesAreOnePerLine) {
  std::vector<double> times;
  ASSERT_THAT(parse_times("0.000000e+00\n1.033914e-01\n\nnan\n", times), is_ok());

  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times[1], 0.1033914);
  EXPECT_TRUE(std::isnan(times[2]));
  EXPECT_THAT(parse_times("0\n2011-09-26 13:02:25\n", times),
              fails(StatusCode::bad_file,
                    StartsWith("line 2: '2011-09-26 13:02:25' is not a time (expected seconds")));
  EXPECT_EQ(times.size(), 3U);
}

}  // namespace
}  // namespace flagstone::io
