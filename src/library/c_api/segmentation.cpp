// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "flagstone/ground_surface.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patch.hpp"
#include "library/c_api/errors.hpp"
#include "library/c_api/handles.hpp"

namespace flagstone::c_api {
namespace {

static_assert(FLAGSTONE_NONGROUND == static_cast<int>(Label::nonground));
static_assert(FLAGSTONE_GROUND == static_cast<int>(Label::ground));
static_assert(FLAGSTONE_NOISE == static_cast<int>(Label::noise));
static_assert(FLAGSTONE_OUT_OF_RANGE == static_cast<int>(Label::out_of_range));
static_assert(FLAGSTONE_INVALID == static_cast<int>(Label::invalid));
static_assert(FLAGSTONE_LABEL_COUNT == label_count);

static_assert(FLAGSTONE_PATCH_GROUND == static_cast<int>(Verdict::ground));
static_assert(FLAGSTONE_PATCH_GROUND_FLAT == static_cast<int>(Verdict::ground_flat));
static_assert(FLAGSTONE_PATCH_TOO_FEW_POINTS == static_cast<int>(Verdict::too_few_points));
static_assert(FLAGSTONE_PATCH_NO_PLANE == static_cast<int>(Verdict::no_plane));
static_assert(FLAGSTONE_PATCH_NOT_UPRIGHT == static_cast<int>(Verdict::not_upright));
static_assert(FLAGSTONE_PATCH_TOO_HIGH == static_cast<int>(Verdict::too_high));
static_assert(FLAGSTONE_PATCH_MIXED == static_cast<int>(Verdict::mixed));
static_assert(FLAGSTONE_PATCH_OFF_SURFACE == static_cast<int>(Verdict::off_surface));

// Patches are read through the C struct, so both must have the same members at the same positions.
static_assert(std::is_standard_layout_v<Patch> && sizeof(Patch) == sizeof(flagstone_patch));
static_assert(offsetof(Patch, zone) == offsetof(flagstone_patch, zone));
static_assert(offsetof(Patch, ring) == offsetof(flagstone_patch, ring));
static_assert(offsetof(Patch, sector) == offsetof(flagstone_patch, sector));
static_assert(offsetof(Patch, verdict) == offsetof(flagstone_patch, verdict));
static_assert(offsetof(Patch, point_count) == offsetof(flagstone_patch, point_count));
static_assert(offsetof(Patch, ground_count) == offsetof(flagstone_patch, ground_count));
static_assert(offsetof(Patch, lower_ground_count) == offsetof(flagstone_patch, lower_ground_count));
static_assert(offsetof(Patch, mean) == offsetof(flagstone_patch, mean));
static_assert(offsetof(Patch, normal) == offsetof(flagstone_patch, normal));
static_assert(offsetof(Patch, d) == offsetof(flagstone_patch, d));
static_assert(offsetof(Patch, eigenvalues) == offsetof(flagstone_patch, eigenvalues));
static_assert(offsetof(Patch, uprightness) == offsetof(flagstone_patch, uprightness));
static_assert(offsetof(Patch, elevation) == offsetof(flagstone_patch, elevation));
static_assert(offsetof(Patch, flatness) == offsetof(flagstone_patch, flatness));
static_assert(offsetof(Patch, likelihood) == offsetof(flagstone_patch, likelihood));
static_assert(offsetof(Patch, surface_variable) == offsetof(flagstone_patch, surface_variable));

/// The first value; null if there is none.
template <class T>
const T* first(std::span<const T> values) {
  return values.empty() ? nullptr : values.data();
}

/// Checks the arguments of a query.
void require_query(const flagstone_segmentation* segmentation, const float* xy, std::size_t count,
                   const void* results) {
  require(segmentation, "segmentation", "a handle");
  if (count == 0) return;
  require(xy, "xy", "the address of x and y of each position");
  require(results, "results", "the address of one result per position");
}

}  // namespace
}  // namespace flagstone::c_api

using namespace flagstone;
using c_api::first;
using c_api::guarded;
using c_api::require;

const char* flagstone_label_name(flagstone_label label) {
  return to_string(static_cast<Label>(label));
}

const char* flagstone_verdict_name(flagstone_verdict verdict) {
  return to_string(static_cast<Verdict>(verdict));
}

flagstone_status flagstone_segmentation_create(flagstone_segmentation** segmentation,
                                               flagstone_error* error) {
  return c_api::create(segmentation, error,
                       [] { return std::make_unique<flagstone_segmentation>(); });
}

void flagstone_segmentation_destroy(flagstone_segmentation* segmentation) { delete segmentation; }

size_t flagstone_segmentation_size(const flagstone_segmentation* segmentation) {
  return segmentation == nullptr ? 0 : segmentation->value.labels().size();
}

const flagstone_label* flagstone_segmentation_labels(const flagstone_segmentation* segmentation) {
  if (segmentation == nullptr) return nullptr;
  return reinterpret_cast<const flagstone_label*>(first(segmentation->value.labels()));
}

size_t flagstone_segmentation_label_count(const flagstone_segmentation* segmentation,
                                          flagstone_label label) {
  if (segmentation == nullptr || label >= label_count) return 0;
  return segmentation->value.count(static_cast<Label>(label));
}

const float* flagstone_segmentation_heights(const flagstone_segmentation* segmentation) {
  return segmentation == nullptr ? nullptr : first(segmentation->value.heights());
}

size_t flagstone_segmentation_patch_count(const flagstone_segmentation* segmentation) {
  return segmentation == nullptr ? 0 : segmentation->value.patches().size();
}

const flagstone_patch* flagstone_segmentation_patches(const flagstone_segmentation* segmentation) {
  if (segmentation == nullptr) return nullptr;
  return reinterpret_cast<const flagstone_patch*>(first(segmentation->value.patches()));
}

flagstone_status flagstone_segmentation_sample_ground(const flagstone_segmentation* segmentation,
                                                      const float* xy, size_t count,
                                                      flagstone_ground_sample* samples,
                                                      flagstone_error* error) {
  return guarded(error, [&] {
    c_api::require_query(segmentation, xy, count, samples);
    for (std::size_t i = 0; i < count; ++i) {
      const GroundSample at = segmentation->value.surface().at(xy[2 * i], xy[2 * i + 1]);
      samples[i] = {at.height, {at.normal[0], at.normal[1], at.normal[2]}, at.slope, at.confidence};
    }
  });
}

flagstone_status flagstone_segmentation_ground_heights(const flagstone_segmentation* segmentation,
                                                       const float* xy, size_t count,
                                                       float* heights, flagstone_error* error) {
  return guarded(error, [&] {
    c_api::require_query(segmentation, xy, count, heights);
    for (std::size_t i = 0; i < count; ++i) {
      heights[i] = segmentation->value.surface().height(xy[2 * i], xy[2 * i + 1]);
    }
  });
}

size_t flagstone_segmentation_grid_count(const flagstone_segmentation* segmentation) {
  return segmentation == nullptr ? 0 : segmentation->value.surface().grids().size();
}

flagstone_status flagstone_segmentation_grid(const flagstone_segmentation* segmentation,
                                             size_t index, flagstone_grid* grid,
                                             flagstone_error* error) {
  return guarded(error, [&] {
    require(segmentation, "segmentation", "a handle");
    require(grid, "grid", "the address of a struct");
    const auto grids = segmentation->value.surface().grids();
    c_api::require_index(index, grids.size());
    const GroundSurface::Grid& chosen = grids[index];
    *grid = {chosen.cell, chosen.width, chosen.heights.data(), chosen.confidences.data()};
  });
}
