// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/npy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "files/io/bytes.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::io {
namespace {

using enum FieldType;
using ::testing::HasSubstr;

constexpr std::size_t dictionary_at = 10;  // after magic, version and a length of two bytes

Bytes npy_file(const std::string& dictionary, const Bytes& items, char version = 1) {
  const std::string text = dictionary + "\n";
  const auto length = version == 1 ? numbers({static_cast<std::uint16_t>(text.size())})
                                   : numbers({static_cast<std::uint32_t>(text.size())});
  return joined({bytes_of("\x93NUMPY"), numbers({version, '\0'}), length, bytes_of(text), items});
}

std::string dictionary(const std::string& descr, const std::string& shape,
                       const std::string& order = "False") {
  return "{'descr': " + descr + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

Status error_of(const Bytes& file) {
  Cloud cloud;
  Status status = read_npy(file, cloud);
  EXPECT_TRUE(cloud.fields().empty()) << "a failed read changed its result";
  return status;
}

Status error_of(const std::string& text, std::size_t items = 0) {
  return error_of(npy_file(text, Bytes(items)));
}

TEST(Npy, ReadsFloatsInCOrder) {
  Cloud cloud;
  ASSERT_THAT(read_npy(npy_file(dictionary("'<f4'", "(2, 4)"),
                                numbers({1.F, 2.F, 3.F, 4.F, 5.F, 6.F, 7.F, 8.F})),
                       cloud),
              is_ok());

  EXPECT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.view()[1].x, 5.0F);
  EXPECT_EQ(cloud.value(1, *cloud.find("intensity")), 8.0);
}

TEST(Npy, ReadsDoublesInFortranOrder) {
  Cloud cloud;
  ASSERT_THAT(
      read_npy(npy_file(dictionary("'<f8'", "(2, 3)", "True"), numbers({1., 2., 3., 4., 5., 6.})),
               cloud),
      is_ok());

  EXPECT_EQ(cloud.view()[1].x, 2.0F);
  EXPECT_EQ(cloud.view()[0].z, 5.0F);
}

TEST(Npy, ReadsBigEndian) {
  Cloud cloud;
  const Bytes items = numbers<std::uint8_t>({0x3f, 0x80, 0, 0, 0x40, 0, 0, 0, 0xbf, 0x80, 0, 0});
  ASSERT_THAT(read_npy(npy_file(dictionary("'>f4'", "(1, 3)"), items), cloud), is_ok());

  EXPECT_EQ(cloud.view()[0].x, 1.0F);
  EXPECT_EQ(cloud.view()[0].y, 2.0F);
  EXPECT_EQ(cloud.view()[0].z, -1.0F);
}

TEST(Npy, ReadsVersionsTwoAndThree) {
  for (const char version : {'\x02', '\x03'}) {
    Cloud cloud;
    EXPECT_THAT(read_npy(npy_file(dictionary("'<f4'", "(1, 3)"), Bytes(12), version), cloud),
                is_ok());
    EXPECT_EQ(cloud.size(), 1U);
  }
}

TEST(Npy, ReadsIntegers) {
  Cloud cloud;
  ASSERT_THAT(
      read_npy(npy_file(dictionary("'<i2'", "(1, 3)"), numbers<std::int16_t>({-1, 2, 3})), cloud),
      is_ok());
  EXPECT_EQ(cloud.view()[0].x, -1.0F);
}

TEST(Npy, ReadsRecordsWithPaddingAndMixedByteOrder) {
  Cloud cloud;
  const std::string descr =
      "[('x', '<f4'), ('', '|V4'), ('y', '>i2'), (\"z\", '<f8'), ('n', '|u1', (2, 2)), ('m', "
      "'<u2', 3)]";
  const Bytes record =
      joined({numbers({1.0F}), Bytes(4), numbers<std::uint8_t>({0x01, 0x02}), numbers({3.0}),
              numbers<std::uint8_t>({5, 6, 7, 8}), numbers<std::uint16_t>({9, 10, 11})});

  ASSERT_THAT(read_npy(npy_file(dictionary(descr, "(1,)"), record), cloud), is_ok());

  EXPECT_EQ(cloud.view()[0].y, 258.0F);
  EXPECT_EQ(cloud.view()[0].z, 3.0F);
  EXPECT_EQ(cloud.value(0, *cloud.find("n"), 3), 8.0);
  EXPECT_EQ(cloud.value(0, *cloud.find("m"), 2), 11.0);
}

TEST(Npy, ReadsNoPoints) {
  Cloud cloud;
  EXPECT_THAT(read_npy(npy_file(dictionary("'<f4'", "(0, 4)"), {}), cloud), is_ok());
  EXPECT_EQ(cloud.fields().size(), 4U);
}

TEST(Npy, ReadsNoPointsInFortranOrder) {  // found by fuzzing: arithmetic on a null pointer
  Cloud cloud;
  EXPECT_THAT(read_npy(npy_file(dictionary("'>u8'", "(0, 7)", "True"), {}), cloud), is_ok());
  EXPECT_EQ(cloud.fields().size(), 7U);
}

TEST(Npy, ReadsLongsOfPythonTwo) {
  Cloud cloud;
  EXPECT_THAT(read_npy(npy_file(dictionary("'<f4'", "(1L, 3L)"), Bytes(12)), cloud), is_ok());
}

TEST(NpyHeader, MustStartWithTheMagicBytes) {
  EXPECT_THAT(error_of(Bytes()), is_bad_at(0, R"(\x93NUMPY)"));
  EXPECT_THAT(error_of(bytes_of("PK\x03\x04")), is_bad_at(0, R"(\x93NUMPY)"));
}

TEST(NpyHeader, RejectsTruncationAnywhere) {
  const Bytes whole = npy_file(dictionary("'<f4'", "(1, 3)"), Bytes(12));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(
        error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))).code(),
        StatusCode::bad_file);
  }
}

TEST(NpyHeader, RejectsUnknownVersions) {
  EXPECT_THAT(error_of(npy_file(dictionary("'<f4'", "(1, 3)"), Bytes(12), '\x04')),
              is_bad_at(6, "NumPy format 4"));
}

TEST(NpyHeader, RejectsALengthBeyondTheFile) {
  const Bytes file = joined(
      {bytes_of("\x93NUMPY"), numbers<std::uint8_t>({2, 0, 0xff, 0xff, 0xff, 0xff}), Bytes(8)});
  EXPECT_THAT(error_of(file), is_bad_at(20, "8 bytes of the NumPy header (expected 4294967295;"));
}

TEST(NpyHeader, MustBeADictionaryOfThreeKeys) {
  EXPECT_THAT(error_of("[]"), is_bad_at(dictionary_at, "a dictionary"));
  EXPECT_THAT(error_of("{'descr': '<f4'}"), is_bad_at(dictionary_at + 16, "once each"));
  EXPECT_THAT(error_of("{'color': 1}"), is_bad_at(dictionary_at + 9, "once each"));
  EXPECT_THAT(error_of("{'descr': '<f4', 'descr': '<f4'}"),
              is_bad_at(dictionary_at + 25, "once each"));
  EXPECT_THAT(error_of("{'descr"), is_bad_at(dictionary_at + 1, "a quoted key"));
  EXPECT_THAT(error_of(dictionary("'<f4'", "(1, 3)", "Maybe")),
              fails(StatusCode::bad_file, HasSubstr("True or False")));
}

TEST(NpyHeader, RejectsOtherTypes) {
  for (const char* type : {"<f2", "<c8", "|S4", "<U4", "|O", "<M8[ns]", "|V4", "", "f", "<f16"}) {
    EXPECT_THAT(error_of(dictionary(fmt::format("'{}'", type), "(1, 3)"), 64),
                is_bad_at(dictionary_at + 10, "expected i or u"));
  }
}

TEST(NpyHeader, RejectsBooleansAsCoordinates) {
  EXPECT_THAT(error_of(dictionary("'|b1'", "(2, 3)"), 6),
              is_bad_at(dictionary_at + 10, "the array contains booleans"));
  EXPECT_THAT(error_of(dictionary("[('x', '<f4'), ('y', '<f4'), ('z', '|b1')]", "(1,)"), 9),
              is_bad_at(dictionary_at + 10, "field 'z' contains booleans"));
}

TEST(Npy, ReadsBooleansInOtherFields) {
  Cloud cloud;
  EXPECT_THAT(
      read_npy(npy_file(dictionary("[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('moves', '|b1')]",
                                   "(1,)"),
                        Bytes(13)),
               cloud),
      is_ok());
  ASSERT_EQ(cloud.fields().size(), 4U);
  EXPECT_EQ(cloud.fields()[3].type, FieldType::uint8);
}

TEST(NpyHeader, RejectsNestedRecords) {
  EXPECT_THAT(error_of(dictionary("[('x', [('a', '<f4')])]", "(1,)")),
              fails(StatusCode::bad_file, HasSubstr("a type such as")));
}

TEST(NpyHeader, RejectsOtherShapes) {
  for (const char* shape : {"()", "(3,)", "(1, 2)", "(1, 3, 1)", "(1, 1025)",
                            "(4611686018427387904, 18446744073709551615)"}) {
    EXPECT_THAT(error_of(dictionary("'<f4'", shape), 64),
                fails(StatusCode::bad_file, HasSubstr("expected N x 3")));
  }
  EXPECT_THAT(error_of(dictionary("[('x', '<f4'), ('y', '<f4'), ('z', '<f4')]", "(1, 1)"), 12),
              fails(StatusCode::bad_file, HasSubstr("2 dimensions (expected 1)")));
}

TEST(NpyHeader, RejectsNegativeAndEndlessShapes) {
  EXPECT_THAT(error_of(dictionary("'<f4'", "(-1, 3)"), 64),
              fails(StatusCode::bad_file, HasSubstr("integers")));
  EXPECT_THAT(error_of(dictionary("'<f4'", "(1 3)"), 64),
              fails(StatusCode::bad_file, HasSubstr("a comma or )")));
  std::string ones = "(";
  for (int i = 0; i < 40; ++i) ones += "1, ";
  EXPECT_THAT(error_of(dictionary("'<f4'", ones + ")"), 64),
              fails(StatusCode::bad_file, HasSubstr("at most 32")));
}

TEST(NpyHeader, RejectsRecordsWithMissingOrDuplicateXOrTooManyNumbers) {
  const auto records = [](const std::string& more) {
    return dictionary("[('y', '<f4'), ('z', '<f4'), " + more + "]", "(1,)");
  };
  EXPECT_THAT(error_of(records(""), 64), is_bad_at(dictionary_at + 10, "no field 'x'"));
  EXPECT_THAT(error_of(records("('x', '<f4'), ('x', '<f4')"), 64),
              is_bad_at(dictionary_at + 10, "occurs twice"));
  EXPECT_THAT(error_of(records("('x', '<f4'), ('a', '<f4', (0,))"), 64),
              fails(StatusCode::bad_file, HasSubstr("no items or too many items")));
  EXPECT_THAT(error_of(records("('x', '<f4'), ('a', '<f4', (4294967296, 4294967296))"), 64),
              fails(StatusCode::bad_file, HasSubstr("no items or too many items")));
  EXPECT_THAT(error_of(records("('x', '<f4'), ('a', '<f8', (65536,))"), 64),
              fails(StatusCode::bad_file, HasSubstr("has count 65536")));
}

TEST(NpyHeader, RejectsTooManyFields) {
  std::string descr = "[";
  for (std::size_t i = 0; i <= max_fields; ++i) descr += fmt::format("('f{}', '<f4'), ", i);
  EXPECT_THAT(error_of(dictionary(descr + "]", "(1,)"), 64),
              fails(StatusCode::bad_file, HasSubstr("more than 1024 fields")));
}

TEST(NpyItems, MustMatchTheShape) {
  const Bytes truncated = npy_file(dictionary("'<f4'", "(2, 3)"), Bytes(23));
  EXPECT_THAT(error_of(truncated),
              is_bad_at(truncated.size(),
                        "2 points of 12 bytes, but the remaining 23 bytes contain only 1"));
  const Bytes too_long = npy_file(dictionary("'<f4'", "(1, 3)"), Bytes(24));
  EXPECT_THAT(error_of(too_long), is_bad_at(too_long.size() - 12, "12 bytes after the 1 points"));
  const Bytes endless = npy_file(dictionary("'<f4'", "(18446744073709551615, 3)"), Bytes(24));
  EXPECT_THAT(error_of(endless), is_bad_at(endless.size(), "contain only 2"));
}

TEST(NpyWriter, AlignsItemsTo64Bytes) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_floats(std::vector<float>(8), 4, cloud), is_ok());
  Bytes file;

  ASSERT_THAT(write_npy(cloud, file), is_ok());

  EXPECT_EQ((file.size() - cloud.bytes().size()) % 64, 0U);
  EXPECT_EQ(file[6], std::byte{1});
}

TEST(NpyWriter, UsesVersionTwoForALongHeader) {
  std::vector<Field> fields{{"x"}, {"y"}, {"z"}};
  for (int i = 0; i < 400; ++i) fields.push_back({fmt::format("{:a>250}", i), int8});
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows(fields, Bytes(412), cloud), is_ok());
  Bytes file;
  Cloud again;

  ASSERT_THAT(write_npy(cloud, file), is_ok());

  EXPECT_EQ(file[6], std::byte{2});
  ASSERT_THAT(read_npy(file, again), is_ok());
  EXPECT_TRUE(std::ranges::equal(again.fields(), cloud.fields()));
}

TEST(NpyFile, StoresArraysOfAnyShape) {
  const TemporaryFolder folder;
  const std::vector values{1.F, 2.F, 3.F, 4.F, 5.F, 6.F};

  ASSERT_THAT(write_npy_file(folder / "list.npy", values, std::array<std::size_t, 1>{6}), is_ok());
  ASSERT_THAT(write_npy_file(folder / "table.npy", values, std::array<std::size_t, 2>{2, 3}),
              is_ok());

  const std::string list = contents_of(folder / "list.npy");
  const std::string table = contents_of(folder / "table.npy");
  EXPECT_THAT(list, HasSubstr("{'descr': '<f4', 'fortran_order': False, 'shape': (6,), }"));
  EXPECT_THAT(table, HasSubstr("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"));
  for (const std::string& file : {list, table}) {
    ASSERT_EQ(file.size() % 64, 24U);
    EXPECT_EQ(bytes_of(file.substr(file.size() - 24)), numbers({1.F, 2.F, 3.F, 4.F, 5.F, 6.F}));
  }
}

TEST(NpyFile, RejectsValuesThatDoNotFillTheShape) {
  const TemporaryFolder folder;

  EXPECT_THAT(
      write_npy_file(folder / "table.npy", std::vector<float>(5), std::array<std::size_t, 2>{2, 3}),
      fails(StatusCode::invalid_argument, HasSubstr("5 numbers for an array of 2 x 3")));
  EXPECT_FALSE(std::filesystem::exists(folder / "table.npy"));
}

}  // namespace
}  // namespace flagstone::io
