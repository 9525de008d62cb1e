// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace flagstone_ros {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using enum Diagnosis::Level;

CloudSummary cloud(double latency) {
  return {.latency = latency,
          .out_of_range = 0.25,
          .sensor_height = 1.7312,
          .tilt = 2.5,
          .mount = "configured"};
}

std::string value_of(const Diagnosis& diagnosis, std::string_view key) {
  for (const auto& [name, value] : diagnosis.values) {
    if (name == key) return value;
  }
  return "missing";
}

TEST(Monitor, ReportsRateAndLatencyOfAPeriod) {
  Monitor monitor(100, "surface");
  for (const double latency : {0.002, 0.030, 0.004, 0.003}) {
    monitor.received(100.5);
    monitor.segmented(cloud(latency));
  }

  const Diagnosis diagnosis = monitor.diagnose(102);

  EXPECT_EQ(diagnosis.level, ok);
  EXPECT_EQ(diagnosis.message, "clouds are segmented");
  EXPECT_THAT(
      diagnosis.values,
      ElementsAre(Pair("method", "surface"), Pair("clouds", "4"), Pair("rate (Hz)", "2.0"),
                  Pair("latency, median (ms)", "3.50"), Pair("latency, worst (ms)", "30.00"),
                  Pair("dropped", "0"), Pair("skipped", "0"), Pair("out of range (%)", "25.0"),
                  Pair("sensor height (m)", "1.731"), Pair("tilt (degrees)", "2.50"),
                  Pair("mount", "configured")));
}

TEST(Monitor, BeginsANewPeriodWithEveryDiagnosis) {
  Monitor monitor(100, "surface");
  monitor.received(100.5);
  monitor.segmented(cloud(0.5));
  static_cast<void>(monitor.diagnose(101));
  monitor.received(101.5);
  monitor.segmented(cloud(0.002));

  const Diagnosis diagnosis = monitor.diagnose(102);

  EXPECT_EQ(value_of(diagnosis, "clouds"), "2");
  EXPECT_EQ(value_of(diagnosis, "latency, worst (ms)"), "2.00");
}

TEST(Monitor, OmitsValuesThatAreNotKnown) {
  Monitor monitor(100, "surface");

  const Diagnosis diagnosis = monitor.diagnose(101);

  EXPECT_EQ(diagnosis.level, ok);
  EXPECT_EQ(diagnosis.message, "waiting for the first cloud");
  EXPECT_EQ(value_of(diagnosis, "latency, median (ms)"), "missing");
  EXPECT_EQ(value_of(diagnosis, "mount"), "missing");
}

TEST(Monitor, WarnsIfNoCloudArrives) {
  Monitor monitor(100, "surface");
  EXPECT_EQ(monitor.diagnose(103).message, "no cloud has arrived yet");
  monitor.received(104);

  const Diagnosis diagnosis = monitor.diagnose(107.5);

  EXPECT_EQ(diagnosis.level, warn);
  EXPECT_EQ(diagnosis.message, "no cloud for 3.5 s");
}

TEST(Monitor, WarnsOfDroppedClouds) {
  Monitor monitor(100, "surface");
  for (int i = 0; i < 5; ++i) monitor.received(100.5);
  monitor.dropped(3);
  monitor.segmented(cloud(0.002));

  const Diagnosis diagnosis = monitor.diagnose(101);

  EXPECT_EQ(diagnosis.level, warn);
  EXPECT_EQ(diagnosis.message, "3 of 5 clouds dropped: the node falls behind");
  EXPECT_EQ(value_of(diagnosis, "dropped"), "3");
}

TEST(Monitor, WarnsOfSkippedClouds) {
  Monitor monitor(100, "surface");
  monitor.received(100.5);
  monitor.received(100.6);
  monitor.skipped("points: no field x");
  monitor.segmented(cloud(0.002));

  const Diagnosis diagnosis = monitor.diagnose(101);

  EXPECT_EQ(diagnosis.level, warn);
  EXPECT_EQ(diagnosis.message, "1 of 2 clouds skipped: points: no field x");
}

TEST(Monitor, ReportsAnErrorIfEveryCloudIsSkipped) {
  Monitor monitor(100, "surface");
  monitor.received(100.5);
  monitor.skipped("points: no field x");

  const Diagnosis diagnosis = monitor.diagnose(101);

  EXPECT_EQ(diagnosis.level, error);
  EXPECT_EQ(diagnosis.message, "no cloud could be segmented: points: no field x");
}

TEST(Monitor, WarnsIfMostPointsAreOutOfRange) {
  Monitor monitor(100, "surface");
  monitor.received(100.5);
  CloudSummary far_away = cloud(0.002);
  far_away.out_of_range = 0.95;
  monitor.segmented(far_away);

  EXPECT_EQ(monitor.diagnose(101).level, warn);
}

TEST(Monitor, ReportsThatNoOutputHasASubscriber) {
  Monitor monitor(100, "surface");
  monitor.received(100.5);
  monitor.unheard();

  const Diagnosis diagnosis = monitor.diagnose(101);

  EXPECT_EQ(diagnosis.level, ok);
  EXPECT_EQ(diagnosis.message, "no output has a subscriber");
}

}  // namespace
}  // namespace flagstone_ros
