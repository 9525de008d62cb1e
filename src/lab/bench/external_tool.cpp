// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/external_tool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/io/message.hpp"

namespace flagstone::bench {

namespace {

#ifdef MSG_NOSIGNAL
constexpr int send_flags = MSG_NOSIGNAL;
#else
constexpr int send_flags = 0;
#endif

/// File actions and attributes for posix_spawn.
class SpawnSettings {
 public:
  explicit SpawnSettings(int socket) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, socket, STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawnattr_init(&attributes_);
    // A separate process group, so that Ctrl-C in the terminal does not reach the tool.
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  SpawnSettings(SpawnSettings&&) = delete;
  SpawnSettings& operator=(SpawnSettings&&) = delete;
  ~SpawnSettings() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
  }

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_of_one_thread() {
  constexpr std::string_view name = "OMP_NUM_THREADS=";
  std::vector<std::string> variables = {std::string(name) + "1"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with(name)) variables.emplace_back(*variable);
  }
  return variables;
}

std::string reason_of(int error) { return std::generic_category().message(error); }

/// A pair of connected sockets that other programs do not inherit.
std::array<int, 2> connected_sockets() {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets.data()) != 0) {
    throw ExternalToolError(fmt::format("cannot be connected: {}", reason_of(errno)));
  }
  for (const int socket : sockets) ::fcntl(socket, F_SETFD, FD_CLOEXEC);
#ifdef SO_NOSIGPIPE
  const int yes = 1;
  ::setsockopt(sockets[0], SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes);
#endif
  return sockets;
}

}  // namespace

ExternalProcess::ExternalProcess(std::vector<std::string> command)
    : ExternalProcess(connected_sockets(), std::move(command)) {}

ExternalProcess::ExternalProcess(std::array<int, 2> sockets, std::vector<std::string> command)
    : socket_(sockets[0]) {
  const io::FileDescriptor theirs(sockets[1]);
  const SpawnSettings settings(theirs.get());
  std::vector<std::string> environment = environment_of_one_thread();
  const int error =
      ::posix_spawnp(&process_, command.front().c_str(), settings.actions(), settings.attributes(),
                     pointers_to(command).data(), pointers_to(environment).data());
  if (error != 0) {
    process_ = -1;
    throw ExternalToolError(
        fmt::format("{} cannot be started: {}", command.front(), reason_of(error)));
  }
}

ExternalProcess::~ExternalProcess() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);  // it has no results to wait for
  ::waitpid(process_, nullptr, 0);
}

void ExternalProcess::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), send_flags);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) throw ExternalToolError("its worker exited early");
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void ExternalProcess::send_line(const std::string& line) {
  const std::string text = line + "\n";
  send(std::as_bytes(std::span(text)));
}

std::string ExternalProcess::read_line(std::chrono::seconds patience) {
  constexpr std::size_t longest = 1000;
  const std::chrono::milliseconds wait = patience;
  while (unread_.find('\n') == std::string::npos) {
    if (unread_.size() > longest)
      throw ExternalToolError("its worker printed a line of more than 1000 bytes");
    pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(wait.count()));
    if (ready < 0) throw ExternalToolError("interrupted");
    if (ready == 0) {
      throw ExternalToolError(
          fmt::format("its worker did not answer within {} s", patience.count()));
    }
    std::array<char, 256> part{};
    const ssize_t size = ::read(socket_.get(), part.data(), part.size());
    if (size <= 0) throw ExternalToolError("its worker exited early");
    unread_.append(part.data(), static_cast<std::size_t>(size));
  }
  const std::size_t end = unread_.find('\n');
  std::string line = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return line;
}

namespace {

using namespace std::chrono_literals;

// Loading Open3D from a cold disk, or processing millions of points, can take minutes.
constexpr auto patience = 300s;

std::vector<float> xyzi_of(const io::Cloud& cloud) {
  const io::Field* const intensity = cloud.find("intensity");
  const CloudView points = cloud.view();
  std::vector<float> values;
  values.reserve(4 * cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = points[i];
    const float strength =
        intensity == nullptr ? 0 : static_cast<float>(cloud.value(i, *intensity));
    values.insert(values.end(), {p.x, p.y, p.z, strength});
  }
  return values;
}

// Finds a file relative to this program. This works in a build tree. An installed program, as in
// the Python package, does not find the workers.
std::string next_to_this_program(const char* path) {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return (program.parent_path() / path).lexically_normal().string();
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

ExternalToolCommand python_tool(const ExternalToolPaths& places, const std::string& name,
                                float sensor_height) {
  const std::string worker =
      places.worker.empty() ? next_to_this_program("../bench/external_worker.py") : places.worker;
  ExternalToolCommand tool{
      name, {places.python, worker, name, fmt::format("{}", sensor_height)}, ""};
  if (!is_file(worker)) {
    tool.missing = fmt::format(
        "{}: no such file (pass bench/external_worker.py of flagstone's sources with "
        "--compare-worker)",
        io::printable(worker));
  }
  return tool;
}

ExternalToolCommand pcl_tool() {
  const std::string worker = next_to_this_program("bench/pcl_ransac");
  if (is_file(worker)) return {"pcl-ransac", {worker}, ""};
  return {"pcl-ransac", {}, "not built, because CMake did not find PCL (Debian: libpcl-dev)"};
}

/// Parses "NANOSECONDS GROUND". Any other answer is the reason for a failure.
std::array<std::uint64_t, 2> numbers_of(std::string_view answer) {
  std::array<std::uint64_t, 2> numbers{};
  const char* at = answer.data();
  const char* const end = at + answer.size();
  for (std::uint64_t& number : numbers) {
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc()) {
      throw ExternalToolError(fmt::format("its worker answered {}", io::quote(answer)));
    }
    at = after == end ? end : after + 1;
  }
  return numbers;
}

}  // namespace

std::vector<ExternalToolCommand> known_external_tools(const ExternalToolPaths& places,
                                                      float sensor_height) {
  return {python_tool(places, "pypatchworkpp-patchwork", sensor_height),
          python_tool(places, "pypatchworkpp-patchworkpp", sensor_height),
          python_tool(places, "open3d-ransac", sensor_height), pcl_tool()};
}

ExternalTool::ExternalTool(const ExternalToolCommand& tool) : worker_(tool.command) {}

void ExternalTool::take(std::span<const io::Cloud> scans) {
  const std::string greeting = worker_.read_line(patience);
  if (greeting != "ready") throw ExternalToolError(io::printable(greeting));
  for (const io::Cloud& scan : scans) {
    worker_.send_line(fmt::format("scan {}", scan.size()));
    const std::vector<float> values = xyzi_of(scan);
    worker_.send(std::as_bytes(std::span(values)));
  }
}

Trial ExternalTool::run_trial(std::size_t scan) {
  worker_.send_line(fmt::format("run {}", scan));
  const auto [nanoseconds, ground] = numbers_of(worker_.read_line(patience));
  return {.milliseconds = static_cast<double>(nanoseconds) / 1e6,
          .ground = static_cast<std::size_t>(ground)};
}

}  // namespace flagstone::bench
