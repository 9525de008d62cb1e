// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/npy.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Status write_heights(const std::filesystem::path& path, const std::vector<float>& heights) {
  return write_npy_file(path, heights, std::array{heights.size()});
}

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

TEST(HeightFile, ReadsBackTheWrittenHeights) {
  const TemporaryFolder folder;
  const std::vector<float> heights{0.25F, -1.5F, unknown};

  ASSERT_THAT(write_heights(folder / "a.npy", heights), is_ok());

  std::vector<float> read;
  ASSERT_THAT(read_height_file(folder / "a.npy", 3, read), is_ok());
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0], 0.25F);
  EXPECT_EQ(read[1], -1.5F);
  EXPECT_TRUE(std::isnan(read[2]));
}

TEST(HeightFile, ReadsNoPoints) {
  const TemporaryFolder folder;
  ASSERT_THAT(write_heights(folder / "a.npy", {}), is_ok());

  std::vector<float> read{1};
  ASSERT_THAT(read_height_file(folder / "a.npy", 0, read), is_ok());
  EXPECT_TRUE(read.empty());
}

TEST(HeightFile, HasThePredictedSize) {
  const TemporaryFolder folder;
  for (const std::size_t points : {0U, 1U, 123'456U}) {
    ASSERT_THAT(write_heights(folder / "a.npy", std::vector<float>(points)), is_ok());
    EXPECT_EQ(std::filesystem::file_size(folder / "a.npy"), height_file_size(points));
  }
}

TEST(HeightFile, RejectsAnotherNumberOfPointsAndReportsBothNumbers) {
  const TemporaryFolder folder;
  ASSERT_THAT(write_heights(folder / "a.npy", std::vector<float>(3)), is_ok());

  std::vector<float> read{1};
  EXPECT_THAT(read_height_file(folder / "a.npy", 4, read),
              fails(StatusCode::bad_file, AllOf(HasSubstr("a.npy: byte "), HasSubstr("3 heights"),
                                                HasSubstr("4 points"))));
  EXPECT_THAT(read, ElementsAre(1));
}

TEST(HeightFile, RejectsATruncatedFile) {
  const TemporaryFolder folder;
  ASSERT_THAT(write_heights(folder / "a.npy", std::vector<float>(3)), is_ok());
  std::filesystem::resize_file(folder / "a.npy", height_file_size(3) - 1);

  std::vector<float> read;
  EXPECT_THAT(read_height_file(folder / "a.npy", 3, read),
              fails(StatusCode::bad_file, HasSubstr("11 bytes follow")));
}

TEST(HeightFile, RejectsOtherTypesAndShapes) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& dictionary) {
    const std::string padded = dictionary + std::string(117 - dictionary.size(), ' ') + '\n';
    put_file(folder / "a.npy", std::string("\x93NUMPY\x01\x00\x76\x00", 10) + padded);
    std::vector<float> read;
    return read_height_file(folder / "a.npy", 0, read).message();
  };

  EXPECT_THAT(complaint("{'descr': '<f8', 'fortran_order': False, 'shape': (0,), }"),
              HasSubstr("float32"));
  EXPECT_THAT(complaint("{'descr': '>f4', 'fortran_order': False, 'shape': (0,), }"),
              HasSubstr("little-endian"));
  EXPECT_THAT(complaint("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }"),
              HasSubstr("one dimension"));
  EXPECT_EQ(complaint("{'descr': '<f4', 'fortran_order': False, 'shape': (0,), }"), "");
}

TEST(HeightFile, ReportsTheNameOfAMissingFile) {
  std::vector<float> read;
  EXPECT_THAT(read_height_file("nowhere/a.npy", 1, read),
              fails(StatusCode::not_found, HasSubstr("nowhere/a.npy")));
}

}  // namespace
}  // namespace flagstone::io
