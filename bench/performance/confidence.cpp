// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Compares the confidence of the surface with its errors in simulated scenes, where the true ground
// is known at every position, measured or not. Prints Markdown.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <flagstone/segmentation.hpp>
#include <flagstone/surface.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/scene.hpp"
#include "terminal.hpp"
#include "timing.hpp"

namespace flagstone::performance {
namespace {

/// The sensors of bench/worlds_study.py, each at its usual height.
constexpr std::array<std::string_view, 8> sensors = {"hdl-64e", "pandar64", "os1-64", "os0-128",
                                                     "hdl-32e", "vlp-16",   "at128",  "livox-avia"};

/// Scans of a run that are evaluated.
constexpr std::array<int, 2> frames = {0, 5};

/// Distance between evaluated positions, metres. Positions are not centred in cells.
constexpr double spacing = 1.0;
constexpr double offset = 0.137;

/// Errors up to this are counted as correct, metres.
constexpr float tolerance = 0.1f;

/// Positions with similar confidence.
struct Bin {
  std::vector<double> errors;  ///< absolute, metres
  double confidence = 0;       ///< sum
};
constexpr std::size_t bin_count = 10;

class ConfidenceSurvey {
 public:
  void add_drive(const sim::SceneKind& kind, const Sensor& sensor, std::uint64_t seed) {
    const sim::Drive drive(kind, sensor, seed);
    const sim::Scene scene = drive.scene();
    Surface surface({.sensor_height = static_cast<float>(sensor.height)});
    for (const int frame : frames) {
      const sim::SimulatedScan scan = drive.scan(scene, sim::Noise{}, frame);
      if (!surface.segment(CloudView(scan.xyzi.data(), scan.size(), 4), result_).ok()) {
        throw std::runtime_error("not enough memory");
      }
      const sim::Frame& pose = drive.poses()[static_cast<std::size_t>(frame)];
      add_scan(sim::true_heights(scene.ground(), pose));
    }
  }

  void print() const {
    fmt::print(
        "| confidence | positions | mean confidence | within 10 cm, % | median error, cm | 95 %, "
        "cm "
        "|\n|---|--:|--:|--:|--:|--:|\n");
    for (std::size_t i = 0; i < bin_count; ++i) {
      const auto tenths = static_cast<double>(i);
      print_row(fmt::format("{:.1f} to {:.1f}", tenths / 10, (tenths + 1) / 10), bins_[i]);
    }
  }

 private:
  void add_scan(const sim::HeightAt& truth) {
    const double extent = result_.surface().extent();
    for (double y = -extent + offset; y < extent; y += spacing) {
      for (double x = -extent + offset; x < extent; x += spacing) {
        const GroundSample ground =
            result_.surface().at(static_cast<float>(x), static_cast<float>(y));
        if (std::isnan(ground.height)) continue;
        const double height = truth(x, y);
        if (std::isnan(height)) continue;  // the simulated ground ends there
        const auto bin = static_cast<std::size_t>(ground.confidence * bin_count);
        Bin& of = bins_[std::min(bin, bin_count - 1)];
        of.errors.push_back(std::abs(static_cast<double>(ground.height) - height));
        of.confidence += static_cast<double>(ground.confidence);
      }
    }
  }

  static void print_row(std::string_view name, const Bin& bin) {
    if (bin.errors.empty()) return;
    const auto count = static_cast<double>(bin.errors.size());
    const auto correct = std::ranges::count_if(bin.errors, [](double e) { return e <= tolerance; });
    fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.1f} |\n", name, bin.errors.size(),
               bin.confidence / count, 100 * static_cast<double>(correct) / count,
               100 * quantile(bin.errors, 0.5), 100 * quantile(bin.errors, 0.95));
  }

  Segmentation result_;
  std::array<Bin, bin_count> bins_;
};

int run(std::uint64_t first_seed) {
  ConfidenceSurvey survey;
  std::uint64_t seed = first_seed;
  for (const sim::SceneKind& kind : sim::scene_kinds()) {
    for (const std::string_view sensor : sensors) {
      show_progress(fmt::format("{}, {}", kind.name, sensor));
      survey.add_drive(kind, Sensor::named(sensor), seed++);
    }
  }
  show_progress("");
  fmt::print(
      "Confidence and error of the surface: {} scenes, {} sensors, {} scans each, from seed {}; "
      "one "
      "position per square metre.\n\n",
      sim::scene_kinds().size(), sensors.size(), frames.size(), first_seed);
  survey.print();
  return 0;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  const std::string_view text = argc > 1 ? argv[1] : "1";
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (argc > 2 || error != std::errc() || end != text.data() + text.size()) {
    std::fputs("usage: confidence [SEED]\nSEED: seed of the first scene (default: 1)\n", stderr);
    return 2;
  }
  try {
    return flagstone::performance::run(seed);
  } catch (const std::exception& error_of_run) {
    std::fprintf(stderr, "confidence: %s\n", error_of_run.what());
    return 1;
  }
}
