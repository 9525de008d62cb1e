// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/read_cloud.hpp"

#include <gtest/gtest.h>

#include <string>

#include "files/io/bytes.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/io/text.hpp"
#include "files/io/write_cloud.hpp"

namespace flagstone::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FormatOf, DependsOnTheExtensionInAnyCase) {
  EXPECT_EQ(format_of("a/000000.bin"), CloudFormat::raw);
  EXPECT_EQ(format_of("k.pcd.bin"), CloudFormat::raw);
  EXPECT_EQ(format_of("A.PCD"), CloudFormat::pcd);
  EXPECT_EQ(format_of("a.ply"), CloudFormat::ply);
  EXPECT_EQ(format_of("a.npy"), CloudFormat::npy);
  EXPECT_EQ(format_of("a.las"), std::nullopt);
  EXPECT_EQ(format_of("a.pcd/"), std::nullopt);
}

TEST(ScanNames, ExcludeLabelsHeightsAndHiddenFiles) {
  EXPECT_TRUE(is_scan_name("velodyne/000000.bin"));
  EXPECT_TRUE(is_scan_name("a.npy"));
  EXPECT_FALSE(is_scan_name("a.label"));
  EXPECT_FALSE(is_scan_name("a.label.npy"));
  EXPECT_FALSE(is_scan_name("a.heights.npy"));
  EXPECT_FALSE(is_scan_name("a.surface.npy"));
  EXPECT_FALSE(is_scan_name("a.ground.npy"));
  EXPECT_FALSE(is_scan_name("k_lidarseg.bin"));
  EXPECT_FALSE(is_scan_name(".a.bin"));
  EXPECT_FALSE(is_scan_name("a.txt"));
}

TEST(ReadCloud, TakesTheColumnsOfRawFilesFromExtensionOrOption) {
  const TemporaryFolder folder;
  for (const char* name : {"a.bin", "a.pcd.bin"}) put_file(folder / name, std::string(240, '\0'));
  Cloud cloud;

  ASSERT_THAT(read_cloud(folder / "a.bin", {}, cloud), is_ok());
  EXPECT_EQ(cloud.size(), 15U);
  ASSERT_THAT(read_cloud(folder / "a.pcd.bin", {}, cloud), is_ok());
  EXPECT_EQ(cloud.size(), 12U);
  ASSERT_THAT(read_cloud(folder / "a.pcd.bin", {.columns = 3}, cloud), is_ok());
  EXPECT_EQ(cloud.size(), 20U);
}

TEST(ReadCloud, RejectsColumnsOutOfRange) {
  for (const int columns : {-1, 1, 2, 1025}) {
    Cloud cloud;
    EXPECT_THAT(read_cloud("a.bin", {.columns = columns}, cloud),
                fails(StatusCode::invalid_argument, HasSubstr("expected 3 to 1024 columns, or 0")));
  }
}

TEST(ReadCloud, RejectsUnknownExtensions) {
  Cloud cloud;
  EXPECT_THAT(read_cloud("scan.las", {}, cloud),
              fails(StatusCode::invalid_argument,
                    AllOf(StartsWith("scan.las: "), HasSubstr(".pcd.bin, .pcd"))));
}

TEST(ReadCloud, StartsItsMessageWithPathAndOffset) {
  const TemporaryFolder folder;
  put_file(folder / "a.bin", std::string(17, '\0'));
  Cloud cloud;
  EXPECT_THAT(read_cloud(folder / "a.bin", {}, cloud),
              fails(StatusCode::bad_file, StartsWith((folder / "a.bin").string() + ": byte 16: ")));
}

TEST(ReadCloud, KeepsTheResultOnFailure) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_floats(std::vector<float>(3), 3, cloud), is_ok());
  EXPECT_FALSE(read_cloud("none.pcd", {}, cloud).ok());
  EXPECT_EQ(cloud.size(), 1U);
}

TEST(WriteCloud, WritesEveryFormatByExtension) {
  const TemporaryFolder folder;
  Cloud cloud;
  ASSERT_THAT(Cloud::from_floats(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}, 4, cloud), is_ok());
  for (const char* name : {"a.bin", "a.pcd", "a.ply", "a.npy"}) {
    Cloud again;
    ASSERT_THAT(write_cloud(folder / name, cloud), is_ok());
    ASSERT_THAT(read_cloud(folder / name, {}, again), is_ok());
    EXPECT_TRUE(std::ranges::equal(again.bytes(), cloud.bytes())) << name;
    EXPECT_TRUE(std::ranges::equal(again.fields(), cloud.fields())) << name;
  }
}

TEST(WriteCloud, StartsItsMessageWithThePath) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {"label", FieldType::uint8}}, {}, cloud),
              is_ok());
  EXPECT_THAT(write_cloud("a.bin", cloud),
              fails(StatusCode::invalid_argument, StartsWith("a.bin: field 'label'")));
  EXPECT_THAT(write_cloud("a.txt", cloud),
              fails(StatusCode::invalid_argument, StartsWith("a.txt: unknown file extension")));
}

}  // namespace
}  // namespace flagstone::io
