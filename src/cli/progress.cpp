// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace flagstone::cli {
namespace {

std::string duration_text(double seconds) {
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_text(std::size_t done, std::size_t total,
                          std::chrono::duration<double> spent) {
  constexpr std::size_t width = 30;
  const std::size_t filled = total == 0 ? width : done * width / total;
  std::string text =
      fmt::format("[{:#<{}}{: <{}}] {} of {} scans", "", filled, "", width - filled, done, total);
  if (done > 0 && done < total) {
    const double each = spent.count() / static_cast<double>(done);
    text += fmt::format(", {} left", duration_text(each * static_cast<double>(total - done)));
  }
  return text;
}

Progress::Progress(std::size_t total)
    : total_(total), on_terminal_(total > 1 && isatty(STDERR_FILENO) != 0) {}

void Progress::show(std::size_t done) {
  if (!on_terminal_) return;
  const auto spent = std::chrono::steady_clock::now() - start_;
  std::fputs(("\r\x1b[K" + progress_text(done, total_, spent)).c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace flagstone::cli
