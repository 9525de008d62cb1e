// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace flagstone::cli {

/// A command of the program: CLI11 fills in its options, then main() runs it.
class Command {
 public:
  explicit Command(const CLI::App& parser) : parser_(parser) {}
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Knows whether it is this command that the user chose.
  [[nodiscard]] const CLI::App& parser() const noexcept { return parser_; }

  /// Returns the exit code. Throws std::invalid_argument for wrong usage.
  virtual int run() = 0;

 private:
  const CLI::App& parser_;
};

// Each adds a command and its options to the program.
std::unique_ptr<Command> add_segment_command(CLI::App& app);
std::unique_ptr<Command> add_doctor_command(CLI::App& app);
std::unique_ptr<Command> add_bench_command(CLI::App& app);
std::unique_ptr<Command> add_demo_command(CLI::App& app);
std::unique_ptr<Command> add_info_command(CLI::App& app);

}  // namespace flagstone::cli
