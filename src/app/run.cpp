// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flagstone::app {
namespace {

std::string duration_text(double seconds) {
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string to_text(const Progress& progress, std::size_t columns) {
  std::string text = fmt::format("{} of {} {}", progress.done, progress.total, progress.unit);
  if (progress.seconds_left && progress.done < progress.total) {
    text += fmt::format(", {} left", duration_text(*progress.seconds_left));
  }
  constexpr std::size_t widest = 30, narrowest = 5, frame = 3;  // "[", "] "
  if (columns >= text.size() + frame + narrowest) {
    const std::size_t width = std::min(widest, columns - text.size() - frame);
    const std::size_t filled = progress.total == 0 ? width : progress.done * width / progress.total;
    text = fmt::format("[{:#<{}}{: <{}}] {}", "", filled, "", width - filled, text);
  }
  return text.substr(0, columns);
}

Progress ProgressMeter::at(std::size_t done) const {
  Progress progress{.done = done, .total = total_, .unit = unit_};
  if (done > first_) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    progress.seconds_left =
        spent.count() / static_cast<double>(done - first_) * static_cast<double>(total_ - done);
  }
  return progress;
}

}  // namespace flagstone::app
