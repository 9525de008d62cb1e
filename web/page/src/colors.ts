// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { labels, noPatch, type Result, type Verdict } from "./messages";

export type Rgb = [number, number, number];
export type Theme = "light" | "dark";

const rgb = (hex: string): Rgb => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)) as Rgb;

interface Palette {
  background: string;
  grid: string;
  /** In the order of the labels. */
  labels: string[];
  /** Ground in both results, in neither, in the first only, in the second only. */
  difference: string[];
  verdicts: Record<Verdict, string>;
  noPatch: string;
  /** The path of the sensor in a map, and its moving objects. */
  path: string;
  moving: string;
  /** Static points of a map, from low to high. */
  obstacles: readonly [Rgb, Rgb];
}

const verdicts: Record<Verdict, string> = {
  ground: "#009e73",
  ground_flat: "#8cb81f",
  too_few_points: "#767e8a",
  no_plane: "#426ed6",
  not_upright: "#b05cce",
  too_high: "#e25e1e",
  mixed: "#d9488b",
  off_surface: "#c79a00",
};

export const palettes: Record<Theme, Palette> = {
  dark: {
    background: "#101318",
    grid: "#2b333d",
    labels: ["#3ac4e2", "#f6c93a", "#d6689e", "#707985", "#b07be0"],
    difference: ["#9a8440", "#4a5664", "#19c9ad", "#f062b0"],
    verdicts,
    noPatch: "#424b56",
    path: "#5cb3ff",
    moving: "#ff4f4f",
    obstacles: [rgb("#4a6072"), rgb("#d5e2ea")],
  },
  light: {
    background: "#f5f6f7",
    grid: "#d9dde1",
    labels: ["#1484a3", "#d09a00", "#b8397c", "#9aa4ae", "#7d3fb5"],
    difference: ["#d8c48a", "#b9c1ca", "#008f79", "#c81f7f"],
    verdicts,
    noPatch: "#bcc4cc",
    path: "#1c4fa8",
    moving: "#d61f1f",
    obstacles: [rgb("#93a0b5"), rgb("#232a3d")],
  },
};

/** Viridis, at equal distances. */
const viridis = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"].map(rgb);
/** Elevations of a map, as in the image of the command. */
export const terrain = ["#86b398", "#c3d3a4", "#e6e3a8", "#f0cf95", "#d8ad80", "#bf8f6b"].map(rgb);

/** The colour of a number from 0 to 1. */
export function rampColor(value: number, ramp: readonly Rgb[] = viridis): Rgb {
  const at = Math.min(Math.max(value, 0), 1) * (ramp.length - 1);
  const index = Math.min(Math.floor(at), ramp.length - 2);
  const part = at - index;
  return ramp[index].map((low, channel) => low + (ramp[index + 1][channel] - low) * part) as Rgb;
}

/** Heights from the first to the last colour, in metres. */
export const heightRange = [-0.25, 3] as const;

export type ColorMode = "label" | "height" | "patch" | "difference";

/** One colour per point, RGBA. The alpha of hidden points is 0. */
export function pointColors(
  mode: ColorMode,
  result: Result,
  other: Result | undefined,
  heights: Float32Array,
  hidden: ReadonlySet<number>,
  theme: Theme,
): Uint8Array {
  const count = result.labels.length;
  const colors = new Uint8Array(4 * count);
  const palette = palettes[theme];
  const ofLabel = palette.labels.map(rgb);
  const ofDifference = palette.difference.map(rgb);
  const ofPatch = result.patches.map(({ verdict }) => rgb(palette.verdicts[verdict] ?? palette.noPatch));
  const none = rgb(palette.noPatch);
  const ground = labels.indexOf("ground");
  // A table is quicker than the ramp.
  const ofHeight = Array.from({ length: 256 }, (_, index) => rampColor(index / 255));
  const [low, high] = heightRange;
  for (let i = 0; i < count; ++i) {
    let color: Rgb;
    let light = 1;
    switch (mode) {
      case "height": {
        const height = heights[i];
        const at = ((height - low) / (high - low)) * 255;
        color = Number.isNaN(height) ? none : ofHeight[Math.min(Math.max(Math.round(at), 0), 255)];
        break;
      }
      case "patch":
        color = result.patchOf[i] === noPatch ? none : ofPatch[result.patchOf[i]];
        break;
      case "difference": {
        const first = result.labels[i] === ground;
        const second = other !== undefined && other.labels[i] === ground;
        color = ofDifference[first ? (second ? 0 : 2) : second ? 3 : 1];
        break;
      }
      default:
        color = ofLabel[result.labels[i]];
        // Objects get lighter with height, so that their shape shows.
        if (result.labels[i] === 0) light = 0.62 + 0.38 * Math.min(Math.max(heights[i] / 3, 0), 1) || 1;
    }
    colors[4 * i] = color[0] * light;
    colors[4 * i + 1] = color[1] * light;
    colors[4 * i + 2] = color[2] * light;
    colors[4 * i + 3] = hidden.has(result.labels[i]) ? 0 : 255;
  }
  return colors;
}
