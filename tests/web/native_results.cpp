// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Segments scans for web/test/native.test.mjs, which compares all bytes of the result with those of
// the WebAssembly module, and for scripts/cross, which compares them with those of other systems.
//
// Each line of standard input is METHOD PATH. The answer on standard output is the CPU time of the
// segmentation in milliseconds (float64), the number of bytes of the result (uint32), and these
// bytes: labels, heights, patches, and the cell, width (uint32), heights and confidences of every
// grid.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iostream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

#include "app/config/method_choice.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/method_runner.hpp"

namespace flagstone {
namespace {

struct Method {
  explicit Method(const config::ResolvedMethod& method) : runner(method.config, method.mount) {}

  eval::MethodRunner runner;
  Segmentation result;
};

void check(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

template <class T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
  const auto added = std::as_bytes(values);
  bytes.insert(bytes.end(), added.begin(), added.end());
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  append(bytes, std::span<const T>(&value, 1));
}

std::vector<std::byte> bytes_of(const Segmentation& result) {
  std::vector<std::byte> bytes;
  append(bytes, result.labels());
  append(bytes, result.heights());
  append(bytes, result.patches());
  for (const GroundSurface::Grid& grid : result.surface().grids()) {
    append(bytes, grid.cell);
    append(bytes, static_cast<std::uint32_t>(grid.width));
    append(bytes, std::span<const float>(grid.heights));
    append(bytes, std::span<const float>(grid.confidences));
  }
  return bytes;
}

void write(const std::vector<std::byte>& bytes) {
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
}

void answer_all() {
  std::map<std::string, Method> methods;
  io::CloudReader reader;
  std::string name;
  std::string path;
  std::string path_before;
  while (std::cin >> name && std::getline(std::cin >> std::ws, path)) {
    if (path != path_before) check(reader.read(path));
    path_before = path;
    auto [method, is_new] = methods.try_emplace(name, config::resolve_one({.methods = {name}}));
    auto& [runner, result] = method->second;
    runner.prepare(reader.cloud());
    const std::clock_t start = std::clock();
    check(runner.segment(reader.cloud(), result));
    const double milliseconds = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const std::vector<std::byte> bytes = bytes_of(result);
    std::vector<std::byte> answer;
    append(answer, milliseconds);
    append(answer, static_cast<std::uint32_t>(bytes.size()));
    write(answer);
    write(bytes);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace flagstone

int main() {
#ifdef _WIN32
  _setmode(_fileno(stdout), _O_BINARY);
#endif
  try {
    flagstone::answer_all();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
