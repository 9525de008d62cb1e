// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// The only file that calls the flagstone module. It copies what the page keeps, because the arrays of the module are
// valid until its next call.
import { load, type Flagstone, type Options, type Scan, type Segmentation, type Segmenter } from "flagstone";
import { readMap } from "./map";
import type { Files } from "./map_files";
import { labels, type MapCopy, type Points, type Report, type Result } from "./messages";
import { patchOfPoints } from "./patches";

/** One scan at a time, with a method that is reused as long as its options do not change. */
export class Session {
  #module: Flagstone;
  #scan: Scan | undefined;
  #method: { key: string; segmenter: Segmenter } | undefined;
  #last: Segmentation | undefined;

  private constructor(module: Flagstone) {
    this.#module = module;
  }

  static async start(): Promise<Session> {
    return new Session(await load());
  }

  /** `columns` is the number of floats per point in `.bin` files, 0 to choose by file extension. */
  open(name: string, content: ArrayBuffer, columns: number): Points {
    const scan = this.#module.read(name, content, { columns });
    this.#scan?.delete();
    this.#scan = scan;
    this.#last = undefined;
    return { name, size: scan.size, positions: scan.positions.slice(), fields: scan.fields };
  }

  map(name: string, files: Files): Promise<MapCopy> {
    return readMap(name, files, this.#module);
  }

  segment(options: Options): Result {
    const key = JSON.stringify(options);
    if (this.#method?.key !== key) {
      const segmenter = this.#module.segmenter(options);
      this.#method?.segmenter.delete();
      this.#method = { key, segmenter };
    }
    this.#last = undefined;
    this.#method.segmenter.reset(); // the height and tilt are those of this scan, not of the scans before
    const start = performance.now();
    this.#last = this.#method.segmenter.segment(this.#opened());
    return copied(this.#last, this.#method.segmenter, performance.now() - start);
  }

  /** Segments with other options and keeps the result of `segment`. */
  compare(options: Options): Result {
    const segmenter = this.#module.segmenter(options);
    try {
      const start = performance.now();
      const result = segmenter.segment(this.#opened());
      return copied(result, segmenter, performance.now() - start);
    } finally {
      segmenter.delete();
    }
  }

  doctor(options: Options): Report {
    return this.#module.doctor(this.#opened(), options);
  }

  /** The content of a file: labels for `.label` and `.npy`, otherwise the scan with its labels and heights. */
  save(name: string, map: "flagstone" | "semantic-kitti"): Uint8Array {
    if (this.#last === undefined) throw new Error(`${name}: the scan has no labels yet (open a scan first)`);
    const content = /\.(label|npy)$/.test(name) ? this.#last.labelFile(name, map) : this.#last.scanFile(name);
    return content.slice();
  }

  #opened(): Scan {
    if (this.#scan === undefined) throw new Error("no scan is open (open a scan first)");
    return this.#scan;
  }
}

function copied(result: Segmentation, segmenter: Segmenter, milliseconds: number): Result {
  const { patches, mount } = result;
  const settings = segmenter.settings as Record<string, unknown>;
  const positions = result.scan.positions;
  return {
    labels: result.labels.slice(),
    counts: labels.map((label) => result.count(label)),
    heights: result.heights.slice(),
    patches,
    patchOf: patchOfPoints(positions, patches, mount, settings),
    grids: result.surface.grids.map((grid) => ({
      ...grid,
      heights: grid.heights.slice(),
      confidences: grid.confidences.slice(),
    })),
    mount,
    settings,
    milliseconds,
  };
}
