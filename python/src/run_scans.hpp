// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Scans of a run with their poses, as the bindings of ground maps, votes and moving points get
// them.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "app/level_scan.hpp"
#include "bindings.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/status.hpp"
#include "points.hpp"
#include "result.hpp"

namespace flagstone::python {

using PoseRows = nanobind::ndarray<const double, nanobind::shape<3, 4>, nanobind::c_contig,
                                   nanobind::device::cpu>;
template <class Number>
using Array = nanobind::ndarray<nanobind::numpy, Number>;

inline Pose pose_of(const PoseRows& rows) {
  Pose pose;
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const from = rows.data() + 4 * row;
    std::copy_n(from, 3, pose.rotation.begin() + static_cast<std::ptrdiff_t>(3 * row));
    pose.position[row] = from[3];
  }
  return pose;
}

/// An array that Python will own.
template <class Number>
class NewArray {
 public:
  explicit NewArray(std::vector<std::size_t> shape, Number value = {}) : shape_(std::move(shape)) {
    std::size_t count = 1;
    for (const std::size_t length : shape_) count *= length;
    numbers_ = std::make_unique<Number[]>(count + 1);  // NumPy needs an address for empty arrays
    std::fill_n(numbers_.get(), count, value);
  }

  [[nodiscard]] Number* data() noexcept { return numbers_.get(); }

  Array<Number> release() {
    nanobind::capsule owner(numbers_.get(),
                            [](void* memory) noexcept { delete[] static_cast<Number*>(memory); });
    return Array<Number>(numbers_.release(), shape_.size(), shape_.data(), owner);
  }

 private:
  std::vector<std::size_t> shape_;
  std::unique_ptr<Number[]> numbers_;
};

/// A Levelling in Python, which is a tuple.
using LevellingTuple = std::tuple<bool, std::size_t, double, double, double>;

inline Levelling levelling_of(const LevellingTuple& tuple) {
  const auto& [applied, cells, offset, slope_x, slope_y] = tuple;
  return {
      .applied = applied, .cells = cells, .offset = offset, .slope_x = slope_x, .slope_y = slope_y};
}

inline nanobind::tuple tuple_of(const Levelling& levelling) {
  return nanobind::make_tuple(levelling.applied, levelling.cells, levelling.offset,
                              levelling.slope_x, levelling.slope_y);
}

/// A scan from Python, in the level frame. Creating it needs the GIL; using it does not.
class GivenScan {
 public:
  GivenScan(nanobind::handle x, nanobind::handle y, nanobind::handle z, const Result& result,
            const PoseRows& pose)
      : points_(x, y, z), result_(result), pose_(pose_of(pose)) {}

  /// Calls `use(cloud, segmentation, pose)`. May throw std::bad_alloc.
  template <class Use>
  Status with_level(Use use) {
    const CloudView cloud = points_.view(copy_);
    const Segmentation& segmentation = result_.segmentation();
    level_.set(cloud, result_.mount(), pose_);
    return use(level_.cloud(), segmentation, level_.pose());
  }

 private:
  Points points_;
  const Result& result_;
  Pose pose_;
  std::vector<float> copy_;
  app::LevelScan level_;
};

/// A map, votes or moving points that threads can share. All functions release the GIL.
template <class State>
class Shared {
 public:
  explicit Shared(State state) : state_(std::move(state)) {}

  /// Calls `use(state)`, possibly in several threads at once.
  template <class Use>
  auto read(const Use& use) const {
    const nanobind::gil_scoped_release released;
    const std::shared_lock lock(mutex_);
    return use(state_);
  }

  /// Calls `use(state)`, in one thread at a time and while no other reads.
  template <class Use>
  auto change(const Use& use) {
    const nanobind::gil_scoped_release released;
    const std::unique_lock lock(mutex_);
    return use(state_);
  }

  /// Calls `use(state, cloud, segmentation, pose)` for a scan, as change() does.
  template <class Use>
  void change_with(GivenScan& scan, const Use& use) {
    raise_if_failed(change([&](State& state) {
      return scan.with_level(
          [&](CloudView cloud, const Segmentation& segmentation, const Pose& pose) {
            return use(state, cloud, segmentation, pose);
          });
    }));
  }

  /// Calls `use(state, cloud, segmentation, pose)` for a scan, as read() does.
  template <class Use>
  void read_with(GivenScan& scan, const Use& use) const {
    raise_if_failed(read([&](const State& state) {
      return scan.with_level(
          [&](CloudView cloud, const Segmentation& segmentation, const Pose& pose) {
            return use(state, cloud, segmentation, pose);
          });
    }));
  }

  [[nodiscard]] nanobind::bytes to_bytes() const {
    std::vector<std::byte> bytes;
    raise_if_failed(read([&](const State& state) { return state.to_bytes(bytes); }));
    return nanobind::bytes(bytes.data(), bytes.size());
  }

  void from_bytes(const nanobind::bytes& bytes) {
    const std::span given(static_cast<const std::byte*>(bytes.data()), bytes.size());
    raise_if_failed(change([&](State& state) { return state.from_bytes(given); }));
  }

 private:
  mutable std::shared_mutex mutex_;
  State state_;
};

}  // namespace flagstone::python
