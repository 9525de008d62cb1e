// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "cloud_properties.hpp"
#include "core/simd_target.hpp"
#include "flagstone/patchwork.hpp"

namespace flagstone {
namespace {

/// The presets, and the presets' numbers over layouts of zones that take other paths.
PatchworkConfig chosen_config(std::size_t choice) {
  const auto names = PatchworkConfig::preset_names();
  PatchworkConfig config = PatchworkConfig::preset(names[choice % names.size()]);
  const auto one_zone = [&](int rings, int sectors, float range) {
    config.zones = {
        {.ring_radii = equal_rings(config.min_range, range, rings), .sectors = sectors}};
  };
  switch (choice / names.size() % 4) {
    case 1: one_zone(1, 1, 1000); break;
    case 2: one_zone(17, 3, 80); break;
    case 3: one_zone(1000, 60, 200); break;
    default: break;
  }
  return config;
}
constexpr std::size_t config_count = 12;

/// One choice of settings, in one thread and in three. Kept, as programs keep them: what came
/// before must not matter.
struct Segmenters {
  explicit Segmenters(const PatchworkConfig& config) : alone(config), crew(config, 3) {}
  Patchwork alone;
  Patchwork crew;
};

Segmenters& chosen_segmenters(std::size_t choice) {
  static std::array<std::unique_ptr<Segmenters>, config_count> made;
  std::unique_ptr<Segmenters>& segmenters = made.at(choice % config_count);
  if (!segmenters) segmenters = std::make_unique<Segmenters>(chosen_config(choice));
  return *segmenters;
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

/// Any bits as floats.
std::vector<Point> points_of_floats(Input input) {
  std::vector<Point> points;
  for (Point p{}; input.read(p);) points.push_back(p);
  return points;
}

/// Numbers of 16 bits as places within 100 m and heights within 6 m, each `copies` times, rising by
/// millimetres: such points share bins.
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

/// Points in a block of memory that ends with them, so that a sanitizer sees a read beyond.
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

void require_same(const Segmentation& a, const Segmentation& b, const char* property) {
  fuzz::require(has_same_bytes(a.labels(), b.labels()) && has_same_bytes(a.patches(), b.patches()),
                property);
}

void check_counts(const Segmentation& result, std::size_t points) {
  fuzz::require(result.labels().size() == points, "every point has a label");
  std::array<std::size_t, label_count> counts{};
  for (const Label label : result.labels()) {
    fuzz::require(static_cast<std::size_t>(label) < label_count, "a label is one there is");
    ++counts.at(static_cast<std::size_t>(label));
  }
  for (std::size_t code = 0; code < label_count; ++code) {
    fuzz::require(counts.at(code) == result.count(static_cast<Label>(code)), "counts are right");
  }
}

void segment(Patchwork& patchwork, CloudView cloud, Segmentation& result) {
  fuzz::require(patchwork.segment(cloud, result).ok(), "every cloud can be segmented");
}

}  // namespace
}  // namespace flagstone

// The first byte chooses settings, the second the layout in memory, the third how the rest becomes
// points. Labels and patches must be the same on the best instruction set, in plain C++ and with
// three threads.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size < 3) return 0;
  const Input input(std::span(data, size).subspan(3));
  const std::size_t copies = data[2] % 16;
  const Memory memory(copies == 0 ? points_of_floats(input) : points_of_shorts(input, copies),
                      data[1]);
  Segmenters& segmenters = chosen_segmenters(data[0]);
  static Segmentation best;
  static Segmentation other;

  segment(segmenters.alone, memory.view(), best);
  check_counts(best, memory.view().size());

  segment(segmenters.crew, memory.view(), other);
  require_same(best, other, "threads change nothing");

  use_simd_target("scalar");
  segment(segmenters.alone, memory.view(), other);
  use_simd_target("");
  require_same(best, other, "the instruction set changes nothing");
  return 0;
}
