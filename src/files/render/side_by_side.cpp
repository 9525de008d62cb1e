// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/side_by_side.hpp"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "files/render/birds_eye.hpp"
#include "files/render/canvas.hpp"
#include "files/render/points.hpp"
#include "files/render/scale.hpp"
#include "files/render/text.hpp"

namespace flagstone::render {
namespace {

Status check_sizes(CloudView cloud, std::span<const Truth> truth, std::span<const Panel> panels) {
  constexpr std::size_t most_panels = 30;
  if (panels.empty() || panels.size() > most_panels)
    return refuse(fmt::format("{} panels (expected 1 to {})", panels.size(), most_panels));
  if (cloud.data() == nullptr && !cloud.empty())
    return refuse(fmt::format("the cloud has {} points but no memory", cloud.size()));
  if (truth.size() != cloud.size())
    return refuse(
        fmt::format("the ground truth has {} entries for {} points (expected one per point)",
                    truth.size(), cloud.size()));
  for (const Panel& panel : panels)
    if (panel.labels.size() != cloud.size())
      return refuse(fmt::format("{}: {} labels for {} points (expected one per point)",
                                printable(panel.title), panel.labels.size(), cloud.size()));
  return {};
}

Status check_options(const SideBySide& options) {
  constexpr int narrowest = 640;
  constexpr int widest = 8192;
  if (options.width < narrowest || options.width > widest)
    return refuse(
        fmt::format("width {} pixels (expected {} to {})", options.width, narrowest, widest));
  const bool asks_for_a_range = options.range >= 1 && options.range <= 1000;
  if (!asks_for_a_range && options.range != 0)
    return refuse(fmt::format("range {} m (expected 1 to 1000, or 0 to choose a suitable one)",
                              options.range));
  return {};
}

// Draws only the points, the circles and the sensor: a scale on top of the points would hide
// errors. Returns the number of points outside the panel.
std::size_t draw_panel(const Canvas& canvas, const TopView& view, CloudView cloud,
                       const PointKinds& points, double range, double text_unit) {
  static const BirdsEye single;
  const double unit = view.panel().width / arrange(single.width, single.height, 1).panel.width;
  fill(canvas, view.panel(), panel_color);
  draw_range_rings(canvas, view, circle_radii(range, nullptr), text_unit);
  const std::size_t beyond = draw_points(canvas, view, cloud, points, unit);
  draw_sensor(canvas, view, unit);
  return beyond;
}

void write_caption(const Canvas& canvas, const Rectangle& panel, const Panel& texts, double unit) {
  cairo_t* context = canvas.context();
  const Font title{.size = 28 * unit, .bold = true, .color = text_color};
  const Font subtitle{.size = 23 * unit, .bold = false, .color = muted_text_color};
  draw_text(context, panel.x, panel.bottom() + 34 * unit,
            fitted(context, texts.title, title, panel.width), title);
  draw_text(context, panel.x, panel.bottom() + 64 * unit,
            fitted(context, texts.subtitle, subtitle, panel.width), subtitle);
}

// Replaces draw_scale(), which is used in images with one panel.
std::string scale_note(double range, std::size_t beyond) {
  std::string note =
      fmt::format("Circles every {:g} m around the sensor; x (forward) is up.", ring_step(range));
  if (beyond != 0)
    note += fmt::format(" {} {} outside the view.", grouped(beyond),
                        beyond == 1 ? "point is" : "points are");
  return note;
}

std::vector<std::byte> picture(CloudView cloud, std::span<const Truth> truth,
                               std::span<const Panel> panels, const SideBySide& options) {
  const PanelGrid grid = arrange_panels(options.width, panels.size());
  const Canvas canvas(options.width, grid.height);
  fill(canvas, {0, 0, static_cast<double>(options.width), static_cast<double>(grid.height)},
       page_color);
  draw_heading(canvas, grid.heading, grid.unit, options.title, options.subtitle);

  const double range = options.range != 0 ? double{options.range}
                                          : suitable_range(cloud, panels.front().labels, nullptr);
  PointKinds points;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    points = kinds_by_truth(panels[i].labels, truth);
    beyond = draw_panel(canvas, TopView(grid.panels[i], range), cloud, points, range, grid.unit);
    write_caption(canvas, grid.panels[i], panels[i], grid.unit);
  }
  draw_kind_names(canvas, grid.legend, grid.unit, points, scale_note(range, beyond));
  return canvas.png();
}

}  // namespace

Status render_side_by_side(CloudView cloud, std::span<const Truth> truth,
                           std::span<const Panel> panels, const SideBySide& options,
                           std::vector<std::byte>& png) noexcept try {
  if (Status status = check_sizes(cloud, truth, panels); !status.ok()) return status;
  if (Status status = check_options(options); !status.ok()) return status;
  png = picture(cloud, truth, panels, options);
  return {};
} catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

}  // namespace flagstone::render
