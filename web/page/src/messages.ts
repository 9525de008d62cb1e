// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// What the page and its worker send each other.
import type { Field, Grid, Mount, Options, Patch, Report } from "flagstone";

export type { Field, Finding, GroundSample, Mount, Options, Patch, Report, Setting, Verdict } from "flagstone";
export { labels } from "flagstone";

/** A scan, as the page draws it. */
export interface Points {
  name: string;
  size: number;
  /** x, y and z of every point. */
  positions: Float32Array;
  fields: Field[];
}

/** A grid of ground heights, copied out of the module. */
export type GridCopy = Grid;

/** A result, copied out of the module. */
export interface Result {
  labels: Uint8Array;
  counts: number[];
  /** Empty if the method does not compute a surface. */
  heights: Float32Array;
  patches: Patch[];
  /** Index of the patch of each point, `noPatch` if it has none. */
  patchOf: Uint16Array;
  grids: GridCopy[];
  mount: Mount;
  settings: Record<string, unknown>;
  /** Time of the segmentation alone. */
  milliseconds: number;
}

export const noPatch = 0xffff;

export type Position = [number, number, number];

/** The ground of a map as triangles, with the values of the cell of each corner. */
export interface GroundMesh {
  positions: Float32Array;
  /** Four numbers per corner; the last one is padding. */
  normals: Int16Array;
  triangles: Uint32Array;
  /** Expected errors of the heights, metres. */
  deviations: Float32Array;
  /** Numbers of scans that agree on the height, and that measured another one. */
  scans: Uint16Array;
  contradictions: Uint16Array;
  /** Numbers of scans since the cell was measured last. */
  ages: Uint32Array;
}

/** A mapped run. Positions are in metres, relative to `origin` in the world frame. */
export interface MapCopy {
  name: string;
  /** Number of scans of the map. */
  scans: number;
  /** Square metres. */
  area: number;
  origin: Position;
  ground: GroundMesh;
  /** Pairs of positions of the sensor. */
  path: Float32Array;
  /** Length of the path, metres. */
  length: number;
  /** Static points that are not ground. */
  points: { positions: Float32Array; heights: Float32Array };
  /** Centres of moving objects in each scan. */
  objects: Float32Array;
  /** Files that could not be read, one line each. */
  problems: string[];
}

/** The requests of the page, with the types of their replies. */
export interface Requests {
  open: { request: { file: File; columns: number }; reply: Points };
  map: { request: { name: string; files: Map<string, File> }; reply: MapCopy };
  segment: { request: { options: Options }; reply: Result };
  compare: { request: { options: Options }; reply: Result };
  doctor: { request: { options: Options }; reply: Report };
  save: { request: { name: string; map: "flagstone" | "semantic-kitti" }; reply: Uint8Array };
}

export type Kind = keyof Requests;
