// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/ply.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "files/io/bytes.hpp"
#include "files/io/status_matchers.hpp"

namespace flagstone::io {
namespace {

using enum FieldType;
using ::testing::HasSubstr;

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

std::string header(const std::string& elements, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

std::string vertices(const std::string& count) { return "element vertex " + count + "\n" + xyz; }

Status read_text(const std::string& text, Cloud& cloud) { return read_ply(bytes_of(text), cloud); }

Status ply_error(const std::string& text) {
  Cloud cloud;
  Status status = read_text(text, cloud);
  EXPECT_TRUE(cloud.fields().empty()) << "a failed read changed its result";
  return status;
}

TEST(Ply, ReadsAsciiWithElementsBeforeAndAfter) {
  Cloud cloud;
  const std::string text = header(
      "comment made by hand\nobj_info none\nelement camera 2\nproperty list uchar float pose\n"
      "element vertex 2\nproperty uchar red\nproperty double x\nproperty float y\nproperty short "
      "z\n"
      "element face 1\nproperty list uchar int vertex_indices\n");

  ASSERT_THAT(read_text(text + "3 1 2 3\n0\n\n255 1.5 nan -7\n0 -2 inf 32767\n3 0 1 1\n", cloud),
              is_ok());

  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.view()[0].x, 1.5F);
  EXPECT_TRUE(std::isnan(cloud.view()[0].y));
  EXPECT_EQ(cloud.view()[1].z, 32767.0F);
  EXPECT_EQ(cloud.value(0, *cloud.find("red")), 255.0);
}

TEST(Ply, ReadsLittleEndianAfterElementsWithLists) {
  Cloud cloud;
  const std::string text = header(
      "element camera 2\nproperty short id\nproperty list ushort double pose\n" + vertices("1"),
      "binary_little_endian");
  const Bytes cameras =
      joined({numbers<std::uint16_t>({1, 2}), Bytes(16), numbers<std::uint16_t>({2, 0})});

  ASSERT_THAT(read_ply(joined({bytes_of(text), cameras, numbers({1.0F, 2.0F, 3.0F})}), cloud),
              is_ok());

  EXPECT_EQ(cloud.view()[0].z, 3.0F);
}

TEST(Ply, ReadsBigEndianAfterElementsWithLists) {
  Cloud cloud;
  const std::string text = header(
      "element camera 1\nproperty list int short pose\nelement vertex 1\nproperty float x\n"
      "property double y\nproperty short z\nproperty uchar red\n",
      "binary_big_endian");
  const Bytes camera = numbers<std::uint8_t>({0, 0, 0, 2, 9, 9, 9, 9});
  const Bytes vertex =
      numbers<std::uint8_t>({0x3f, 0x80, 0, 0, 0xc0, 0, 0, 0, 0, 0, 0, 0, 0x01, 0x02, 200});

  ASSERT_THAT(read_ply(joined({bytes_of(text), camera, vertex}), cloud), is_ok());

  EXPECT_EQ(cloud.view()[0].x, 1.0F);
  EXPECT_EQ(cloud.view()[0].y, -2.0F);
  EXPECT_EQ(cloud.view()[0].z, 258.0F);
  EXPECT_EQ(cloud.value(0, *cloud.find("red")), 200.0);
}

TEST(Ply, ReadsBothNamesOfEveryType) {
  const std::vector<std::pair<const char*, FieldType>> names{
      {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
      {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
      {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  for (const auto& [name, type] : names) {
    Cloud cloud;
    ASSERT_THAT(read_text(header(vertices("1") + "property " + name + " v\n") + "1 2 3 4\n", cloud),
                is_ok());
    EXPECT_EQ(cloud.find("v")->type, type);
    EXPECT_EQ(cloud.value(0, *cloud.find("v")), 4.0);
  }
}

TEST(Ply, SkipsAnyNumberOfElementsWithoutProperties) {
  const std::string empty = "element nothing 18446744073709551615\n";
  Cloud cloud;
  EXPECT_THAT(read_text(header(empty + vertices("1")) + "1 2 3\n", cloud), is_ok());
  EXPECT_THAT(
      read_text(header(empty + vertices("1"), "binary_little_endian") + std::string(12, 'a'),
                cloud),
      is_ok());
}

TEST(Ply, DoesNotReadElementsAfterTheVertices) {
  Cloud cloud;
  const std::string text =
      header(vertices("1") + "element face 9\nproperty list uchar int i\n", "binary_little_endian");
  EXPECT_THAT(read_text(text + std::string(12, 'a'), cloud), is_ok());
}

TEST(Ply, ReadsNoPoints) {
  Cloud cloud;
  EXPECT_THAT(read_text(header(vertices("0")), cloud), is_ok());
  EXPECT_EQ(cloud.fields().size(), 3U);
}

TEST(PlyHeader, MustStartWithPly) {
  EXPECT_THAT(ply_error(""), is_bad_at(0, "expected 'ply' on the first line"));
  EXPECT_THAT(ply_error("plyx\n"), is_bad_at(0, "expected 'ply' on the first line"));
}

TEST(PlyHeader, MustEndWithEndHeader) {
  EXPECT_THAT(ply_error("ply\nformat ascii 1.0\n"), is_bad_at(21, "expected end_header"));
}

TEST(PlyHeader, RequiresOneKnownFormat) {
  EXPECT_THAT(ply_error("ply\nformat ascii 2.0\nend_header\n"), is_bad_at(4, "format ascii 1.0"));
  EXPECT_THAT(ply_error("ply\nformat ascii 1.0\nformat ascii 1.0\nend_header\n"),
              is_bad_at(21, "one line"));
  EXPECT_THAT(ply_error("ply\nelement vertex 0\nend_header\n"), is_bad_at(0, "no format line"));
}

TEST(PlyHeader, RejectsUnknownLines) {
  EXPECT_THAT(ply_error(header("elephant 1\n")),
              is_bad_at(21, "'elephant' is not a PLY header line"));
  EXPECT_THAT(ply_error("ply\n" + std::string(1000000, '\xff')), is_bad_at(4, R"('\xff\xff)"));
}

TEST(PlyHeader, RejectsInvalidCounts) {
  for (const char* count : {"-1", "", "1.5", "x", "18446744073709551616"}) {
    EXPECT_THAT(ply_error(header(vertices(count))), is_bad_at(21, "COUNT an integer"));
  }
}

TEST(PlyHeader, RejectsDuplicateElements) {
  EXPECT_THAT(ply_error(header(vertices("0") + vertices("0"))),
              is_bad_at(21 + 17 + 51, "'vertex' occurs twice"));
}

TEST(PlyHeader, RejectsInvalidProperties) {
  EXPECT_THAT(ply_error(header("property float x\n")), is_bad_at(21, "precedes the first element"));
  EXPECT_THAT(ply_error(header("element vertex 1\nproperty float\n")),
              is_bad_at(38, "property TYPE NAME"));
  EXPECT_THAT(ply_error(header("element vertex 1\nproperty int64 x\n")),
              is_bad_at(38, "'int64' is not a property type"));
  EXPECT_THAT(ply_error(header("element face 1\nproperty list float int x\n")),
              is_bad_at(36, "'float' is not a property type"));
}

TEST(PlyHeader, RejectsTooManyProperties) {
  std::string many = "element vertex 1\n";
  for (std::size_t i = 0; i <= max_fields; ++i) many += fmt::format("property float f{}\n", i);
  EXPECT_THAT(ply_error(header(many)),
              fails(StatusCode::bad_file, HasSubstr("more than 1024 properties")));
}

TEST(PlyHeader, RequiresVertices) {
  EXPECT_THAT(ply_error(header("element face 1\nproperty float x\n")),
              is_bad_at(0, "no element 'vertex'"));
}

TEST(PlyHeader, RequiresXYAndZOnce) {
  EXPECT_THAT(ply_error(header("element vertex 1\nproperty float x\nproperty float y\n")),
              is_bad_at(21, "no field 'z'"));
  EXPECT_THAT(ply_error(header(vertices("1") + "property float x\n")),
              is_bad_at(21, "'x' occurs twice"));
}

TEST(PlyHeader, RejectsListsInTheVertices) {
  EXPECT_THAT(ply_error(header(vertices("1") + "property list uchar int views\n")),
              is_bad_at(21 + 17 + 51, "property 'views' of element 'vertex' is a list"));
}

TEST(PlyAscii, RejectsMorePointsThanTheTextCanContain) {
  const std::string text = header(vertices("18446744073709551615")) + "1 2 3\n";
  EXPECT_THAT(ply_error(text), is_bad_at(text.size(), "too many for the remaining 6 bytes"));
}

TEST(PlyAscii, RejectsAFileThatEndsBeforeThePoints) {
  const std::string text =
      header("element camera 3\nproperty float f\n" + vertices("1")) + "1\n2\n";
  EXPECT_THAT(ply_error(text), is_bad_at(text.size(), "after 2 of the 3 lines before the points"));
}

TEST(PlyAscii, RejectsInvalidNumbers) {
  const std::string text = header(vertices("1"));
  EXPECT_THAT(ply_error(text + "1 two 3\n"),
              is_bad_at(text.size() + 2, "field 'y' of point 0 is 'two' (expected float32)"));
}

TEST(PlyAscii, RejectsMorePointsThanTheHeaderSpecifies) {
  const std::string text = header(vertices("1"));
  EXPECT_THAT(ply_error(text + "1 2 3\n4 5 6\n"),
              is_bad_at(text.size() + 6, "more data after the 1 points"));
}

TEST(PlyBinary, RejectsATruncatedFile) {
  const std::string text = header(vertices("2"), "binary_little_endian") + std::string(23, 'a');
  EXPECT_THAT(ply_error(text), is_bad_at(text.size(), "contain only 1"));
}

TEST(PlyBinary, RejectsHugeCounts) {
  const std::string text =
      header(vertices("1537228672809129302"), "binary_big_endian") + std::string(24, 'a');
  EXPECT_THAT(ply_error(text), is_bad_at(text.size(), "contain only 2"));
}

TEST(PlyBinary, RejectsMorePointsThanTheHeaderSpecifies) {
  const std::string text = header(vertices("1"), "binary_little_endian");
  EXPECT_THAT(ply_error(text + std::string(24, 'a')),
              is_bad_at(text.size() + 12, "12 bytes after the 1 points"));
}

TEST(PlyBinary, RejectsHugeElementsBeforeThePoints) {
  const std::string text =
      header("element big 2305843009213693953\nproperty double f\n" + vertices("1"),
             "binary_little_endian") +
      std::string(20, 'a');
  EXPECT_THAT(ply_error(text),
              is_bad_at(text.size(), "within the 2305843009213693953 items of element 'big'"));
}

TEST(PlyBinary, RejectsListsBeyondTheFile) {
  const std::string text = header("element big 1\nproperty list uint double f\n" + vertices("1"),
                                  "binary_little_endian") +
                           "\xff\xff\xff\xff" + std::string(12, 'a');
  EXPECT_THAT(ply_error(text), is_bad_at(text.size(), "of element 'big'"));
  const std::string none =
      header("element big 9999999999\nproperty list uint double f\n" + vertices("1"),
             "binary_little_endian");
  EXPECT_THAT(ply_error(none), is_bad_at(none.size(), "of element 'big'"));
}

TEST(PlyBinary, RejectsListsOfNegativeLength) {
  const std::string text =
      header("element big 1\nproperty list char char f\n" + vertices("1"), "binary_little_endian");
  EXPECT_THAT(ply_error(text + "\xff" + std::string(12, 'a')),
              is_bad_at(text.size(), "list 'f' of element 'big' has length -1"));
}

Cloud cloud_with(const Field& field, const Bytes& value) {
  Cloud cloud;
  EXPECT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, field}, joined({Bytes(12), value}), cloud),
              is_ok());
  return cloud;
}

TEST(PlyWriter, SplitsFieldsOfSeveralNumbersAndOmitsPadding) {
  const Cloud cloud = cloud_with({"n", int16, 2}, numbers<std::int16_t>({-1, 5}));
  const Cloud padded = cloud_with({"_", int16, 2}, Bytes(4));
  Bytes file;
  Cloud again;

  ASSERT_THAT(write_ply(cloud, file), is_ok());
  ASSERT_THAT(read_ply(file, again), is_ok());
  EXPECT_EQ(again.value(0, *again.find("n_1")), 5.0);

  ASSERT_THAT(write_ply(padded, file), is_ok());
  ASSERT_THAT(read_ply(file, again), is_ok());
  EXPECT_EQ(again.fields().size(), 3U);
}

TEST(PlyWriter, WritesWideIntegersThatADoubleRepresents) {
  Bytes file;
  Cloud again;
  ASSERT_THAT(
      write_ply(cloud_with({"t", int64}, numbers<std::int64_t>({-(std::int64_t{1} << 53U)})), file),
      is_ok());
  ASSERT_THAT(read_ply(file, again), is_ok());
  EXPECT_EQ(again.value(0, *again.find("t")), -9007199254740992.0);
}

TEST(PlyWriter, RejectsWideIntegersThatADoubleWouldRound) {
  Bytes file;
  EXPECT_THAT(
      write_ply(cloud_with({"t", uint64}, numbers<std::uint64_t>({9007199254740993U})), file),
      fails(StatusCode::invalid_argument, HasSubstr("field 't' of point 0 is 9007199254740993")));
}

TEST(PlyWriter, RejectsDuplicateProperties) {
  Cloud cloud;
  const std::vector<Field> fields{{"x"}, {"y"}, {"z"}, {"n", int8, 2}, {"n_1", int8}};
  ASSERT_THAT(Cloud::from_rows(fields, Bytes(15), cloud), is_ok());
  Bytes file;
  EXPECT_THAT(write_ply(cloud, file),
              fails(StatusCode::invalid_argument, HasSubstr("'n_1' occurs twice")));
}

TEST(PlyWriter, RejectsTooManyProperties) {
  Bytes file;
  EXPECT_THAT(write_ply(cloud_with({"n", int8, 2000}, Bytes(2000)), file),
              fails(StatusCode::invalid_argument, HasSubstr("more than 1024 properties")));
}

}  // namespace
}  // namespace flagstone::io
