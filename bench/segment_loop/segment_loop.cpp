// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Segments scans on demand, for bench/compare.py: one round over all scans for each line of
// standard input, whose times it prints in nanoseconds. Uses what every revision of the library
// has, and the method surface where there is one.
//
//     segment_loop METHOD FILE...    patchwork or surface; KITTI's .bin: x, y, z and intensity as
//                                    32-bit floats

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <flagstone/flagstone.hpp>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr std::size_t floats_a_point = 4;

std::vector<float> read_floats(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::vector<float> floats(static_cast<std::size_t>(file.tellg()) / sizeof(float));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(floats.data()),
            static_cast<std::streamsize>(floats.size() * sizeof(float)));
  return floats;
}

/// Null where this revision has no such method.
std::unique_ptr<flagstone::Segmenter> make_segmenter(const std::string& method) {
  if (method == "patchwork") return std::make_unique<flagstone::Patchwork>();
#if __has_include(<flagstone/surface_segmenter.hpp>)  // its name in revisions up to 2026-11-21
  if (method == "surface") return std::make_unique<flagstone::SurfaceSegmenter>();
#elif __has_include(<flagstone/surface.hpp>)
  if (method == "surface") return std::make_unique<flagstone::Surface>();
#endif
  return nullptr;
}

/// FNV-1a of the labels: equal wherever the labels are.
std::uint64_t hash_of(const flagstone::Segmentation& result) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const flagstone::Label label : result.labels()) {
    hash = (hash ^ static_cast<std::uint64_t>(label)) * 0x100000001b3;
  }
  return hash;
}

}  // namespace

/// By this name callgrind is told to count here alone.
extern "C" [[gnu::noinline]] void segment_measured(flagstone::Segmenter& segmenter,
                                                   const flagstone::CloudView& cloud,
                                                   flagstone::Segmentation& result) {
  (void)segmenter.segment(cloud, result);
}

int main(int argc, char** argv) {
  const std::string method = argc < 2 ? "" : argv[1];
  const std::unique_ptr<flagstone::Segmenter> segmenter = make_segmenter(method);
  if (segmenter == nullptr) {
    std::cerr << "this revision has no method \"" << method << "\" to time\n";
    return 1;
  }
  std::vector<std::vector<float>> scans;
  for (int i = 2; i < argc; ++i) {
    scans.push_back(read_floats(argv[i]));
    if (scans.back().size() < floats_a_point) {
      std::cerr << argv[i] << ": holds no points of four 32-bit floats; give KITTI's .bin files\n";
      return 1;
    }
  }
  flagstone::Segmentation result;
  const auto view_of = [](const std::vector<float>& scan) {
    return flagstone::CloudView(scan.data(), scan.size() / floats_a_point, floats_a_point);
  };

  // Twice to warm up; then what the labels are.
  for (int round = 0; round < 2; ++round) {
    for (const std::vector<float>& scan : scans) (void)segmenter->segment(view_of(scan), result);
  }
  for (const std::vector<float>& scan : scans) {
    (void)segmenter->segment(view_of(scan), result);
    std::cout << hash_of(result) << ' ';
  }
  std::cout << '\n' << std::flush;

  for (std::string line; std::getline(std::cin, line);) {
    // Another program had the core in between: the first scan is not to pay for the caches.
    (void)segmenter->segment(view_of(scans.back()), result);
    for (const std::vector<float>& scan : scans) {
      const flagstone::CloudView cloud = view_of(scan);
      const auto start = std::chrono::steady_clock::now();
      segment_measured(*segmenter, cloud, result);
      const std::chrono::nanoseconds time = std::chrono::steady_clock::now() - start;
      std::cout << time.count() << ' ';
    }
    std::cout << '\n' << std::flush;
  }
  return 0;
}
