// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/derived_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <string>

#include "files/io/status_matchers.hpp"
#include "files/ros/livox_message.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

using enum PointFieldType;
using io::fails;
using io::is_ok;
using io::joined;
using io::numbers;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::array two_labels{Label::ground, Label::nonground};
const std::array two_heights{0.25F, -1.5F};

/// A parsed message and a message derived from it.
struct Derived {
  explicit Derived(const CloudMessage& message) : source_bytes(message.bytes()) {
    EXPECT_THAT(parse(source_bytes, message.format.encoding, source), is_ok());
  }

  void append(std::initializer_list<AddedField> added) {
    const std::vector<AddedField> fields(added);
    EXPECT_THAT(derived.append(source, fields), is_ok());
    parse_result();
  }

  void select(const Selection& selection, std::initializer_list<AddedField> added = {}) {
    const std::vector<AddedField> fields(added);
    EXPECT_THAT(derived.select(source, selection, fields), is_ok());
    parse_result();
  }

  void parse_result() {
    EXPECT_THAT(derived.write_message(bytes), is_ok());
    EXPECT_THAT(parse(bytes, source.format.encoding, result), is_ok());
  }

  Bytes source_bytes;
  PointCloud2View source;
  DerivedCloud derived;
  Bytes bytes;
  PointCloud2View result;
};

/// The bytes of a field of one point.
Bytes bytes_of(const PointCloud2View& cloud, const std::string& name, std::size_t row,
               std::size_t column) {
  const PointField* const field = cloud.find(name);
  if (field == nullptr) return {};
  const auto data = cloud.data.subspan(
      row * cloud.row_stride() + column * cloud.point_stride() + field->offset, field->size());
  return {data.begin(), data.end()};
}

class DerivedInAnyFormat : public ::testing::TestWithParam<MessageFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, DerivedInAnyFormat, ::testing::ValuesIn(all_formats));

TEST_P(DerivedInAnyFormat, HasLabelAndHeightAfterTheFieldsOfTheSource) {
  Derived derived(small_message(GetParam()));

  derived.append({label_field(two_labels), height_field(two_heights)});

  CloudMessage expected = small_message(GetParam());
  expected.fields.push_back({"label", 18, uint8, 1});
  expected.fields.push_back({"height", 20, float32, 1});
  expected.point_step = 24;
  expected.row_step = 48;
  expected.data =
      joined({numbers({1.F, 2.F, 3.F, 40.F}), numbers<std::uint16_t>({5}),
              numbers<std::uint8_t>({1, 0}), numbers({0.25F}), numbers({-1.F, -2.F, -3.F, 50.F}),
              numbers<std::uint16_t>({6}), numbers<std::uint8_t>({0, 0}), numbers({-1.5F})});
  EXPECT_EQ(derived.bytes, expected.bytes());
}

TEST_P(DerivedInAnyFormat, HasTheSelectedPoints) {
  Derived derived(small_message(GetParam()));

  derived.select(Selection(two_labels, {Label::nonground}));

  CloudMessage expected = small_message(GetParam());
  expected.width = 1;
  expected.row_step = 18;
  expected.data.erase(expected.data.begin(), expected.data.begin() + 18);
  EXPECT_EQ(derived.bytes, expected.bytes());
}

TEST(DerivedCloud, OfNoAddedFieldsIsTheSource) {
  Derived derived(small_message());
  derived.append({});
  EXPECT_EQ(derived.bytes, derived.source_bytes);
}

TEST(DerivedCloud, KeepsRowsAndRemovesTheirPadding) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 21;
  message.data.insert(message.data.begin() + 18, 3, std::byte{0xff});
  Derived derived(message);

  derived.append({label_field(two_labels)});

  EXPECT_EQ(derived.result.height, 2U);
  EXPECT_EQ(derived.result.width, 1U);
  EXPECT_EQ(derived.result.row_step, 19U);
  EXPECT_EQ(bytes_of(derived.result, "x", 1, 0), numbers({-1.F}));
  EXPECT_EQ(bytes_of(derived.result, "label", 0, 0), numbers<std::uint8_t>({1}));
  EXPECT_EQ(bytes_of(derived.result, "label", 1, 0), numbers<std::uint8_t>({0}));
}

TEST(DerivedCloud, SelectedFromRowsIsNotOrganized) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 21;
  message.data.insert(message.data.begin() + 18, 3, std::byte{0xff});
  Derived derived(message);

  derived.select(Selection(std::array<std::uint8_t, 2>{7, 1}), {height_field(two_heights)});

  EXPECT_EQ(derived.result.height, 1U);
  EXPECT_EQ(derived.result.width, 2U);
  EXPECT_EQ(bytes_of(derived.result, "x", 0, 1), numbers({-1.F}));
  EXPECT_EQ(bytes_of(derived.result, "height", 0, 1), numbers({-1.5F}));
}

TEST(DerivedCloud, SelectsTheValuesOfAddedFieldsToo) {
  Derived derived(small_message());

  derived.select(Selection(std::array<std::uint8_t, 2>{0, 1}),
                 {height_field(two_heights), label_field(two_labels)});

  EXPECT_EQ(derived.result.width, 1U);
  EXPECT_EQ(bytes_of(derived.result, "height", 0, 0), numbers({-1.5F}));
  EXPECT_EQ(bytes_of(derived.result, "label", 0, 0), numbers<std::uint8_t>({0}));
  EXPECT_EQ(bytes_of(derived.result, "ring", 0, 0), numbers<std::uint16_t>({6}));
}

TEST(DerivedCloud, CanHaveNoPointsButHasTheAddedFields) {
  Derived derived(small_message());
  derived.select(Selection(std::array<std::uint8_t, 2>{0, 0}), {label_field(two_labels)});
  EXPECT_EQ(derived.result.size(), 0U);
  EXPECT_NE(derived.result.find("label"), nullptr);

  CloudMessage empty;
  Derived from_nothing(empty);
  from_nothing.append({label_field({}), height_field({})});
  EXPECT_EQ(from_nothing.result.fields.size(), 2U);
  EXPECT_EQ(from_nothing.result.point_step, 8U);
}

TEST(DerivedCloud, WritesAddedNumbersInTheByteOrderOfThePoints) {
  CloudMessage message = small_message();
  message.is_bigendian = true;
  Derived derived(message);

  derived.append({height_field(two_heights)});

  EXPECT_TRUE(derived.result.is_bigendian);
  EXPECT_EQ(bytes_of(derived.result, "height", 0, 0), numbers<std::uint8_t>({0x3e, 0x80, 0, 0}));
}

TEST(DerivedCloud, CanHaveAddedFieldsOfEveryType) {
  const Bytes values =
      numbers<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
  for (const bool big : {false, true}) {
    for (std::uint8_t type = 1; type <= 11; ++type) {
      CloudMessage message = small_message();
      message.is_bigendian = big;
      Derived derived(message);
      const std::size_t size = size_of(static_cast<PointFieldType>(type));

      derived.append(
          {{"new", static_cast<PointFieldType>(type), std::span(values).first(2 * size)}});

      Bytes second(values.begin() + static_cast<std::ptrdiff_t>(size),
                   values.begin() + static_cast<std::ptrdiff_t>(2 * size));
      if (big) std::ranges::reverse(second);
      EXPECT_EQ(bytes_of(derived.result, "new", 0, 1), second);
      EXPECT_EQ(derived.result.find("new")->offset % size, 0U);
      EXPECT_EQ(derived.result.point_step % size, 0U);
    }
  }
}

TEST(DerivedCloud, ReplacesAFieldOfTheSameNameAndTypeInItsPosition) {
  CloudMessage message = small_message();
  message.fields[3].name = "height";
  Derived derived(message);

  derived.append({height_field(two_heights)});

  EXPECT_EQ(derived.result.fields, message.fields);
  EXPECT_EQ(derived.result.point_step, message.point_step);
  EXPECT_EQ(bytes_of(derived.result, "height", 0, 0), numbers({0.25F}));
  EXPECT_EQ(bytes_of(derived.result, "height", 0, 1), numbers({-1.5F}));
  EXPECT_EQ(bytes_of(derived.result, "ring", 0, 1), numbers<std::uint16_t>({6}));
}

TEST(DerivedCloud, DoesNotOverwriteAFieldThatAFieldOfUnknownTypeMayOverlap) {
  CloudMessage message = small_message();
  message.fields[3].name = "height";
  message.fields[4].type = static_cast<PointFieldType>(12);
  Derived derived(message);

  derived.append({height_field(two_heights)});

  EXPECT_EQ(derived.result.find("height")->offset, 20U);
}

TEST(DerivedCloud, HasAReplacedFieldOnce) {
  CloudMessage message = small_message();
  message.fields[3].name = "height";
  message.fields.push_back({"height", 16, uint8, 1});
  message.fields.erase(message.fields.begin() + 4);  // ring, which would overlap
  Derived derived(message);

  derived.append({height_field(two_heights)});

  EXPECT_EQ(std::ranges::count(derived.result.fields, "height", &PointField::name), 1);
  EXPECT_EQ(derived.result.find("height")->offset, 12U);
}

TEST(DerivedCloud, OfALabelledCloudHasTheSameLayout) {
  Derived once(small_message());
  once.append({label_field(two_labels), height_field(two_heights)});
  DerivedCloud twice;
  Bytes bytes;
  const std::vector<AddedField> fields{label_field(two_labels), height_field(two_heights)};

  ASSERT_THAT(twice.append(once.result, fields), is_ok());
  ASSERT_THAT(twice.write_message(bytes), is_ok());

  EXPECT_EQ(bytes, once.bytes);
}

TEST(DerivedCloud, RemovesAFieldOfTheSameNameAndAnotherType) {
  CloudMessage message = small_message();
  message.fields[4].name = "label";  // uint16
  Derived derived(message);

  derived.append({label_field(two_labels)});

  EXPECT_EQ(std::ranges::count(derived.result.fields, "label", &PointField::name), 1);
  EXPECT_EQ(derived.result.find("label")->offset, 18U);
  EXPECT_EQ(derived.result.find("label")->type, uint8);
  EXPECT_EQ(bytes_of(derived.result, "label", 0, 0), numbers<std::uint8_t>({1}));
  EXPECT_EQ(bytes_of(derived.result, "intensity", 0, 1), numbers({50.F}));
}

TEST(DerivedCloud, DoesNotOverwriteAFieldThatOverlapsTheReplacedOne) {
  CloudMessage message = small_message();
  message.fields[3].name = "height";
  message.fields.push_back({"high_bits", 14, uint16, 1});
  Derived derived(message);

  derived.append({height_field(two_heights)});

  EXPECT_EQ(derived.result.find("height")->offset, 20U);
  EXPECT_EQ(bytes_of(derived.result, "high_bits", 0, 0),
            bytes_of(derived.source, "high_bits", 0, 0));
}

TEST(DerivedCloud, CopiesPointsOfAnySize) {
  for (std::uint32_t step = 1; step < 150; ++step) {
    CloudMessage message;
    message.width = 1000;
    message.point_step = step;
    message.row_step = 1000 * step;
    message.data.resize(std::size_t{1000} * step);
    for (std::size_t i = 0; i < message.data.size(); ++i) {
      message.data[i] = static_cast<std::byte>(i * 31 + i / 251);
    }
    std::vector<Label> labels(1000);
    std::vector<float> heights(1000);
    for (std::size_t i = 0; i < 1000; ++i) {
      labels[i] = static_cast<Label>((i * i / 7) % 5);
      heights[i] = static_cast<float>(i);
    }
    Derived all(message);
    all.append({label_field(labels), height_field(heights)});
    Derived some(message);
    some.select(Selection(labels, {Label::ground, Label::noise}), {height_field(heights)});

    std::size_t kept = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
      const auto original = std::span<const std::byte>(message.data).subspan(i * step, step);
      const auto copy = all.result.data.subspan(i * all.result.point_step);
      ASSERT_TRUE(std::ranges::equal(original, copy.first(step)));
      ASSERT_EQ(bytes_of(all.result, "height", 0, i), numbers({heights[i]}));
      ASSERT_EQ(bytes_of(all.result, "label", 0, i), numbers({labels[i]}));
      if (labels[i] != Label::ground && labels[i] != Label::noise) continue;
      const auto selected = some.result.data.subspan(kept * some.result.point_step);
      ASSERT_TRUE(std::ranges::equal(original, selected.first(step)));
      ASSERT_EQ(bytes_of(some.result, "height", 0, kept), numbers({heights[i]}));
      ++kept;
    }
    ASSERT_EQ(some.result.size(), kept);
  }
}

TEST(DerivedCloud, ClearsTheBytesBetweenFields) {
  Derived derived(small_message());
  derived.append({height_field(two_heights)});
  Bytes dirty(derived.derived.data_size(), std::byte{0xff});
  derived.derived.write_data(dirty);
  EXPECT_EQ(dirty[18], std::byte{0});
  EXPECT_EQ(dirty[19], std::byte{0});
  EXPECT_TRUE(std::ranges::equal(dirty, derived.result.data));
}

TEST_P(DerivedInAnyFormat, CanBeMadeFromALivoxMessage) {
  const Bytes message = livox_message(GetParam(), 5);
  PointCloud2View source;
  LivoxMessage livox;
  ASSERT_THAT(parse_livox(message, GetParam().encoding, source, livox), is_ok());
  const std::vector<Label> labels(5, Label::ground);
  const std::vector<AddedField> fields{label_field(labels)};
  DerivedCloud derived;
  Bytes bytes;

  ASSERT_THAT(derived.append(source, fields), is_ok());
  ASSERT_THAT(derived.write_message(bytes), is_ok());

  PointCloud2View result;
  ASSERT_THAT(parse(bytes, GetParam().encoding, result), is_ok());
  EXPECT_EQ(result.format, GetParam());
  EXPECT_EQ(derived.layout().padded_point_step, 0U);
  EXPECT_EQ(result.point_step, 20U);
  EXPECT_EQ(result.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    for (const PointField& field : source.fields) {
      EXPECT_EQ(bytes_of(result, std::string(field.name), 0, i),
                bytes_of(source, std::string(field.name), 0, i));
    }
    EXPECT_EQ(bytes_of(result, "label", 0, i), numbers<std::uint8_t>({1}));
  }
}

TEST(DerivedCloudError, LeavesAnEmptyResult) {
  Derived derived(small_message());
  const std::array one{Label::ground};
  const std::vector<AddedField> fields{label_field(one)};

  EXPECT_THAT(
      derived.derived.append(derived.source, fields),
      fails(StatusCode::invalid_argument,
            HasSubstr("field 'label' has 1 bytes for 2 points (expected 1 bytes per point)")));

  EXPECT_EQ(derived.derived.data_size(), 0U);
  EXPECT_TRUE(derived.derived.layout().fields.empty());
  derived.derived.write_data({});
}

TEST(DerivedCloudError, IsReportedForAnotherNumberOfSelectedPoints) {
  Derived derived(small_message());
  EXPECT_THAT(derived.derived.select(derived.source, Selection(std::array<std::uint8_t, 3>{})),
              fails(StatusCode::invalid_argument,
                    HasSubstr("the selection has 3 values for 2 points (expected one per point)")));
}

TEST(DerivedCloudError, IsReportedForDuplicateAndUnknownFields) {
  Derived derived(small_message());
  const std::vector<AddedField> twice{label_field(two_labels), label_field(two_labels)};
  EXPECT_THAT(derived.derived.append(derived.source, twice),
              fails(StatusCode::invalid_argument, HasSubstr("field 'label' is added twice")));
  const std::vector<AddedField> unknown{{"new", static_cast<PointFieldType>(12), {}}};
  EXPECT_THAT(derived.derived.append(derived.source, unknown),
              fails(StatusCode::invalid_argument, HasSubstr("field 'new' has datatype 12")));
}

TEST(DerivedCloudError, IsReportedBeyondTheLimitsOfAMessage) {
  CloudMessage message = small_message();
  message.fields.resize(max_point_fields, message.fields[4]);
  Derived full(message);
  const std::vector<AddedField> fields{label_field(two_labels)};
  EXPECT_THAT(
      full.derived.append(full.source, fields),
      fails(StatusCode::invalid_argument, HasSubstr("1025 fields do not fit in a message")));

  PointCloud2View long_point;
  long_point.height = 1;
  long_point.point_step = 0xffffffffU;
  const std::vector<AddedField> none{label_field({})};
  EXPECT_THAT(DerivedCloud().append(long_point, none),
              fails(StatusCode::invalid_argument, HasSubstr("does not fit in a point")));
  long_point.point_step = 0xfffffff0U;
  const std::vector<AddedField> rounded{height_field({}), {"last", uint64, {}}, label_field({})};
  EXPECT_THAT(DerivedCloud().append(long_point, rounded),
              fails(StatusCode::invalid_argument, HasSubstr("does not fit in a point")));
  const std::vector<AddedField> labelled{height_field({}), label_field({})};
  long_point.point_step = 0xfffffff8U;
  EXPECT_THAT(DerivedCloud().append(long_point, labelled),
              fails(StatusCode::invalid_argument, HasSubstr("do not fit in a message")));
}

TEST(Selection, CountsAndKeepsPoints) {
  const std::array labels{Label::ground, Label::invalid, Label::noise, Label::ground};
  const Selection ground(labels, {Label::ground});
  EXPECT_EQ(ground.size(), 4U);
  EXPECT_EQ(ground.count(), 2U);
  std::array<std::uint8_t, 3> kept{};
  ground.get(1, kept);
  EXPECT_THAT(kept, ElementsAre(0, 0, 1));
  const std::array<std::uint8_t, 4> mask{0, 1, 0, 200};
  Selection(mask).get(1, kept);
  EXPECT_THAT(kept, ElementsAre(1, 0, 1));
}

}  // namespace
}  // namespace flagstone::ros
