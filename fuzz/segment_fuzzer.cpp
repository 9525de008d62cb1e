// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "cloud_properties.hpp"
#include "flagstone/baselines.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone {
namespace {

/// The presets, also with layouts of zones that take other code paths.
PatchworkConfig patchwork_config(std::size_t choice) {
  const auto names = PatchworkConfig::preset_names();
  PatchworkConfig config = PatchworkConfig::preset(names[choice % names.size()]);
  const auto one_zone = [&](int rings, int sectors, float range) {
    config.zones = {
        {.ring_radii = equal_rings(config.min_range, range, rings), .sectors = sectors}};
  };
  switch (choice / names.size() % 4) {
    case 1: one_zone(1, 1, 1000); break;
    case 2: one_zone(17, 3, 80); break;
    case 3:
      one_zone(1000, 60, 200);
      config.field_of_view = {.begin = 100, .width = 160};
      break;
    default: break;
  }
  return config;
}
constexpr std::size_t patchwork_count = 12;

/// The smallest and the largest surface, different numbers of levels, and settings with almost no
/// limits.
SurfaceConfig surface_config(std::size_t choice) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  SurfaceConfig config;
  switch (choice) {
    case 1: config.max_range = 8; break;
    case 2: config.max_range = 200; break;
    case 3: config.refinement.levels = 0; break;
    case 4: config.refinement.levels = 2; break;
    case 5: config.sensor_height = 100; break;
    case 6:
      config.max_range = 16;
      config.sensor_height = 0;
      config.noise_depth = 1000;
      config.noise_slope = 10;
      config.acceptance = {.upright_angle = 0,
                           .max_clutter_ratio = infinite,
                           .max_height = 1000,
                           .max_slope = 10,
                           .max_step = infinite,
                           .max_step_per_metre = 10};
      break;
    case 7:
      config.refinement = {.levels = 4,
                           .gate = 10,
                           .gate_factor = 1,
                           .gate_per_metre = 1,
                           .max_clutter_ratio = infinite,
                           .lower_bound_weight = 1};
      config.point = {.margin = 10,
                      .obstacle_margin = 0,
                      .obstacle_height = 0,
                      .noise_depth = 0,
                      .noise_depth_per_metre = 0};
      break;
    default: break;
  }
  return config;
}
constexpr std::size_t surface_count = 8;

/// The baselines, with their default settings.
constexpr std::array<std::string_view, 5> baselines = {"ransac", "gpf", "line_fit", "cascaded",
                                                       "r_gpf"};

/// A method with one choice of settings, with one thread and, if it supports threads, with three.
/// Reused for all inputs, as in programs: previous inputs must not matter.
struct Segmenters {
  std::unique_ptr<Segmenter> alone;
  std::unique_ptr<Segmenter> crew;
};

Segmenters made_segmenters(std::size_t choice) {
  if (choice < patchwork_count) {
    const PatchworkConfig config = patchwork_config(choice);
    return {std::make_unique<Patchwork>(config), std::make_unique<Patchwork>(config, 3)};
  }
  if (choice >= patchwork_count + surface_count) {
    register_baselines();
    return {make_segmenter(baselines.at(choice - patchwork_count - surface_count)), nullptr};
  }
  const SurfaceConfig config = surface_config(choice - patchwork_count);
  return {std::make_unique<Surface>(config), std::make_unique<Surface>(config, 3)};
}

Segmenters& chosen_segmenters(std::size_t byte) {
  static std::array<Segmenters, patchwork_count + surface_count + baselines.size()> made;
  const std::size_t choice = byte % made.size();
  Segmenters& segmenters = made.at(choice);
  if (!segmenters.alone) segmenters = made_segmenters(choice);
  return segmenters;
}

/// Reads numbers from the input until it ends.
class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  bool read(T& value) {
    if (bytes_.size() < sizeof value) return false;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return true;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Floats with any value, including NaN, infinity and denormals.
std::vector<Point> points_of_floats(Input input) {
  std::vector<Point> points;
  for (Point p{}; input.read(p);) points.push_back(p);
  return points;
}

/// 16-bit integers as positions within 100 m and heights within 6 m, each `copies` times with
/// heights that increase by millimetres, so that points share bins.
std::vector<Point> points_of_shorts(Input input, std::size_t copies) {
  std::vector<Point> points;
  for (std::array<std::int16_t, 3> at{}; input.read(at);) {
    const Point p{static_cast<float>(at[0]) / 327.68f, static_cast<float>(at[1]) / 327.68f,
                  static_cast<float>(at[2]) / 5461.0f};
    for (std::size_t i = 0; i < copies; ++i) {
      points.push_back({p.x, p.y, p.z + 0.001f * static_cast<float>(i)});
    }
  }
  return points;
}

/// Points in a block of memory without padding at its end, so that a sanitizer detects a read out
/// of bounds.
class Memory {
 public:
  Memory(const std::vector<Point>& points, std::size_t choice) : count_(points.size()) {
    static constexpr std::array<CloudLayout, 8> layouts = {{{12, 0, 4, 8},
                                                            {16, 0, 4, 8},
                                                            {16, 4, 8, 12},
                                                            {20, 0, 4, 8},
                                                            {13, 1, 5, 9},
                                                            {12, 8, 4, 0},
                                                            {-12, 0, 4, 8},
                                                            {-16, 0, 4, 8}}};
    layout_ = layouts.at(choice % layouts.size());
    const auto step =
        static_cast<std::size_t>(layout_.stride < 0 ? -layout_.stride : layout_.stride);
    const auto last = static_cast<std::size_t>(layout_.x > layout_.z ? layout_.x : layout_.z);
    const std::size_t steps = points.empty() ? 0 : (points.size() - 1) * step;
    bytes_ = std::make_unique<std::byte[]>(steps + last + sizeof(float));
    first_ = bytes_.get() + (layout_.stride < 0 ? steps : 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::byte* const record = first_ + static_cast<std::ptrdiff_t>(i) * layout_.stride;
      std::memcpy(record + layout_.x, &points[i].x, sizeof(float));
      std::memcpy(record + layout_.y, &points[i].y, sizeof(float));
      std::memcpy(record + layout_.z, &points[i].z, sizeof(float));
    }
  }

  [[nodiscard]] CloudView view() const { return {first_, count_, layout_}; }

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::byte* first_ = nullptr;
  std::size_t count_;
  CloudLayout layout_{};
};

template <class T>
bool has_same_bytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool has_same_surface(const GroundSurface& a, const GroundSurface& b) {
  const auto is_same = [](const GroundSurface::Grid& left, const GroundSurface::Grid& right) {
    return left.cell == right.cell &&
           has_same_bytes(std::span(left.heights), std::span(right.heights)) &&
           has_same_bytes(std::span(left.confidences), std::span(right.confidences));
  };
  return std::ranges::equal(a.grids(), b.grids(), is_same);
}

void require_same(const Segmentation& a, const Segmentation& b, const char* property) {
  fuzz::require(
      has_same_bytes(a.labels(), b.labels()) && has_same_bytes(a.patches(), b.patches()) &&
          has_same_bytes(a.heights(), b.heights()) && has_same_surface(a.surface(), b.surface()),
      property);
}

void check_counts(const Segmentation& result, std::size_t points) {
  fuzz::require(result.labels().size() == points, "every point has a label");
  std::array<std::size_t, label_count> counts{};
  for (const Label label : result.labels()) {
    fuzz::require(static_cast<std::size_t>(label) < label_count, "a label is valid");
    ++counts.at(static_cast<std::size_t>(label));
  }
  for (std::size_t code = 0; code < label_count; ++code) {
    fuzz::require(counts.at(code) == result.count(static_cast<Label>(code)), "counts are correct");
  }
}

/// Properties of heights and ground, for methods that provide a surface.
void check_surface(const Segmentation& result, CloudView cloud) {
  const GroundSurface& surface = result.surface();
  if (surface.empty()) return fuzz::require(result.heights().empty(), "heights need a surface");
  for (const GroundSurface::Grid& grid : surface.grids()) {
    for (std::size_t i = 0; i < grid.heights.size(); ++i) {
      const float confidence = grid.confidences[i];
      fuzz::require(confidence >= 0 && confidence <= 1, "confidence is 0 to 1");
      fuzz::require((confidence == 0) == std::isnan(grid.heights[i]), "confidence is 0 if unknown");
      fuzz::require(!std::isinf(grid.heights[i]), "heights of the ground are finite");
    }
  }
  fuzz::require(result.heights().size() == cloud.size(), "every point has a height");
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float height = result.heights()[i];
    const Label label = result.labels()[i];
    fuzz::require(label != Label::ground || !std::isnan(height), "ground points have a height");
    if (label == Label::invalid || label == Label::out_of_range) {
      fuzz::require(std::isnan(height), "points without a position have no height");
      continue;
    }
    const Point p = cloud[i];
    const float above = p.z - surface.height(p.x, p.y);
    fuzz::require(std::isnan(height) == std::isnan(above), "heights are known if the ground is");
    // Segmenters flush numbers below 1.2e-38 to zero.
    const bool is_same = height == above || std::abs(height - above) < 1e-37f;
    fuzz::require(std::isnan(height) || is_same, "heights are above ground");
  }
}

void segment(Segmenter& segmenter, CloudView cloud, Segmentation& result) {
  fuzz::require(segmenter.segment(cloud, result).ok(), "every cloud can be segmented");
}

}  // namespace
}  // namespace flagstone

namespace flagstone {
namespace {

/// A method that estimates height and tilt from the scan. The estimate may fail, but the result is
/// valid.
void segment_estimating(std::size_t choice, CloudView cloud) {
  static std::array<std::unique_ptr<GravityAlignedSegmenter>, 3> made;
  std::unique_ptr<GravityAlignedSegmenter>& levelled = made.at(choice % made.size());
  if (!levelled) {
    MountSettings settings;
    settings.height = choice % 2 == 0 ? HeightSource::estimate : HeightSource::track;
    if (choice % made.size() != 0) settings.tilt = TiltSource::estimate;
    levelled =
        std::make_unique<GravityAlignedSegmenter>(std::make_unique<Patchwork>(), 1.723f, settings);
  }
  static Segmentation result;
  levelled->reset();
  segment(*levelled, cloud, result);
  check_counts(result, cloud.size());
  const Mount& mount = levelled->mount();
  const float length = std::hypot(mount.up[0], mount.up[1], mount.up[2]);
  fuzz::require(std::abs(length - 1) < 1e-3f, "up has length 1");
  fuzz::require(std::isfinite(mount.sensor_height), "the height is finite");
}

}  // namespace
}  // namespace flagstone

// The first byte selects the method and its settings, the second the layout in memory, the third
// how the rest is converted to points. Labels, patches, heights and surface must be bit-identical
// on the best instruction set, in plain C++ and with three threads.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size < 3) return 0;
  const Input input(std::span(data, size).subspan(3));
  const std::size_t copies = data[2] % 16;
  const Memory memory(copies == 0 ? points_of_floats(input) : points_of_shorts(input, copies),
                      data[1]);
  segment_estimating(data[1], memory.view());
  Segmenters& segmenters = chosen_segmenters(data[0]);
  static Segmentation best;
  static Segmentation other;

  segment(*segmenters.alone, memory.view(), best);
  check_counts(best, memory.view().size());
  check_surface(best, memory.view());

  if (segmenters.crew) {
    segment(*segmenters.crew, memory.view(), other);
    require_same(best, other, "results do not depend on threads");
  }

  use_simd_target("scalar");
  segment(*segmenters.alone, memory.view(), other);
  use_simd_target("");
  require_same(best, other, "results do not depend on the instruction set");
  return 0;
}
