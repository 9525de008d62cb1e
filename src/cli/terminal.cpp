// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "files/io/message.hpp"

namespace flagstone::cli {
namespace {

volatile std::sig_atomic_t was_signalled = 0;

void handle_signal(int signal) {
  was_signalled = 1;
  std::signal(signal, SIG_DFL);
}

/// Width of the terminal on standard error; otherwise COLUMNS, otherwise 80.
std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  std::size_t columns = 0;
  if (const char* const text = std::getenv("COLUMNS")) {
    const std::string_view digits = text;
    std::from_chars(digits.data(), digits.data() + digits.size(), columns);
  }
  return columns > 0 ? columns : 80;
}

}  // namespace

void print_error(std::string_view message) {
  // Not fmt::print, which throws if standard error cannot be written.
  std::fputs(fmt::format("flagstone: {}\n", io::printable(message)).c_str(), stderr);
}

void catch_interrupts() {
  std::signal(SIGINT, handle_signal);
  std::signal(SIGTERM, handle_signal);
}

bool interrupted() noexcept { return was_signalled != 0; }

void ProgressBar::show(const app::Progress& progress) {
  if (progress.total <= 1 || ::isatty(STDERR_FILENO) == 0) return;
  // A line of the full width would move the cursor to the next line.
  std::fputs(("\r\x1b[K" + app::to_text(progress, terminal_columns() - 1)).c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

void ProgressBar::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

app::RunCallbacks ProgressBar::callbacks() {
  return {.progress =
              [this](const app::Progress& progress) {
                std::fflush(stdout);
                show(progress);
              },
          .message =
              [this](const std::string& line) {
                clear();
                print_error(line);
              },
          .stop = interrupted};
}

}  // namespace flagstone::cli
