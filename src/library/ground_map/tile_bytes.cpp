// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/tile_bytes.hpp"

#include <cmath>
#include <cstddef>

#include "library/ground_map/presence_bits.hpp"

namespace flagstone {
namespace {

bool is_measured(const MapCell& cell) noexcept { return cell.last_scan != 0; }

void write(const HeightEvidence& evidence, StateWriter& writer) {
  writer.add(evidence.height);
  writer.add(evidence.weight);
  writer.add(evidence.scatter);
  writer.add(evidence.scans);
}

HeightEvidence read_evidence(StateReader& reader) noexcept {
  HeightEvidence evidence;
  evidence.height = reader.read<float>();
  evidence.weight = reader.read<float>();
  evidence.scatter = reader.read<float>();
  evidence.scans = reader.read<std::uint16_t>();
  return evidence;
}

bool is_possible(const HeightEvidence& evidence) noexcept {
  return std::isfinite(evidence.height) && evidence.weight > 0 && std::isfinite(evidence.weight) &&
         evidence.scatter >= 0 && std::isfinite(evidence.scatter) && evidence.scans > 0;
}

// No bit set, not even a sign.
bool is_empty(const HeightEvidence& evidence) noexcept {
  const auto is_zero = [](float number) { return std::bit_cast<std::uint32_t>(number) == 0; };
  return is_zero(evidence.height) && is_zero(evidence.weight) && is_zero(evidence.scatter) &&
         evidence.scans == 0;
}

}  // namespace

void write_cells(const CellTiles::Tile& tile, StateWriter& writer) {
  const PresenceBits<MapTile::cells> measured([&](std::size_t k) { return is_measured(tile[k]); });
  measured.write(writer);
  for (const MapCell& cell : tile) {
    if (!is_measured(cell)) continue;
    write(cell.best, writer);
    write(cell.other, writer);
    writer.add(cell.last_scan);
  }
}

Status read_cells(StateReader& reader, CellTiles::Tile& tile) {
  PresenceBits<MapTile::cells> measured;
  const bool has_cells = measured.read(reader) && measured.any();
  for (std::size_t k = 0; k < tile.size() && !reader.failed(); ++k) {
    if (!measured[k]) continue;
    const std::size_t offset = reader.offset();
    MapCell& cell = tile[k];
    cell.best = read_evidence(reader);
    cell.other = read_evidence(reader);
    cell.last_scan = reader.read<std::uint32_t>();
    const bool possible = is_possible(cell.best) && cell.last_scan > 0 &&
                          (is_empty(cell.other) || is_possible(cell.other));
    if (!possible && !reader.failed()) {
      return bad_state(offset, "a cell has an impossible number",
                       "finite heights, positive weights and numbers of scans");
    }
  }
  if (reader.failed() || !has_cells) {
    return bad_state(reader.offset(), "the cells of a tile are missing",
                     "one bit per cell, then the cells");
  }
  return {};
}

}  // namespace flagstone
