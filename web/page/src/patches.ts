// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { noPatch, type Mount, type Patch } from "./messages";

/** Metres, origin at the sensor, z up: see the C++ struct `Mount`. */
export function levelFrame({ up, origin, scale }: Mount): (x: number, y: number, z: number) => [number, number, number] {
  const length = Math.hypot(...up);
  const [ux, uy, uz] = up.map((part) => part / length) as [number, number, number];
  const k = uz < -0.999999 ? 0 : 1 / (1 + uz);
  const upsideDown = uz < -0.999999;
  return (x, y, z) => {
    const px = x * scale - origin[0];
    const py = y * scale - origin[1];
    const pz = z * scale - origin[2];
    if (upsideDown) return [px, -py, -pz];
    return [
      (1 - ux * ux * k) * px - ux * uy * k * py - ux * pz,
      -ux * uy * k * px + (1 - uy * uy * k) * py - uy * pz,
      ux * px + uy * py + uz * pz,
    ];
  };
}

interface Zone {
  ring_radii: number[];
  sectors: number;
}

const key = (zone: number, ring: number, sector: number) => (zone * 4096 + ring) * 4096 + sector;

/** The bin of a position, in the numbers of a `Patch`. */
type Bin = (x: number, y: number) => number | undefined;

/** The bins of `surface`: squares of 8 m, or of 4 m near the sensor. */
function squareBins(patches: Map<number, number>, settings: Record<string, unknown>): Bin {
  const extent = Math.ceil((settings.max_range as number) / 8) * 8;
  return (x, y) => {
    const near = patches.get(key(0, Math.floor((y + extent) / 4), Math.floor((x + extent) / 4)));
    return near ?? patches.get(key(1, Math.floor((y + extent) / 8), Math.floor((x + extent) / 8)));
  };
}

/** The bins of `patchwork`: rings and sectors of zones. */
function polarBins(patches: Map<number, number>, settings: Record<string, unknown>): Bin {
  const zones = settings.zones as Zone[];
  const { begin, width } = settings.field_of_view as { begin: number; width: number };
  const minimum = settings.min_range as number;
  return (x, y) => {
    const range = Math.hypot(x, y);
    if (range < minimum) return undefined;
    const zone = zones.findIndex(({ ring_radii }) => range < ring_radii[ring_radii.length - 1]);
    if (zone < 0) return undefined;
    const { ring_radii, sectors } = zones[zone];
    const ring = ring_radii.findIndex((radius) => range < radius);
    const degrees = (((Math.atan2(y, x) * 180) / Math.PI - begin) % 360 + 360) % 360;
    return patches.get(key(zone, ring, Math.min(Math.floor((degrees / width) * sectors), sectors - 1)));
  };
}

/** Index of the patch of each point, `noPatch` if it has none. */
export function patchOfPoints(
  positions: Float32Array,
  patches: Patch[],
  mount: Mount,
  settings: Record<string, unknown>,
): Uint16Array {
  const result = new Uint16Array(positions.length / 3).fill(noPatch);
  if (patches.length === 0) return result;
  const indices = new Map(patches.map(({ zone, ring, sector }, index) => [key(zone, ring, sector), index]));
  const bin = settings.zones === undefined ? squareBins(indices, settings) : polarBins(indices, settings);
  const level = levelFrame(mount);
  // Most scans are level.
  if (mount.up[0] === 0 && mount.up[1] === 0 && mount.up[2] > 0) {
    const { origin, scale } = mount;
    for (let i = 0; i < result.length; ++i) {
      result[i] = bin(positions[3 * i] * scale - origin[0], positions[3 * i + 1] * scale - origin[1]) ?? noPatch;
    }
    return result;
  }
  for (let i = 0; i < result.length; ++i) {
    const [x, y] = level(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    result[i] = bin(x, y) ?? noPatch;
  }
  return result;
}
