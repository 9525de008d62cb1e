// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "library/core/buffer.hpp"
#include "library/core/plane.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::plane_fits {

/// Up to sixteen bins S_n that are fitted together. Their points are packed so that every pass of
/// the fit reads contiguous memory. Add all bins by add() and then call gather(), or add all by
/// add_empty().
///
/// The number of elements per bin is a multiple of 16. After the last point z is infinite: such
/// elements are above any plane and need no special case.
class BinBatch {
 public:
  /// A position near all points of a bin, so that single precision is enough for coordinates
  /// relative to it, metres.
  struct Origin {
    float x, y;
    float z = 0;
  };

  /// Reserves memory for bins with up to `points` points in total. May throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Removes all bins.
  void clear() noexcept { count_ = 0; }

  /// Adds a bin, which must have points. At most batch_size bins.
  void add(std::uint32_t bin, std::uint32_t size) noexcept {
    bins_[count_] = bin;
    sizes_[count_] = size;
    firsts_[count_] = count_ == 0 ? 0 : firsts_[count_ - 1] + places(count_ - 1);
    ++count_;
  }

  /// Packs the points of the bins. The origin of a bin is the middle between its first and its last
  /// point, with z = 0.
  void gather(const ScanPoints& scan, const BinGroups& groups) noexcept;

  /// Adds a bin of `size` points, without its number, with the given origin. The caller writes the
  /// points to x(i), y(i) and z(i), where 16 more elements than `places(i)` can be written, and
  /// sets the elements after the last point as gather() does.
  void add_empty(std::size_t size, Origin origin) noexcept {
    origins_[count_] = origin;
    add(0, static_cast<std::uint32_t>(size));
  }

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// Number of bin `i`, as passed to add().
  [[nodiscard]] std::uint32_t bin(std::size_t i) const noexcept { return bins_[i]; }

  /// Number of points of bin `i` of the batch.
  [[nodiscard]] std::size_t size(std::size_t i) const noexcept { return sizes_[i]; }
  /// Number of elements of bin `i`: the number of points, rounded up to a multiple of 16.
  [[nodiscard]] std::size_t places(std::size_t i) const noexcept {
    return (std::size_t{sizes_[i]} + 15) / 16 * 16;
  }

  [[nodiscard]] Origin origin(std::size_t i) const noexcept { return origins_[i]; }

  /// Packed coordinates of bin `i`, relative to its origin, metres, aligned to a vector.
  [[nodiscard]] float* x(std::size_t i) noexcept { return x_.data() + firsts_[i]; }
  [[nodiscard]] float* y(std::size_t i) noexcept { return y_.data() + firsts_[i]; }
  [[nodiscard]] float* z(std::size_t i) noexcept { return z_.data() + firsts_[i]; }
  [[nodiscard]] const float* x(std::size_t i) const noexcept { return x_.data() + firsts_[i]; }
  [[nodiscard]] const float* y(std::size_t i) const noexcept { return y_.data() + firsts_[i]; }
  [[nodiscard]] const float* z(std::size_t i) const noexcept { return z_.data() + firsts_[i]; }

 private:
  std::size_t count_ = 0;
  std::array<std::uint32_t, batch_size> bins_{};
  std::array<std::uint32_t, batch_size> sizes_{};
  std::array<std::size_t, batch_size> firsts_{};
  std::array<Origin, batch_size> origins_{};
  Buffer<float> x_;
  Buffer<float> y_;
  Buffer<float> z_;
};

}  // namespace flagstone::plane_fits
