// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lab/sim/extent.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {

/// A residential street with grades and slopes below 1 or 2 %: houses, gardens, parked cars,
/// traffic.
Landscape flat_street(std::uint64_t seed);

/// A residential street on a hillside, with grades of 10 to 25 % up and down and vertical curves
/// between them. The land rises evenly behind one sidewalk and descends a bank behind the other.
Landscape steep_street(std::uint64_t seed);

/// A narrow street between two nearly closed rows of parked cars, along the kerb or in bays. They
/// hide most of the ground next to the road.
Landscape parked_cars(std::uint64_t seed, const Extent& extent);

/// A lane through wavy greens with few houses: many bushes, hedges, tufts and patches of low
/// vegetation, starting at the edge of the lane.
Landscape bushes_and_lawn(std::uint64_t seed);

/// Open terrain without a road: hills, swells, bumps, mounds, dips and a bank on each side, bare
/// earth between grass, few plants, a fence. The vehicle pitches and rolls.
Landscape bumpy_field(std::uint64_t seed);

/// A straight road with edges of known shape, a different one every 15 m on each side: kerbs, a
/// ditch, a retaining wall down, stairs, an embankment. The landscape lists the steps.
Landscape steps(std::uint64_t seed);

/// A winding gravel path through gently wavy lawns: patches of grass 30 to 80 cm high, bushes,
/// trees, benches, lamp posts, a reflective pond, people on a path next to it.
Landscape park(std::uint64_t seed, const Extent& extent);

/// A track of two ruts along a wooded hillside: roots across it, leaf litter, puddles, a bank above
/// and a slope below, many trunks, ferns, fallen logs, boughs at the height of a person. The
/// vehicle pitches and rolls.
Landscape forest_track(std::uint64_t seed, const Extent& extent);

/// Furrows 15 to 25 cm deep and 40 to 80 cm apart, which the vehicle crosses at an angle: clods,
/// wheel tracks, a headland at their end, a ditch and a hedge along one side, a ploughing tractor.
/// The vehicle pitches and rolls.
Landscape ploughed_field(std::uint64_t seed);

/// A straight road between the slope of a dam, 2 to 4 m down, and a cutting, 2 to 3 m up:
/// shoulders, ditches, retaining walls down (with and without a guard rail) and up, a culvert,
/// oncoming cars. The landscape lists the steps.
Landscape embankment(std::uint64_t seed);

/// A haul road over churned earth: a pit 1 to 3 m deep with a ramp, a trench, low mounds, heaps of
/// gravel and sand, pipes, pallets, boards, barriers, containers, a fence of wire mesh, an
/// excavator, workers.
Landscape construction_site(std::uint64_t seed);
/// A street of terraced houses with three to six storeys and shop windows directly behind wide
/// sidewalks: zebra crossings, bus stops, trees, traffic of cars, buses, trucks and cyclists, many
/// pedestrians.
Landscape urban_street(std::uint64_t seed, const Extent& extent);

/// A highway of two by three lanes, 400 m long, that enters a superelevated curve: median barrier,
/// shoulders, guard rails, cuttings with a ditch or embankments, noise barriers, a gantry, trucks
/// and cars.
Landscape highway(std::uint64_t seed, const Extent& extent);
/// The road of steps() with deep edges: quays of 1.5 to 3 m, ditches of 1 and 1.5 m, embankments of
/// 1.5 and 3 m.
Landscape drops(std::uint64_t seed);

/// Two crowned roads that cross: round kerbs, islands, raised flower beds, zebra crossings, traffic
/// lights, houses or parks at the corners, vehicles that wait or cross, pedestrians.
Landscape crossroads(std::uint64_t seed, const Extent& extent);

/// A multi-storey car park: a ramp of 12 to 15 % from one storey to the next, ceilings 2.35 to 2.8
/// m high, columns, beams, parapets, parked cars. The ground is the storey of the vehicle: the
/// floor of the upper storey exists only behind the top of the ramp.
Landscape ramp(std::uint64_t seed);

/// A road of two lanes through a cutting into a tunnel, or out of one: raised walkways, arched or
/// flat ceiling, jet fans, lamps, wet patches, traffic.
Landscape tunnel(std::uint64_t seed);

/// A warehouse with a glossy, nearly level floor: racks along or across a wide aisle, pallets on
/// the floor, a dock 1.1 m above a yard with trucks, columns, forklifts, people. Nothing hangs
/// lower than the roof beams, so that sensors from 0.3 to 2 m high fit.
Landscape indoor_hall(std::uint64_t seed);

}  // namespace flagstone::sim
