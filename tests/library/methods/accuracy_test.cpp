// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Accuracy on real scans, per set and protocol. The protocols are defined in lab/eval/protocol.hpp,
// and the classes of sets with other classes in their classes.json.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "lab/eval/protocol.hpp"
#include "mean_f1.hpp"

namespace flagstone {
namespace {

using eval::patchwork_plusplus_protocol;
using eval::patchwork_protocol;

/// Mean F1 with these settings and the sensor height of each scan, percent.
template <class Method, class Config>
double mean_f1(const std::string& name, Config config, const std::vector<tests::RealScan>& scans,
               const eval::Protocol& protocol, int turns = 1) {
  const auto make = [&](float sensor_height) {
    config.sensor_height = sensor_height;
    return std::make_unique<Method>(config);
  };
  return tests::mean_f1(name, make, scans, protocol, turns);
}

double of_preset(const std::string& preset, const std::vector<tests::RealScan>& scans,
                 const eval::Protocol& protocol) {
  return mean_f1<Patchwork>("preset " + preset, PatchworkConfig::preset(preset), scans, protocol);
}

double of_surface(const std::vector<tests::RealScan>& scans, const eval::Protocol& protocol,
                  int turns = 1) {
  return mean_f1<Surface>("surface", SurfaceConfig(), scans, protocol, turns);
}

/// The classes of a set of real scans.
eval::Protocol protocol_of(const std::string& set) {
  eval::Protocol protocol;
  const Status status =
      eval::read_protocol(tests::real_scan_folder() / set / "classes.json", protocol);
  EXPECT_TRUE(status.ok()) << status.message();
  return protocol;
}

TEST(PatchworkAccuracy, OfTheDefaultPresetOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(of_preset("default", scans, patchwork_protocol()), 94.5);
  EXPECT_GE(of_preset("default", scans, patchwork_plusplus_protocol()), 97.7);
}

TEST(PatchworkAccuracy, OfTheSettingsForTheHdl64eEqualsTheDefaultPresetOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);
  const PatchworkConfig derived = PatchworkConfig::for_sensor("hdl-64e");

  for (const eval::Protocol& protocol : {patchwork_protocol(), patchwork_plusplus_protocol()}) {
    EXPECT_GE(mean_f1<Patchwork>("derived from hdl-64e", derived, scans, protocol),
              of_preset("default", scans, protocol) - 0.25)
        << protocol.name;
  }
}

TEST(PatchworkAccuracy,
     OfTheReferencePresetIsWithinHalfAPercentagePointOfTheAuthorsPackageOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  // pypatchworkpp 1.4.1, class patchwork, sensor height 1.73 m, on the same scans;
  // docs/explanation/patchwork.md
  EXPECT_NEAR(of_preset("reference", scans, patchwork_protocol()), 95.07, 0.5);
  EXPECT_NEAR(of_preset("reference", scans, patchwork_plusplus_protocol()), 98.07, 0.5);
}

TEST(SurfaceAccuracy, OnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(of_surface(scans, patchwork_protocol()), 96.3);
  EXPECT_GE(of_surface(scans, patchwork_plusplus_protocol()), 99.1);
}

TEST(SurfaceAccuracy, OnNuScenes) {
  const auto scans = tests::real_scans("nuscenes");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(of_surface(scans, protocol_of("nuscenes")), 98.4);
}

TEST(SurfaceAccuracy, OnLivox) {
  const auto scans = tests::real_scans("livox");
  FLAGSTONE_REQUIRE_SCANS(scans);

  // On the steep scans 04 and 10, single results vary by percentage points.
  EXPECT_GE(of_surface(scans, protocol_of("livox"), 16), 95.5);
}

}  // namespace
}  // namespace flagstone
