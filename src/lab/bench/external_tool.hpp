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

/// Thrown if an external tool is not available or fails. The message is one line, without the name
/// of the tool.
class ExternalToolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A child process that communicates through standard input and output; it is killed on
/// destruction. Its standard error is discarded. It runs on the cores that this process may use,
/// with OMP_NUM_THREADS=1, and does not receive Ctrl-C. Not thread-safe.
class ExternalProcess {
 public:
  /// Starts the program `command`, searched for in PATH. Throws ExternalToolError.
  explicit ExternalProcess(std::vector<std::string> command);
  ~ExternalProcess();
  ExternalProcess(const ExternalProcess&) = delete;
  ExternalProcess& operator=(const ExternalProcess&) = delete;
  ExternalProcess(ExternalProcess&&) = delete;
  ExternalProcess& operator=(ExternalProcess&&) = delete;

  /// Sends all bytes. Throws ExternalToolError if the process has exited.
  void send(std::span<const std::byte> bytes);
  void send_line(const std::string& line);

  /// Reads the next line, without its newline. Throws ExternalToolError if the process exits,
  /// prints a line of more than 1000 bytes or prints nothing for `patience`, or if a signal
  /// arrives.
  std::string read_line(std::chrono::seconds patience);

 private:
  ExternalProcess(std::array<int, 2> sockets, std::vector<std::string> command);

  io::FileDescriptor socket_;
  pid_t process_ = -1;
  std::string unread_;
};

/// Paths of external tools.
struct ExternalToolPaths {
  std::string python = "python3";  ///< an interpreter with the packages installed
  std::string worker = {};  ///< bench/external_worker.py; empty for the file of this build tree
};

/// An external tool to compare with.
struct ExternalToolCommand {
  std::string name;
  std::vector<std::string> command;  ///< command line of its worker
  std::string missing;               ///< why it cannot be started, one line; empty if it can
};

/// The known external tools: the two methods of pypatchworkpp, and the plane RANSACs of Open3D and
/// PCL. `sensor_height`, metres, is passed to tools that use it.
[[nodiscard]] std::vector<ExternalToolCommand> known_external_tools(const ExternalToolPaths& places,
                                                                    float sensor_height);

/// An external tool that times itself on the scans it receives. bench/external_worker.py documents
/// the protocol.
class ExternalTool final : public Candidate {
 public:
  /// Starts its worker. Throws ExternalToolError.
  explicit ExternalTool(const ExternalToolCommand& tool);

  /// Waits until the worker is ready, then sends x, y, z and intensity (0 if a scan has none) of
  /// every point. Throws ExternalToolError.
  void take(std::span<const io::Cloud> scans);

  /// Throws ExternalToolError.
  Trial run_trial(std::size_t scan) override;

 private:
  ExternalProcess worker_;
};

}  // namespace flagstone::bench
