// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { instantiate, Module } from "./module.js";

/** The labels, in the order of their codes. */
export const labels = ["nonground", "ground", "noise", "out_of_range", "invalid"] as const;
export type LabelName = (typeof labels)[number];

/** Why a patch is ground or not, in the order of the codes. */
const verdicts = [
  "ground",
  "ground_flat",
  "too_few_points",
  "no_plane",
  "not_upright",
  "too_high",
  "mixed",
  "off_surface",
] as const;
export type Verdict = (typeof verdicts)[number];

/** A number, boolean or string, a list of them, or a table of settings. */
export type Setting = boolean | number | string | Setting[] | { [name: string]: Setting };

/** The method and its settings. The names are the names in Python and in TOML. */
export interface Options {
  /** `surface` (the default), `patchwork`, or a baseline. */
  method?: string;
  /** `default`, `paper` or `reference`; only for `patchwork`. */
  preset?: string;
  /** Name of a known sensor, which sets the height and the range. */
  sensor?: string;
  /** Height of the sensor above the ground in metres, or `estimate` or `track`. */
  sensor_height?: number | "estimate" | "track";
  /** Up direction in the frame of the scan, or `estimate` or `off`. */
  tilt?: [number, number, number] | "estimate" | "off";
  /** Settings as TOML, as `flagstone config` prints them and `doctor` recommends them. */
  config?: string;
  /** Other settings of the method, by name. */
  [name: string]: Setting | undefined;
}

/** A column of a scan. */
export interface Field {
  name: string;
  /** `float32`, `float64`, or an integer type such as `uint8`. */
  type: string;
  /** Numbers per point. */
  count: number;
  /** Offset in a row, in bytes. */
  offset: number;
}

/** The ground at one position. Numbers are NaN if the ground is unknown there. */
export interface GroundSample {
  /** z of the ground in metres, in the frame of the sensor. */
  height: number;
  normal: [number, number, number];
  /** Angle between the normal and the z axis, in radians. */
  slope: number;
  /** Probability that the height is within 10 cm of the ground, 0 to 1. */
  confidence: number;
}

/** A square grid of ground heights around the sensor. */
export interface Grid {
  /** Cell size in metres. */
  cell: number;
  /** Number of cells along a side. */
  width: number;
  /**
   * Heights of the cell centres in metres, NaN if unknown. Row by row, y ascending, x ascending within a row: the centre of
   * cell (row, column) is x = (column + 0.5 - width / 2) * cell, y = (row + 0.5 - width / 2) * cell.
   */
  heights: Float32Array;
  /** Confidence of each height, 0 to 1. */
  confidences: Float32Array;
}

/** A bin of points with the plane fitted to it. See the C++ struct `Patch` for the units. */
export interface Patch {
  zone: number;
  ring: number;
  sector: number;
  verdict: Verdict;
  point_count: number;
  ground_count: number;
  lower_ground_count: number;
  mean: [number, number, number];
  normal: [number, number, number];
  d: number;
  eigenvalues: [number, number, number];
  uprightness: number;
  elevation: number;
  flatness: number;
  likelihood: number;
  surface_variable: number;
}

/** Height and tilt of the sensor. */
export interface Mount {
  /** Metres above the ground. */
  sensor_height: number;
  up: [number, number, number];
  origin: [number, number, number];
  /** Metres per unit of the scan. */
  scale: number;
  /** The decision about the estimate, in one sentence. */
  decision: string;
  /** True if the height or tilt was estimated from the last scan. */
  accepted: boolean;
}

/** A finding of `doctor`. */
export interface Finding {
  id: string;
  severity: "fine" | "note" | "fix";
  /** The observation, in plain words. */
  sentence: string;
  /** What to do; empty if nothing. */
  remedy: string;
  values: Record<string, number>;
}

/** The report of `doctor`, the object that `flagstone doctor --json` prints. */
export interface Report {
  scans: string[];
  method: string;
  fix: number;
  note: number;
  findings: Finding[];
  /** Recommended settings, for `Options.config`; null if there are none. */
  toml: string | null;
}

/**
 * Arrays of scans and results are views of the memory of the module. A view is valid until the next call of any function.
 * Then get it again from its object, or copy it with `slice()` before.
 */
export class Scan {
  /** Internal. */
  readonly address: number;
  readonly #module: Module;

  /** Internal: use `Flagstone.read`. */
  constructor(
    module: Module,
    address: number,
    /** Name of the file. */
    readonly name: string,
  ) {
    this.#module = module;
    this.address = address;
  }

  /** Number of points. */
  get size(): number {
    return this.#module.exports.flagstone_scan_size(this.address);
  }

  /** The columns. */
  get fields(): Field[] {
    return JSON.parse(this.#module.made(this.#module.exports.flagstone_scan_fields(this.address)));
  }

  /** The rows: `size` times `stride` bytes, in the order of `fields`, little-endian. */
  get rows(): Uint8Array {
    return this.#module.bytes(this.#module.exports.flagstone_scan_rows(this.address), this.size * this.stride);
  }

  /** Bytes per row. */
  get stride(): number {
    return this.#module.exports.flagstone_scan_stride(this.address);
  }

  /** x, y and z of every point, three numbers per point. */
  get positions(): Float32Array {
    const address = this.#module.check(this.#module.exports.flagstone_scan_positions(this.address));
    return this.#module.floats(address, 3 * this.size);
  }

  /** A copy of a column of single numbers, such as `intensity`. Undefined if the scan does not have it. */
  values(name: string): Float64Array | undefined {
    const field = this.fields.find((candidate) => candidate.name === name);
    const read = field === undefined ? undefined : readers[field.type];
    if (field === undefined || read === undefined) return undefined;
    const { rows, stride, size } = this;
    const view = new DataView(rows.buffer, rows.byteOffset, rows.byteLength);
    const values = new Float64Array(size);
    for (let i = 0; i < size; ++i) values[i] = read(view, i * stride + field.offset);
    return values;
  }

  /** Releases the memory. Do not use the scan afterwards. */
  delete(): void {
    this.#module.exports.flagstone_scan_delete(this.address);
  }
}

const readers: Record<string, (view: DataView, offset: number) => number> = {
  int8: (view, offset) => view.getInt8(offset),
  uint8: (view, offset) => view.getUint8(offset),
  int16: (view, offset) => view.getInt16(offset, true),
  uint16: (view, offset) => view.getUint16(offset, true),
  int32: (view, offset) => view.getInt32(offset, true),
  uint32: (view, offset) => view.getUint32(offset, true),
  int64: (view, offset) => Number(view.getBigInt64(offset, true)),
  uint64: (view, offset) => Number(view.getBigUint64(offset, true)),
  float32: (view, offset) => view.getFloat32(offset, true),
  float64: (view, offset) => view.getFloat64(offset, true),
};

/** The ground as one continuous surface. Empty for methods that do not compute one. */
export class Surface {
  readonly #module: Module;
  readonly #method: number;

  /** Internal: use `Segmentation.surface`. */
  constructor(module: Module, method: number) {
    this.#module = module;
    this.#method = method;
  }

  /** The grids, coarsest and largest first. */
  get grids(): Grid[] {
    const { exports } = this.#module;
    return Array.from({ length: exports.flagstone_grid_count(this.#method) }, (_, index) => {
      const width = exports.flagstone_grid_width(this.#method, index);
      return {
        cell: exports.flagstone_grid_cell(this.#method, index),
        width,
        heights: this.#module.floats(exports.flagstone_grid_heights(this.#method, index), width * width),
        confidences: this.#module.floats(exports.flagstone_grid_confidences(this.#method, index), width * width),
      };
    });
  }

  /** The ground at (x, y), in metres. */
  at(x: number, y: number): GroundSample {
    const address = this.#module.exports.flagstone_surface_at(this.#method, x, y);
    const [height, nx, ny, nz, slope, confidence] = this.#module.floats(address, 6) as unknown as Six;
    return { height, normal: [nx, ny, nz], slope, confidence };
  }

  /** z of the ground at (x, y); NaN if unknown. */
  height(x: number, y: number): number {
    return this.at(x, y).height;
  }
}

type Six = [number, number, number, number, number, number];

/** The result of one scan. It belongs to its segmenter and is replaced by the next scan. */
export class Segmentation {
  readonly #module: Module;
  readonly #method: number;

  /** Internal: use `Segmenter.segment`. */
  constructor(
    module: Module,
    method: number,
    /** The scan. */
    readonly scan: Scan,
  ) {
    this.#module = module;
    this.#method = method;
  }

  /** The label of each point: an index into `labels`. */
  get labels(): Uint8Array {
    return this.#module.bytes(this.#module.exports.flagstone_labels(this.#method), this.scan.size);
  }

  /** Number of points with a label. */
  count(label: LabelName): number {
    return this.#module.exports.flagstone_label_count(this.#method, labels.indexOf(label));
  }

  /** Height of each point above the ground in metres, NaN if unknown. Empty for methods without a surface. */
  get heights(): Float32Array {
    const { exports } = this.#module;
    return this.#module.floats(exports.flagstone_heights(this.#method), exports.flagstone_height_count(this.#method));
  }

  /** The ground as a surface. */
  get surface(): Surface {
    return new Surface(this.#module, this.#method);
  }

  /** The bytes of all patches, in the layout of the C++ struct `Patch`. */
  get patchBytes(): Uint8Array {
    const { exports } = this.#module;
    const count = exports.flagstone_patch_count(this.#method);
    return this.#module.bytes(exports.flagstone_patches(this.#method), count * patchSize);
  }

  /** A copy of the patches. */
  get patches(): Patch[] {
    const bytes = this.patchBytes;
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    return Array.from({ length: bytes.length / patchSize }, (_, index) => patchAt(view, index * patchSize));
  }

  /** The height and tilt of the sensor that were used. */
  get mount(): Mount {
    return JSON.parse(this.#module.made(this.#module.exports.flagstone_mount(this.#method)));
  }

  /** The content of a label file, as `flagstone segment` writes it: `.label` or `.npy`. */
  labelFile(name: string, map: "flagstone" | "semantic-kitti" = "flagstone"): Uint8Array {
    this.#module.give(name);
    this.#module.check(this.#module.exports.flagstone_write_labels(this.#method, Number(map === "semantic-kitti")));
    return this.#module.writtenFile();
  }

  /** The content of a file with the scan, its labels and heights: `.pcd`, `.ply` or `.npy`. */
  scanFile(name: string): Uint8Array {
    this.#module.give(name);
    this.#module.check(this.#module.exports.flagstone_write_scan(this.#method, this.scan.address));
    return this.#module.writtenFile();
  }
}

const patchSize = 80;

function patchAt(view: DataView, at: number): Patch {
  const float = (offset: number) => view.getFloat32(at + offset, true);
  const vector = (offset: number): [number, number, number] => [float(offset), float(offset + 4), float(offset + 8)];
  return {
    zone: view.getUint16(at, true),
    ring: view.getUint16(at + 2, true),
    sector: view.getUint16(at + 4, true),
    verdict: verdicts[view.getUint16(at + 6, true)] as Verdict,
    point_count: view.getUint32(at + 8, true),
    ground_count: view.getUint32(at + 12, true),
    lower_ground_count: view.getUint32(at + 16, true),
    mean: vector(20),
    normal: vector(32),
    d: float(44),
    eigenvalues: vector(48),
    uprightness: float(60),
    elevation: float(64),
    flatness: float(68),
    likelihood: float(72),
    surface_variable: float(76),
  };
}

/** A method with its settings. It reuses its memory from scan to scan. */
export class Segmenter {
  readonly #module: Module;
  readonly #address: number;

  /** Internal: use `Flagstone.segmenter`. */
  constructor(module: Module, options: Options) {
    this.#module = module;
    module.give(JSON.stringify(options));
    this.#address = module.check(module.exports.flagstone_method_new());
  }

  /** All settings with their values, in the tables that `flagstone config` prints. */
  get settings(): { [name: string]: Setting } {
    return JSON.parse(this.#module.made(this.#module.exports.flagstone_method_settings(this.#address)));
  }

  /** Labels every point of a scan. The result is replaced by the next call. */
  segment(scan: Scan): Segmentation {
    this.#module.check(this.#module.exports.flagstone_segment(this.#address, scan.address));
    return new Segmentation(this.#module, this.#address, scan);
  }

  /** Discards the estimated height and tilt, the only state that a segmenter keeps between scans. */
  reset(): void {
    this.#module.exports.flagstone_method_reset(this.#address);
  }

  /** Releases the memory. Do not use the segmenter and its result afterwards. */
  delete(): void {
    this.#module.exports.flagstone_method_delete(this.#address);
  }
}

/** The library. Create it with `load`. */
export class Flagstone {
  readonly #module: Module;

  /** Internal: use `load`. */
  constructor(module: Module) {
    this.#module = module;
  }

  /** Version of flagstone. */
  get version(): string {
    return this.#module.made(this.#module.exports.flagstone_version());
  }

  /**
   * Reads a scan from the content of a `.bin`, `.pcd.bin`, `.pcd`, `.ply` or `.npy` file. The name determines the format.
   * `columns` is the number of floats per point in `.bin` files (default: 5 for `.pcd.bin`, otherwise 4).
   */
  read(name: string, content: Uint8Array | ArrayBuffer, { columns = 0 } = {}): Scan {
    this.#module.giveFile(name, content);
    return new Scan(this.#module, this.#module.check(this.#module.exports.flagstone_scan_read(columns)), name);
  }

  /** Makes a scan of numbers: `columns` per point, x, y and z first. */
  scan(points: Float32Array, columns = 3): Scan {
    return this.read("points.bin", new Uint8Array(points.buffer, points.byteOffset, points.byteLength), { columns });
  }

  /** A segmenter for several scans. */
  segmenter(options: Options = {}): Segmenter {
    return new Segmenter(this.#module, options);
  }

  /** Examines one or more scans of a sensor, and compares them with the settings. */
  doctor(scans: Scan | Scan[], options: Options = {}): Report {
    const { exports } = this.#module;
    this.#module.give(JSON.stringify(options));
    const doctor = this.#module.check(exports.flagstone_doctor_new());
    try {
      for (const scan of Array.isArray(scans) ? scans : [scans]) {
        this.#module.give(scan.name);
        this.#module.check(exports.flagstone_doctor_examine(doctor, scan.address));
      }
      return JSON.parse(this.#module.made(exports.flagstone_doctor_report(doctor)));
    } finally {
      exports.flagstone_doctor_delete(doctor);
    }
  }

  /**
   * Reads one class per point from the content of a label file: `.label` (SemanticKITTI), `.bin` (nuScenes-lidarseg) or
   * `.npy`. `points` is the number of points of the scan.
   */
  readLabels(name: string, content: Uint8Array | ArrayBuffer, points: number): Uint32Array {
    this.#module.giveFile(name, content);
    this.#module.check(this.#module.exports.flagstone_read_labels(points));
    return new Uint32Array(this.#module.writtenFile().buffer);
  }
}

/**
 * Loads the WebAssembly module. By default it is `flagstone.wasm` next to this file; `source` can be its URL, its bytes or
 * the compiled module.
 */
export async function load(
  source: string | URL | BufferSource | WebAssembly.Module = new URL("./flagstone.wasm", import.meta.url),
): Promise<Flagstone> {
  return new Flagstone(await instantiate(source));
}
