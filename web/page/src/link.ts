// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { sliders } from "./settings";

/** What a link shares: settings and the view, never data. */
export interface Shared {
  method: "surface" | "patchwork";
  /** `auto` leaves the height to the estimate, or to the settings from the doctor. */
  height: number | "auto";
  /** Changed settings, by their names in TOML. */
  changes: Record<string, number>;
  /** Settings from the doctor, as TOML. */
  config: string;
  color: "label" | "height" | "patch";
  compare: "off" | "difference" | "side";
  surface: boolean;
  points: boolean;
  /** Name of a built-in scan. */
  sample: string;
  camera: number[];
}

export function initial(): Shared {
  return {
    method: "surface",
    height: "auto",
    changes: {},
    config: "",
    color: "label",
    compare: "off",
    surface: false,
    points: true,
    sample: "",
    camera: [],
  };
}

const oneOf = <T extends string>(value: string | null, values: readonly T[], otherwise: T): T =>
  values.find((each) => each === value) ?? otherwise;

export function fromFragment(fragment: string): Shared {
  const entries = new URLSearchParams(fragment.replace(/^#/, ""));
  const shared = initial();
  shared.method = oneOf(entries.get("method"), ["surface", "patchwork"], "surface");
  const height = Number(entries.get("sensor_height") ?? NaN);
  if (Number.isFinite(height)) shared.height = height;
  shared.config = entries.get("config") ?? "";
  shared.color = oneOf(entries.get("color"), ["label", "height", "patch"], "label");
  shared.compare = oneOf(entries.get("compare"), ["off", "difference", "side"], "off");
  shared.surface = entries.get("surface") === "1";
  shared.points = entries.get("points") !== "0";
  shared.sample = entries.get("scan") ?? "";
  const camera = (entries.get("camera") ?? "").split(",").map(Number);
  if (camera.length === 6 && camera.every(Number.isFinite)) shared.camera = camera;
  for (const { name } of sliders[shared.method]) {
    const value = Number(entries.get(name) ?? NaN);
    if (Number.isFinite(value)) shared.changes[name] = value;
  }
  return shared;
}

export function toFragment(shared: Shared): string {
  const start = initial();
  const entries = new URLSearchParams();
  if (shared.sample !== "") entries.set("scan", shared.sample);
  if (shared.method !== start.method) entries.set("method", shared.method);
  if (shared.height !== "auto") entries.set("sensor_height", String(shared.height));
  for (const [name, value] of Object.entries(shared.changes)) entries.set(name, String(value));
  if (shared.config !== "") entries.set("config", shared.config);
  if (shared.color !== start.color) entries.set("color", shared.color);
  if (shared.compare !== start.compare) entries.set("compare", shared.compare);
  if (shared.surface) entries.set("surface", "1");
  if (!shared.points) entries.set("points", "0");
  if (shared.camera.length === 6) entries.set("camera", shared.camera.join(","));
  return `#${entries.toString().replaceAll("%2C", ",")}`;
}
