// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import type { Tiles } from "./map_files";
import type { GroundMesh, Position } from "./messages";

/** Maps with more cells than this are drawn with every second cell, every fourth, ... */
const mostCells = 2_000_000;

/** Slopes are shaded as if they were this many times as steep, so that gentle ones are visible. */
export const steeper = 3;

/**
 * The ground as triangles. Cells without a height are holes. Positions are relative to `origin`, so that 32 bits are exact
 * for every frame.
 */
export function mapMesh(map: Tiles, origin: Position): GroundMesh {
  const { width, tiles } = map;
  let step = 1;
  while (map.cells / step ** 2 > mostCells && width % (2 * step) === 0) step *= 2;
  const size = step * map.cell;

  const indices = new Map(tiles.map((tile, index) => [`${tile.x},${tile.y}`, index]));
  const numbers = tiles.map(() => new Int32Array(width * width).fill(-1));
  /** Tile and cell, in a tile or the next one; undefined outside the map. */
  const locate = (index: number, row: number, column: number): [number, number] | undefined => {
    if (row >= 0 && row < width && column >= 0 && column < width) return [index, row * width + column];
    const { x, y } = tiles[index];
    const next = indices.get(`${x + Math.floor(column / width)},${y + Math.floor(row / width)}`);
    return next === undefined ? undefined : [next, ((row + width) % width) * width + ((column + width) % width)];
  };
  const heightAt = (index: number, row: number, column: number): number => {
    const place = locate(index, row, column);
    return place === undefined ? NaN : tiles[place[0]].heights[place[1]];
  };
  /** Slope between two heights on both sides of a middle one, any of which can be unknown. */
  const slope = (before: number, middle: number, after: number): number => {
    if (!Number.isNaN(before) && !Number.isNaN(after)) return (after - before) / (2 * size);
    if (!Number.isNaN(after)) return (after - middle) / size;
    return Number.isNaN(before) ? 0 : (middle - before) / size;
  };

  const positions: number[] = [];
  const normals: number[] = [];
  const cellsOfCorners: number[] = [];
  const triangles: number[] = [];
  /** Number of the corner at a cell, -1 if its height is unknown. */
  const corner = (index: number, row: number, column: number): number => {
    const place = locate(index, row, column);
    if (place === undefined) return -1;
    const [at, cell] = place;
    const tile = tiles[at];
    const height = tile.heights[cell];
    if (numbers[at][cell] >= 0 || Number.isNaN(height)) return numbers[at][cell];
    numbers[at][cell] = positions.length / 3;
    const [ownRow, ownColumn] = [Math.floor(cell / width), cell % width];
    positions.push(
      (tile.x * width + ownColumn + 0.5) * map.cell - origin[0],
      (tile.y * width + ownRow + 0.5) * map.cell - origin[1],
      height - origin[2],
    );
    const dx = slope(heightAt(at, ownRow, ownColumn - step), height, heightAt(at, ownRow, ownColumn + step));
    const dy = slope(heightAt(at, ownRow - step, ownColumn), height, heightAt(at, ownRow + step, ownColumn));
    const scale = 32767 / Math.hypot(steeper * dx, steeper * dy, 1);
    normals.push(-steeper * dx * scale, -steeper * dy * scale, scale, 0);
    cellsOfCorners.push(at, cell);
    return numbers[at][cell];
  };
  tiles.forEach((_, index) => {
    for (let row = 0; row < width; row += step) {
      for (let column = 0; column < width; column += step) {
        const known = [
          corner(index, row, column),
          corner(index, row, column + step),
          corner(index, row + step, column + step),
          corner(index, row + step, column),
        ].filter((number) => number >= 0);
        if (known.length >= 3) triangles.push(known[0], known[1], known[2]);
        if (known.length === 4) triangles.push(known[0], known[2], known[3]);
      }
    }
  });

  const count = positions.length / 3;
  const layer = <T extends { [index: number]: number }>(into: T, value: (tile: Tiles["tiles"][number], cell: number) => number): T => {
    for (let i = 0; i < count; ++i) into[i] = value(tiles[cellsOfCorners[2 * i]], cellsOfCorners[2 * i + 1]);
    return into;
  };
  return {
    positions: Float32Array.from(positions),
    normals: Int16Array.from(normals),
    triangles: Uint32Array.from(triangles),
    deviations: layer(new Float32Array(count), (tile, cell) => tile.deviations[cell]),
    scans: layer(new Uint16Array(count), (tile, cell) => tile.scans[cell]),
    contradictions: layer(new Uint16Array(count), (tile, cell) => tile.contradictions[cell]),
    ages: layer(new Uint32Array(count), (tile, cell) => map.scans - tile.lastScans[cell]),
  };
}
