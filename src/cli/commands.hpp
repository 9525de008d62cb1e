// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace flagstone::cli {

/// A command of the program. CLI11 sets its options, then main() runs it.
class Command {
 public:
  explicit Command(const CLI::App& parser) : parser_(parser) {}
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Its `parsed()` is true if the user chose this command.
  [[nodiscard]] const CLI::App& parser() const noexcept { return parser_; }

  /// Returns the exit code. Throws std::invalid_argument for a usage error.
  virtual int run() = 0;

 private:
  const CLI::App& parser_;
};

// Each of these adds a command with its options and help to the program.
std::unique_ptr<Command> add_segment_command(CLI::App& app);
std::unique_ptr<Command> add_doctor_command(CLI::App& app);
std::unique_ptr<Command> add_info_command(CLI::App& app);
std::unique_ptr<Command> add_map_command(CLI::App& app);
std::unique_ptr<Command> add_bag_command(CLI::App& app);
std::unique_ptr<Command> add_ray_command(CLI::App& app);
std::unique_ptr<Command> add_eval_command(CLI::App& app);
std::unique_ptr<Command> add_sweep_command(CLI::App& app);
std::unique_ptr<Command> add_bench_command(CLI::App& app);
std::unique_ptr<Command> add_demo_command(CLI::App& app);
std::unique_ptr<Command> add_simulate_command(CLI::App& app);
std::unique_ptr<Command> add_config_command(CLI::App& app);
std::unique_ptr<Command> add_sensors_command(CLI::App& app);
std::unique_ptr<Command> add_completion_command(CLI::App& app);
std::unique_ptr<Command> add_manual_command(CLI::App& app);

}  // namespace flagstone::cli
