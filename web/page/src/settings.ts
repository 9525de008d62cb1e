// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

/** A setting with a slider. The library checks the limits; the sliders cover the useful part of them. */
export interface Slider {
  name: string;
  title: string;
  hint: string;
  unit: string;
  low: number;
  high: number;
  step: number;
}

export const sensorHeight: Slider = {
  name: "sensor_height",
  title: "Sensor height",
  hint: "Height of the sensor above the ground",
  unit: "m",
  low: 0,
  high: 5,
  step: 0.01,
};

/** The settings that matter, by method. The names are the names in TOML. */
export const sliders: Record<string, Slider[]> = {
  surface: [
    {
      name: "point.margin",
      title: "Margin",
      hint: "Points lower than this above the surface are ground",
      unit: "m",
      low: 0.02,
      high: 1,
      step: 0.01,
    },
    {
      name: "point.obstacle_margin",
      title: "Margin at obstacles",
      hint: "The margin in cells that contain an obstacle",
      unit: "m",
      low: 0,
      high: 0.5,
      step: 0.01,
    },
    {
      name: "point.noise_depth",
      title: "Noise depth",
      hint: "Points farther than this below the surface are noise",
      unit: "m",
      low: 0.05,
      high: 2,
      step: 0.05,
    },
    {
      name: "acceptance.max_slope",
      title: "Steepest ground",
      hint: "Maximum slope of the ground as seen from below the sensor",
      unit: "m/m",
      low: 0,
      high: 1,
      step: 0.01,
    },
    {
      name: "max_range",
      title: "Maximum range",
      hint: "Points at this horizontal range or beyond are out of range",
      unit: "m",
      low: 8,
      high: 200,
      step: 1,
    },
  ],
  patchwork: [
    {
      name: "distance_margin",
      title: "Margin",
      hint: "Points lower than this above the plane of their patch are ground",
      unit: "m",
      low: 0.01,
      high: 1,
      step: 0.005,
    },
    {
      name: "uprightness.angle",
      title: "Uprightness",
      hint: "Minimum angle between the normal of a ground patch and the horizontal plane",
      unit: "°",
      low: 0,
      high: 89,
      step: 1,
    },
    {
      name: "seed_height",
      title: "Seed height",
      hint: "Points lower than this above the lowest points of a bin start the fit",
      unit: "m",
      low: 0.02,
      high: 2,
      step: 0.02,
    },
    {
      name: "noise_margin",
      title: "Noise margin",
      hint: "Points farther than this below the plane of a ground patch are noise",
      unit: "m",
      low: 0.05,
      high: 2,
      step: 0.05,
    },
  ],
};

/** The value of a setting such as `point.margin`. */
export function valueOf(settings: Record<string, unknown>, name: string): number | undefined {
  const value = name.split(".").reduce<unknown>((table, key) => (table as Record<string, unknown>)?.[key], settings);
  return typeof value === "number" ? value : undefined;
}
