// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/file_descriptor.hpp"
#include "lab/bench/candidates.hpp"

namespace flagstone::bench {

/// An external tool that cannot be had or stopped working: one line, without its name.
class ExternalToolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Another program, talked to through its standard input and output; ended at the end of its life.
/// What it says on standard error is not shown. It runs on one thread, as far as it follows
/// OMP_NUM_THREADS, on the cores this process may use, and Ctrl-C does not reach it.
class ExternalProcess {
 public:
  /// Starts the program `command` names, looked for as a shell does. Throws ExternalToolError.
  explicit ExternalProcess(std::vector<std::string> command);
  ~ExternalProcess();
  ExternalProcess(const ExternalProcess&) = delete;
  ExternalProcess& operator=(const ExternalProcess&) = delete;
  ExternalProcess(ExternalProcess&&) = delete;
  ExternalProcess& operator=(ExternalProcess&&) = delete;

  /// Sends all of it. Throws ExternalToolError where nobody listens any more.
  void send(std::span<const std::byte> bytes);
  void send_line(const std::string& line);

  /// The next line it prints, without its newline. Throws ExternalToolError where it ends before,
  /// prints more than a line may hold, says nothing for so long, or a signal arrives meanwhile.
  std::string read_line(std::chrono::seconds patience);

 private:
  ExternalProcess(std::array<int, 2> sockets, std::vector<std::string> command);

  io::FileDescriptor socket_;
  pid_t process_ = -1;
  std::string unread_;
};

/// Where other people's programs are found.
struct ExternalToolPaths {
  std::string python = "python3";  ///< an interpreter that has the packages
  std::string worker = {};         ///< bench/peer_worker.py; empty for that around the command
};

/// A program to compare with.
struct ExternalToolCommand {
  std::string name;
  std::vector<std::string> command;  ///< what starts its worker
  std::string missing;               ///< why it cannot be started, one line; else empty
};

/// The programs there may be: pypatchworkpp's two methods, and the plane RANSACs of Open3D and of
/// PCL. `sensor_height`: metres, for those that ask.
[[nodiscard]] std::vector<ExternalToolCommand> known_external_tools(const ExternalToolPaths& places,
                                                                    float sensor_height);

/// A program that times itself on the scans it was sent: bench/peer_worker.py says how they talk.
class ExternalTool final : public Candidate {
 public:
  /// Starts its worker. Throws ExternalToolError.
  explicit ExternalTool(const ExternalToolCommand& tool);

  /// Waits until it is ready and sends it x, y, z and intensity (0 where a scan has none) of every
  /// point. Throws ExternalToolError.
  void take(std::span<const io::Cloud> scans);

  /// Throws ExternalToolError.
  Trial run_trial(std::size_t scan) override;

 private:
  ExternalProcess worker_;
};

}  // namespace flagstone::bench
