// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {

/// Exit code and output of a run of the command.
struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  std::string out;
  std::string err;
};

/// A running process of the built `flagstone` command.
class CommandProcess {
 public:
  /// Starts the command. Standard output and standard error go to these files, if given.
  explicit CommandProcess(const std::vector<std::string>& arguments,
                          const std::filesystem::path& standard_output = {},
                          const std::filesystem::path& standard_error = {});
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;
  CommandProcess(CommandProcess&&) = delete;
  CommandProcess& operator=(CommandProcess&&) = delete;
  ~CommandProcess();

  /// Waits until the command has printed something; false if it has not within a minute.
  [[nodiscard]] bool prints_something() const;

  void send(int signal) const;

  /// Waits for the end of the process.
  Outcome finish();

 private:
  io::TemporaryFolder streams_;
  pid_t process_ = -1;
};

/// Runs the command and waits for its end.
Outcome run(const std::vector<std::string>& arguments);

/// The lines of `text`, without line breaks.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace flagstone::cli
