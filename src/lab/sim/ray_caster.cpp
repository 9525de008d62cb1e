// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

namespace flagstone::sim {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

void check_indices(const Mesh& mesh) {
  for (const Mesh::Triangle& triangle : mesh.triangles()) {
    if (*std::ranges::max_element(triangle) >= mesh.vertices().size()) {
      throw std::invalid_argument("mesh: a triangle refers to a vertex that does not exist");
    }
  }
}

// Copies the mesh into buffers owned by Embree, which requires floats.
EmbreeScene build(RTCDevice device, const Mesh& mesh) {
  EmbreeScene scene(rtcNewScene(device));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices().size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(Mesh::Triangle), mesh.triangles().size()));
  if (vertices == nullptr || indices == nullptr) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (const Vector3& vertex : mesh.vertices()) {
    *vertices++ = static_cast<float>(vertex.x);
    *vertices++ = static_cast<float>(vertex.y);
    *vertices++ = static_cast<float>(vertex.z);
  }
  for (const Mesh::Triangle& triangle : mesh.triangles()) {
    indices = std::ranges::copy(triangle, indices).out;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);  // the scene keeps it
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene.get());
  return scene;
}

}  // namespace

struct RayCaster::Impl {
  Mesh mesh;
  Device device;
  EmbreeScene scene;
};

RayCaster::RayCaster(Mesh mesh) : impl_(std::make_unique<Impl>()) {
  check_indices(mesh);
  impl_->mesh = std::move(mesh);
  if (impl_->mesh.triangles().empty()) return;
  // One building thread makes the tree deterministic, and with it the choice between two triangles
  // if a beam hits their common edge.
  impl_->device.reset(rtcNewDevice("threads=1"));
  if (!impl_->device) throw std::bad_alloc();
  impl_->scene = build(impl_->device.get(), impl_->mesh);
  if (rtcGetDeviceError(impl_->device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

const Mesh& RayCaster::mesh() const noexcept { return impl_->mesh; }

std::optional<RayCaster::Hit> RayCaster::cast(Vector3 origin, Vector3 direction, double near,
                                              double far) const noexcept {
  if (!impl_->scene) return std::nullopt;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tnear = static_cast<float>(near);
  query.ray.tfar = static_cast<float>(far);
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  // Embree determines the triangle. The position is computed again in double precision, which is
  // more precise and does not depend on the instruction set that Embree uses.
  const std::uint32_t triangle = query.hit.primID;
  const Vector3 a = impl_->mesh.corner(triangle, 0);
  const Vector3 normal =
      normalized(cross(impl_->mesh.corner(triangle, 1) - a, impl_->mesh.corner(triangle, 2) - a));
  const double approach = dot(normal, direction);
  constexpr double edge_on = 1e-6;  // a smaller divisor loses more digits than Embree's floats have
  const double range = std::abs(approach) < edge_on ? static_cast<double>(query.ray.tfar)
                                                    : dot(normal, a - origin) / approach;
  return Hit{
      .range = range, .triangle = triangle, .incidence = std::abs(approach), .normal = normal};
}

}  // namespace flagstone::sim
