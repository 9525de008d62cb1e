// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/birds_eye.hpp"

#include <fmt/format.h>

#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/render/canvas.hpp"
#include "files/render/points.hpp"
#include "files/render/scale.hpp"
#include "files/render/text.hpp"
#include "files/render/zone_layer.hpp"

namespace flagstone::render {
namespace {

Status check_sizes(CloudView cloud, const Segmentation& result, const BirdsEye& options) {
  if (cloud.data() == nullptr && !cloud.empty())
    return refuse(fmt::format("the cloud has {} points but no memory", cloud.size()));
  if (result.labels().size() != cloud.size())
    return refuse(
        fmt::format("{} labels for {} points (expected the result of segmenting this cloud)",
                    result.labels().size(), cloud.size()));
  if (!options.reference.empty() && options.reference.size() != cloud.size())
    return refuse(fmt::format("the reference has {} entries for {} points (expected one per point)",
                              options.reference.size(), cloud.size()));
  return {};
}

Status check_options(const BirdsEye& options) {
  constexpr int smallest = 320;
  constexpr int largest = 8192;
  for (const int size : {options.width, options.height})
    if (size < smallest || size > largest)
      return refuse(fmt::format("size {} x {} pixels (expected {} to {} each)", options.width,
                                options.height, smallest, largest));
  const bool asks_for_a_range = options.range >= 1 && options.range <= 1000;
  if (!asks_for_a_range && options.range != 0)
    return refuse(fmt::format("range {} m (expected 1 to 1000, or 0 to choose a suitable one)",
                              options.range));
  if (options.tint_patches && options.zones == nullptr)
    return refuse("tint_patches requires the zones that the scan was segmented with");
  return {};
}

Status check_zones(const Segmentation& result, const BirdsEye& options) {
  if (options.zones == nullptr) return {};
  try {
    options.zones->check();
  } catch (const std::invalid_argument& error) {
    return refuse(error.what());
  }
  return options.tint_patches ? check_bins(result.patches(), *options.zones) : Status();
}

Status check(CloudView cloud, const Segmentation& result, const BirdsEye& options) {
  if (Status status = check_sizes(cloud, result, options); !status.ok()) return status;
  if (Status status = check_options(options); !status.ok()) return status;
  return check_zones(result, options);
}

std::vector<std::byte> picture(CloudView cloud, const Segmentation& result,
                               const BirdsEye& options) {
  const Canvas canvas(options.width, options.height);
  const Layout layout = arrange(options.width, options.height, options.tint_patches ? 2 : 1);
  const double range =
      options.range != 0 ? options.range : suitable_range(cloud, result.labels(), options.zones);
  const TopView view(layout.panel, range);
  const PointKinds points = options.reference.empty()
                                ? kinds_by_label(result.labels())
                                : kinds_by_truth(result.labels(), options.reference);

  fill(canvas, {0, 0, static_cast<double>(options.width), static_cast<double>(options.height)},
       page_color);
  fill(canvas, layout.panel, panel_color);
  if (options.tint_patches) tint_bins(canvas, view, result.patches(), *options.zones);
  const std::vector<double> circles = circle_radii(range, options.zones);
  if (options.zones != nullptr)
    draw_zone_lines(canvas, view, *options.zones, layout.unit);
  else
    draw_range_rings(canvas, view, circles, layout.unit);
  const std::size_t beyond = draw_points(canvas, view, cloud, points, layout.unit);
  draw_scale(canvas, view, range, circles, layout.unit);
  draw_beyond_note(canvas, layout, beyond);
  draw_heading(canvas, layout.heading, layout.unit, options.title, options.subtitle);
  draw_legend(canvas, layout, points, result.patches(), options.tint_patches);
  return canvas.png();
}

}  // namespace

Status draw_birds_eye(const std::filesystem::path& png, CloudView cloud, const Segmentation& result,
                      const BirdsEye& options) noexcept try {
  if (Status status = check(cloud, result, options); !status.ok()) return status;
  return io::write_file(png, picture(cloud, result, options));
} catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

}  // namespace flagstone::render
