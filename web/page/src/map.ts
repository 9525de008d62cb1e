// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// A mapped run, as the page draws it. The ground is required; a problem with another file is reported, and the rest shown.
import type { Flagstone } from "flagstone";
import { contentOf, readObjects, readPoses, readTiles, type Files, type Pose, type Tiles } from "./map_files";
import { mapMesh } from "./map_mesh";
import { labels, type MapCopy, type Position } from "./messages";

export async function readMap(name: string, files: Files, module: Flagstone): Promise<MapCopy> {
  const tiles = await readTiles(files);
  const origin = originOf(tiles);
  const problems: string[] = [];
  const optional = async <T>(names: string[], read: (...files: File[]) => Promise<T>, otherwise: T): Promise<T> => {
    const found = names.map((each) => files.get(each));
    if (found.includes(undefined)) return otherwise;
    try {
      return await read(...(found as File[]));
    } catch (error) {
      problems.push(error instanceof Error ? error.message : String(error));
      return otherwise;
    }
  };
  const poses = await optional(["poses.txt"], readPoses, []);
  const objects = await optional(["objects.csv", "run.json"], (table, run) => readObjects(table, run, poses), new Float64Array());
  const points = await optional(["static.ply"], async (file) => obstacles(module, file.name, await contentOf(file), origin), {
    positions: new Float32Array(),
    heights: new Float32Array(),
  });
  return {
    name,
    scans: tiles.scans,
    area: tiles.cells * tiles.cell ** 2,
    origin,
    ground: mapMesh(tiles, origin),
    ...pathOf(poses, origin),
    points,
    objects: relative(objects, origin),
    problems,
  };
}

/** The middle of the map, in whole metres. */
function originOf({ cell, width, tiles }: Tiles): Position {
  const middle = (values: number[]) => Math.round(((Math.min(...values) + Math.max(...values) + 1) / 2) * width * cell);
  const heights = tiles.flatMap((tile) => tile.heights.find((height) => !Number.isNaN(height)) ?? []);
  return [middle(tiles.map(({ x }) => x)), middle(tiles.map(({ y }) => y)), Math.round(heights[0] ?? 0)];
}

function relative(positions: ArrayLike<number>, origin: Position): Float32Array {
  return Float32Array.from(positions, (value, index) => value - origin[index % 3]);
}

/** The path of the sensor: pairs of positions, and its length in metres. */
function pathOf(poses: Pose[], origin: Position): { path: Float32Array; length: number } {
  const known = poses.map((pose) => [pose[3], pose[7], pose[11]]).filter((position) => position.every(Number.isFinite));
  let length = 0;
  const pieces = known.slice(1).flatMap((position, index) => {
    length += Math.hypot(...position.map((value, axis) => value - known[index][axis]));
    return [...known[index], ...position];
  });
  return { path: relative(pieces, origin), length };
}

/** The static points that are not ground. */
function obstacles(module: Flagstone, name: string, content: ArrayBuffer, origin: Position): MapCopy["points"] {
  const scan = module.read(name, content);
  try {
    const [x, y, z, height, label] = ["x", "y", "z", "height", "label"].map((field) => {
      const values = scan.values(field);
      if (values === undefined) throw new Error(`${name}: field ${field} is missing (expected the file of flagstone map)`);
      return values;
    });
    const indices = Array.from(label.keys()).filter((index) => label[index] === labels.indexOf("nonground"));
    const positions = new Float32Array(3 * indices.length);
    indices.forEach((index, i) => positions.set([x[index] - origin[0], y[index] - origin[1], z[index] - origin[2]], 3 * i));
    return { positions, heights: Float32Array.from(indices, (index) => height[index]) };
  } finally {
    scan.delete();
  }
}
