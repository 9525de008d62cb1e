// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

/** The exports of flagstone.wasm, in web/src/module.cpp. Numbers are addresses, sizes or truth values. */
export interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  flagstone_text_buffer(size: number): number;
  flagstone_text_size(): number;
  flagstone_text(): number;
  flagstone_version(): number;
  flagstone_file_new(size: number): number;
  flagstone_written(): number;
  flagstone_written_size(): number;
  flagstone_scan_read(columns: number): number;
  flagstone_scan_delete(scan: number): void;
  flagstone_scan_size(scan: number): number;
  flagstone_scan_stride(scan: number): number;
  flagstone_scan_rows(scan: number): number;
  flagstone_scan_fields(scan: number): number;
  flagstone_scan_positions(scan: number): number;
  flagstone_method_new(): number;
  flagstone_method_delete(method: number): void;
  flagstone_method_reset(method: number): void;
  flagstone_method_settings(method: number): number;
  flagstone_segment(method: number, scan: number): number;
  flagstone_mount(method: number): number;
  flagstone_labels(method: number): number;
  flagstone_label_count(method: number, code: number): number;
  flagstone_heights(method: number): number;
  flagstone_height_count(method: number): number;
  flagstone_patches(method: number): number;
  flagstone_patch_count(method: number): number;
  flagstone_grid_count(method: number): number;
  flagstone_grid_cell(method: number, index: number): number;
  flagstone_grid_width(method: number, index: number): number;
  flagstone_grid_heights(method: number, index: number): number;
  flagstone_grid_confidences(method: number, index: number): number;
  flagstone_surface_at(method: number, x: number, y: number): number;
  flagstone_write_labels(method: number, semanticKitti: number): number;
  flagstone_write_scan(method: number, scan: number): number;
  flagstone_read_labels(points: number): number;
  flagstone_doctor_new(): number;
  flagstone_doctor_delete(doctor: number): void;
  flagstone_doctor_examine(doctor: number, scan: number): number;
  flagstone_doctor_report(doctor: number): number;
}

/** A running module: its memory, and text to and from it. */
export class Module {
  readonly #encoder = new TextEncoder();
  readonly #decoder = new TextDecoder();

  constructor(readonly exports: Exports) {}

  /** Passes text to the next function that uses it. */
  give(text: string): void {
    const bytes = this.#encoder.encode(text);
    const address = this.check(this.exports.flagstone_text_buffer(bytes.length));
    this.bytes(address, bytes.length).set(bytes);
  }

  /** The text that the last function made. */
  text(): string {
    const { exports } = this;
    return this.#decoder.decode(this.bytes(exports.flagstone_text(), exports.flagstone_text_size()));
  }

  /** The text after a function that makes one. */
  made(succeeded: number): string {
    this.check(succeeded);
    return this.text();
  }

  /** Returns the result of a function, or throws its message if the result is 0. */
  check(result: number): number {
    if (result === 0) throw new Error(this.text());
    return result;
  }

  /** Adds a file for the next function that reads one of this name, and passes the name. */
  giveFile(name: string, content: Uint8Array | ArrayBuffer): void {
    const bytes = content instanceof Uint8Array ? content : new Uint8Array(content);
    this.give(name);
    const address = this.check(this.exports.flagstone_file_new(bytes.length));
    this.bytes(address, bytes.length).set(bytes);
  }

  /** A copy of the file written last. */
  writtenFile(): Uint8Array {
    return this.bytes(this.exports.flagstone_written(), this.exports.flagstone_written_size()).slice();
  }

  bytes(address: number, size: number): Uint8Array {
    return new Uint8Array(this.exports.memory.buffer, address, size);
  }

  floats(address: number, count: number): Float32Array {
    return new Float32Array(this.exports.memory.buffer, address, count);
  }
}

/** A module from an URL, or from bytes or a compiled module that the caller loaded. */
export async function instantiate(source: string | URL | BufferSource | WebAssembly.Module): Promise<Module> {
  const compiled = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytesOf(source));
  const { exports } = await WebAssembly.instantiate(compiled, { wasi_snapshot_preview1: system });
  const module = new Module(exports as unknown as Exports);
  module.exports._initialize();
  return module;
}

async function bytesOf(source: string | URL | BufferSource): Promise<BufferSource> {
  if (typeof source !== "string" && !(source instanceof URL)) return source;
  const url = new URL(source, import.meta.url);
  if (url.protocol === "file:") {
    const files = "node:fs/promises"; // a name that bundlers for browsers do not follow
    const { readFile } = await import(/* @vite-ignore */ files);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: cannot be loaded: HTTP status ${response.status}`);
  return response.arrayBuffer();
}

/**
 * The functions of the system that the C++ library refers to. The module has no files, no environment and no clock that
 * changes a result, so that each function reports that it is not available, like a function of a system without it.
 */
const notAvailable = 52; // ENOSYS
const system = {
  fd_close: () => notAvailable,
  fd_seek: () => notAvailable,
  fd_write: () => notAvailable,
  fd_read: () => notAvailable,
  fd_fdstat_get: () => notAvailable,
  fd_prestat_get: () => 8, // EBADF: no directories
  fd_prestat_dir_name: () => 8,
  environ_get: () => notAvailable,
  environ_sizes_get: () => notAvailable,
  clock_time_get: () => notAvailable,
  poll_oneoff: () => notAvailable,
  sched_yield: () => 0,
  proc_exit: (code: number) => {
    throw new Error(`flagstone.wasm ended with exit code ${code}`);
  },
};
