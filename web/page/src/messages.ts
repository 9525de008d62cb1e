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

/** The requests of the page, with the types of their replies. */
export interface Requests {
  open: { request: { file: File }; reply: Points };
  segment: { request: { options: Options }; reply: Result };
  compare: { request: { options: Options }; reply: Result };
  doctor: { request: { options: Options }; reply: Report };
  save: { request: { name: string; map: "flagstone" | "semantic-kitti" }; reply: Uint8Array };
}

export type Kind = keyof Requests;
