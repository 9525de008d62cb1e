// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {

/// How a run of the command ended and what it printed.
struct Outcome {
  int exit_code = -1;  ///< -1 where a signal ended it
  std::string out;
  std::string err;
};

/// The `flagstone` command as built, running with these arguments.
class CommandProcess {
 public:
  /// Starts it; standard output and standard error go to these files if they are named.
  explicit CommandProcess(const std::vector<std::string>& arguments,
                          const std::filesystem::path& standard_output = {},
                          const std::filesystem::path& standard_error = {});
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;
  CommandProcess(CommandProcess&&) = delete;
  CommandProcess& operator=(CommandProcess&&) = delete;
  ~CommandProcess();

  /// Returns when it has printed something or a minute is over; whether it has.
  [[nodiscard]] bool prints_something() const;

  void send(int signal) const;

  /// Waits for its end.
  Outcome finish();

 private:
  io::TemporaryFolder streams_;
  pid_t process_ = -1;
};

/// Runs the command to its end.
Outcome run(const std::vector<std::string>& arguments);

/// The lines of what was printed, without their newlines.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace flagstone::cli
