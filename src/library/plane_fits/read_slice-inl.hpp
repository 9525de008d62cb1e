// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The first pass over a cloud: it records where the bin changes from one point to the next, for any
// function that finds the bin of a point. Included once per instruction set.

// clang-format off
#if defined(FLAGSTONE_PLANE_FITS_READ_SLICE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_PLANE_FITS_READ_SLICE_INL_HPP
#undef FLAGSTONE_PLANE_FITS_READ_SLICE_INL_HPP
#else
#define FLAGSTONE_PLANE_FITS_READ_SLICE_INL_HPP
#endif
// clang-format on

#include "library/core/simd/read_cloud-inl.hpp"
#include "library/plane_fits/scan_points.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Records the points at which the bin changes.
class RunWriter {
 public:
  explicit RunWriter(RunStart* starts) : begin_(starts), end_(starts) {}

  /// Adds the bins of the next vector of points.
  HWY_INLINE void add(IntVector bins) {
    const IntTag di;
    const auto starts = hn::Ne(bins, move_up(bins, previous_));
    end_ += compress_store(hn::Or(bins, places_), starts, reinterpret_cast<std::int32_t*>(end_));
    previous_ = bins;
    places_ = hn::Add(places_, hn::Set(di, static_cast<std::int32_t>(hn::Lanes(di)) << bin_bits));
  }

  /// Removes runs that begin at `count` or later, closes the list and returns the number of runs.
  std::size_t close(std::size_t count) {
    while (end_ > begin_ && (end_[-1] >> bin_bits) >= count) --end_;
    *end_ = static_cast<RunStart>(count) << bin_bits;
    return static_cast<std::size_t>(end_ - begin_);
  }

 private:
  RunStart* begin_;
  RunStart* end_;
  IntVector previous_ = hn::Set(IntTag(), -1);  // not a bin
  /// Indices of the next points, shifted left by bin_bits.
  IntVector places_ = hn::ShiftLeft<bin_bits>(hn::Iota(IntTag(), 0));
};

/// Copies the coordinates of points and records their runs.
template <class Locate>
struct CopyPoints {
  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    hn::StoreU(x, d, slice.x + i);
    hn::StoreU(y, d, slice.y + i);
    hn::StoreU(z, d, slice.z + i);
    runs.add(locate(x, y, z));
  }
  const PointSlice& slice;
  const Locate& locate;
  RunWriter& runs;
};

/// Reads a slice and returns its number of runs. `locate(x, y, z)` returns the bins of a vector of
/// points, each less than 1 << bin_bits; see read_cloud().
template <class Locate>
HWY_INLINE std::size_t read_slice(const PointSlice& slice, const Locate& locate) {
  RunWriter runs(slice.starts);
  read_cloud(slice.cloud, slice.begin, slice.end, CopyPoints<Locate>{slice, locate, runs});
  return runs.close(slice.end - slice.begin);
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
