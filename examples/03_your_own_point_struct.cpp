// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Read your own points without copying them: your own struct, or bytes with a layout.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <span>
#include <vector>

namespace {

/// Any struct with float members x, y and z works. The members can be at any offset.
struct Return {
  double time;
  float z;
  std::uint16_t ring;
  float x, y;
};

std::vector<Return> make_scan() {
  std::vector<Return> returns;
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      returns.push_back({0.1, -1.73f, 0, range * std::cos(angle), range * std::sin(angle)});
    }
  }
  return returns;
}

}  // namespace

int main() {
  const std::vector<Return> returns = make_scan();
  flagstone::Surface segmenter;
  flagstone::Segmentation scan;

  const flagstone::CloudView structs{std::span<const Return>(returns)};
  if (!segmenter.segment(structs, scan).ok()) return 1;
  std::printf("structs, ground: %zu of %zu points\n", scan.count(flagstone::Label::ground),
              scan.labels().size());

  // The same memory as a driver would pass it: bytes, with the offsets from a message.
  const std::span<const std::byte> message = std::as_bytes(std::span(returns));
  const flagstone::CloudLayout layout{.stride = sizeof(Return),
                                      .x = offsetof(Return, x),
                                      .y = offsetof(Return, y),
                                      .z = offsetof(Return, z)};
  if (!segmenter.segment(flagstone::CloudView(message.data(), returns.size(), layout), scan).ok())
    return 1;
  std::printf("bytes, ground: %zu of %zu points\n", scan.count(flagstone::Label::ground),
              scan.labels().size());
}
