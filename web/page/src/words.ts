// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// What the page says about a point.
import { labels, noPatch, type Points, type Result, type Verdict } from "./messages";
import { valueOf } from "./settings";

export const labelTitles = ["non-ground", "ground", "noise", "out of range", "invalid"];

export const verdictTitles: Record<Verdict, string> = {
  ground: "ground",
  ground_flat: "ground, flat",
  too_few_points: "too few points",
  no_plane: "no plane",
  not_upright: "not upright",
  too_high: "too high",
  mixed: "mixed",
  off_surface: "off the surface",
};

const verdictSentences: Record<Verdict, string> = {
  ground: "The patch passed every test.",
  ground_flat: "The patch is high, but flat enough for ground.",
  too_few_points: "The patch has too few points for a plane.",
  no_plane: "Fewer than three points remained for the plane of the patch.",
  not_upright: "The plane of the patch is too steep for ground, as on a wall or a hedge.",
  too_high: "The patch is higher than ground can be at this range.",
  mixed: "Too many points are just above the plane of the patch, as at a wall or a bush.",
  off_surface: "The patch is too far from the height that its neighbours predict.",
};

export const metres = (value: number, digits = 2) =>
  Number.isNaN(value) ? "unknown" : `${value.toFixed(digits).replace("-", "−")} m`;

/** Term and description, in the order of the list. */
export function aboutPoint(points: Points, result: Result, heights: Float32Array, index: number): [string, string][] {
  const { scale } = result.mount;
  const [x, y, z] = points.positions.subarray(3 * index, 3 * index + 3).map((value) => value * scale);
  const patch = result.patches[result.patchOf[index]];
  const rows: [string, string][] = [
    ["Label", labelTitles[result.labels[index]]],
    ["Height", `${metres(heights[index])} above the ${result.heights.length > 0 ? "surface" : "base of the sensor"}`],
    ["Reason", reason(result, index)],
  ];
  if (patch !== undefined) {
    rows.push(["Patch", `${verdictTitles[patch.verdict]}, ${patch.point_count} points`]);
    if (result.settings.zones === undefined) rows.push(["", verdictSentences[patch.verdict]]);
  }
  rows.push(["Position", `${[x, y, z].map((value) => value.toFixed(2).replace("-", "−")).join(", ")} m`]);
  rows.push(["Range", metres(Math.hypot(x, y))]);
  return rows;
}

function reason(result: Result, index: number): string {
  const label = labels[result.labels[index]];
  const setting = (name: string, unit = "m") => `${+(valueOf(result.settings, name) ?? NaN).toFixed(3)} ${unit}`;
  if (label === "invalid") return "A coordinate is not finite, or the return is missing (0, 0, 0).";
  const patch = result.patches[result.patchOf[index]];
  if (result.settings.zones === undefined) {
    if (label === "out_of_range") return `The point is farther away than the maximum range, ${setting("max_range")}.`;
    if (label === "noise") return "The point is too far below the surface, and not on a separate plane.";
    const limits = `${setting("point.margin")}, or ${setting("point.obstacle_margin")} at obstacles`;
    if (label === "ground") return `The point is within the margin of the surface: ${limits}.`;
    return `The point is above the margin of the surface: ${limits}.`;
  }
  if (label === "out_of_range") return "The point is outside the zones.";
  if (label === "noise") return "The point is too far below the plane of its patch.";
  if (result.patchOf[index] === noPatch || patch === undefined) return "The point is in no patch.";
  if (label === "ground") return `The point is within ${setting("distance_margin")} of the plane of a ground patch.`;
  if (patch.verdict === "ground" || patch.verdict === "ground_flat") {
    return `The point is more than ${setting("distance_margin")} above the plane of its patch.`;
  }
  return verdictSentences[patch.verdict];
}
