// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// What the page says and draws of a map.
import { BufferAttribute, BufferGeometry } from "three";
import { palettes, rampColor, terrain, type Rgb, type Theme } from "./colors";
import type { GroundMesh, MapCopy, Position } from "./messages";
import { metres } from "./words";

export type MapColor = "height" | "deviation" | "scans";

/** Numbers from the first to the last colour. */
interface Scale {
  low: number;
  high: number;
  text: string;
  format: (value: number) => string;
  value: (corner: number) => number;
}

export function scaleOf({ ground, origin }: MapCopy, color: MapColor): Scale {
  const { positions, deviations, scans } = ground;
  switch (color) {
    case "deviation":
      return { low: 0, high: 0.1, text: "expected error", format: metres, value: (corner) => deviations[corner] };
    case "scans":
      return { low: 0, high: Math.max(quantile(scans, 0.98), 2), text: "scans per cell", format: String, value: (corner) => scans[corner] };
    default: {
      const heights = positions.filter((_, index) => index % 3 === 2);
      const [low, high] = [quantile(heights, 0.01), quantile(heights, 0.99)];
      const middle = (low + high) / 2;
      const half = Math.max(high - low, 0.5) / 2;
      const up = origin[2];
      return { low: middle - half, high: middle + half, text: "height", format: (z) => metres(z + up, 1), value: (corner) => positions[3 * corner + 2] };
    }
  }
}

function quantile(values: Float32Array | Uint16Array, part: number): number {
  return values.length === 0 ? 0 : values.slice().sort()[Math.floor((values.length - 1) * part)];
}

export const rampOf = (color: MapColor): ((value: number) => Rgb) =>
  color === "height" ? (value) => rampColor(value, terrain) : (value) => rampColor(value).map((part) => 0.72 * part + 40) as Rgb;

export function mapGeometry(map: MapCopy, color: MapColor): BufferGeometry {
  const { positions, normals, triangles } = map.ground;
  const { low, high, value } = scaleOf(map, color);
  const ramp = rampOf(color);
  const colors = new Uint8Array((4 * positions.length) / 3);
  for (let corner = 0; corner < positions.length / 3; ++corner) {
    colors.set(ramp((value(corner) - low) / (high - low)), 4 * corner);
    colors[4 * corner + 3] = 255;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 4, true));
  geometry.setAttribute("color", new BufferAttribute(colors, 4, true));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return geometry;
}

/** Distance between contour lines: about ten of them. */
export function contourOf(map: MapCopy): number {
  const { low, high } = scaleOf(map, "height");
  return [0.25, 0.5, 1, 2, 5, 10, 20, 50].find((step) => (high - low) / step <= 12) ?? 100;
}

/** Colours of the static points, RGBA: lighter with height, so that their shape shows. */
export function obstacleColors({ points: { heights } }: MapCopy, theme: Theme, shown: boolean): Uint8Array {
  const [low, high] = palettes[theme].obstacles;
  const colors = new Uint8Array(4 * heights.length);
  heights.forEach((height, i) => {
    const at = Number.isNaN(height) ? 0 : Math.min(Math.max(height / 6, 0), 1);
    for (let channel = 0; channel < 3; ++channel) colors[4 * i + channel] = low[channel] + (high[channel] - low[channel]) * at;
    colors[4 * i + 3] = shown ? 255 : 0;
  });
  return colors;
}

/** The middle of the ground, and its size in metres along x and y. */
export function extentOf({ positions }: GroundMesh): { center: Position; width: number; height: number } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, index) => {
    low[index % 3] = Math.min(low[index % 3], value);
    high[index % 3] = Math.max(high[index % 3], value);
  });
  const center = low.map((value, axis) => (value + high[axis]) / 2) as Position;
  return { center, width: high[0] - low[0], height: high[1] - low[1] };
}

/** Term and description of a cell. */
export function aboutCell({ ground, origin, scans }: MapCopy, corner: number): [string, string][] {
  const [x, y, z] = ground.positions.subarray(3 * corner, 3 * corner + 3);
  const position = [x + origin[0], y + origin[1]];
  const age = ground.ages[corner];
  const others = ground.contradictions[corner];
  return [
    ["Height", metres(z + origin[2])],
    ["Error", `${metres(ground.deviations[corner])} (expected)`],
    ["Measured", `by ${ground.scans[corner]} of ${scans} scans${others > 0 ? `, ${others} others disagree` : ""}`],
    ["Age", age === 0 ? "measured by the last scan" : `${age} scans`],
    ["Position", `${position.map((value) => value.toFixed(1).replace("-", "−")).join(", ")} m`],
  ];
}
