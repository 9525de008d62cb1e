// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures the labels of ground on both sides of edges of known shape (kerbs, ditches, drops and
// stairs of the simulated scenes `steps` and `drops`), and the labels of ghost points below the
// ground. Prints Markdown.

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
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/random.hpp"
#include "terminal.hpp"

namespace flagstone::performance {
namespace {

/// Upper limits of the range bands, metres.
constexpr std::array<double, 3> bands = {10, 20, 40};

/// Maximum distance of counted ground from an edge, metres. It is larger behind a drop, which hides
/// the ground at its base.
constexpr double beside_edge = 2;
constexpr double behind_drop = 10;

/// Ghost points added to every scan of the scenes with edges: their number, their depth below a
/// ground point, and the maximum range of that ground point; metres.
constexpr std::size_t added_ghosts = 100;
constexpr double min_depth = 0.3;
constexpr double max_depth = 2.5;
constexpr double ghost_range = 20;

/// Parts of an edge, in the order of the table columns.
enum class Part : std::uint8_t { lower, face, upper };
constexpr std::size_t part_count = 3;

/// Number of points by label.
struct Labelled {
  std::size_t points = 0, ground = 0, noise = 0;

  void add(Label label) {
    ++points;
    ground += static_cast<std::size_t>(label == Label::ground);
    noise += static_cast<std::size_t>(label == Label::noise);
  }
  [[nodiscard]] std::string percent_of(std::size_t part) const {
    if (points == 0) return "-";
    return fmt::format("{:.1f}", 100 * static_cast<double>(part) / static_cast<double>(points));
  }
};

/// One kind of edge in one range band.
using Edge = std::array<Labelled, part_count>;

struct KindOfEdge {
  std::string_view name;
  double rise;  ///< metres
  std::array<Edge, bands.size()> by_range;
};

/// Results of one method in one scene.
struct Findings {
  std::vector<KindOfEdge> kinds;
  Labelled ghosts;      ///< ghost points of the simulator: beams reflected by the ground
  Labelled added;       ///< added ghost points
  Labelled not_ground;  ///< points of objects on the ground

  KindOfEdge& kind_of(const sim::GroundStep& step) {
    const auto found = std::ranges::find(kinds, step.kind, &KindOfEdge::name);
    if (found != kinds.end()) return *found;
    return kinds.emplace_back(KindOfEdge{.name = step.kind, .rise = step.rise, .by_range = {}});
  }
};

struct Method {
  std::string name;  ///< METHOD or patchwork/PRESET
  std::unique_ptr<Segmenter> segmenter;
  std::map<std::string_view, Findings> findings;  ///< by scene
};

Method make_method(std::string_view name) {
  const std::size_t slash = name.find('/');
  const std::string_view method = name.substr(0, slash);
  if (slash == std::string_view::npos) return {std::string(name), make_segmenter(method), {}};
  if (method != "patchwork") {
    throw std::invalid_argument(fmt::format("{}: only patchwork has presets", name));
  }
  PatchworkConfig config = PatchworkConfig::preset(name.substr(slash + 1));
  return {std::string(name), make_segmenter(method, config), {}};
}

/// The edge closest to a position, and the part of it.
struct EdgePosition {
  const sim::GroundStep* step = nullptr;
  Part part = Part::face;
};

EdgePosition nearest_edge(std::span<const sim::GroundStep> steps, sim::Vector3 world) {
  EdgePosition nearest;
  double min_distance = behind_drop;
  for (const sim::GroundStep& step : steps) {
    if (world.x < step.x_begin || world.x >= step.x_end) continue;
    const double outward = step.y_end > step.y_begin ? 1 : -1;
    const double across = (world.y - step.y_begin) * outward;
    const double width = std::abs(step.y_end - step.y_begin);
    const double distance = std::max({-across, across - width, 0.0});
    const double reach = step.rise < 0 && across > width ? behind_drop : beside_edge;
    if (distance >= std::min(min_distance, reach)) continue;
    min_distance = distance;
    const bool up = step.rise > 0;
    nearest = {.step = &step, .part = Part::face};
    if (across < 0) nearest.part = up ? Part::lower : Part::upper;
    if (across > width) nearest.part = up ? Part::upper : Part::lower;
  }
  return nearest;
}

/// A scan followed by added ghost points.
struct GhostScan {
  sim::SimulatedScan scan;
  std::size_t first_added = 0;
};

GhostScan add_ghosts(sim::SimulatedScan scan, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> ground;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool near = std::hypot(scan.xyzi[4 * i], scan.xyzi[4 * i + 1]) < ghost_range;
    if (near && sim::is_ground(static_cast<sim::SemanticClass>(scan.classes[i]))) {
      ground.push_back(i);
    }
  }
  Random random(seed);
  const std::size_t first = scan.size();
  for (std::size_t k = 0; k < count && !ground.empty(); ++k) {
    const double drawn = random.uniform() * static_cast<double>(ground.size());
    const std::size_t above = 4 * ground[static_cast<std::size_t>(drawn)];
    const auto depth = static_cast<float>(random.uniform(min_depth, max_depth));
    const std::array<float, 4> ghost = {scan.xyzi[above], scan.xyzi[above + 1],
                                        scan.xyzi[above + 2] - depth, 0};
    scan.xyzi.insert(scan.xyzi.end(), ghost.begin(), ghost.end());
    scan.classes.push_back(static_cast<std::uint32_t>(sim::SemanticClass::outlier));
  }
  return {std::move(scan), first};
}

/// The edge position of each point of a scan.
std::vector<EdgePosition> positions_of(const sim::SimulatedScan& scan, const sim::Frame& pose,
                                       std::span<const sim::GroundStep> steps) {
  std::vector<EdgePosition> positions(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float* const p = scan.xyzi.data() + 4 * i;
    if (std::hypot(p[0], p[1]) >= bands.back()) continue;
    if (!sim::is_ground(static_cast<sim::SemanticClass>(scan.classes[i]))) continue;
    positions[i] = nearest_edge(steps, pose.to_world({p[0], p[1], p[2]}));
  }
  return positions;
}

void add_scan(const GhostScan& ghost_scan, std::span<const EdgePosition> positions,
              std::span<const Label> labels, Findings& findings) {
  const sim::SimulatedScan& scan = ghost_scan.scan;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto semantic = static_cast<sim::SemanticClass>(scan.classes[i]);
    if (labels[i] == Label::out_of_range || labels[i] == Label::invalid) continue;
    if (semantic == sim::SemanticClass::outlier) {
      (i < ghost_scan.first_added ? findings.ghosts : findings.added).add(labels[i]);
    } else if (!sim::is_ground(semantic)) {
      findings.not_ground.add(labels[i]);
    } else if (positions[i].step != nullptr) {
      const double range = std::hypot(scan.xyzi[4 * i], scan.xyzi[4 * i + 1]);
      const auto band =
          static_cast<std::size_t>(std::ranges::upper_bound(bands, range) - bands.begin());
      Edge& edge = findings.kind_of(*positions[i].step).by_range[band];
      edge[static_cast<std::size_t>(positions[i].part)].add(labels[i]);
    }
  }
}

void survey(std::string_view scene_name, unsigned drives, std::vector<Method>& methods) {
  Segmentation result;
  for (std::uint64_t seed = 1; seed <= drives; ++seed) {
    const sim::Drive drive(*sim::find_scene_kind(scene_name), Sensor::named("hdl-64e"), seed);
    const sim::Scene scene = drive.scene();
    const std::size_t added = drive.steps().empty() ? 0 : added_ghosts;
    for (int frame = 0; frame < sim::frames_per_drive; ++frame) {
      show_progress(fmt::format("{}, run {}, scan {}", scene_name, seed, frame));
      const auto index = static_cast<std::size_t>(frame);
      const GhostScan ghost_scan = add_ghosts(drive.scan(scene, sim::Noise{}, frame), added,
                                              seed * sim::frames_per_drive + index);
      const CloudView cloud(ghost_scan.scan.xyzi.data(), ghost_scan.scan.size(), 4);
      const std::vector<EdgePosition> positions =
          positions_of(ghost_scan.scan, drive.poses()[index], drive.steps());
      for (Method& method : methods) {
        if (!method.segmenter->segment(cloud, result).ok()) {
          throw std::runtime_error("not enough memory");
        }
        add_scan(ghost_scan, positions, result.labels(), method.findings[scene_name]);
      }
    }
  }
  show_progress("");
}

void print_edges(const Method& method, std::string_view scene) {
  std::vector<KindOfEdge> kinds = method.findings.at(scene).kinds;
  std::ranges::sort(
      kinds, {}, [](const KindOfEdge& kind) { return std::pair(std::abs(kind.rise), kind.name); });
  fmt::print(
      "\n`{}`, scene `{}`:\n\n| edge | range, m | lower side: points | ground, % | noise, % | "
      "face: points | ground, % | upper side: points | ground, % |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|\n",
      method.name, scene);
  for (const KindOfEdge& kind : kinds) {
    double from = 0;
    for (std::size_t band = 0; band < bands.size(); ++band) {
      const auto& [lower, face, upper] = kind.by_range[band];
      if (lower.points + face.points + upper.points > 0) {
        fmt::print("| {} | {:.0f}-{:.0f} | {} | {} | {} | {} | {} | {} | {} |\n", kind.name, from,
                   bands[band], lower.points, lower.percent_of(lower.ground),
                   lower.percent_of(lower.noise), face.points, face.percent_of(face.ground),
                   upper.points, upper.percent_of(upper.ground));
      }
      from = bands[band];
    }
  }
}

void print_rest(const std::vector<Method>& methods, std::span<const std::string_view> scenes) {
  fmt::print(
      "\n| scene | method | simulated ghost points | ground, % | noise, % | added ghost points | "
      "ground, % | noise, % | "
      "points of objects | ground, % |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::string_view scene : scenes) {
    for (const Method& method : methods) {
      const Findings& found = method.findings.at(scene);
      fmt::print("| {} | `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n", scene, method.name,
                 found.ghosts.points, found.ghosts.percent_of(found.ghosts.ground),
                 found.ghosts.percent_of(found.ghosts.noise), found.added.points,
                 found.added.percent_of(found.added.ground),
                 found.added.percent_of(found.added.noise), found.not_ground.points,
                 found.not_ground.percent_of(found.not_ground.ground));
    }
  }
}

int run(std::string_view names, unsigned drives) {
  std::vector<Method> methods;
  while (!names.empty()) {
    const std::size_t comma = names.find(',');
    methods.push_back(make_method(names.substr(0, comma)));
    names = comma == std::string_view::npos ? "" : names.substr(comma + 1);
  }
  constexpr std::array<std::string_view, 4> scenes = {"steps", "drops", "flat_street",
                                                      "parked_cars"};
  for (const std::string_view scene : scenes) survey(scene, drives, methods);
  fmt::print(
      "Ground within {} m of edges, or {} m behind drops; {} scans of each scene, seeds 1 to {}. "
      "{} ghost points "
      "are added to each scan of the scenes `steps` and `drops`, {} to {} m below ground points "
      "within {} m.\n",
      beside_edge, behind_drop, drives * sim::frames_per_drive, drives, added_ghosts, min_depth,
      max_depth, ghost_range);
  for (const Method& method : methods) {
    for (const std::string_view scene : {scenes[0], scenes[1]}) print_edges(method, scene);
  }
  print_rest(methods, scenes);
  return 0;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  flagstone::register_baselines();
  const std::string_view methods = argc > 1 ? argv[1] : "patchwork,surface";
  const std::string_view count = argc > 2 ? argv[2] : "5";
  unsigned drives = 0;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), drives);
  const bool is_count = error == std::errc() && end == count.data() + count.size();
  if (argc > 3 || !is_count || drives < 1 || drives > 1000) {
    std::fputs(
        "usage: edges [METHOD[/PRESET],... [RUNS]]\nRUNS: 1 to 1000, 10 scans per run (default: "
        "5)\n",
        stderr);
    return 2;
  }
  try {
    return flagstone::performance::run(methods, drives);
  } catch (const std::exception& error_of_run) {
    std::fprintf(stderr, "edges: %s\n", error_of_run.what());
    return 1;
  }
}
