// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Output to a terminal: a progress bar that fits, and file names without control characters.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/labelled_scans.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A terminal with this number of columns, and the text written to it.
class Terminal {
 public:
  explicit Terminal(unsigned short columns) : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(master_);
    ::unlockpt(master_);
    name_ = ::ptsname(master_);
    ours_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY);  // keeps it open after the first writer
    winsize size{};
    size.ws_col = columns;
    size.ws_row = 24;
    ::ioctl(ours_, TIOCSWINSZ, &size);
    reader_ = std::thread([this] { read(); });
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  Terminal(Terminal&&) = delete;
  Terminal& operator=(Terminal&&) = delete;
  ~Terminal() { close(); }

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// The text written so far; closes the terminal.
  std::string text() {
    close();
    return text_;
  }

 private:
  void read() {
    std::array<char, 4096> bytes{};
    for (;;) {
      const ssize_t count = ::read(master_, bytes.data(), bytes.size());
      if (count <= 0) return;
      text_.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }
  void close() {
    if (ours_ < 0) return;
    ::close(ours_);
    ours_ = -1;
    reader_.join();
    ::close(master_);
  }

  int master_ = -1;
  int ours_ = -1;
  std::string name_;
  std::string text_;
  std::thread reader_;
};

/// Length of the longest text between two deletions of the line; adds their number to `updates`.
std::size_t widest(const std::string& text, std::size_t& updates) {
  constexpr std::string_view erase = "\r\x1b[K";
  std::size_t most = 0;
  std::size_t at = text.find(erase);
  while (at != std::string::npos) {
    const std::size_t begin = at + erase.size();
    at = text.find(erase, begin);
    most = std::max(most, std::min(at, text.size()) - begin);
    ++updates;
  }
  return most;
}

void expect_it_fits(const std::vector<std::string>& arguments, const std::string& unit) {
  Terminal terminal(40);
  const io::TemporaryFolder streams;
  EXPECT_EQ(CommandProcess(arguments, streams / "out", terminal.name()).finish().exit_code, 0);

  const std::string text = terminal.text();
  std::size_t updates = 0;
  EXPECT_LT(widest(text, updates), 40U) << text;
  EXPECT_GE(updates, 2U);
  EXPECT_THAT(text, HasSubstr(" of 8 " + unit));
  EXPECT_THAT(text, Not(HasSubstr("\n")));
}

TEST(ProgressBar, FitsFortyColumnsInEveryCommand) {
  const io::TemporaryFolder folder;
  for (char name = '0'; name < '8'; ++name) {
    put_labelled(folder / "data", std::string("00000") + name, small_scan(400));
  }
  const std::string data = folder.path().string() + "/data";
  expect_it_fits({"segment", data + "/velodyne", "-o", folder.path().string() + "/out"}, "scans");
  expect_it_fits({"eval", data}, "scans");
  expect_it_fits({"simulate", "--scene", "flat_street", "--sensor", "vlp-16", "--frames", "8", "-o",
                  folder.path().string() + "/simulated"},
                 "");
}

TEST(FileName, CannotControlTheTerminal) {
  const io::TemporaryFolder folder;
  const std::string name = "two\nlines\033[2J.bin";
  put_scan(folder / name, small_scan(200));

  const Outcome segmented =
      run({"segment", (folder / name).string(), "-o", (folder / "out").string()});
  const Outcome shown = run({"info", (folder / name).string()});
  const Outcome examined = run({"doctor", (folder / name).string()});

  for (const std::string& out : {segmented.out, shown.out, examined.out}) {
    EXPECT_THAT(out, HasSubstr("two\\x0alines\\x1b[2J.bin"));
    EXPECT_THAT(out, Not(HasSubstr("\033")));
  }
  EXPECT_EQ(lines_of(segmented.out).size(), 1U);
}

}  // namespace
}  // namespace flagstone::cli
