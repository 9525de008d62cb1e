// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "flagstone/ground_map.hpp"
#include "library/moving_points/directions.hpp"

namespace flagstone {

/// A pose after levelling, and its inverse.
class LevelledPose {
 public:
  LevelledPose() = default;
  LevelledPose(const Pose& pose, const Levelling& levelling) noexcept
      : to_world_(
            product({1, 0, 0, 0, 1, 0, -levelling.slope_x, -levelling.slope_y, 1}, pose.rotation)),
        to_sensor_(product(transposed(pose.rotation),
                           {1, 0, 0, 0, 1, 0, levelling.slope_x, levelling.slope_y, 1})),
        position_{pose.position[0], pose.position[1], pose.position[2] - levelling.offset} {}

  /// The transform from the sensor frame of this pose to that of another one.
  [[nodiscard]] AffineTransform to(const LevelledPose& other) const noexcept {
    const Matrix rotation = product(other.to_sensor_, to_world_);
    AffineTransform transform{};
    for (std::size_t r = 0; r < 3; ++r) {
      double offset = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        transform[4 * r + c] = static_cast<float>(rotation[3 * r + c]);
        offset += other.to_sensor_[3 * r + c] * (position_[c] - other.position_[c]);
      }
      transform[4 * r + 3] = static_cast<float>(offset);
    }
    return transform;
  }

  /// All numbers of the pose, to save it.
  using Numbers = std::array<double, 21>;
  explicit LevelledPose(const Numbers& numbers) noexcept {
    auto from = numbers.begin();
    for_each_number(*this, [&](double& number) { number = *from++; });
  }
  [[nodiscard]] Numbers numbers() const noexcept {
    Numbers numbers{};
    auto to = numbers.begin();
    for_each_number(*this, [&](double number) { *to++ = number; });
    return numbers;
  }

 private:
  template <class Self, class Use>
  static void for_each_number(Self& self, const Use& use) noexcept {
    for (auto& number : self.to_world_) use(number);
    for (auto& number : self.to_sensor_) use(number);
    for (auto& number : self.position_) use(number);
  }

  using Matrix = std::array<double, 9>;

  static Matrix product(const Matrix& a, const Matrix& b) noexcept {
    Matrix result{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < 3; ++k) result[3 * r + c] += a[3 * r + k] * b[3 * k + c];
      }
    }
    return result;
  }
  static Matrix transposed(const Matrix& m) noexcept {
    return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
  }

  Matrix to_world_{}, to_sensor_{};
  std::array<double, 3> position_{};
};

}  // namespace flagstone
