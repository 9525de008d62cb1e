// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/python_command.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "flagstone/version.hpp"

namespace flagstone::cli {
namespace {

/// Path of the interpreter; the Python package sets it (python/flagstone/_command.py).
constexpr const char* python_variable = "FLAGSTONE_PYTHON";

/// Removes the current directory from the search path of modules: it may contain files with the
/// names of modules.
constexpr const char* program =
    "import sys; sys.path = [entry for entry in sys.path if entry]; "
    "from flagstone._python_commands import main; sys.exit(main(sys.argv[1:]))";

/// The arguments of Python, of which the first is its path.
class PythonArguments {
 public:
  PythonArguments(const std::string& command, const nlohmann::ordered_json& options,
                  const std::vector<std::string>& paths, std::string_view extra) {
    const char* const python = std::getenv(python_variable);
    if (python == nullptr || *python == '\0') {
      throw std::invalid_argument(
          fmt::format("{}: this build of the command does not include the Python package (install "
                      "it with: pip install 'flagstone[{}]')",
                      command, extra));
    }
    using Handler = nlohmann::ordered_json::error_handler_t;
    texts_ = {python,  "-c",
              program, FLAGSTONE_VERSION,
              command, options.dump(-1, ' ', false, Handler::replace)};
    texts_.insert(texts_.end(), paths.begin(), paths.end());
    for (std::string& text : texts_) pointers_.push_back(text.data());
    pointers_.push_back(nullptr);
  }
  PythonArguments(const PythonArguments&) = delete;
  PythonArguments& operator=(const PythonArguments&) = delete;
  ~PythonArguments() = default;

  [[nodiscard]] const char* python() const noexcept { return pointers_[0]; }
  [[nodiscard]] char* const* pointers() const noexcept { return pointers_.data(); }

  [[noreturn]] void throw_not_started(int error) const {
    throw std::runtime_error(fmt::format("{}: cannot be started: {} (check {})",
                                         io::printable(python()), std::strerror(error),
                                         python_variable));
  }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

/// Waits for a process. Returns its status as waitpid() does.
int wait_for(pid_t process) {
  using namespace std::chrono_literals;
  constexpr auto pause = 20ms;
  constexpr auto patience = 2s;  // Ctrl-C reaches the process without our help
  auto since_interrupt = 0ms;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (interrupted()) {
      if (since_interrupt == patience) ::kill(process, SIGTERM);
      since_interrupt += pause;
    }
    std::this_thread::sleep_for(pause);
  }
  return status;
}

}  // namespace

void run_in_python(const std::string& command, const nlohmann::ordered_json& options,
                   const std::vector<std::string>& paths) {
  const PythonArguments arguments(command, options, paths, command == "ray" ? "ray" : "bag");
  std::fflush(stdout);
  ::execv(arguments.python(), arguments.pointers());
  arguments.throw_not_started(errno);
}

int call_python(const std::string& command, const nlohmann::ordered_json& options,
                const std::vector<std::string>& paths, std::string_view extra) {
  const PythonArguments arguments(command, options, paths, extra);
  std::fflush(stdout);
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, arguments.python(), nullptr, nullptr, arguments.pointers(), environ);
  if (error != 0) arguments.throw_not_started(error);
  const int status = wait_for(process);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

bool is_bag(std::string_view path) {
  std::error_code ignored;
  const std::filesystem::path file(path);
  if (std::filesystem::is_directory(file, ignored)) {
    return std::filesystem::exists(file / "metadata.yaml", ignored);
  }
  constexpr std::array endings = {".bag", ".mcap", ".db3", ".mcap.zstd", ".db3.zstd"};
  return std::ranges::any_of(endings, [&](const char* ending) { return path.ends_with(ending); });
}

bool are_bags(const std::vector<std::string>& paths) {
  const auto bag = std::ranges::find_if(paths, is_bag);
  const auto scan = std::ranges::find_if_not(paths, is_bag);
  if (bag == paths.end() || scan == paths.end()) return scan == paths.end();
  throw std::invalid_argument(
      fmt::format("{}: is a bag, and {} is not (expected either bags or scans)",
                  io::printable(*bag), io::printable(*scan)));
}

}  // namespace flagstone::cli
