// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/surface_files.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "files/io/atomic_file.hpp"
#include "files/io/npy.hpp"

namespace flagstone::app {
namespace {

using Json = nlohmann::ordered_json;

/// A float32 with the fewest digits that identify it: 0.1, not 0.10000000149011612.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

double finest_cell(const GroundSurface& surface) { return shortest(surface.grids().back().cell); }

Json grids_json(const GroundSurface& surface) {
  Json grids = Json::array();
  for (const GroundSurface::Grid& grid : surface.grids()) {
    grids.push_back({{"cell", shortest(grid.cell)}, {"extent", shortest(grid.extent())}});
  }
  return grids;
}

}  // namespace

Status SurfaceFiles::write(const GroundSurface& surface) const {
  const double cell = resolution > 0 ? resolution : finest_cell(surface);
  const render::HeightMap map = render::map_of(surface, shortest(surface.extent()), cell);
  Status status = io::write_npy_file(grid(), map.heights, std::array{map.width, map.width});
  if (!status.ok()) return status;
  return io::write_file(frame(), std::string_view(frame_text(surface, map)));
}

std::string SurfaceFiles::frame_text(const GroundSurface& surface,
                                     const render::HeightMap& map) const {
  const double extent = map.extent();
  Json json;
  json["scan"] = scan;
  json["grid"] = grid().filename().string();
  json["picture"] = picture().filename().string();
  json["frame"] = "sensor: x forward, y left, z up; origin at the sensor";
  json["units"] = "metres";
  json["values"] = "z of the ground at the centre of each cell";
  json["dtype"] = "float32";
  json["nodata"] = "NaN";
  json["rows"] = map.width;
  json["columns"] = map.width;
  json["resolution"] = map.cell;
  json["axes"] = {{"rows", "y, from the largest to the smallest"},
                  {"columns", "x, from the smallest to the largest"}};
  json["origin"] = {{"x", -extent}, {"y", extent}, {"is", "outer corner of row 0, column 0"}};
  json["extent"] = {{"min_x", -extent}, {"min_y", -extent}, {"max_x", extent}, {"max_y", extent}};
  json["geotransform"] = {-extent, map.cell, 0, extent, 0, -map.cell};
  json["made_from"] = grids_json(surface);
  // File names may not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace flagstone::app
