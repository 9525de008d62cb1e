// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "app/doctor/examination.hpp"
#include "app/doctor/street_scan.hpp"

namespace flagstone::doctor {
namespace {

Diagnosis diagnosis_of(const std::vector<Point>& points, const Expected& expected = {}) {
  const std::array scans{examine(cloud_of(points))};
  return diagnose(summarise(scans), expected);
}

/// The findings that are not fine.
std::set<std::string> complaints(const Diagnosis& diagnosis) {
  std::set<std::string> ids;
  for (const Finding& finding : diagnosis.findings) {
    if (finding.severity != Severity::fine) ids.insert(finding.id);
  }
  return ids;
}

const Finding& finding_of(const Diagnosis& diagnosis, const std::string& id) {
  const auto found = std::ranges::find(diagnosis.findings, id, &Finding::id);
  if (found == diagnosis.findings.end()) throw std::out_of_range("no finding " + id);
  return *found;
}

TEST(Doctor, FindsNothingInAGoodScan) {
  const Diagnosis diagnosis = diagnosis_of(street_scan());

  EXPECT_THAT(complaints(diagnosis), testing::IsEmpty());
  EXPECT_FALSE(diagnosis.has_something_to_fix());
  EXPECT_TRUE(diagnosis.advice.has_value());
  const Advice advice = diagnosis.advice.value_or(Advice());
  EXPECT_FALSE(advice.has_mount);
  EXPECT_EQ(advice.mount.sensor_height, Expected().sensor_height);
}

TEST(Doctor, ReportsEveryFindingForAGoodScan) {
  const Diagnosis diagnosis = diagnosis_of(street_scan());

  for (const Fault& fault : faults()) {
    EXPECT_EQ(finding_of(diagnosis, fault.finding).severity, Severity::fine) << fault.finding;
  }
}

class DoctorFault : public testing::TestWithParam<Fault> {};

TEST_P(DoctorFault, IsTheOnlyFinding) {
  const Fault& fault = GetParam();

  const Diagnosis diagnosis = diagnosis_of(fault.apply(street_scan()), fault.expected);

  const Finding& finding = finding_of(diagnosis, fault.finding);
  EXPECT_EQ(finding.severity, fault.severity) << finding.sentence;
  std::set<std::string> ids = complaints(diagnosis);
  for (const std::string& other : fault.comes_with) ids.erase(other);
  EXPECT_THAT(ids, testing::ElementsAre(fault.finding));
  EXPECT_FALSE(finding.sentence.empty());
  EXPECT_FALSE(finding.remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(All, DoctorFault, testing::ValuesIn(faults()),
                         [](const auto& fault) { return fault.param.name; });

TEST(Doctor, RecommendsNoSettingsIfNoneHelp) {
  for (const Fault& fault : faults()) {
    const std::set<std::string> hopeless{"points", "coordinates", "single_viewpoint", "ground"};
    if (!hopeless.contains(fault.finding)) continue;
    EXPECT_FALSE(diagnosis_of(fault.apply(street_scan()), fault.expected).advice.has_value())
        << fault.name;
  }
}

TEST(Doctor, ReportsScansThatDifferInHeight) {
  const auto lower = [](Point p) { return Point{p.x, p.y, p.z - 0.45f}; };
  const std::array scans{examine(cloud_of(street_scan())),
                         examine(cloud_of(changed(street_scan(), lower)))};

  const Diagnosis diagnosis = diagnose(summarise(scans), {});

  EXPECT_THAT(finding_of(diagnosis, "sensor_height").sentence,
              testing::HasSubstr("varies by 0.45 m"));
}

TEST(Doctor, FollowsTheMajorityOfScans) {
  const Examination fine = examine(cloud_of(street_scan()));
  const Examination odd =
      examine(cloud_of(changed(street_scan(), [](Point p) { return Point{p.x, -p.y, -p.z}; })));

  EXPECT_THAT(complaints(diagnose(summarise(std::array{fine, odd, fine}), {})), testing::IsEmpty());
  EXPECT_THAT(complaints(diagnose(summarise(std::array{odd, fine, odd}), {})),
              testing::ElementsAre("axes"));
}

}  // namespace
}  // namespace flagstone::doctor
