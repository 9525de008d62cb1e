// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pcd.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>

#include "files/io/bytes.hpp"
#include "files/io/cloud_generator.hpp"
#include "files/io/compress_lzf.hpp"
#include "files/io/status_matchers.hpp"

namespace flagstone::io {
namespace {

using enum FieldType;
using ::testing::HasSubstr;

/// A header whose lines can be replaced individually; an empty line is omitted.
struct Header {
  std::string version = "VERSION 0.7\n";
  std::string fields = "FIELDS x y z\n";
  std::string size = "SIZE 4 4 4\n";
  std::string type = "TYPE F F F\n";
  std::string count = "COUNT 1 1 1\n";
  std::string width = "WIDTH 1\n";
  std::string height = "HEIGHT 1\n";
  std::string viewpoint = "VIEWPOINT 0 0 0 1 0 0 0\n";
  std::string points = "POINTS 1\n";
  std::string data = "DATA ascii\n";

  [[nodiscard]] std::string text() const {
    return version + fields + size + type + count + width + height + viewpoint + points + data;
  }
  /// Offset of the start of a line, or of the points.
  [[nodiscard]] std::size_t offset_of(std::string_view line) const { return text().find(line); }
  [[nodiscard]] std::size_t end() const { return text().size(); }
};

Status read(const std::string& text, Cloud& cloud) { return read_pcd(bytes_of(text), cloud); }

Status error_of(const std::string& text) {
  Cloud cloud;
  Status status = read(text, cloud);
  EXPECT_TRUE(cloud.fields().empty()) << "a failed read changed its result";
  return status;
}

Status error_of(const Header& header, const std::string& body = "1 2 3\n") {
  return error_of(header.text() + body);
}

TEST(Pcd, ReadsAsciiFieldsOfAnyOrderAndType) {
  Cloud cloud;
  const std::string text =
      "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS ring z normal x y t\n"
      "SIZE 2 4 4 8 4 8\nTYPE U F F F I U\nCOUNT 1 1 3 1 1 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
      "7 1.5 0 0 1 -2.25 -3 18446744073709551615\n65535 nan +0.5 -1e-3 inf 4 5 0\n";

  ASSERT_THAT(read(text, cloud), is_ok());

  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.view()[0].x, -2.25F);
  EXPECT_EQ(cloud.view()[0].y, -3.0F);
  EXPECT_EQ(cloud.view()[0].z, 1.5F);
  EXPECT_TRUE(std::isnan(cloud.view()[1].z));
  EXPECT_EQ(cloud.value(1, *cloud.find("ring")), 65535.0);
  EXPECT_EQ(cloud.value(1, *cloud.find("normal"), 0), 0.5);
  EXPECT_EQ(cloud.value(1, *cloud.find("normal"), 2), HUGE_VAL);
  EXPECT_EQ(cloud.value(0, *cloud.find("t")), 18446744073709551615.0);
}

TEST(Pcd, ReadsBinaryWithPadding) {
  const Header header{.fields = "FIELDS x y z _ i _\n",
                      .size = "SIZE 4 4 4 1 4 1\n",
                      .type = "TYPE F F F U F U\n",
                      .count = "COUNT 1 1 1 4 1 12\n",
                      .data = "DATA binary\n"};
  Cloud cloud;

  ASSERT_THAT(read_pcd(joined({bytes_of(header.text()), numbers({1.0F, 2.0F, 3.0F, 0.0F, 0.5F}),
                               Bytes(12)}),
                       cloud),
              is_ok());

  EXPECT_EQ(cloud.stride(), 32U);
  EXPECT_EQ(cloud.view()[0].z, 3.0F);
  EXPECT_EQ(cloud.value(0, *cloud.find("i")), 0.5);
}

Bytes compressed_file(const Cloud& cloud) {
  Bytes file;
  EXPECT_THAT(write_pcd(cloud, file), is_ok());
  const std::size_t rows_at = file.size() - cloud.bytes().size();
  std::string header(reinterpret_cast<const char*>(file.data()), rows_at);
  header.replace(header.rfind("binary\n"), 7, "binary_compressed\n");
  Bytes columns;
  for (const Field& field : cloud.fields()) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto number = cloud.bytes().subspan(i * cloud.stride() + field.offset, field.size());
      columns.insert(columns.end(), number.begin(), number.end());
    }
  }
  const Bytes stream = compress_lzf(columns);
  return joined({bytes_of(header),
                 numbers({static_cast<std::uint32_t>(stream.size()),
                          static_cast<std::uint32_t>(columns.size())}),
                 stream});
}

RC_GTEST_PROP(Pcd, ReadsCompressedClouds, ()) {
  const Cloud cloud = *arbitrary_cloud();
  Cloud again;

  RC_ASSERT(read_pcd(compressed_file(cloud), again).message().empty());

  RC_ASSERT(std::ranges::equal(again.fields(), cloud.fields()));
  RC_ASSERT(std::ranges::equal(again.bytes(), cloud.bytes()));
}

RC_GTEST_PROP(Pcd, ReadsEveryNumberFromItsShortestText, ()) {
  const auto type = *rc::gen::elementOf(all_field_types);
  const char letter = !is_integer(type) ? 'F' : to_string(type)[0] == 'u' ? 'U' : 'I';
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  Cloud source;
  const std::vector<Field> fields{{"x"}, {"y"}, {"z"}, {"v", type}};
  const Bytes number = numbers({bits});
  const Bytes value(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(size_of(type)));
  RC_ASSERT(Cloud::from_rows(fields, joined({Bytes(12), value}), source).ok());
  const double expected = source.value(0, source.fields()[3]);
  std::string text = fmt::format("{}", expected);
  if (is_integer(type) && letter == 'U') {
    std::uint64_t whole = 0;
    std::memcpy(&whole, value.data(), value.size());
    text = fmt::format("{}", whole);
  } else if (is_integer(type)) {
    const auto unused = 64 - 8 * size_of(type);
    text = fmt::format("{}", static_cast<std::int64_t>(bits << unused) >> unused);
  }
  const Header header{.fields = "FIELDS x y z v\n",
                      .size = fmt::format("SIZE 4 4 4 {}\n", size_of(type)),
                      .type = fmt::format("TYPE F F F {}\n", letter),
                      .count = ""};
  Cloud cloud;

  RC_ASSERT(read(header.text() + "0 0 0 " + text + "\n", cloud).message().empty());

  RC_ASSERT(std::isnan(expected) || std::ranges::equal(cloud.bytes(), source.bytes()));
}

TEST(Pcd, ReadsVersion06WithoutViewpointAndCount) {
  Cloud cloud;
  const Header header{.version = "VERSION .6\n", .count = "", .viewpoint = ""};
  EXPECT_THAT(read(header.text() + "1 2 3", cloud), is_ok());
  EXPECT_EQ(cloud.size(), 1U);
}

TEST(Pcd, ReadsLinesThatEndWithCrLf) {
  std::string text = Header().text() + "1 2 3\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\r');
  }
  Cloud cloud;
  EXPECT_THAT(read(text, cloud), is_ok());
  EXPECT_EQ(cloud.view()[0].z, 3.0F);
}

TEST(Pcd, ReadsOrganizedClouds) {
  Cloud cloud;
  const Header header{.width = "WIDTH 2\n", .height = "HEIGHT 2\n", .points = "POINTS 4\n"};
  ASSERT_THAT(read(header.text() + "1 2 3\n4 5 6\n\n7 8 9\n0 0 0\n", cloud), is_ok());
  EXPECT_EQ(cloud.size(), 4U);
}

TEST(Pcd, ReadsNoPoints) {
  const std::string none = "WIDTH 0\nHEIGHT 1\nPOINTS 0\n";
  for (const char* data : {"ascii\n", "binary\n", "binary_compressed\n"}) {
    const Bytes sizes = std::string_view(data) == "binary_compressed\n" ? Bytes(8) : Bytes();
    Cloud cloud;
    const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n" + none + "DATA " + data;
    EXPECT_THAT(read_pcd(joined({bytes_of(header), sizes}), cloud), is_ok());
    EXPECT_TRUE(cloud.empty());
  }
}

TEST(Pcd, ReadsTinyNumbersAsZero) {
  Cloud cloud;
  ASSERT_THAT(read(Header().text() + "1e-60 -1e-60 1e-42\n", cloud), is_ok());
  EXPECT_EQ(cloud.view()[0].x, 0.0F);
  EXPECT_EQ(cloud.view()[0].z, 1e-42F);
}

TEST(PcdHeader, IsRequired) {
  EXPECT_THAT(error_of(std::string()), is_bad_at(0, "ends within the PCD header"));
}

TEST(PcdHeader, MustEndWithData) {
  const std::string text = "VERSION 0.7\nFIELDS x y z\n";
  EXPECT_THAT(error_of(text), is_bad_at(text.size(), "expected a DATA line"));
}

TEST(PcdHeader, QuotesGarbageInShortPrintableForm) {
  EXPECT_THAT(error_of("VERSION 0.7\n" + std::string(1000000, '\0')),
              is_bad_at(12, R"('\x00\x00)"));
  EXPECT_LT(error_of("VERSION 0.7\n" + std::string(1000000, '\0')).message().size(), 400U);
}

TEST(PcdHeader, RejectsARepeatedLine) {
  EXPECT_THAT(error_of(Header{.version = "VERSION 0.7\nVERSION 0.7\n"}),
              is_bad_at(12, "second VERSION line"));
}

TEST(PcdHeader, RejectsUnknownVersions) {
  EXPECT_THAT(error_of(Header{.version = "VERSION 0.8\n"}), is_bad_at(8, "expected 0.6 or 0.7"));
}

TEST(PcdHeader, RequiresFieldsSizeAndType) {
  EXPECT_THAT(error_of(Header{.fields = ""}),
              is_bad_at(Header{.fields = ""}.offset_of("DATA"), "no FIELDS line"));
  EXPECT_THAT(error_of(Header{.size = ""}),
              is_bad_at(Header{.size = ""}.offset_of("DATA"), "no SIZE line"));
  EXPECT_THAT(error_of(Header{.type = ""}),
              is_bad_at(Header{.type = ""}.offset_of("DATA"), "no TYPE line"));
}

TEST(PcdHeader, RequiresOneValuePerField) {
  const Header header{.size = "SIZE 4 4\n"};
  EXPECT_THAT(error_of(header),
              is_bad_at(header.offset_of("SIZE"), "SIZE line has 2 values (expected 3)"));
}

TEST(PcdHeader, RejectsUnknownTypes) {
  const Header half{.size = "SIZE 4 2 4\n"};
  EXPECT_THAT(error_of(half), is_bad_at(half.offset_of("TYPE") + 7, "TYPE 'F' and SIZE '2'"));
  const Header unknown{.type = "TYPE F F Q\n"};
  EXPECT_THAT(error_of(unknown), is_bad_at(unknown.offset_of("Q"), "TYPE 'Q'"));
}

TEST(PcdHeader, RejectsDuplicateFields) {
  const Header header{.fields = "FIELDS x x z\n"};
  EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("FIELDS"), "'x' occurs twice"));
}

TEST(PcdHeader, RequiresXYAndZ) {
  const Header header{.fields = "FIELDS x w z\n"};
  EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("FIELDS"), "no field 'y'"));
}

TEST(PcdHeader, RejectsInvalidCounts) {
  for (const char* count : {"-1", "0x1", "1.0", "18446744073709551616"}) {
    const Header header{.count = fmt::format("COUNT 1 1 {}\n", count)};
    EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("COUNT") + 10, "is not an integer"));
  }
}

TEST(PcdHeader, RejectsCountsBeyondTheRowLimit) {
  for (const char* count : {"0", "18446744073709551615", "4611686018427387905", "20000"}) {
    const Header header{.fields = "FIELDS x y z n\n",
                        .size = "SIZE 4 4 4 4\n",
                        .type = "TYPE F F F F\n",
                        .count = fmt::format("COUNT 1 1 1 {}\n", count)};
    EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("FIELDS"), "has count"));
  }
}

TEST(PcdHeader, RejectsTooManyFields) {
  std::string names = "FIELDS";
  for (std::size_t i = 0; i <= max_fields; ++i) names += fmt::format(" f{}", i);
  const Header header{.fields = names + "\n"};
  EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("FIELDS"), "more than 1024 fields"));
}

TEST(PcdHeader, RejectsANegativeNumberOfPoints) {
  const Header header{.points = "POINTS -1\n"};
  EXPECT_THAT(error_of(header), is_bad_at(header.offset_of("-1"), "'-1' is not an integer"));
}

TEST(PcdHeader, RejectsPointsThatDifferFromWidthTimesHeight) {
  const Header header{.width = "WIDTH 3\n", .points = "POINTS 4\n"};
  EXPECT_THAT(error_of(header),
              is_bad_at(header.offset_of("POINTS"), "POINTS 4 is not WIDTH 3 times HEIGHT 1"));
}

TEST(PcdHeader, RejectsASizeThatOverflows) {
  const Header header{
      .width = "WIDTH 4294967296\n", .height = "HEIGHT 4294967296\n", .points = "POINTS 0\n"};
  EXPECT_THAT(error_of(header),
              is_bad_at(header.offset_of("WIDTH"), "more points than a file can contain"));
}

TEST(PcdHeader, RequiresANumberOfPoints) {
  const Header header{.width = "", .height = "", .points = ""};
  EXPECT_THAT(error_of(header),
              is_bad_at(header.offset_of("DATA"), "expected WIDTH and HEIGHT, POINTS"));
}

TEST(PcdHeader, RejectsUnknownData) {
  const Header header{.data = "DATA zip\n"};
  EXPECT_THAT(error_of(header),
              is_bad_at(header.offset_of("zip"), "expected ascii, binary or binary_compressed"));
}

TEST(PcdAscii, RejectsMorePointsThanTheTextCanContain) {
  const Header header{.width = "", .height = "", .points = "POINTS 18446744073709551615\n"};
  EXPECT_THAT(error_of(header), is_bad_at(header.end() + 6, "too many for the remaining 6 bytes"));
}

TEST(PcdAscii, RejectsALineWithTooFewNumbers) {
  EXPECT_THAT(error_of(Header(), "1.5 2.5\n3\n"),
              is_bad_at(Header().end() + 7, "point 0 has 2 numbers"));
}

TEST(PcdAscii, RejectsALineWithTooManyNumbers) {
  EXPECT_THAT(error_of(Header(), "1 2 3 4\n"),
              is_bad_at(Header().end() + 6, "'4' follows the 3 numbers"));
}

TEST(PcdAscii, RejectsMoreLinesThanPoints) {
  EXPECT_THAT(error_of(Header(), "1 2 3\n\n4 5 6\n"),
              is_bad_at(Header().end() + 7, "more data after the 1 points"));
}

TEST(PcdAscii, RejectsInvalidNumbers) {
  for (const char* word : {"abc", "1,5", "0x10", "--1", "+-1", "1e", "1e39", "-1e400"}) {
    EXPECT_THAT(error_of(Header(), fmt::format("1 {} 3\n", word)),
                is_bad_at(Header().end() + 2,
                          fmt::format("field 'y' of point 0 is '{}' (expected float32)", word)));
  }
}

TEST(PcdAscii, RejectsIntegersOutOfRange) {
  const Header header{.fields = "FIELDS x y z i\n",
                      .size = "SIZE 4 4 4 1\n",
                      .type = "TYPE F F F U\n",
                      .count = ""};
  for (const char* word : {"256", "-1", "1.0", "nan"}) {
    EXPECT_THAT(error_of(header, fmt::format("1 2 3 {}\n", word)),
                is_bad_at(header.end() + 6, "(expected uint8)"));
  }
}

const Header binary{.width = "WIDTH 2\n", .points = "POINTS 2\n", .data = "DATA binary\n"};

TEST(PcdBinary, RejectsATruncatedFile) {
  EXPECT_THAT(error_of(binary, std::string(23, 'a')),
              is_bad_at(binary.end() + 23,
                        "2 points of 12 bytes, but the remaining 23 bytes contain only 1"));
}

TEST(PcdBinary, RejectsHugeCounts) {
  const Header header{.width = "WIDTH 1537228672809129302\n",
                      .height = "HEIGHT 12\n",
                      .points = "",
                      .data = "DATA binary\n"};
  EXPECT_THAT(error_of(header, std::string(24, 'a')),
              fails(StatusCode::bad_file, HasSubstr("more points than a file can contain")));
  const Header nearly{
      .width = "WIDTH 1537228672809129302\n", .points = "", .data = "DATA binary\n"};
  EXPECT_THAT(error_of(nearly, std::string(24, 'a')),
              is_bad_at(nearly.end() + 24, "contain only 2"));
}

TEST(PcdBinary, RejectsMorePointsThanTheHeaderSpecifies) {
  EXPECT_THAT(error_of(binary, std::string(36, 'a')),
              is_bad_at(binary.end() + 24, "12 bytes after the 2 points"));
}

TEST(PcdBinary, AllowsARemainderShorterThanAPoint) {
  Cloud cloud;
  EXPECT_THAT(read(binary.text() + std::string(25, 'a'), cloud), is_ok());
}

const Header compressed{.data = "DATA binary_compressed\n"};

Status compressed_error(std::uint32_t stream_size, std::uint32_t expanded_size,
                        const Bytes& stream) {
  Cloud cloud;
  return read_pcd(
      joined({bytes_of(compressed.text()), numbers({stream_size, expanded_size}), stream}), cloud);
}

TEST(PcdCompressed, RequiresBothSizes) {
  EXPECT_THAT(error_of(compressed, "1234567"),
              is_bad_at(compressed.end() + 7, "before the two sizes"));
}

TEST(PcdCompressed, RejectsAnExpandedSizeThatDiffersFromThePoints) {
  EXPECT_THAT(compressed_error(5, 13, Bytes(5)),
              is_bad_at(compressed.end() + 4, "expanded size of 13 bytes"));
  EXPECT_THAT(compressed_error(5, 4294967295U, Bytes(5)),
              is_bad_at(compressed.end() + 4, "1 points of 12"));
}

TEST(PcdCompressed, RejectsATruncatedStream) {
  EXPECT_THAT(compressed_error(6, 12, Bytes(5)),
              is_bad_at(compressed.end() + 13, "5 bytes of compressed data (expected 6;"));
}

TEST(PcdCompressed, RejectsAStreamThatExpandsToMore) {
  const Bytes bomb = compress_lzf(Bytes(100000));
  EXPECT_THAT(compressed_error(static_cast<std::uint32_t>(bomb.size()), 12, bomb),
              is_bad_at(compressed.end() + 8, "expands to 100000 bytes (expected 12)"));
}

TEST(PcdCompressed, RejectsAStreamThatExpandsToLess) {
  const Bytes short_stream = compress_lzf(Bytes(11));
  EXPECT_THAT(compressed_error(static_cast<std::uint32_t>(short_stream.size()), 12, short_stream),
              is_bad_at(compressed.end() + 8, "expands to 11 bytes (expected 12)"));
}

TEST(PcdCompressed, RejectsAReferenceBeforeTheStart) {
  EXPECT_THAT(compressed_error(2, 12, numbers<std::uint8_t>({1U << 5U, 0})),
              is_bad_at(compressed.end() + 8, "refers 1 bytes back"));
}

TEST(PcdCompressed, RejectsMorePointsThanTheStreamCanContain) {
  // 40 bytes can expand to at most 3,520.
  const Header header{
      .width = "WIDTH 300000000\n", .points = "", .data = "DATA binary_compressed\n"};
  Cloud cloud;
  EXPECT_THAT(read_pcd(joined({bytes_of(header.text()), numbers<std::uint32_t>({32, 3600000000U}),
                               Bytes(32)}),
                       cloud),
              is_bad_at(header.end() + 8, "(expected 3600000000)"));
}

}  // namespace
}  // namespace flagstone::io
