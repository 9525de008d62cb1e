// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "library/surface/grid.hpp"
#include "random_surface.hpp"

namespace flagstone::tests {

/// A grid that owns its memory.
class OwnedGrid {
 public:
  OwnedGrid(float cell, std::size_t width, float height = 0, float confidence = 0)
      : heights_(width * width, height), confidences_(width * width, confidence) {
    grid_ = {.cell = cell,
             .width = width,
             .heights = heights_.data(),
             .confidences = confidences_.data()};
  }
  OwnedGrid(const OwnedGrid&) = delete;
  OwnedGrid& operator=(const OwnedGrid&) = delete;

  /// Sets the heights to the ground at the centres of the cells.
  void set(const Ground& ground) {
    for (std::size_t row = 0; row < grid_.width; ++row) {
      for (std::size_t column = 0; column < grid_.width; ++column) {
        at(row, column) = ground(grid_.center(column), grid_.center(row));
      }
    }
  }

  [[nodiscard]] const surface::Grid& grid() const { return grid_; }
  /// The grid with its heights copied to `memory`, where 16 more can be read, as in the method.
  [[nodiscard]] surface::Grid readable(std::vector<float>& memory) const {
    memory = heights_;
    memory.resize(heights_.size() + 16, 1e9f);
    surface::Grid copy = grid_;
    copy.heights = memory.data();
    return copy;
  }
  [[nodiscard]] float& at(std::size_t row, std::size_t column) {
    return heights_[row * grid_.width + column];
  }
  [[nodiscard]] std::vector<float>& heights() { return heights_; }
  [[nodiscard]] std::vector<float>& confidences() { return confidences_; }

 private:
  surface::Grid grid_;
  std::vector<float> heights_;
  std::vector<float> confidences_;
};

}  // namespace flagstone::tests
