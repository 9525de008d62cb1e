// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/io/file_descriptor.hpp"

namespace flagstone::bench {

/// A peer that cannot be had or stopped working: one line, without its name.
class PeerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Another program, talked to through its standard input and output; ended at the end of its life.
/// What it says on standard error is not shown. It runs on one thread, as far as it follows
/// OMP_NUM_THREADS, on the cores this process may use, and Ctrl-C does not reach it.
class PeerProcess {
 public:
  /// Starts the program `command` names, looked for as a shell does. Throws PeerError.
  explicit PeerProcess(std::vector<std::string> command);
  ~PeerProcess();
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;
  PeerProcess(PeerProcess&&) = delete;
  PeerProcess& operator=(PeerProcess&&) = delete;

  /// Sends all of it. Throws PeerError where nobody listens any more.
  void send(std::span<const std::byte> bytes);
  void send_line(const std::string& line);

  /// The next line it prints, without its newline. Throws PeerError where it ends before, prints
  /// more than a line may hold, says nothing for so long, or a signal arrives meanwhile.
  std::string read_line(std::chrono::seconds patience);

 private:
  PeerProcess(std::array<int, 2> sockets, std::vector<std::string> command);

  io::FileDescriptor socket_;
  pid_t process_ = -1;
  std::string unread_;
};

}  // namespace flagstone::bench
