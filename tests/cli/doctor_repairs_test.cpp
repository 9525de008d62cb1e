// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "app/config/method_choice.hpp"
#include "app/doctor/advice.hpp"
#include "app/doctor/examination.hpp"
#include "app/doctor/faults.hpp"
#include "app/doctor/street_scan.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "lab/eval/score.hpp"
#include "library/methods/method.hpp"

namespace flagstone::cli {
namespace {

using doctor::Fault;
using doctor::street_scan;

/// F1 of the street scan, changed to `points`, with these settings; in percent.
double f1_of(const std::vector<Point>& points, const config::MethodChoice& choice) {
  const auto [name, config, mount] = config::resolve_one(choice);
  const float height = sensor_height_of(config, mount.mount.sensor_height);
  GravityAlignedSegmenter segmenter(config.make(), height, mount);
  Segmentation result;
  EXPECT_TRUE(segmenter.segment(CloudView(std::span<const Point>(points)), result).ok());
  return 100 * eval::compare(result.labels(), doctor::street_truth()).f1();
}

/// Faults that settings can repair and that do not change the order of the points.
std::vector<Fault> repairable() {
  std::vector<Fault> found;
  for (const Fault& fault : doctor::faults()) {
    const bool has_settings = fault.finding == "units" || fault.finding == "axes" ||
                              fault.finding == "tilt" || fault.finding == "origin" ||
                              fault.finding == "sensor_height";
    if (has_settings && fault.comes_with.empty()) found.push_back(fault);
  }
  return found;
}

class DoctorRepair : public testing::TestWithParam<Fault> {};

TEST_P(DoctorRepair, RestoresTheF1OfTheScanWithoutTheFault) {
  const io::TemporaryFolder folder;
  const std::vector<Point> points = GetParam().apply(street_scan());
  const std::array scans{doctor::examine(doctor::cloud_of(points))};
  const doctor::Diagnosis diagnosis =
      doctor::diagnose(doctor::summarise(scans), GetParam().expected);
  EXPECT_TRUE(diagnosis.advice.has_value());
  const std::string file = (folder / "doctor.toml").string();
  io::put_file(file, doctor::to_toml(diagnosis.advice.value_or(doctor::Advice())));

  for (const std::string method : {"surface", "patchwork"}) {
    const double fine = f1_of(street_scan(), {.methods = {method}});
    const double repaired = f1_of(points, {.methods = {method}, .config_file = file});

    EXPECT_GT(repaired, fine - 0.5) << method;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DoctorRepair, testing::ValuesIn(repairable()),
                         [](const auto& fault) { return fault.param.name; });

}  // namespace
}  // namespace flagstone::cli
