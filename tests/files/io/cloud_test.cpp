// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/cloud.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "files/io/bytes.hpp"
#include "files/io/cloud_generator.hpp"
#include "files/io/status_matchers.hpp"

namespace flagstone::io {
namespace {

using enum FieldType;
using ::testing::HasSubstr;

const std::vector<Field> xyz{{"x"}, {"y"}, {"z"}};

Cloud two_points() {
  Cloud cloud;
  const std::vector<float> values{1, 2, 3, 0.5F, 4, 5, 6, 0.25F};
  EXPECT_THAT(Cloud::from_floats(values, 4, cloud), is_ok());
  return cloud;
}

TEST(Cloud, ReleasesItsRowsAndIsThenEmpty) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}}, Bytes(36), cloud), is_ok());
  const std::byte* const place = cloud.bytes().data();

  const Bytes rows = cloud.release_rows();

  EXPECT_EQ(rows.data(), place);
  EXPECT_EQ(rows.size(), 36U);
  EXPECT_TRUE(cloud.empty());
  EXPECT_TRUE(cloud.fields().empty());
  EXPECT_TRUE(cloud.bytes().empty());
  EXPECT_TRUE(cloud.view().empty());
}

TEST(Cloud, PacksFieldsInTheirOrder) {
  Cloud cloud;
  const std::vector<Field> fields{{"t", float64}, {"x"}, {"y"}, {"z"}, {"n", int16, 3}};

  ASSERT_THAT(Cloud::from_rows(fields, Bytes(52), cloud), is_ok());

  EXPECT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.stride(), 26U);
  EXPECT_EQ(cloud.find("x")->offset, 8U);
  EXPECT_EQ(cloud.find("n")->offset, 20U);
  EXPECT_EQ(cloud.find("w"), nullptr);
}

TEST(Cloud, ViewOfFloatCoordinatesRefersToTheRows) {
  const Cloud cloud = two_points();

  EXPECT_EQ(cloud.view().data(), cloud.bytes().data());
  EXPECT_EQ(cloud.view()[1].y, 5.0F);
}

TEST(Cloud, ViewOfOtherCoordinatesIsConverted) {
  Cloud cloud;
  const std::vector<Field> fields{{"z", float64}, {"y", int16}, {"x", uint8}};
  const Bytes rows =
      joined({numbers({-0.5}), numbers<std::int16_t>({-300}), numbers<std::uint8_t>({200})});

  ASSERT_THAT(Cloud::from_rows(fields, rows, cloud), is_ok());

  EXPECT_EQ(cloud.view().size(), 1U);
  EXPECT_EQ(cloud.view()[0].x, 200.0F);
  EXPECT_EQ(cloud.view()[0].y, -300.0F);
  EXPECT_EQ(cloud.view()[0].z, -0.5F);
}

TEST(Cloud, ViewStaysValidWhenTheCloudIsCopiedAndMoved) {
  Cloud copy = two_points();
  const Cloud moved = std::move(copy);

  EXPECT_EQ(moved.view()[0].z, 3.0F);
}

TEST(Cloud, WithoutPointsHasAnEmptyView) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows(xyz, {}, cloud), is_ok());

  EXPECT_TRUE(cloud.empty());
  EXPECT_TRUE(cloud.view().empty());
}

TEST(Cloud, ValueReadsAnyElementOfAnyType) {
  Cloud cloud;
  const std::vector<Field> fields{{"x"}, {"y"}, {"z"}, {"n", int8, 2}, {"t", uint64}};
  const Bytes rows =
      joined({Bytes(12), numbers<std::int8_t>({-1, -2}), numbers<std::uint64_t>({7})});
  ASSERT_THAT(Cloud::from_rows(fields, rows, cloud), is_ok());

  EXPECT_EQ(cloud.value(0, *cloud.find("n"), 1), -2.0);
  EXPECT_EQ(cloud.value(0, *cloud.find("t")), 7.0);
}

TEST(Cloud, RejectsFieldsWithoutX) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"X"}, {"y"}, {"z"}}, {}, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("no field 'x'")));
}

TEST(Cloud, RejectsDuplicateNames) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {"y"}}, {}, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("'y' occurs twice")));
}

TEST(Cloud, AllowsRepeatedPadding) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"x"}, {"_"}, {"y"}, {"_"}, {"z"}}, Bytes(20), cloud), is_ok());
}

TEST(Cloud, RejectsCoordinatesOfSeveralNumbers) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"x", float32, 2}, {"y"}, {"z"}}, {}, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("'x' has count 2")));
}

TEST(Cloud, RejectsRowsThatAreTooLong) {
  Cloud cloud;
  const std::size_t huge = std::numeric_limits<std::size_t>::max() / 4 + 2;
  EXPECT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {"n", float32, huge}}, {}, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("rows of at most 65536 bytes")));
}

TEST(Cloud, RejectsFieldsWithCountZero) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {"n", float32, 0}}, {}, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("has count 0")));
}

TEST(Cloud, RejectsNamesThatAFormatCannotStore) {
  for (const char* name : {"", "a b", "a'", "a\\", "\n", "\xc3\xa9"}) {
    Cloud cloud;
    EXPECT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {name}}, {}, cloud),
                fails(StatusCode::invalid_argument, HasSubstr("printable ASCII")));
  }
}

TEST(Cloud, RejectsAnIncompleteRow) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows(xyz, Bytes(13), cloud),
              fails(StatusCode::invalid_argument, HasSubstr("13 bytes")));
}

TEST(Cloud, FromFloatsRejectsFewerThanThreePerPoint) {
  Cloud cloud;
  const std::vector<float> values(4);
  EXPECT_THAT(Cloud::from_floats(values, 2, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("2 floats per point")));
}

TEST(UnnamedFields, AreNamedByColumn) {
  const auto fields = unnamed_fields(7, float32);

  std::vector<std::string> names(fields.size());
  std::ranges::transform(fields, names.begin(), &Field::name);
  EXPECT_THAT(names, ::testing::ElementsAre("x", "y", "z", "intensity", "ring", "c5", "c6"));
}

TEST(WithLabels, AddsOneFieldAndKeepsTheRest) {
  const Cloud cloud = two_points();
  const std::vector labels{Label::ground, Label::invalid};
  Cloud labelled;

  ASSERT_THAT(with_labels(cloud, labels, labelled), is_ok());

  const Field* field = labelled.find("label");
  ASSERT_NE(field, nullptr);
  EXPECT_EQ(field->type, uint8);
  EXPECT_EQ(labelled.value(0, *field), 1.0);
  EXPECT_EQ(labelled.value(1, *field), 4.0);
  EXPECT_EQ(labelled.value(1, *labelled.find("intensity")), 0.25);
}

TEST(WithLabels, ReplacesExistingLabels) {
  Cloud cloud;
  const std::vector<Field> fields{{"x"}, {"label", uint32}, {"y"}, {"z"}};
  ASSERT_THAT(Cloud::from_rows(fields, numbers({1.0F, 9.0F, 2.0F, 3.0F}), cloud), is_ok());
  const std::vector labels{Label::noise};

  ASSERT_THAT(with_labels(cloud, labels, cloud), is_ok());

  EXPECT_EQ(cloud.fields().size(), 4U);
  EXPECT_EQ(cloud.fields().back().name, "label");
  EXPECT_EQ(cloud.value(0, cloud.fields().back()), 2.0);
  EXPECT_EQ(cloud.view()[0].y, 2.0F);
}

TEST(WithLabels, RejectsAnotherNumberOfLabels) {
  const Cloud cloud = two_points();
  Cloud out;
  EXPECT_THAT(with_labels(cloud, std::vector{Label::ground}, out),
              fails(StatusCode::invalid_argument, HasSubstr("1 labels for 2 points")));
}

TEST(WithHeights, AppendsAFloatField) {
  const Cloud cloud = two_points();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Cloud with;

  ASSERT_THAT(with_heights(cloud, std::vector{0.25F, nan}, with), is_ok());

  const Field& field = with.fields().back();
  EXPECT_EQ(field.name, "height");
  EXPECT_EQ(field.type, float32);
  EXPECT_EQ(with.value(0, field), 0.25);
  EXPECT_TRUE(std::isnan(with.value(1, field)));
  EXPECT_EQ(with.value(1, *with.find("intensity")), 0.25);
  EXPECT_EQ(with.view()[1].z, 6.0F);
}

TEST(WithHeights, ReplacesHeightsOfAnyType) {
  Cloud cloud;
  const std::vector<Field> fields{{"x"}, {"height", float64}, {"y"}, {"z"}};
  Bytes row = joined({numbers({1.0F}), numbers({9.0}), numbers({2.0F, 3.0F})});
  ASSERT_THAT(Cloud::from_rows(fields, row, cloud), is_ok());

  ASSERT_THAT(with_heights(cloud, std::vector{0.5F}, cloud), is_ok());

  EXPECT_EQ(cloud.fields().size(), 4U);
  EXPECT_EQ(cloud.fields().back().name, "height");
  EXPECT_EQ(cloud.value(0, cloud.fields().back()), 0.5);
  EXPECT_EQ(cloud.view()[0].z, 3.0F);
}

TEST(WithHeights, RejectsAnotherNumberOfHeights) {
  const Cloud cloud = two_points();
  Cloud out;
  EXPECT_THAT(with_heights(cloud, std::vector{1.0F}, out),
              fails(StatusCode::invalid_argument, HasSubstr("1 heights for 2 points")));
}

TEST(Select, KeepsTheGivenOrder) {
  const Cloud cloud = two_points();
  Cloud out;

  ASSERT_THAT(select(cloud, std::vector<std::size_t>{1, 0, 1}, out), is_ok());

  ASSERT_EQ(out.size(), 3U);
  EXPECT_EQ(out.view()[0].x, 4.0F);
  EXPECT_EQ(out.view()[1].x, 1.0F);
  EXPECT_EQ(out.value(2, *out.find("intensity")), 0.25);
}

TEST(Select, RejectsAnIndexOutOfRange) {
  const Cloud cloud = two_points();
  Cloud out;
  EXPECT_THAT(select(cloud, std::vector<std::size_t>{2}, out),
              fails(StatusCode::invalid_argument, HasSubstr("index 2 is out of range")));
}

TEST(Select, SelectsPointsByMask) {
  const Cloud cloud = two_points();
  Cloud out;

  ASSERT_THAT(select_where(cloud, std::vector<std::uint8_t>{0, 7}, out), is_ok());

  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out.view()[0].x, 4.0F);
}

TEST(Select, RejectsAMaskOfAnotherSize) {
  const Cloud cloud = two_points();
  Cloud out;
  EXPECT_THAT(select_where(cloud, std::vector<std::uint8_t>{1}, out),
              fails(StatusCode::invalid_argument, HasSubstr("a mask of size 1 for 2 points")));
}

RC_GTEST_PROP(Select, MaskAndItsOppositeSelectEachPointOnce, ()) {
  const Cloud cloud = *arbitrary_cloud();
  const auto mask = *rc::gen::container<std::vector<std::uint8_t>>(
      cloud.size(), rc::gen::inRange<std::uint8_t>(0, 2));
  std::vector<std::uint8_t> opposite(mask.size());
  std::ranges::transform(mask, opposite.begin(), std::logical_not<>());
  Cloud kept;
  Cloud rest;

  RC_ASSERT(select_where(cloud, mask, kept).ok());
  RC_ASSERT(select_where(cloud, opposite, rest).ok());

  RC_ASSERT(kept.size() + rest.size() == cloud.size());
  std::size_t from_kept = 0;
  std::size_t from_rest = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto row = mask[i] != 0
                         ? kept.bytes().subspan(from_kept++ * cloud.stride(), cloud.stride())
                         : rest.bytes().subspan(from_rest++ * cloud.stride(), cloud.stride());
    RC_ASSERT(std::ranges::equal(row, cloud.bytes().subspan(i * cloud.stride(), cloud.stride())));
  }
}

}  // namespace
}  // namespace flagstone::io
