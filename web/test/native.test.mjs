// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The module gives the same bytes as the native build: labels, heights, patches and surface, and the report of `doctor`.
// Prints a table with the CPU times of both. FLAGSTONE_COMMAND is the command, FLAGSTONE_NATIVE_RESULTS the program of
// tests/web/native_results.cpp, FLAGSTONE_DATA a directory of real scans. FLAGSTONE_SCANS=all tests all of them, and every
// scene; otherwise a few.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";

import { load } from "flagstone";

const command = process.env.FLAGSTONE_COMMAND;
const program = process.env.FLAGSTONE_NATIVE_RESULTS;
const data = process.env.FLAGSTONE_DATA;
const all = process.env.FLAGSTONE_SCANS === "all";
const missing = command && program ? false : "FLAGSTONE_COMMAND and FLAGSTONE_NATIVE_RESULTS are not set";

/** scene, sensor, further options */
const simulated = [
  ["flat_street", "hdl-64e"],
  ["park", "vlp-16"],
  ["tunnel", "livox-avia"],
  ["steep_street", "os1-64", "--noise", "harsh", "--weather", "rain,wet"],
];
const moreScenes = ["parked_cars", "bushes_and_lawn", "bumpy_field", "steps", "forest_track", "ploughed_field"].concat(
  ["embankment", "construction_site", "urban_street", "highway", "drops", "crossroads", "ramp", "indoor_hall"],
);
const sensors = ["hdl-64e", "hdl-32e", "vlp-16", "pandar64", "os0-128", "os1-64", "livox-avia", "at128"];
if (all) simulated.push(...moreScenes.map((scene, i) => [scene, sensors[i % sensors.length]]));

// During the first scans, memory is allocated and the JavaScript engine optimises the module.
const warmUp = all ? 10 : 1;
const repeats = all ? 9 : 3;

let flagstone;
let native;
let directory;
/** Number of points, method and times of each scan, by group of scans. */
const table = new Map();

before(async () => {
  flagstone = await load();
  directory = mkdtempSync(path.join(tmpdir(), "flagstone-web-"));
  if (!missing) native = new Native(program);
});

after(() => {
  native?.end();
  console.log("| scans | number | points | method | native, ms | WebAssembly, ms | ratio |");
  for (const [group, rows] of table) {
    for (const method of ["surface", "patchwork"]) {
      const of = (key) => median(rows.filter((row) => row.method === method).map((row) => row[key]));
      const [other, wasm] = [of("native"), of("wasm")];
      console.log(
        `| ${group} | ${rows.length / 2} | ${of("points")} | ${method} | ${other.toFixed(2)} | ${wasm.toFixed(2)} | ${(wasm / other).toFixed(1)} |`,
      );
    }
  }
  rmSync(directory, { recursive: true, force: true });
});

/** The native library, as a process that answers requests. */
class Native {
  #child;
  #bytes = Buffer.alloc(0);
  #arrived = () => {};

  constructor(file) {
    this.#child = spawn(file, { stdio: ["pipe", "pipe", "inherit"] });
    this.#child.stdout.on("data", (bytes) => {
      this.#bytes = Buffer.concat([this.#bytes, bytes]);
      this.#arrived();
    });
    this.#child.on("exit", () => this.#arrived());
  }

  async #take(size) {
    while (this.#bytes.length < size) {
      assert.equal(this.#child.exitCode, null, "the native program ended");
      await new Promise((resolve) => (this.#arrived = resolve));
    }
    const taken = this.#bytes.subarray(0, size);
    this.#bytes = this.#bytes.subarray(size);
    return taken;
  }

  async segment(method, file) {
    this.#child.stdin.write(`${method} ${file}\n`);
    const head = await this.#take(12);
    const milliseconds = head.readDoubleLE(0);
    return { milliseconds, bytes: await this.#take(head.readUInt32LE(8)) };
  }

  end() {
    this.#child.stdin.end();
  }
}

/** The parts of a result, in the order of the native program. */
function partsOf(result) {
  const parts = { labels: result.labels, heights: result.heights, patches: result.patchBytes };
  result.surface.grids.forEach((grid, i) => {
    parts[`cell of grid ${i}`] = new Float32Array([grid.cell]);
    parts[`width of grid ${i}`] = new Uint32Array([grid.width]);
    parts[`heights of grid ${i}`] = grid.heights;
    parts[`confidences of grid ${i}`] = grid.confidences;
  });
  return Object.entries(parts).map(([name, array]) => [
    name,
    Buffer.from(array.buffer, array.byteOffset, array.byteLength),
  ]);
}

function median(numbers) {
  return [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
}

/** CPU time of this process in milliseconds. Other programs do not change it, in contrast to the time of a clock. */
function cpuTime() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
}

/** Compares every part of the result, and times both builds alternately. */
async function compare(file, group) {
  const scan = flagstone.read(file, readFileSync(file));
  for (const method of ["surface", "patchwork"]) {
    const segmenter = flagstone.segmenter({ method });
    const times = { wasm: [], native: [] };
    for (let repeat = 0; repeat < repeats + warmUp; ++repeat) {
      const start = cpuTime();
      const result = segmenter.segment(scan);
      const milliseconds = cpuTime() - start;
      const { milliseconds: nativeMilliseconds, bytes } = await native.segment(method, file);
      if (repeat >= warmUp) {
        times.wasm.push(milliseconds);
        times.native.push(nativeMilliseconds);
      }
      if (repeat > 0) continue;
      let offset = 0;
      for (const [name, part] of partsOf(result)) {
        const expected = bytes.subarray(offset, offset + part.length);
        assert.ok(part.equals(expected), `${file}: ${method}: ${name}: ${firstDifference(part, expected)}`);
        offset += part.length;
      }
      assert.equal(offset, bytes.length, `${file}: ${method}: size of the result`);
    }
    if (!table.has(group)) table.set(group, []);
    table.get(group).push({ points: scan.size, method, native: median(times.native), wasm: median(times.wasm) });
    segmenter.delete();
  }
  scan.delete();
}

function firstDifference(ours, theirs) {
  const at = ours.findIndex((byte, i) => byte !== theirs[i]);
  return `byte ${at} of ${ours.length} differs`;
}

function simulate([scene, sensor, ...options]) {
  const output = path.join(directory, `${scene}-${sensor}`);
  execFileSync(command, ["simulate", "--scene", scene, "--sensor", sensor, "--frames", "1", ...options, "-o", output], {
    stdio: "ignore",
  });
  return path.join(output, "sequences", "00", "velodyne", "000000.bin");
}

function realScans() {
  const files = [];
  const add = (folder) => {
    for (const name of readdirSync(folder).sort()) {
      const file = path.join(folder, name);
      if (statSync(file).isDirectory()) add(file);
      else if (/\.(bin|pcd|ply|npy)$/.test(name) && !name.endsWith("_lidarseg.bin")) files.push(file);
    }
  };
  add(data);
  return all ? files : files.filter((_, i) => i % 10 === 0);
}

for (const options of simulated) {
  test(`a simulated scan gives the same bytes: ${options.join(" ")}`, { skip: missing }, async () => {
    await compare(simulate(options), "simulated");
  });
}

const withoutData = data && existsSync(data) ? missing : "FLAGSTONE_DATA is not set";
test("real scans give the same bytes", { skip: withoutData }, async () => {
  for (const file of realScans()) await compare(file, path.relative(data, file).split(path.sep)[0]);
});

test("doctor gives the same report", { skip: missing }, () => {
  const files = [simulate(simulated[0])];
  if (!withoutData) files.push(...realScans());
  for (const file of files) {
    const report = flagstone.doctor(flagstone.read(file, readFileSync(file)));
    let printed;
    try {
      printed = execFileSync(command, ["doctor", "--json", file], { encoding: "utf8" });
    } catch (error) {
      printed = error.stdout; // exit code 1: there is something to fix
    }
    assertSameReport(report, JSON.parse(printed), file);
  }
});

/** The words are equal. Numbers can differ in the last digits, because the C libraries have different atan2() and log(). */
function assertSameReport(ours, theirs, file) {
  const words = (report) => ({ ...report, findings: report.findings.map((finding) => ({ ...finding, values: null })) });
  assert.deepEqual(words(ours), words(theirs), file);
  ours.findings.forEach(({ id, values }, i) => {
    const expected = theirs.findings[i].values;
    assert.deepEqual(Object.keys(values), Object.keys(expected), `${file}: ${id}`);
    for (const [name, value] of Object.entries(values)) {
      const tolerance = 1e-9 * Math.max(1, Math.abs(expected[name]));
      assert.ok(Math.abs(value - expected[name]) <= tolerance, `${file}: ${id}: ${name}: ${value}, ${expected[name]}`);
    }
  });
}
