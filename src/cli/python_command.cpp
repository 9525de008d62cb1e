// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/python_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

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

}  // namespace

void run_in_python(const std::string& command, const nlohmann::ordered_json& options,
                   const std::vector<std::string>& paths) {
  const char* const python = std::getenv(python_variable);
  if (python == nullptr || *python == '\0') {
    throw std::invalid_argument(
        fmt::format("{}: this build of the command does not include the Python package (install it "
                    "with: pip install 'flagstone[{}]')",
                    command, command == "ray" ? "ray" : "bag"));
  }
  using Handler = nlohmann::ordered_json::error_handler_t;
  std::vector<std::string> arguments = {python,  "-c",
                                        program, FLAGSTONE_VERSION,
                                        command, options.dump(-1, ' ', false, Handler::replace)};
  arguments.insert(arguments.end(), paths.begin(), paths.end());
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  ::execv(python, pointers.data());
  throw std::runtime_error(fmt::format("{}: cannot be started: {} (check {})",
                                       io::printable(python), std::strerror(errno),
                                       python_variable));
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
