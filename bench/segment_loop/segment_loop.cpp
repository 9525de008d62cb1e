// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Segments scans on demand for bench/compare.py. For each line of standard input, it segments all
// scans once and prints the times in nanoseconds. It uses only the API that every revision of the
// library has, and the method surface if the revision has it.
//
//     segment_loop [--target NAME] METHOD FILE...
//
//     NAME     instruction set, e.g. avx2; the best one if omitted
//     METHOD   patchwork or surface
//     FILE     KITTI .bin with x, y, z and intensity as 32-bit floats

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <flagstone/flagstone.hpp>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#if __has_include(<library/core/simd_target.hpp>)
#include <library/core/simd_target.hpp>
#elif __has_include(<core/simd_target.hpp>)  // its path in revisions up to 2026-11-21
#include <core/simd_target.hpp>
#else  // before vector instructions
namespace flagstone {
void use_simd_target(std::string_view /*name*/) {
  throw std::invalid_argument("this revision has only one instruction set");
}
}  // namespace flagstone
#endif

namespace {

constexpr std::size_t floats_per_point = 4;

std::vector<float> read_floats(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::vector<float> floats(static_cast<std::size_t>(file.tellg()) / sizeof(float));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(floats.data()),
            static_cast<std::streamsize>(floats.size() * sizeof(float)));
  return floats;
}

/// Null if this revision does not have the method.
std::unique_ptr<flagstone::Segmenter> make_segmenter(const std::string& method) {
  if (method == "patchwork") return std::make_unique<flagstone::Patchwork>();
#if __has_include(<flagstone/surface_segmenter.hpp>)  // its name in revisions up to 2026-11-21
  if (method == "surface") return std::make_unique<flagstone::SurfaceSegmenter>();
#elif __has_include(<flagstone/surface.hpp>)
  if (method == "surface") return std::make_unique<flagstone::Surface>();
#endif
  return nullptr;
}

/// FNV-1a hash of the labels.
std::uint64_t hash_of(const flagstone::Segmentation& result) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const flagstone::Label label : result.labels()) {
    hash = (hash ^ static_cast<std::uint64_t>(label)) * 0x100000001b3;
  }
  return hash;
}

}  // namespace

/// Separate function with a fixed name, so that callgrind can count its instructions alone.
extern "C" [[gnu::noinline]] void segment_measured(flagstone::Segmenter& segmenter,
                                                   const flagstone::CloudView& cloud,
                                                   flagstone::Segmentation& result) {
  (void)segmenter.segment(cloud, result);
}

int main(int argc, char** argv) {
  if (argc >= 3 && std::string_view(argv[1]) == "--target") {
    try {
      flagstone::use_simd_target(argv[2]);
    } catch (const std::invalid_argument& error) {
      std::cerr << error.what() << '\n';
      return 1;
    }
    argc -= 2;
    argv += 2;
  }
  const std::string method = argc < 2 ? "" : argv[1];
  const std::unique_ptr<flagstone::Segmenter> segmenter = make_segmenter(method);
  if (segmenter == nullptr) {
    std::cerr << "method \"" << method << "\" does not exist in this revision\n";
    return 1;
  }
  std::vector<std::vector<float>> scans;
  for (int i = 2; i < argc; ++i) {
    scans.push_back(read_floats(argv[i]));
    if (scans.back().size() < floats_per_point) {
      std::cerr << argv[i]
                << ": no points (expected a KITTI .bin file with four 32-bit floats per point)\n";
      return 1;
    }
  }
  flagstone::Segmentation result;
  const auto view_of = [](const std::vector<float>& scan) {
    return flagstone::CloudView(scan.data(), scan.size() / floats_per_point, floats_per_point);
  };

  // Two warm-up rounds, then a round that prints the hashes of the labels.
  for (int round = 0; round < 2; ++round) {
    for (const std::vector<float>& scan : scans) (void)segmenter->segment(view_of(scan), result);
  }
  for (const std::vector<float>& scan : scans) {
    (void)segmenter->segment(view_of(scan), result);
    std::cout << hash_of(result) << ' ';
  }
  std::cout << '\n' << std::flush;

  for (std::string line; std::getline(std::cin, line);) {
    // Another program used the core in between: one untimed scan warms the caches.
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
