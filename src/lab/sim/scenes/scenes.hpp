// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lab/sim/scene.hpp"

namespace flagstone::sim {

/// A residential street with grades and slopes below 1 or 2 %: houses, gardens, parked cars,
/// traffic.
Landscape flat_street(std::uint64_t seed);

/// A residential street of grades between 10 and 25 % up and down with vertical curves between, on
/// a hillside: the land climbs evenly behind one sidewalk and falls, down a bank, behind the other.
Landscape steep_street(std::uint64_t seed);

/// A narrow street between two nearly closed rows of parked cars, along the kerb or in bays, so
/// close that they hide most of the ground beside the road.
Landscape parked_cars(std::uint64_t seed);

/// A lane through wavy greens with few houses: many bushes, hedges, tufts and patches of low growth
/// from the edge of the lane on.
Landscape bushes_and_lawn(std::uint64_t seed);

/// Open terrain without a road: hills, swells, bumps, mounds, dips and a bank on either side, bare
/// earth between grass, few plants, a fence. The vehicle pitches and rolls.
Landscape bumpy_field(std::uint64_t seed);

/// A straight road with edges of known shape, another every 15 m on either side: kerbs, a ditch, a
/// retaining wall down, stairs, an embankment; the steps are listed in the landscape.
Landscape steps(std::uint64_t seed);

/// A winding gravel path through gently wavy lawns: patches of grass 30 to 80 cm high, bushes,
/// trees, benches, lamp posts, a pond that mirrors, people on a path beside it.
Landscape park(std::uint64_t seed);

/// A track of two ruts along a wooded hillside: roots across it, leaf litter, puddles, a bank above
/// and a slope below, many trunks, ferns, fallen logs, boughs as low as a person. The vehicle
/// pitches and rolls.
Landscape forest_track(std::uint64_t seed);

/// Furrows 15 to 25 cm deep, 40 to 80 cm apart, that the vehicle crosses at an angle: clods, wheel
/// tracks, a headland where they end, a ditch and a hedge along one side, a tractor at work. The
/// vehicle pitches and rolls.
Landscape ploughed_field(std::uint64_t seed);

/// A straight road between a dam's slope, 2 to 4 m down, and a cutting, 2 to 3 m up: shoulders,
/// ditches, retaining walls down with and without a guard rail, and up, a culvert, oncoming cars.
/// The steps are listed in the landscape.
Landscape embankment(std::uint64_t seed);

/// A haul road over churned earth: a pit 1 to 3 m deep with a ramp, a trench, low mounds, heaps of
/// gravel and sand, pipes, pallets, boards, barriers, containers, a fence of wire mesh, an
/// excavator, workers.
Landscape construction_site(std::uint64_t seed);
/// A street of terraced houses of three to six storeys with shop windows straight behind wide
/// sidewalks: zebra crossings, bus stops, trees, traffic of cars, buses, trucks and cyclists, many
/// pedestrians.
Landscape urban_street(std::uint64_t seed);

/// A highway of two by three lanes that turns into a superelevated curve: median barrier,
/// shoulders, guard rails, cuttings with a ditch or embankments, noise barriers, a gantry, trucks
/// and cars; 400 m long.
Landscape highway(std::uint64_t seed);
/// The same road with edges that lead deep down: quays of 1.5 to 3 m, ditches of 1 and 1.5 m,
/// embankments of 1.5 and 3 m.
Landscape drops(std::uint64_t seed);

/// Two crowned roads that cross: round kerbs, islands, raised flower beds, zebra crossings, traffic
/// lights, houses or parks at the corners, vehicles that wait or cross, pedestrians.
Landscape crossroads(std::uint64_t seed);

/// A multi-storey car park: a ramp of 12 to 15 % from one storey to the next, ceilings 2.35 to
/// 2.8 m high, columns, beams, parapets, parked cars. The ground is the storey one is on: the floor
/// of the upper one lies behind the head of the ramp only.
Landscape ramp(std::uint64_t seed);

/// A road of two lanes through a cutting into a tunnel, or out of one: raised walkways, arched or
/// flat ceiling, jet fans, lamps, wet patches, traffic.
Landscape tunnel(std::uint64_t seed);

/// A warehouse with a glossy, nearly level floor: racks along or across a wide aisle, pallets on
/// the floor, a dock 1.1 m above a yard with trucks, columns, forklifts, people. Nothing hangs
/// lower than the roof beams, so that sensors of any height between 0.3 and 2 m may drive.
Landscape indoor_hall(std::uint64_t seed);

}  // namespace flagstone::sim
