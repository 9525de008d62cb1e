// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/zone_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flagstone::render {
namespace {

constexpr std::array<VerdictLook, 6> looks = {{
    {.verdict = Verdict::ground, .name = "ground", .color = {0, 158, 115}},
    {.verdict = Verdict::ground_flat, .name = "ground, flat", .color = {166, 214, 42}},
    {.verdict = Verdict::too_few_points, .name = "too few points", .color = {118, 126, 138}},
    {.verdict = Verdict::no_plane, .name = "no plane", .color = {66, 110, 214}},
    {.verdict = Verdict::not_upright, .name = "not upright", .color = {176, 92, 206}},
    {.verdict = Verdict::too_high, .name = "too high", .color = {226, 94, 30}},
}};

double inner_radius(const PatchworkConfig& config, std::size_t zone, std::size_t ring) noexcept {
  if (ring > 0) return config.zones[zone].ring_radii[ring - 1];
  return zone > 0 ? config.zones[zone - 1].ring_radii.back() : config.min_range;
}

// Start angle of a sector, radians counter-clockwise from x.
double sector_begin(const PatchworkConfig& config, const Zone& zone, int sector) noexcept {
  const FieldOfView& view = config.field_of_view;
  const double share = static_cast<double>(sector) / zone.sectors;
  return (view.begin + share * view.width) * std::numbers::pi / 180;
}

// Appends one bin to the path, in metres. All bins have the same orientation, so that adjacent bins
// are filled without a seam.
void add_bin(cairo_t* context, const PatchworkConfig& config, const Patch& patch) noexcept {
  const Zone& zone = config.zones[patch.zone];
  const double begin = sector_begin(config, zone, patch.sector);
  const double end = sector_begin(config, zone, patch.sector + 1);
  cairo_new_sub_path(context);
  cairo_arc(context, 0, 0, zone.ring_radii[patch.ring], begin, end);
  cairo_arc_negative(context, 0, 0, inner_radius(config, patch.zone, patch.ring), end, begin);
  cairo_close_path(context);
}

// Appends a circle, or the arc of it within the field of view.
void add_circle(cairo_t* context, const PatchworkConfig& config, double radius) noexcept {
  const Zone& zone = config.zones.front();
  cairo_new_sub_path(context);
  cairo_arc(context, 0, 0, radius, sector_begin(config, zone, 0),
            sector_begin(config, zone, zone.sectors));
}

void add_sector_lines(cairo_t* context, const PatchworkConfig& config, const Zone& zone,
                      double inner) noexcept {
  const double outer = zone.ring_radii.back();
  const int last = config.field_of_view.width < 360 ? zone.sectors : zone.sectors - 1;
  for (int sector = 0; sector <= last; ++sector) {
    const double angle = sector_begin(config, zone, sector);
    cairo_move_to(context, inner * std::cos(angle), inner * std::sin(angle));
    cairo_line_to(context, outer * std::cos(angle), outer * std::sin(angle));
  }
}

void clip_to_panel(cairo_t* context, const TopView& view) noexcept {
  add_rectangle(context, view.panel());
  cairo_clip(context);
}

// Strokes the path, given in metres, with a line of `width` pixels.
void stroke(cairo_t* context, double width, double opacity) noexcept {
  cairo_identity_matrix(context);
  cairo_set_line_width(context, width);
  set_color(context, zone_line_color, opacity);
  cairo_stroke(context);
}

}  // namespace

std::span<const VerdictLook> verdict_looks() noexcept { return looks; }

Status check_bins(std::span<const Patch> patches, const PatchworkConfig& config) {
  const auto is_bin = [&config](const Patch& patch) {
    return patch.zone < config.zones.size() &&
           patch.ring < config.zones[patch.zone].ring_radii.size() &&
           patch.sector < config.zones[patch.zone].sectors;
  };
  const auto stranger = std::ranges::find_if_not(patches, is_bin);
  if (stranger == patches.end()) return {};
  return Status(
      StatusCode::invalid_argument,
      fmt::format("image: patch {} is zone {}, ring {}, sector {}, which the configuration does "
                  "not contain "
                  "(expected the configuration that the scan was segmented with)",
                  stranger - patches.begin(), stranger->zone, stranger->ring, stranger->sector));
}

void tint_bins(const Canvas& canvas, const TopView& view, std::span<const Patch> patches,
               const PatchworkConfig& config) noexcept {
  cairo_t* context = canvas.context();
  cairo_save(context);
  clip_to_panel(context, view);
  view.use_metres(context);
  for (const VerdictLook& look : looks) {
    for (const Patch& patch : patches)
      if (patch.verdict == look.verdict) add_bin(context, config, patch);
    set_color(context, look.color, tint_opacity);
    cairo_fill(context);
  }
  cairo_restore(context);
}

void draw_zone_lines(const Canvas& canvas, const TopView& view, const PatchworkConfig& config,
                     double unit) noexcept {
  cairo_t* context = canvas.context();
  cairo_save(context);
  clip_to_panel(context, view);

  view.use_metres(context);
  for (std::size_t zone = 0; zone < config.zones.size(); ++zone) {
    const std::vector<float>& radii = config.zones[zone].ring_radii;
    for (std::size_t ring = 0; ring + 1 < radii.size(); ++ring)
      add_circle(context, config, radii[ring]);
    add_sector_lines(context, config, config.zones[zone], inner_radius(config, zone, 0));
  }
  stroke(context, 1.0 * unit, 0.28);

  view.use_metres(context);
  add_circle(context, config, config.min_range);
  for (const Zone& zone : config.zones) add_circle(context, config, zone.ring_radii.back());
  stroke(context, 2.0 * unit, 0.6);
  cairo_restore(context);
}

}  // namespace flagstone::render
