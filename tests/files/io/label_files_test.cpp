// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/label_files.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "files/io/bytes.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector all_labels{Label::nonground, Label::ground, Label::noise, Label::out_of_range,
                             Label::invalid};

TEST(LabelFile, ContainsOneCodePerPoint) {
  const TemporaryFolder folder;

  ASSERT_THAT(write_label_file(folder / "a.label", all_labels, LabelMap::flagstone), is_ok());

  const Bytes expected = numbers<std::uint32_t>({0, 1, 2, 3, 4});
  EXPECT_EQ(contents_of(folder / "a.label"), as_text(expected));
}

TEST(LabelFile, UsesRoadForGroundWithSemanticKittiCodes) {
  const TemporaryFolder folder;

  ASSERT_THAT(write_label_file(folder / "a.label", all_labels, LabelMap::semantic_kitti), is_ok());

  const Bytes expected = numbers<std::uint32_t>({0, 40, 0, 0, 0});
  EXPECT_EQ(contents_of(folder / "a.label"), as_text(expected));
}

TEST(LabelFile, ContainsTheSameCodesAsANumPyArray) {
  const TemporaryFolder folder;

  ASSERT_THAT(LabelWriter(LabelMap::flagstone).write_label_npy(folder / "a.npy", all_labels),
              is_ok());
  ASSERT_THAT(LabelWriter(LabelMap::semantic_kitti).write_label_npy(folder / "b.npy", all_labels),
              is_ok());

  std::vector<std::uint32_t> classes;
  ASSERT_THAT(read_reference(folder / "a.npy", 5, classes), is_ok());
  EXPECT_THAT(classes, ElementsAre(0, 1, 2, 3, 4));
  ASSERT_THAT(read_reference(folder / "b.npy", 5, classes), is_ok());
  EXPECT_THAT(classes, ElementsAre(0, 40, 0, 0, 0));
  EXPECT_THAT(contents_of(folder / "b.npy"), ::testing::EndsWith(std::string("\0\x28\0\0\0", 5)));
}

TEST(LabelFile, ContainsNothingOfThePreviousScan) {
  const TemporaryFolder folder;
  LabelWriter writer;
  const std::vector<Label> more(1000, Label::ground);
  ASSERT_THAT(writer.write_label_file(folder / "more.label", more), is_ok());
  ASSERT_THAT(writer.write_label_npy(folder / "more.npy", more), is_ok());

  ASSERT_THAT(writer.write_label_file(folder / "a.label", all_labels), is_ok());
  ASSERT_THAT(writer.write_label_npy(folder / "a.npy", all_labels), is_ok());

  for (const std::string name : {"a.label", "a.npy"}) {
    std::vector<Label> labels;
    ASSERT_THAT(read_labels(folder / name, all_labels.size(), labels), is_ok());
    EXPECT_EQ(labels, all_labels) << name;
  }
}

TEST(LabelFile, ReportsThePathThatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(write_label_file(folder / "none" / "a.label", all_labels, LabelMap::flagstone),
              fails(StatusCode::unwritable, HasSubstr("none/a.label: ")));
}

RC_GTEST_PROP(LabelFile, ReadsBackInBothFormats, ()) {
  const auto labels = *rc::gen::container<std::vector<Label>>(rc::gen::elementOf(all_labels));
  const TemporaryFolder folder;
  std::vector<Label> from_label;
  std::vector<Label> from_npy;

  RC_ASSERT(write_label_file(folder / "a.label", labels, LabelMap::flagstone).ok());
  RC_ASSERT(LabelWriter().write_label_npy(folder / "a.npy", labels).ok());

  RC_ASSERT(read_labels(folder / "a.label", labels.size(), from_label).ok());
  RC_ASSERT(read_labels(folder / "a.npy", labels.size(), from_npy).ok());
  RC_ASSERT(from_label == labels);
  RC_ASSERT(from_npy == labels);
}

TEST(LabelFile, RejectsAnUnknownCode) {
  const TemporaryFolder folder;
  ASSERT_THAT(write_class_file(folder / "a.label", std::vector<std::uint32_t>{0, 5}), is_ok());
  std::vector<Label> labels;
  EXPECT_THAT(read_labels(folder / "a.label", 2, labels),
              fails(StatusCode::bad_file, HasSubstr("a.label: the label of point 1 is 5")));
}

TEST(Reference, ReadsTheClassFromTheLowSixteenBits) {
  std::vector<std::uint32_t> classes;
  ASSERT_THAT(parse_reference(numbers<std::uint32_t>({0x00070028, 0xffff0000}), ClassFormat::label,
                              2, classes),
              is_ok());
  EXPECT_THAT(classes, ElementsAre(40, 0));
}

TEST(Reference, ReadsOneBytePerPointFromLidarseg) {
  std::vector<std::uint32_t> classes;
  ASSERT_THAT(parse_reference(numbers<std::uint8_t>({24, 255}), ClassFormat::lidarseg, 2, classes),
              is_ok());
  EXPECT_THAT(classes, ElementsAre(24, 255));
}

Bytes npy_file(const std::string& descr, const std::string& shape, const Bytes& items) {
  const std::string text =
      "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + "}\n";
  return joined({bytes_of("\x93NUMPY"), numbers<std::uint8_t>({1, 0}),
                 numbers({static_cast<std::uint16_t>(text.size())}), bytes_of(text), items});
}

TEST(Reference, ReadsIntegerArrays) {
  std::vector<std::uint32_t> classes;
  ASSERT_THAT(
      parse_reference(npy_file(">i8", "(1, 1)", numbers<std::uint8_t>({0, 0, 0, 0, 0, 0, 1, 2})),
                      ClassFormat::npy, 1, classes),
      is_ok());
  EXPECT_THAT(classes, ElementsAre(258));
}

TEST(Reference, RejectsArraysThatAreNotLabels) {
  std::vector<std::uint32_t> classes;
  const auto parse = [&](const Bytes& file) {
    return parse_reference(file, ClassFormat::npy, 2, classes);
  };
  EXPECT_THAT(parse(npy_file("<f4", "(2,)", Bytes(8))),
              is_bad_at(20, "labels are float32 (expected integers)"));
  EXPECT_THAT(parse(npy_file("<i4", "(1, 2)", Bytes(8))),
              fails(StatusCode::bad_file, HasSubstr("expected N or N x 1")));
  EXPECT_THAT(parse(npy_file("<i4", "()", Bytes(8))),
              fails(StatusCode::bad_file, HasSubstr("expected N or N x 1")));
  EXPECT_THAT(parse(npy_file("<i4", "(18446744073709551615,)", Bytes(8))),
              fails(StatusCode::bad_file, HasSubstr("8 bytes follow")));
  EXPECT_THAT(parse(npy_file("<i4", "(2,)", Bytes(7))),
              fails(StatusCode::bad_file, HasSubstr("7 bytes follow")));
}

TEST(Reference, RejectsInvalidClasses) {
  std::vector<std::uint32_t> classes;
  const Bytes negative = npy_file("<i4", "(2,)", numbers<std::int32_t>({1, -1}));
  EXPECT_THAT(parse_reference(negative, ClassFormat::npy, 2, classes),
              is_bad_at(negative.size() - 4, "label of point 1 is out of range (expected 0 to"));
  const Bytes large = npy_file("<u8", "(1,)", numbers<std::uint64_t>({1ULL << 32U}));
  EXPECT_THAT(parse_reference(large, ClassFormat::npy, 1, classes),
              is_bad_at(large.size() - 8, "label of point 0 is out of range"));
  EXPECT_TRUE(classes.empty());
}

TEST(Reference, ReportsBothNumbersIfTheyDiffer) {
  std::vector<std::uint32_t> classes;
  EXPECT_THAT(parse_reference(Bytes(8), ClassFormat::label, 3, classes),
              is_bad_at(8, "contains 2 labels, but the scan has 3 points"));
  EXPECT_THAT(parse_reference(Bytes(8), ClassFormat::label, 1, classes),
              is_bad_at(4, "contains 2 labels, but the scan has 1 points"));
  EXPECT_THAT(parse_reference(Bytes(8), ClassFormat::lidarseg, 2, classes),
              is_bad_at(2, "contains 8 labels, but the scan has 2 points"));
  EXPECT_THAT(
      parse_reference(npy_file("<i2", "(4,)", Bytes(8)), ClassFormat::npy, 3, classes),
      fails(StatusCode::bad_file, HasSubstr("contains 4 labels, but the scan has 3 points")));
}

TEST(Reference, ReportsTheSizeOfAnIncompleteLabel) {
  std::vector<std::uint32_t> classes;
  EXPECT_THAT(parse_reference(Bytes(7), ClassFormat::label, 2, classes),
              is_bad_at(4, "7 bytes are not a whole number of labels"));
}

TEST(Reference, IsReadByExtension) {
  const TemporaryFolder folder;
  put_file(folder / "a.label", std::string(8, '\1'));
  put_file(folder / "a_lidarseg.bin", std::string(8, '\1'));
  std::vector<std::uint32_t> classes;

  EXPECT_THAT(read_reference(folder / "a.label", 2, classes), is_ok());
  EXPECT_THAT(read_reference(folder / "a_lidarseg.bin", 8, classes), is_ok());
  EXPECT_THAT(read_reference(folder / "a.txt", 8, classes),
              fails(StatusCode::invalid_argument, HasSubstr("expected .label, .bin or .npy")));
  EXPECT_THAT(read_reference(folder / "b.label", 8, classes),
              fails(StatusCode::not_found, HasSubstr("b.label: ")));
  const auto path = folder / "a.label";
  EXPECT_THAT(read_reference(path, 3, classes),
              fails(StatusCode::bad_file,
                    AllOf(StartsWith(path.string() + ": byte 8: "), HasSubstr("2 labels"))));
}

}  // namespace
}  // namespace flagstone::io
