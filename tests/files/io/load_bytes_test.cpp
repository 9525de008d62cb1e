// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/load_bytes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "files/io/bytes.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/named_pipe.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/io/text.hpp"
#include "files/io/without_root.hpp"
#include "skip_on_windows.hpp"

namespace flagstone::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(LoadBytes, ReadsAWholeFile) {
  const TemporaryFolder folder;
  const std::string contents = "a\n" + std::string(100000, '\0') + "b";
  put_file(folder / "a", contents);
  Bytes bytes;

  ASSERT_THAT(load_bytes(folder / "a", bytes), is_ok());

  EXPECT_EQ(as_text(bytes), contents);
}

TEST(LoadBytes, ReadsAnEmptyFile) {
  const TemporaryFolder folder;
  put_file(folder / "a", "");
  Bytes bytes;
  EXPECT_THAT(load_bytes(folder / "a", bytes), is_ok());
  EXPECT_TRUE(bytes.empty());
}

TEST(LoadBytes, ReportsAMissingFile) {
  const TemporaryFolder folder;
  Bytes bytes;
  const auto path = folder / "none";
  EXPECT_THAT(load_bytes(path, bytes),
              fails(StatusCode::not_found,
                    AllOf(StartsWith(path.string() + ": "), HasSubstr("No such file"))));
}

TEST(LoadBytes, ReportsOneLineForAnyPath) {
  FLAGSTONE_SKIP_ON_WINDOWS("names with line breaks");
  Bytes bytes;
  EXPECT_THAT(load_bytes("no\nsuch\nfile", bytes),
              fails(StatusCode::not_found, StartsWith(R"(no\x0asuch\x0afile: )")));
}

TEST(LoadBytes, RejectsADirectory) {
  const TemporaryFolder folder;
  Bytes bytes;
  EXPECT_THAT(load_bytes(folder.path(), bytes),
              fails(StatusCode::unreadable, HasSubstr("is a directory")));
}

TEST(LoadBytes, RejectsAPipeWithoutWaiting) {
  FLAGSTONE_SKIP_ON_WINDOWS("pipes in directories");
  const TemporaryFolder folder;
  ASSERT_TRUE(make_pipe(folder / "pipe"));
  Bytes bytes;
  EXPECT_THAT(load_bytes(folder / "pipe", bytes),
              fails(StatusCode::unreadable, HasSubstr("is a pipe")));
}

TEST(LoadBytes, RejectsADevice) {
  FLAGSTONE_SKIP_ON_WINDOWS("devices in directories");
  Bytes bytes;
  EXPECT_THAT(load_bytes("/dev/zero", bytes),
              fails(StatusCode::unreadable, HasSubstr("is a device")));
}

TEST(LoadBytes, ReportsMissingPermission) {
  FLAGSTONE_SKIP_ON_WINDOWS("permission bits");
  const TemporaryFolder folder;
  put_file(folder / "a", "x");
  std::filesystem::permissions(folder / "a", std::filesystem::perms::none);
  Bytes bytes;
  const WithoutRoot nobody;
  EXPECT_THAT(load_bytes(folder / "a", bytes),
              fails(StatusCode::unreadable, HasSubstr("Permission denied")));
}

TEST(LoadBytes, RejectsAFileAboveTheLimitBeforeAllocating) {
  FLAGSTONE_SKIP_ON_WINDOWS("a resize_file() beyond 4 GiB in the libc++ of Zig");
  const TemporaryFolder folder;
  put_file(folder / "a", "");
  std::filesystem::resize_file(folder / "a", max_file_size + 1);  // sparse: takes no space on disk
  Bytes bytes;
  EXPECT_THAT(load_bytes(folder / "a", bytes),
              fails(StatusCode::bad_file, HasSubstr("at most 8589934592")));
}

TEST(LoadBytes, ReusesTheMemoryOfTheResult) {
  const TemporaryFolder folder;
  put_file(folder / "long", std::string(5000, 'a'));
  put_file(folder / "short", "bcd");
  Bytes bytes;
  ASSERT_THAT(load_bytes(folder / "long", bytes), is_ok());
  const std::byte* const place = bytes.data();

  ASSERT_THAT(load_bytes(folder / "short", bytes), is_ok());

  EXPECT_EQ(as_text(bytes), "bcd");
  EXPECT_EQ(bytes.data(), place);
}

TEST(LoadBytes, IsEmptyAfterAFailure) {
  const TemporaryFolder folder;
  Bytes bytes(100);
  EXPECT_FALSE(load_bytes(folder / "none", bytes).ok());
  EXPECT_TRUE(bytes.empty());
}

TEST(ReadAhead, LeavesFilesReadableAndDoesNotWaitForPipes) {
  FLAGSTONE_SKIP_ON_WINDOWS("pipes in directories");
  const TemporaryFolder folder;
  put_file(folder / "a", "x");
  ASSERT_TRUE(make_pipe(folder / "pipe"));

  read_ahead(folder / "none");
  read_ahead(folder / "pipe");
  read_ahead(folder / "a");

  Bytes bytes;
  EXPECT_THAT(load_bytes(folder / "a", bytes), is_ok());
  EXPECT_EQ(as_text(bytes), "x");
}

}  // namespace
}  // namespace flagstone::io
