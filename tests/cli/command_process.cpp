// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/command_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <sstream>
#include <system_error>
#include <thread>

#include "files/io/file_contents.hpp"

namespace flagstone::cli {
namespace {

/// The files of the three standard streams of a new process.
class Streams {
 public:
  Streams() { ::posix_spawn_file_actions_init(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  Streams(Streams&&) = delete;
  Streams& operator=(Streams&&) = delete;
  ~Streams() { ::posix_spawn_file_actions_destroy(&actions_); }

  void lead(int stream, const std::filesystem::path& file, int flags) {
    ::posix_spawn_file_actions_addopen(&actions_, stream, file.c_str(), flags, 0600);
  }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

CommandProcess::CommandProcess(const std::vector<std::string>& arguments,
                               const std::filesystem::path& standard_output,
                               const std::filesystem::path& standard_error) {
  std::vector<std::string> words = {FLAGSTONE_COMMAND};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  Streams streams;
  streams.lead(STDIN_FILENO, "/dev/null", O_RDONLY);
  streams.lead(STDOUT_FILENO, standard_output.empty() ? streams_ / "out" : standard_output,
               O_WRONLY | O_CREAT);
  streams.lead(STDERR_FILENO, standard_error.empty() ? streams_ / "err" : standard_error,
               O_WRONLY | O_CREAT | O_NOCTTY);
  // Restore the default as a shell does: a child of a test that ignores SIGXFSZ would ignore it
  // too.
  posix_spawnattr_t attributes{};
  ::posix_spawnattr_init(&attributes);
  sigset_t defaults{};
  ::sigemptyset(&defaults);
  ::sigaddset(&defaults, SIGXFSZ);
  ::posix_spawnattr_setsigdefault(&attributes, &defaults);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error =
      ::posix_spawn(&process_, argv[0], streams.get(), &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::generic_category(), argv[0]);
}

CommandProcess::~CommandProcess() {
  if (process_ < 0) return;
  send(SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool CommandProcess::prints_something() const {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 1min;
  while (std::chrono::steady_clock::now() < end) {
    std::error_code ignored;
    if (std::filesystem::file_size(streams_ / "out", ignored) > 0 && !ignored) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

void CommandProcess::send(int signal) const { ::kill(process_, signal); }

Outcome CommandProcess::finish() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  process_ = -1;
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = io::contents_of(streams_ / "out"),
          .err = io::contents_of(streams_ / "err")};
}

Outcome run(const std::vector<std::string>& arguments) {
  return CommandProcess(arguments).finish();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace flagstone::cli
