// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/scene.hpp"

#include <algorithm>
#include <array>

#include "lab/sim/scenes/scenes.hpp"

namespace flagstone::sim {

namespace {

// The instance with one stretch of a scene that can be long.
template <Landscape (*make)(std::uint64_t seed, const Extent& extent)>
Landscape shortest(std::uint64_t seed) {
  return make(seed, {});
}

constexpr std::array kinds{
    SceneKind{"flat_street", "residential street, nearly level", flat_street},
    SceneKind{"steep_street", "residential street, grades of 10 to 25 %, crests and dips",
              steep_street},
    SceneKind{"parked_cars", "narrow street, cars along both kerbs or in bays",
              shortest<parked_cars>, parked_cars},
    SceneKind{"bushes_and_lawn", "lane through greens: bushes, hedges, tufts, low vegetation",
              bushes_and_lawn},
    SceneKind{"bumpy_field", "open terrain without a road: bumps, slopes, banks, dips",
              bumpy_field},
    SceneKind{"steps", "road with known kerbs, ditches, drop-offs, stairs, embankments", steps},
    SceneKind{"park", "winding gravel path, lawns, high grass, trees, a pond, pedestrians",
              shortest<park>, park},
    SceneKind{"forest_track", "two ruts through a forest: roots, banks, trunks, ferns, logs",
              shortest<forest_track>, forest_track},
    SceneKind{"ploughed_field", "furrows crossed at an angle, headland, ditch, hedge, tractor",
              ploughed_field},
    SceneKind{"embankment", "road on a dam: drops, ditch, culvert; a cutting on the other side",
              embankment},
    SceneKind{"construction_site", "churned earth, pit, trench, heaps, materials, excavator",
              construction_site},
    SceneKind{"urban_street", "terraced houses, shop windows, buses, cyclists, pedestrians",
              shortest<urban_street>, urban_street},
    SceneKind{"highway", "2 x 3 lanes, barriers, slopes, superelevation, trucks", shortest<highway>,
              highway},
    SceneKind{"drops", "road along quays, deep ditches and steep embankments", drops},
    SceneKind{"crossroads", "crowned roads that cross, islands, flower beds, waiting traffic",
              shortest<crossroads>, crossroads},
    SceneKind{"ramp", "two-storey car park, a ramp of 12 to 15 %, low ceilings", ramp},
    SceneKind{"tunnel", "two lanes into a hill: walkways, vault or slab, fans, wet patches",
              tunnel},
    SceneKind{"indoor_hall", "warehouse: racks, pallets, forklifts, docks, a glossy floor",
              indoor_hall},
};

}  // namespace

std::span<const SceneKind> scene_kinds() noexcept { return kinds; }

const SceneKind* find_scene_kind(std::string_view name) noexcept {
  const auto* found = std::ranges::find(kinds, name, &SceneKind::name);
  return found == kinds.end() ? nullptr : found;
}

}  // namespace flagstone::sim
