// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { BufferAttribute, BufferGeometry } from "three";
import { rampColor } from "./colors";
import { levelFrame } from "./patches";
import type { GridCopy, Mount } from "./messages";

/** The ground as triangles, in the frame of the scan. Where grids overlap, the finest one is used. */
export function surfaceMesh(grids: GridCopy[], mount: Mount): BufferGeometry {
  const corners: number[] = [];
  const triangles: number[] = [];
  grids.forEach((grid, level) => addGrid(grid, grids[level + 1], corners, triangles));

  const heights = corners.filter((_, index) => index % 3 === 2).sort((a, b) => a - b);
  const low = heights[Math.floor(heights.length * 0.02)] ?? 0;
  const high = heights[Math.floor(heights.length * 0.98)] ?? 1;
  const colors = new Uint8Array(corners.length);
  for (let i = 0; i < corners.length; i += 3) {
    const at = (corners[i + 2] - low) / Math.max(high - low, 0.5);
    colors.set(rampColor(0.2 + 0.65 * at).map((part) => Math.round(part * 0.5 + 70)), i);
  }

  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(inScanFrame(corners, mount), 3));
  geometry.setAttribute("color", new BufferAttribute(colors, 3, true));
  geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
  geometry.computeVertexNormals();
  // Light shows gentle slopes: they are shaded as if they were three times as steep.
  const normals = geometry.getAttribute("normal");
  for (let i = 0; i < normals.count; ++i) {
    const [x, y, z] = [3 * normals.getX(i), 3 * normals.getY(i), normals.getZ(i)];
    const length = Math.hypot(x, y, z);
    normals.setXYZ(i, x / length, y / length, z / length);
  }
  return geometry;
}

function addGrid(grid: GridCopy, finer: GridCopy | undefined, corners: number[], triangles: number[]): void {
  const { cell, width, heights } = grid;
  const center = (index: number) => (index + 0.5 - width / 2) * cell;
  const numbers = new Int32Array(width * width).fill(-1);
  const corner = (row: number, column: number) => {
    const at = row * width + column;
    if (numbers[at] < 0) {
      numbers[at] = corners.length / 3;
      corners.push(center(column), center(row), heights[at]);
    }
    return numbers[at];
  };
  for (let row = 0; row + 1 < width; ++row) {
    for (let column = 0; column + 1 < width; ++column) {
      const at = row * width + column;
      const known = [at, at + 1, at + width, at + width + 1].every((index) => !Number.isNaN(heights[index]));
      if (!known || isRefined(finer, center(column), center(row), cell)) continue;
      const [a, b] = [corner(row, column), corner(row, column + 1)];
      const [c, d] = [corner(row + 1, column), corner(row + 1, column + 1)];
      triangles.push(a, b, d, a, d, c);
    }
  }
}

/** True if a finer grid covers the square from (x, y) on. */
function isRefined(finer: GridCopy | undefined, x: number, y: number, size: number): boolean {
  if (finer === undefined) return false;
  const { cell, width, heights } = finer;
  const edge = ((width - 1) / 2) * cell;
  if (x < -edge || y < -edge || x + size > edge || y + size > edge) return false;
  const index = (value: number) => Math.min(Math.max(Math.round(value / cell - 0.5 + width / 2), 0), width - 1);
  return !Number.isNaN(heights[index(y + size / 2) * width + index(x + size / 2)]);
}

function inScanFrame(corners: number[], mount: Mount): Float32Array {
  const level = levelFrame({ ...mount, origin: [0, 0, 0], scale: 1 });
  // The rows of the rotation; its inverse is the transpose.
  const columns = [level(1, 0, 0), level(0, 1, 0), level(0, 0, 1)];
  const positions = new Float32Array(corners.length);
  for (let i = 0; i < corners.length; i += 3) {
    for (let axis = 0; axis < 3; ++axis) {
      const [x, y, z] = columns[axis];
      const turned = x * corners[i] + y * corners[i + 1] + z * corners[i + 2];
      positions[i + axis] = (turned + mount.origin[axis]) / mount.scale;
    }
  }
  return positions;
}
