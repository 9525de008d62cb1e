// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Reads the directory that `flagstone map` writes: docs/reference/file-formats.md describes its files.

/** Files by their names without directories. */
export type Files = ReadonlyMap<string, File>;

/** A tile of `width` x `width` cells. The first row has the smallest y, the first cell of a row the smallest x. */
export interface Tile {
  /** The tile covers x from `x * width` to `(x + 1) * width` cells, and y in the same way. */
  x: number;
  y: number;
  heights: Float32Array;
  deviations: Float32Array;
  lastScans: Uint32Array;
  scans: Uint16Array;
  contradictions: Uint16Array;
}

export interface Tiles {
  /** Side of a cell, metres. */
  cell: number;
  width: number;
  /** Number of scans of the map. */
  scans: number;
  cells: number;
  tiles: Tile[];
}

/** The pose of a scan: the rows of a 3x4 matrix, from the sensor to the world frame. NaN if unknown. */
export type Pose = Float64Array;

const fields = [
  ["height", "<f4"],
  ["deviation", "<f4"],
  ["last_scan", "<u4"],
  ["scans", "<u2"],
  ["contradictions", "<u2"],
];
const cellSize = 16; // bytes

export async function contentOf(file: File): Promise<ArrayBuffer> {
  return file.arrayBuffer().catch(() => {
    throw new Error(`${file.name}: cannot be read (expected a file, not a directory; if it was moved, open it again)`);
  });
}

async function textOf(file: File): Promise<string> {
  return new TextDecoder().decode(await contentOf(file));
}

async function jsonOf(file: File): Promise<Record<string, unknown>> {
  const text = await textOf(file);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new Error(`${file.name}: is not JSON (expected a file of flagstone map; it may be truncated)`);
  }
  if (typeof value !== "object" || value === null) throw new Error(`${file.name}: is not a JSON object`);
  return value as Record<string, unknown>;
}

/** The ground of a map. */
export async function readTiles(files: Files): Promise<Tiles> {
  const file = files.get("map.json");
  if (file === undefined) throw new Error("map.json: is missing (expected the directory that flagstone map wrote)");
  const geometry = await jsonOf(file);
  if (geometry.format !== "flagstone ground map" || geometry.version !== 1) {
    throw new Error("map.json: is not a ground map (expected format 'flagstone ground map', version 1)");
  }
  const number = (key: string, low: number, high: number) => {
    const value = geometry[key];
    if (typeof value === "number" && value >= low && value <= high) return value;
    throw new Error(`map.json: ${key} is ${JSON.stringify(value)} (expected a number from ${low} to ${high})`);
  };
  const cell = number("cell", 0.01, 100);
  const width = number("tile_width", 1, 1024);
  const scans = number("scans", 0, 2 ** 32);
  const cells = number("cells", 0, 2 ** 53);
  if (!Array.isArray(geometry.tiles) || geometry.tiles.length === 0) {
    throw new Error("map.json: the map has no tiles (expected ground from at least one scan)");
  }
  const listed = geometry.tiles as { file?: unknown; x?: unknown; y?: unknown }[];
  const tiles = listed.map(async ({ file: name, x, y }, index) => {
    if (typeof name !== "string" || !Number.isSafeInteger(x) || !Number.isSafeInteger(y)) {
      throw new Error(`map.json: tile ${index} has no file, x and y`);
    }
    const content = files.get(name);
    if (content === undefined) throw new Error(`${name}: the tile is missing (expected every tile of map.json)`);
    return tileOf(name, x as number, y as number, width, await contentOf(content));
  });
  return { cell, width, scans, cells, tiles: await Promise.all(tiles) };
}

/** A NumPy file, version 1.0, of width x width records. */
function tileOf(name: string, x: number, y: number, width: number, content: ArrayBuffer): Tile {
  const view = new DataView(content);
  const isNpy = content.byteLength >= 10 && view.getUint32(0) === 0x934e554d && view.getUint32(4) === 0x50590100;
  const start = isNpy ? 10 + view.getUint16(8, true) : 0;
  const header = new TextDecoder("latin1").decode(content.slice(10, start)).replace(/\s+/g, "").replaceAll(",]", "]");
  const types = fields.map(([field, type]) => `('${field}','${type}')`).join(",");
  const expected = [`'descr':[${types}]`, "'fortran_order':False", `'shape':(${width},${width})`];
  if (!expected.every((part) => header.includes(part))) {
    throw new Error(`${name}: is not a tile (expected a NumPy array of ${width} x ${width} records with ${fields.map(([field]) => field).join(", ")})`);
  }
  const size = start + width * width * cellSize;
  if (content.byteLength !== size) {
    throw new Error(`${name}: ${content.byteLength} bytes are not a tile (expected ${size} bytes; the file may be truncated)`);
  }
  const count = width * width;
  const tile: Tile = {
    x,
    y,
    heights: new Float32Array(count),
    deviations: new Float32Array(count),
    lastScans: new Uint32Array(count),
    scans: new Uint16Array(count),
    contradictions: new Uint16Array(count),
  };
  for (let i = 0, at = start; i < count; ++i, at += cellSize) {
    tile.heights[i] = view.getFloat32(at, true);
    tile.deviations[i] = view.getFloat32(at + 4, true);
    tile.lastScans[i] = view.getUint32(at + 8, true);
    tile.scans[i] = view.getUint16(at + 12, true);
    tile.contradictions[i] = view.getUint16(at + 14, true);
  }
  return tile;
}

async function linesOf(file: File): Promise<string[]> {
  const lines = (await textOf(file)).split("\n");
  if (lines.pop() !== "") throw new Error(`${file.name}: line ${lines.length + 1}: is incomplete (the file may be truncated)`);
  return lines;
}

/** One pose per line: `poses.txt`. */
export async function readPoses(file: File): Promise<Pose[]> {
  return (await linesOf(file)).map((line, index) => {
    const words = line.trim().split(/\s+/);
    if (words.length !== 12) {
      throw new Error(`${file.name}: line ${index + 1}: ${words.length} numbers (expected 12, the rows of a 3x4 matrix)`);
    }
    return Float64Array.from(words, (word) => {
      const value = Number(word);
      if (Number.isNaN(value) && !/^[+-]?nan$/i.test(word)) {
        throw new Error(`${file.name}: line ${index + 1}: '${word.slice(0, 40)}' is not a number`);
      }
      return value;
    });
  });
}

/** The centre of each moving object in the world frame, three numbers per object. */
export async function readObjects(objects: File, run: File, poses: Pose[]): Promise<Float64Array> {
  const description = await jsonOf(run);
  const tilt = (description.origin as { settings?: { mount?: { tilt?: unknown } } } | undefined)?.settings?.mount?.tilt;
  // Boxes are then in the gravity-aligned frame, and the poses are those of the sensor.
  if (tilt !== undefined && tilt !== "off") return new Float64Array();
  if (!Array.isArray(description.scans)) throw new Error(`${run.name}: scans are missing (expected a file of flagstone map)`);
  const indices = new Map(description.scans.map((path, index) => [String(path).replace(/^.*[/\\]|(\.pcd)?\.[^.]*$/g, ""), index]));
  const lines = await linesOf(objects);
  const columns = lines[0]?.split(",") ?? [];
  const sides = ["min_x", "min_y", "min_z", "max_x", "max_y", "max_z"].map((name) => columns.indexOf(name));
  if (columns[0] !== "scan" || sides.includes(-1)) {
    throw new Error(`${objects.name}: line 1: columns are missing (expected scan, min_x, min_y, min_z, max_x, max_y, max_z)`);
  }
  const centers: number[] = [];
  lines.slice(1).forEach((line, index) => {
    const words = line.split(",");
    const box = sides.map((column) => Number(words[column] || NaN));
    if (words.length !== columns.length || box.some(Number.isNaN)) {
      throw new Error(`${objects.name}: line ${index + 2}: is not an object (expected ${columns.length} values)`);
    }
    const pose = poses[indices.get(words[0]) ?? -1];
    if (pose === undefined || pose.some(Number.isNaN)) return;
    const [x, y, z] = [0, 1, 2].map((axis) => (box[axis] + box[axis + 3]) / 2);
    for (let row = 0; row < 12; row += 4) centers.push(pose[row] * x + pose[row + 1] * y + pose[row + 2] * z + pose[row + 3]);
  });
  return Float64Array.from(centers);
}
