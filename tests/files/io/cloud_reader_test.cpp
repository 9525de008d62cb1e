// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "files/io/bytes.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/io/text.hpp"
#include "files/io/write_cloud.hpp"

namespace flagstone::io {
namespace {

using ::testing::HasSubstr;

/// `points` points, point i at (i, 2i, 3i) with intensity `tag`.
Cloud cloud_of(std::size_t points, float tag) {
  std::vector<float> floats;
  for (std::size_t i = 0; i < points; ++i) {
    const auto x = static_cast<float>(i);
    floats.insert(floats.end(), {x, 2 * x, 3 * x, tag});
  }
  Cloud cloud;
  EXPECT_THAT(Cloud::from_floats(floats, 4, cloud), is_ok());
  return cloud;
}

bool same(const Cloud& a, const Cloud& b) {
  return std::ranges::equal(a.fields(), b.fields()) && std::ranges::equal(a.bytes(), b.bytes());
}

class CloudReaderTest : public ::testing::Test {
 protected:
  /// Writes a cloud in the format of its file extension.
  [[nodiscard]] std::filesystem::path put(const std::string& name, const Cloud& cloud) const {
    EXPECT_THAT(write_cloud(folder_ / name, cloud), is_ok());
    return folder_ / name;
  }

  TemporaryFolder folder_;
  CloudReader reader_;
};

TEST_F(CloudReaderTest, ReadsEachOfSeveralFilesAsIfAlone) {
  // Different sizes and formats: nothing of an earlier file may remain.
  const std::vector<std::string> names{"a.bin", "b.bin", "c.pcd", "d.bin", "e.npy",
                                       "f.ply", "g.pcd", "h.bin", "i.bin"};
  const std::vector<std::size_t> sizes{100, 30, 70, 200, 5, 120, 0, 0, 90};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Cloud cloud = cloud_of(sizes[i], static_cast<float>(i));
    const auto path = put(names[i], cloud);

    ASSERT_THAT(reader_.read(path), is_ok()) << names[i];

    EXPECT_TRUE(same(reader_.cloud(), cloud)) << names[i];
    EXPECT_EQ(reader_.file_size(), std::filesystem::file_size(path)) << names[i];
  }
}

TEST_F(CloudReaderTest, ReusesTheMemoryOfRawPoints) {
  const auto large = put("large.bin", cloud_of(1000, 1));
  const auto small = put("small.bin", cloud_of(900, 2));
  ASSERT_THAT(reader_.read(large), is_ok());
  const std::byte* const place = reader_.cloud().bytes().data();

  ASSERT_THAT(reader_.read(small), is_ok());
  EXPECT_EQ(reader_.cloud().bytes().data(), place);
  ASSERT_THAT(reader_.read(large), is_ok());
  EXPECT_EQ(reader_.cloud().bytes().data(), place);
}

TEST_F(CloudReaderTest, HasNoPointsAfterAFailureAndReadsTheNextFile) {
  const auto good = put("good.bin", cloud_of(50, 1));
  put_file(folder_ / "cut.bin", std::string(45, 'x'));
  put_file(folder_ / "cut.pcd", "FIELDS x y z\n");
  const std::vector<std::string> bad{"cut.bin", "cut.pcd", "none.bin", "scan.txt"};
  for (const std::string& name : bad) {
    ASSERT_THAT(reader_.read(good), is_ok());

    EXPECT_FALSE(reader_.read(folder_ / name).ok()) << name;

    EXPECT_TRUE(reader_.cloud().empty()) << name;
    EXPECT_TRUE(reader_.cloud().fields().empty()) << name;
    EXPECT_EQ(reader_.file_size(), 0U) << name;
  }
  EXPECT_THAT(reader_.read(good), is_ok());
  EXPECT_TRUE(same(reader_.cloud(), cloud_of(50, 1)));
}

TEST_F(CloudReaderTest, FailsWithTheMessagesOfReadCloud) {
  put_file(folder_ / "cut.bin", std::string(45, 'x'));
  for (const std::string name : {"cut.bin", "none.bin", "scan.txt"}) {
    Cloud cloud;
    const Status alone = read_cloud(folder_ / name, {}, cloud);

    const Status status = reader_.read(folder_ / name);

    EXPECT_EQ(status.code(), alone.code());
    EXPECT_EQ(status.message(), alone.message());
    EXPECT_THAT(status.message(), HasSubstr(name + ": "));
  }
}

TEST_F(CloudReaderTest, ReleasesTheCloud) {
  const auto path = put("a.bin", cloud_of(10, 1));
  ASSERT_THAT(reader_.read(path), is_ok());

  const Cloud kept = reader_.release();

  EXPECT_TRUE(reader_.cloud().empty());
  ASSERT_THAT(reader_.read(put("b.bin", cloud_of(10, 2))), is_ok());
  EXPECT_TRUE(same(kept, cloud_of(10, 1)));
}

}  // namespace
}  // namespace flagstone::io
