// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/lower_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "library/plane_fits/lower_plane.hpp"

namespace flagstone::surface {
namespace {

/// Side of a square, metres.
constexpr float square_size = 4;

/// A length rounded to 1/1024 m.
double rounded(double metres) { return std::nearbyint(metres * 1024) / 1024; }

}  // namespace

LowerGround::LowerGround(const SquareCells& cells)
    : cells_(&cells), width_(static_cast<std::uint32_t>(2 * cells.extent() / square_size)) {
  const std::size_t count = std::size_t{width_} * width_;
  squares_.reserve(count);
  touched_.reserve(count);
  std::fill_n(squares_.data(), count, Square{});
}

/// Calls `work(index, point, number of its square)` for each point labelled noise that can be
/// ground, in the order of the cloud. Points are relative to the corner of their square, at the
/// height SquareCells::packed_zero(), and rounded, so that sums over them are exact in any order.
template <class Work>
void LowerGround::each_noise(CloudView cloud, std::span<const Label> labels,
                             const Work& work) noexcept {
  const auto* const first = reinterpret_cast<const std::uint8_t*>(labels.data());
  const std::uint8_t* const end = first + labels.size();
  const std::uint8_t* at = first;
  while (at < end) {
    at = static_cast<const std::uint8_t*>(
        std::memchr(at, static_cast<int>(Label::noise), static_cast<std::size_t>(end - at)));
    if (at == nullptr) return;
    const auto i = static_cast<std::size_t>(at++ - first);
    const Point p = cloud[i];
    const float depth = cells_->noise_height() - p.z;
    if (depth > 0 &&
        depth * depth > cells_->noise_slope() * cells_->noise_slope() * (p.x * p.x + p.y * p.y)) {
      continue;
    }
    const auto along = [&](float coordinate) {
      return std::min(static_cast<std::uint32_t>((coordinate + cells_->extent()) / square_size),
                      width_ - 1);
    };
    const std::uint32_t column = along(p.x);
    const std::uint32_t row = along(p.y);
    const auto from_corner = [&](float coordinate, std::uint32_t index) {
      return rounded(double{coordinate} + double{cells_->extent()} - double{square_size} * index);
    };
    work(i,
         Vector3{from_corner(p.x, column), from_corner(p.y, row),
                 rounded(double{p.z} - double{cells_->packed_zero()})},
         row * width_ + column);
  }
}

std::size_t LowerGround::find(CloudView cloud, std::span<Label> labels) noexcept {
  touched_count_ = 0;
  each_noise(cloud, labels, [&](std::size_t, const Vector3& point, std::uint32_t number) {
    Square& square = squares_.data()[number];
    if (square.all.count == 0) touched_.data()[touched_count_++] = number;
    square.all.add(point[0], point[1], point[2]);
  });
  const std::span<const std::uint32_t> touched(touched_.data(), touched_count_);

  // Fit each plane through the points near the previous one.
  bool any = false;
  const auto fit = [&] {
    any = false;
    for (const std::uint32_t number : touched) {
      Square& square = squares_.data()[number];
      square.searched = square.all.count >= plane_fits::fewest_sunken_points;
      any = any || square.searched;
      if (square.searched) square.plane = plane_of(square.all);
      square.all = {};
    }
  };
  for (const std::uint32_t number : touched) {
    squares_.data()[number].deep = squares_.data()[number].all.count;
  }
  fit();
  for (const double fit_margin : plane_fits::sunken_fit_margins) {
    if (!any) break;
    each_noise(cloud, labels, [&](std::size_t, const Vector3& point, std::uint32_t number) {
      Square& square = squares_.data()[number];
      if (!square.searched || std::abs(plane_fits::height_above(square.plane, point)) >= fit_margin)
        return;
      square.all.add(point[0], point[1], point[2]);
    });
    fit();
  }

  std::size_t found = 0;
  if (any) {
    for (const std::uint32_t number : touched) {
      Square& square = squares_.data()[number];
      square.searched = square.searched && plane_fits::is_lower_ground(square.plane, square.deep);
    }
    each_noise(cloud, labels, [&](std::size_t i, const Vector3& point, std::uint32_t number) {
      const Square& square = squares_.data()[number];
      if (!square.searched ||
          std::abs(plane_fits::height_above(square.plane, point)) >= plane_fits::sunken_margin)
        return;
      labels[i] = Label::ground;
      ++found;
    });
  }
  for (const std::uint32_t number : touched) squares_.data()[number] = {};
  return found;
}

}  // namespace flagstone::surface
