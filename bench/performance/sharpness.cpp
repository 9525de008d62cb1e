// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures the height and width of steps of known shape in the surface of a method: kerbs, ditches,
// drops and stairs of the simulated scene `steps`. Prints Markdown.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <flagstone/baselines.hpp>
#include <flagstone/segmentation.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/scene.hpp"
#include "terminal.hpp"

namespace flagstone::performance {
namespace {

/// Upper limits of the range bands, metres.
constexpr std::array<double, 3> bands = {10, 20, 40};

/// Observations of steps, with the ground truth at the same positions.
struct Views {
  std::size_t positions = 0;
  std::size_t known = 0;  ///< positions with a surface height on both sides
  std::size_t found = 0;  ///< positions with at least half of the true rise
  std::vector<double> true_rise, rise, true_width,
      width;  ///< metres; widths of steps that were found
};
using ViewsByRange = std::array<Views, bands.size()>;

struct KindOfStep {
  std::string_view name;
  double rise;             ///< metres
  ViewsByRange seen;       ///< with ground points on both sides
  ViewsByRange half_seen;  ///< with ground points on the near side only
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::vector<float> ground_points(const sim::SimulatedScan& scan) {
  std::vector<float> points;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!sim::is_ground(static_cast<sim::SemanticClass>(scan.classes[i]))) continue;
    points.insert(points.end(), {scan.xyzi[4 * i], scan.xyzi[4 * i + 1]});
  }
  return points;
}

/// Measures all steps around the sensor positions of simulated runs.
class StepSurvey {
 public:
  explicit StepSurvey(std::string_view method)
      : method_(method), segmenter_(make_segmenter(method)) {}

  void add_drive(std::uint64_t seed) {
    const sim::Drive drive(*sim::find_scene_kind("steps"), Sensor::named("hdl-64e"), seed);
    const sim::Scene scene = drive.scene();
    for (int frame = 0; frame < sim::frames_per_drive; ++frame) {
      show_progress(fmt::format("run {}, scan {}", seed, frame));
      const sim::SimulatedScan scan = drive.scan(scene, sim::Noise{}, frame);
      if (!segmenter_->segment(CloudView(scan.xyzi.data(), scan.size(), 4), result_).ok()) {
        throw std::runtime_error("not enough memory");
      }
      if (result_.surface().empty()) {
        throw std::invalid_argument(
            fmt::format("{}: this method does not compute a surface", method_));
      }
      add_scan(drive, scene, drive.poses()[static_cast<std::size_t>(frame)], ground_points(scan));
    }
    show_progress("");
  }

  void print(ViewsByRange KindOfStep::* views) const {
    std::vector<KindOfStep> kinds = kinds_;
    std::ranges::sort(kinds, {}, [](const KindOfStep& kind) {
      return std::pair(std::abs(kind.rise), kind.name);
    });
    fmt::print(
        "| step | range, m | positions | known, % | found, % | rise, cm: true | surface | "
        "width, m: true | surface |\n|---|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const KindOfStep& kind : kinds) {
      double from = 0;
      for (std::size_t band = 0; band < bands.size(); ++band) {
        const Views& in_band = (kind.*views)[band];
        if (in_band.positions > 0) print_row(kind.name, from, bands[band], in_band);
        from = bands[band];
      }
    }
  }

 private:
  KindOfStep& kind_of(const sim::GroundStep& step) {
    const auto found = std::ranges::find(kinds_, step.kind, &KindOfStep::name);
    if (found != kinds_.end()) return *found;
    return kinds_.emplace_back(
        KindOfStep{.name = step.kind, .rise = step.rise, .seen = {}, .half_seen = {}});
  }

  void add_scan(const sim::Drive& drive, const sim::Scene& scene, const sim::Frame& pose,
                const std::vector<float>& ground) {
    const sim::HeightAt truth = sim::true_heights(scene.ground(), pose);
    const sim::HeightAt found = [this](double x, double y) {
      return static_cast<double>(
          result_.surface().height(static_cast<float>(x), static_cast<float>(y)));
    };
    for (const sim::GroundStep& step : drive.steps()) {
      KindOfStep& kind = kind_of(step);
      for (const sim::StepPlace& place : sim::places_on(step, scene.ground(), pose)) {
        const auto band = static_cast<std::size_t>(
            std::ranges::upper_bound(bands, std::hypot(place.x, place.y)) - bands.begin());
        if (band == bands.size()) continue;
        const sim::SeenSides seen = sim::seen_sides(place, ground);
        if (!seen.before) continue;
        add(sim::view_step(place, truth), sim::view_step(place, found),
            (seen.behind ? kind.seen : kind.half_seen)[band]);
      }
    }
  }

  static void add(const sim::StepView& truth, const sim::StepView& found, Views& views) {
    ++views.positions;
    if (std::isnan(found.rise)) return;
    ++views.known;
    views.true_rise.push_back(truth.rise);
    views.rise.push_back(found.rise);
    if (found.rise / truth.rise < 0.5) return;
    ++views.found;
    if (!truth.width || !found.width) return;
    views.true_width.push_back(*truth.width);
    views.width.push_back(*found.width);
  }

  static void print_row(std::string_view name, double from, double to, const Views& views) {
    const auto percent = [&](std::size_t part) {
      return 100 * static_cast<double>(part) / static_cast<double>(views.positions);
    };
    const auto middle = [](const std::vector<double>& values, double unit, int digits) {
      return values.empty() ? std::string("-")
                            : fmt::format("{:.{}f}", median(values) * unit, digits);
    };
    constexpr double centimetres = 100;
    fmt::print("| {} | {:.0f}-{:.0f} | {} | {:.0f} | {:.0f} | {} | {} | {} | {} |\n", name, from,
               to, views.positions, percent(views.known), percent(views.found),
               middle(views.true_rise, centimetres, 1), middle(views.rise, centimetres, 1),
               middle(views.true_width, 1, 2), middle(views.width, 1, 2));
  }

  std::string method_;
  std::unique_ptr<Segmenter> segmenter_;
  Segmentation result_;
  std::vector<KindOfStep> kinds_;  // in order of first occurrence
};

int run(const std::string& method, unsigned drives) {
  StepSurvey survey(method);
  for (std::uint64_t seed = 1; seed <= drives; ++seed) survey.add_drive(seed);
  fmt::print(
      "Steps in the surface of `{}`, {} scans of the scene `steps`, seeds 1 to {}. Rise: from {} m "
      "before to {} m "
      "behind the step. Width: from 10 to 90 % of the rise, if at least half of it is found. All "
      "values are "
      "medians.\n\nPositions with ground points on both sides within that distance:\n\n",
      method, drives * sim::frames_per_drive, drives, sim::beside_step, sim::beside_step);
  survey.print(&KindOfStep::seen);
  fmt::print(
      "\nPositions with ground points on the near side only; the far side is hidden or between "
      "beams:\n\n");
  survey.print(&KindOfStep::half_seen);
  return 0;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  flagstone::register_baselines();
  const std::string method = argc > 1 ? argv[1] : "surface";
  const std::string_view count = argc > 2 ? argv[2] : "5";
  unsigned drives = 0;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), drives);
  const bool is_count = error == std::errc() && end == count.data() + count.size();
  if (argc > 3 || !is_count || drives < 1 || drives > 1000) {
    std::fputs("usage: sharpness [METHOD [RUNS]]\nRUNS: 1 to 1000, 10 scans per run (default: 5)\n",
               stderr);
    return 2;
  }
  try {
    return flagstone::performance::run(method, drives);
  } catch (const std::exception& error_of_run) {
    std::fprintf(stderr, "sharpness: %s\n", error_of_run.what());
    return 1;
  }
}
