// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "flagstone/cloud_view.hpp"
#include "flagstone/status.hpp"
#include "library/c_api/errors.hpp"
#include "library/c_api/handles.hpp"
#include "library/methods/method.hpp"

namespace flagstone::c_api {
namespace {

static_assert(FLAGSTONE_OK == static_cast<int>(StatusCode::ok));
static_assert(FLAGSTONE_INVALID_ARGUMENT == static_cast<int>(StatusCode::invalid_argument));
static_assert(FLAGSTONE_OUT_OF_MEMORY == static_cast<int>(StatusCode::out_of_memory));

static_assert(FLAGSTONE_MOUNT_FIXED == static_cast<int>(MountVerdict::fixed));
static_assert(FLAGSTONE_MOUNT_ACCEPTED == static_cast<int>(MountVerdict::accepted));
static_assert(FLAGSTONE_MOUNT_TOO_FEW_POINTS == static_cast<int>(MountVerdict::too_few_points));
static_assert(FLAGSTONE_MOUNT_NO_PLANE == static_cast<int>(MountVerdict::no_plane));
static_assert(FLAGSTONE_MOUNT_OBSTRUCTED == static_cast<int>(MountVerdict::obstructed));
static_assert(FLAGSTONE_MOUNT_POINTS_BELOW == static_cast<int>(MountVerdict::points_below));
static_assert(FLAGSTONE_MOUNT_ONE_SIDED == static_cast<int>(MountVerdict::one_sided));
static_assert(FLAGSTONE_MOUNT_HEIGHT_LIMIT == static_cast<int>(MountVerdict::height_limit));
static_assert(FLAGSTONE_MOUNT_TILT_LIMIT == static_cast<int>(MountVerdict::tilt_limit));
static_assert(FLAGSTONE_MOUNT_OUTLIER == static_cast<int>(MountVerdict::outlier));

std::unique_ptr<flagstone_segmenter> make(const MethodConfig& config, MountSettings mount,
                                          unsigned threads) {
  mount.mount.sensor_height = sensor_height_of(config, mount.mount.sensor_height);
  return std::make_unique<flagstone_segmenter>(
      GravityAlignedSegmenter(config.make(threads), mount.mount.sensor_height, mount));
}

CloudView view_of(const flagstone_cloud& cloud) {
  return {
      cloud.data, cloud.count, {.stride = cloud.stride, .x = cloud.x, .y = cloud.y, .z = cloud.z}};
}

/// The message of a cloud that a method rejects. Methods return no message.
std::string rejection_of(const flagstone_cloud& cloud) {
  const std::string points = std::to_string(cloud.count) + " points";
  return cloud.data == nullptr ? "cloud: data is NULL (expected the address of " + points + ')'
                               : "cloud: " + points + " (expected at most 4294967295)";
}

}  // namespace
}  // namespace flagstone::c_api

using namespace flagstone;
using c_api::create;
using c_api::guarded;
using c_api::require;

flagstone_cloud flagstone_cloud_of_floats(const float* points, size_t count,
                                          size_t floats_per_point) {
  const CloudView view(points, count, floats_per_point);
  const CloudLayout& layout = view.layout();
  return {points, count, layout.stride, layout.x, layout.y, layout.z};
}

flagstone_status flagstone_segmenter_create(const char* method, float sensor_height,
                                            flagstone_segmenter** segmenter,
                                            flagstone_error* error) {
  return create(segmenter, error, [&] {
    require(method, "method", "the name of a method");
    MethodConfig config = default_config(method);
    set_sensor_height(sensor_height, config);
    MountSettings mount;
    mount.mount.sensor_height = sensor_height;
    return c_api::make(config, mount, 1);
  });
}

flagstone_status flagstone_segmenter_create_with(const flagstone_settings* settings,
                                                 uint32_t threads, flagstone_segmenter** segmenter,
                                                 flagstone_error* error) {
  return create(segmenter, error, [&] {
    require(settings, "settings", "a handle");
    return c_api::make(settings->config, settings->mount, threads);
  });
}

void flagstone_segmenter_destroy(flagstone_segmenter* segmenter) { delete segmenter; }

flagstone_status flagstone_segment(flagstone_segmenter* segmenter, flagstone_cloud cloud,
                                   flagstone_segmentation* segmentation, flagstone_error* error) {
  if (segmentation != nullptr) segmentation->value.clear();
  return guarded(error, [&] {
    require(segmenter, "segmenter", "a handle");
    require(segmentation, "segmentation", "a handle");
    const Status status = segmenter->method.segment(c_api::view_of(cloud), segmentation->value);
    if (status.code() == StatusCode::out_of_memory) throw std::bad_alloc();
    if (!status.ok()) throw std::invalid_argument(c_api::rejection_of(cloud));
  });
}

const char* flagstone_mount_verdict_name(flagstone_mount_verdict verdict) {
  return to_string(static_cast<MountVerdict>(verdict));
}

flagstone_status flagstone_segmenter_mount(const flagstone_segmenter* segmenter,
                                           flagstone_mount* mount, flagstone_error* error) {
  return guarded(error, [&] {
    require(segmenter, "segmenter", "a handle");
    require(mount, "mount", "the address of a struct");
    const Mount& used = segmenter->method.mount();
    const MountDecision& decision = segmenter->method.decision();
    mount->sensor_height = used.sensor_height;
    std::ranges::copy(used.up, mount->up);
    mount->confidence = decision.confidence;
    mount->verdict = static_cast<flagstone_mount_verdict>(decision.verdict);
  });
}

void flagstone_segmenter_reset(flagstone_segmenter* segmenter) {
  if (segmenter != nullptr) segmenter->method.reset();
}
