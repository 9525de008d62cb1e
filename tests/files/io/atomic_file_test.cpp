// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/atomic_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/file_size_limit.hpp"
#include "files/io/named_pipe.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/io/without_root.hpp"
#include "skip_on_windows.hpp"

namespace flagstone::io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(WriteFile, CreatesANewFile) {
  const TemporaryFolder folder;

  EXPECT_THAT(write_file(folder / "a", "hello"), is_ok());

  EXPECT_EQ(contents_of(folder / "a"), "hello");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, ReplacesAnOldFile) {
  const TemporaryFolder folder;
  put_file(folder / "a", "old and longer");

  EXPECT_THAT(write_file(folder / "a", "new"), is_ok());

  EXPECT_EQ(contents_of(folder / "a"), "new");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, WritesAnEmptyFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(write_file(folder / "a", ""), is_ok());
  EXPECT_TRUE(fs::exists(folder / "a"));
}

TEST(WriteFile, LeavesNothingBehindIfTheDiskIsFull) {
  FLAGSTONE_SKIP_ON_WINDOWS("limits of file sizes");
  const TemporaryFolder folder;
  const FileSizeLimit limit(1000);

  const Status status = write_file(folder / "a", std::string(2000, 'x'));

  EXPECT_THAT(status,
              fails(StatusCode::unwritable, AllOf(StartsWith((folder / "a").string() + ": "),
                                                  HasSubstr("File too large"))));
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteFile, KeepsTheOldFileIfTheDiskIsFull) {
  FLAGSTONE_SKIP_ON_WINDOWS("limits of file sizes");
  const TemporaryFolder folder;
  put_file(folder / "a", "old");
  const FileSizeLimit limit(1000);

  EXPECT_THAT(write_file(folder / "a", std::string(2000, 'x')),
              fails(StatusCode::unwritable, HasSubstr("a: ")));

  EXPECT_EQ(contents_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, RequiresAnExistingDirectory) {
  const TemporaryFolder folder;
  EXPECT_THAT(write_file(folder / "none" / "a", "x"),
              fails(StatusCode::unwritable, HasSubstr("No such file or directory")));
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteFile, RequiresAWritableDirectory) {
  FLAGSTONE_SKIP_ON_WINDOWS("permission bits");
  const TemporaryFolder folder;
  using enum fs::perms;
  fs::permissions(folder.path(), owner_read | owner_exec | others_read | others_exec);

  const WithoutRoot nobody;
  EXPECT_THAT(write_file(folder / "a", "x"),
              fails(StatusCode::unwritable, HasSubstr("Permission denied")));
}

TEST(WriteFile, DoesNotReplaceADirectory) {
  const TemporaryFolder folder;
  EXPECT_THAT(write_file(folder.path(), "x"),
              fails(StatusCode::unwritable, HasSubstr("is a directory")));
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteFile, DoesNotReplaceAPipeOrDevice) {
  FLAGSTONE_SKIP_ON_WINDOWS("pipes and devices in directories");
  const TemporaryFolder folder;
  ASSERT_TRUE(make_pipe(folder / "pipe"));

  EXPECT_THAT(write_file(folder / "pipe", "x"),
              fails(StatusCode::unwritable, HasSubstr("not a regular file")));
  EXPECT_THAT(write_file("/dev/full", "x"),
              fails(StatusCode::unwritable, HasSubstr("not a regular file")));

  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, FollowsASymbolicLink) {
  FLAGSTONE_SKIP_ON_WINDOWS("symbolic links that every user can create");
  const TemporaryFolder folder;
  put_file(folder / "target", "old");
  fs::create_symlink("target", folder / "link");

  EXPECT_THAT(write_file(folder / "link", "new"), is_ok());

  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(contents_of(folder / "target"), "new");
}

TEST(WriteFile, RejectsABrokenLink) {
  FLAGSTONE_SKIP_ON_WINDOWS("symbolic links that every user can create");
  const TemporaryFolder folder;
  fs::create_symlink("nowhere", folder / "link");
  EXPECT_THAT(write_file(folder / "link", "x"),
              fails(StatusCode::unwritable, HasSubstr("broken symbolic link")));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, SkipsExistingTemporaryFiles) {
  const TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) {
    put_file(
        folder / (".flagstone-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"),
        "other");
  }

  EXPECT_THAT(write_file(folder / "a", "x"), is_ok());

  EXPECT_EQ(folder.entries(), 101);
}

}  // namespace
}  // namespace flagstone::io
