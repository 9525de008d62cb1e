// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/peer.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "files/io/message.hpp"

namespace flagstone::bench {
namespace {

using namespace std::chrono_literals;

// Loading Open3D from a cold disk takes long; so may a scan of millions of points.
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

// The command lies in the build folder of its source tree, which has what is compared with. Carried
// off, with the Python package, it finds neither.
std::string beside_this_program(const char* place) {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return (program.parent_path() / place).lexically_normal().string();
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

PeerCommand python_peer(const PeerPlaces& places, const std::string& name, float sensor_height) {
  const std::string worker =
      places.worker.empty() ? beside_this_program("../bench/peer_worker.py") : places.worker;
  PeerCommand peer{name, {places.python, worker, name, fmt::format("{}", sensor_height)}, ""};
  if (!is_file(worker)) {
    peer.missing = fmt::format(
        "{}: no such file; name bench/peer_worker.py of flagstone's sources with --compare-worker",
        io::printable(worker));
  }
  return peer;
}

PeerCommand pcl_peer() {
  const std::string worker = beside_this_program("bench/pcl_ransac");
  if (is_file(worker)) return {"pcl-ransac", {worker}, ""};
  return {"pcl-ransac", {}, "not built, since CMake found no PCL (Debian: libpcl-dev)"};
}

/// The two numbers of "NANOSECONDS GROUND"; what it says instead is why it failed.
std::array<std::uint64_t, 2> numbers_of(std::string_view answer) {
  std::array<std::uint64_t, 2> numbers{};
  const char* at = answer.data();
  const char* const end = at + answer.size();
  for (std::uint64_t& number : numbers) {
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc()) {
      throw PeerError(fmt::format("its worker said {}", io::quote(answer)));
    }
    at = after == end ? end : after + 1;
  }
  return numbers;
}

}  // namespace

std::vector<PeerCommand> known_peers(const PeerPlaces& places, float sensor_height) {
  return {python_peer(places, "pypatchworkpp-patchwork", sensor_height),
          python_peer(places, "pypatchworkpp-patchworkpp", sensor_height),
          python_peer(places, "open3d-ransac", sensor_height), pcl_peer()};
}

Peer::Peer(const PeerCommand& peer) : worker_(peer.command) {}

void Peer::take(std::span<const io::Cloud> scans) {
  const std::string greeting = worker_.read_line(patience);
  if (greeting != "ready") throw PeerError(io::printable(greeting));
  for (const io::Cloud& scan : scans) {
    worker_.send_line(fmt::format("scan {}", scan.size()));
    const std::vector<float> values = xyzi_of(scan);
    worker_.send(std::as_bytes(std::span(values)));
  }
}

Visit Peer::visit(std::size_t scan) {
  worker_.send_line(fmt::format("run {}", scan));
  const auto [nanoseconds, ground] = numbers_of(worker_.read_line(patience));
  return {.milliseconds = static_cast<double>(nanoseconds) / 1e6,
          .ground = static_cast<std::size_t>(ground)};
}

}  // namespace flagstone::bench
