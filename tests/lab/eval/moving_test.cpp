// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/moving.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/npy.hpp"
#include "files/io/temporary_folder.hpp"
#include "lab/eval/results.hpp"
#include "lab/eval/results_export.hpp"
#include "lab/eval/results_text.hpp"

namespace flagstone::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A point straight ahead with its class, and its mark: nonzero for a point that moves.
struct Sample {
  float range;
  std::uint32_t id;
  std::uint32_t mark;
};

MovingScore moving_score(const std::vector<Sample>& samples) {
  std::vector<float> values;
  std::vector<std::uint32_t> classes;
  std::vector<std::uint32_t> marks;
  for (const Sample& sample : samples) {
    values.insert(values.end(), {sample.range, 0, 0});
    classes.push_back(sample.id);
    marks.push_back(sample.mark);
  }
  MovingTruth truth;
  truth.set(CloudView(values.data(), samples.size()), classes);
  return truth.score(marks);
}

constexpr std::uint32_t paved = 40;
constexpr std::uint32_t house = 50;
constexpr std::uint32_t moving_car = 252;

TEST(MovingScore, CountsMovingAndStaticPoints) {
  const MovingScore scored = moving_score({{5, moving_car, 7},
                                           {5, moving_car, 1},
                                           {5, moving_car, 0},
                                           {5, house, 1},
                                           {5, house, 0},
                                           {5, house, 0},
                                           {5, house, 0},
                                           {5, paved, 1},
                                           {5, paved, 0}});

  const Confusion& points = scored.all.points;
  EXPECT_EQ(points.true_positives, 2);
  EXPECT_EQ(points.false_positives, 2);
  EXPECT_EQ(points.false_negatives, 1);
  EXPECT_EQ(points.true_negatives, 4);
  EXPECT_DOUBLE_EQ(points.iou(), 0.4);
  EXPECT_DOUBLE_EQ(scored.all.kept_share(), 0.75) << "ground is not counted";
  EXPECT_EQ(scored.all.moving(), 3);
  EXPECT_EQ(scored.all.marked(), 4);
}

TEST(MovingScore, Classes251To259Move) {
  for (std::uint32_t id = 2; id < 300; ++id) {
    EXPECT_EQ(moving_score({{5, id, 0}}).all.moving(), id >= 251 && id <= 259 ? 1 : 0) << id;
  }
}

TEST(MovingScore, UnlabelledPointsAndOutliersAreNotScored) {
  EXPECT_EQ(moving_score({{5, 0, 1}, {5, 1, 1}}).all.points.total(), 0);
}

TEST(MovingScore, RangeBandsEndAt10And20And40And80Metres) {
  const MovingScore scored = moving_score({{9.9F, moving_car, 1},
                                           {10, moving_car, 1},
                                           {20, moving_car, 1},
                                           {39, house, 0},
                                           {40, moving_car, 0},
                                           {80, moving_car, 0},
                                           {std::nanf(""), moving_car, 0}});

  std::vector<double> moving;
  for (const MovingCounts& band : scored.by_range) moving.push_back(band.moving());
  EXPECT_THAT(moving, ElementsAre(1, 1, 1, 1));
  EXPECT_EQ(scored.by_range[2].obstacles, 1);
  EXPECT_EQ(scored.all.moving(), 4) << "points beyond 80 m are not scored";
}

TEST(MovingScore, IsUndefinedWithoutMovingPoints) {
  const MovingScore scored = moving_score({{5, paved, 1}});

  EXPECT_TRUE(std::isnan(scored.all.points.iou()));
  EXPECT_TRUE(std::isnan(scored.all.points.recall()));
  EXPECT_TRUE(std::isnan(scored.all.kept_share()));
}

std::vector<Sample> random_samples() {
  return *rc::gen::container<std::vector<Sample>>(rc::gen::construct<Sample>(
      rc::gen::map(rc::gen::inRange(0, 1000), [](int v) { return static_cast<float>(v) / 10; }),
      rc::gen::element<std::uint32_t>(0, 1, 10, paved, house, 70, 251, moving_car, 259),
      rc::gen::inRange<std::uint32_t>(0, 3)));
}

RC_GTEST_PROP(MovingScore, IsPerfectIfExactlyTheMovingPointsAreMarked, ()) {
  std::vector<Sample> samples = random_samples();
  for (Sample& sample : samples) sample.mark = sample.id >= 251 ? 1 : 0;

  const MovingScore scored = moving_score(samples);

  for (const MovingCounts& counts : scored.by_range) {
    RC_ASSERT(counts.moving() == 0 || counts.points.iou() == 1);
    RC_ASSERT(counts.kept == counts.obstacles);
  }
}

RC_GTEST_PROP(MovingScore, CountsOfScansAddUp, ()) {
  const std::vector<Sample> first = random_samples();
  const std::vector<Sample> second = random_samples();
  std::vector<Sample> both = first;
  both.insert(both.end(), second.begin(), second.end());
  const std::vector<LabelledScan> scans = {{"a", {}, {}}, {"b", {}, {}}};
  std::vector<std::optional<ScanOutcome>> outcomes(2);
  for (const std::size_t i : {0U, 1U}) {
    outcomes[i].emplace();
    outcomes[i]->moving.push_back({.error = {}, .score = moving_score(i == 0 ? first : second)});
  }

  const Results results = gather({}, scans, outcomes, std::array{MovingSource{"map", {}}});

  const MovingScore expected = moving_score(both);
  const auto equals = [](const MovingCounts& a, const MovingCounts& b) {
    return a.points.true_positives == b.points.true_positives &&
           a.points.false_positives == b.points.false_positives &&
           a.points.false_negatives == b.points.false_negatives &&
           a.points.true_negatives == b.points.true_negatives && a.obstacles == b.obstacles &&
           a.kept == b.kept;
  };
  RC_ASSERT(equals(results.moving[0].all.pooled, expected.all));
  for (std::size_t band = 0; band < expected.by_range.size(); ++band) {
    RC_ASSERT(equals(results.moving[0].by_range[band].pooled, expected.by_range[band]));
  }
}

/// Two scans with moving points, one without, and one that failed.
class MovingOverScans : public testing::Test {
 protected:
  MovingOverScans() {
    std::vector<std::optional<ScanOutcome>> outcomes(4);
    const auto put = [&](std::size_t scan, const std::vector<Sample>& samples) {
      outcomes[scan].emplace();
      outcomes[scan]->moving.push_back({.error = {}, .score = moving_score(samples)});
    };
    put(0, {{5, moving_car, 1}, {5, house, 0}});
    put(1, {{5, moving_car, 1}, {5, moving_car, 0}, {15, house, 1}, {15, house, 0}});
    put(2, {{5, house, 1}});
    outcomes[3].emplace();
    outcomes[3]->moving.push_back({.error = "d: moving points map: no such file", .score = {}});
    const std::vector<LabelledScan> scans = {
        {"a", {}, {}}, {"b", {}, {}}, {"c", {}, {}}, {"d", {}, {}}};
    results_ = gather({}, scans, outcomes, std::array{MovingSource{"map", {}}});
  }

  Results results_;
};

TEST_F(MovingOverScans, MetricsAreOverThePointsOfAllScans) {
  const MovingCounts& all = results_.moving[0].all.pooled;
  EXPECT_DOUBLE_EQ(all.points.iou(), 2.0 / 5);
  EXPECT_DOUBLE_EQ(all.points.recall(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(all.points.precision(), 2.0 / 4);
  EXPECT_DOUBLE_EQ(all.kept_share(), 2.0 / 4);
}

TEST_F(MovingOverScans, MeanIouIsOverScansWithMovingPoints) {
  const Spread& iou = results_.moving[0].all.iou;
  EXPECT_EQ(iou.count, 2U);
  EXPECT_DOUBLE_EQ(iou.mean, (1.0 + 1.0 / 3) / 2);
}

TEST_F(MovingOverScans, ScansAreCountedWithoutMethods) {
  EXPECT_EQ(results_.scans, 4U);
  EXPECT_EQ(results_.moving[0].scans.size(), 3U);
  ASSERT_EQ(results_.failures.size(), 1U);
  EXPECT_EQ(results_.failures[0].scan, "d");
}

TEST_F(MovingOverScans, JsonHasTheBandsAndScansOfEachSource) {
  const nlohmann::ordered_json json = to_json(results_).at("moving").at(0);

  EXPECT_EQ(json.at("name"), "map");
  EXPECT_EQ(json.at("scans"), 3);
  EXPECT_EQ(json.at("iou"), 0.4);
  EXPECT_EQ(json.at("mean_iou").at("scans"), 2);
  EXPECT_EQ(json.at("moving_points"), 3);
  EXPECT_EQ(json.at("marked_points"), 4);
  ASSERT_EQ(json.at("by_range").size(), 4U);
  EXPECT_EQ(json.at("by_range").at(1).at("from"), 10);
  EXPECT_EQ(json.at("by_range").at(1).at("to"), 20);
  EXPECT_EQ(json.at("by_range").at(1).at("kept"), 0.5);
  EXPECT_TRUE(json.at("by_range").at(1).at("iou").is_null());
  ASSERT_EQ(json.at("per_scan").size(), 3U);
  EXPECT_EQ(json.at("per_scan").at(1).at("scan"), "b");
  EXPECT_EQ(json.at("per_scan").at(1).at("iou"), 1.0 / 3);
}

TEST_F(MovingOverScans, TheTableHasOneRowPerBand) {
  const std::string text = moving_table(results_);

  for (const char* part : {"0-10 m", "10-20 m", "20-40 m", "40-80 m", "all"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, AllOf(HasSubstr("40.00"), HasSubstr("66.67"), HasSubstr("n/a"),
                          HasSubstr("map: scored on 3 of 4 scans")));
}

TEST(ReadMoving, NumbersOfObjectsMove) {
  const io::TemporaryFolder folder;
  std::string file = io::npy_header(io::FieldType::uint16, 3);
  file += std::string("\x00\x00\x01\x00\xff\xff", 6);
  std::vector<std::uint32_t> marks;
  io::put_file(folder / "a.moving.npy", file);

  const Status status = read_moving(folder / "a.moving.npy", 3, marks);

  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_THAT(marks, ElementsAre(0, 1, 65535));
}

TEST(ReadMoving, LabelFilesContainClasses) {
  const io::TemporaryFolder folder;
  const std::vector<std::uint32_t> classes = {9, 250, 251, 252, 259, 260, (7U << 16U) | 253};
  ASSERT_TRUE(io::write_class_file(folder / "a.label", classes).ok());
  std::vector<std::uint32_t> marks;

  const Status status = read_moving(folder / "a.label", classes.size(), marks);

  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_THAT(marks, ElementsAre(0, 0, 1, 1, 1, 0, 1));
}

}  // namespace
}  // namespace flagstone::eval
