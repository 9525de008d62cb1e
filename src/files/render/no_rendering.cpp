// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Replaces all drawing functions if CMake does not find Cairo.
#include <new>

#include "files/render/birds_eye.hpp"
#include "files/render/ground_map_picture.hpp"
#include "files/render/rendering_available.hpp"
#include "files/render/side_by_side.hpp"
#include "files/render/surface_picture.hpp"

namespace flagstone::render {
namespace {

Status refuse() noexcept try { return rendering_available(); } catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

}  // namespace

Status rendering_available() {
  return Status(
      StatusCode::unwritable,
      "images are not available: flagstone was built without Cairo (install Cairo's "
      "development files, on Debian: pkg-config libcairo2-dev, and build flagstone again)");
}

Status draw_birds_eye(const std::filesystem::path&, CloudView, const Segmentation&,
                      const BirdsEye&) noexcept {
  return refuse();
}

Status draw_surface(const std::filesystem::path&, const GroundSurface&,
                    const SurfacePicture&) noexcept {
  return refuse();
}

Status draw_ground_map(const std::filesystem::path&, const GroundGrid&,
                       const GroundMapPicture&) noexcept {
  return refuse();
}

Status render_side_by_side(CloudView, std::span<const Truth>, std::span<const Panel>,
                           const SideBySide&, std::vector<std::byte>&) noexcept {
  return refuse();
}

}  // namespace flagstone::render
