// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { before, describe, test } from "node:test";

import { labels, load } from "flagstone";

let flagstone;
before(async () => {
  flagstone = await load();
});

/** A level ground 1.73 m below the sensor, with a box on it: x, y, z, intensity. */
function groundAndBox() {
  const points = [];
  for (let x = -20; x <= 20; x += 0.4) {
    for (let y = -20; y <= 20; y += 0.4) points.push(x, y, -1.73, 0.5);
  }
  for (let y = -1; y <= 1; y += 0.1) {
    for (let z = -1.7; z <= 0; z += 0.1) points.push(8, y, z, 0.25);
  }
  return new Float32Array(points);
}

function bytesOf(array) {
  return new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
}

const text = (string) => new TextEncoder().encode(string);
const three = [1, 2, 3, 4, 5, 6, 7, 8, 9];

describe("readers", () => {
  test("a .bin file has x, y, z and intensity", () => {
    const scan = flagstone.read("a.bin", bytesOf(new Float32Array([1, 2, 3, 0.5, 4, 5, 6, 0.25])));
    assert.equal(scan.size, 2);
    assert.deepEqual(
      scan.fields.map((field) => field.name),
      ["x", "y", "z", "intensity"],
    );
    assert.deepEqual([...scan.positions], [1, 2, 3, 4, 5, 6]);
    assert.deepEqual([...scan.values("intensity")], [0.5, 0.25]);
    assert.equal(scan.values("ring"), undefined);
  });

  test("a .pcd.bin file has five floats per point", () => {
    assert.equal(flagstone.read("a.pcd.bin", bytesOf(new Float32Array(15))).size, 3);
  });

  test("columns is the number of floats per point in a .bin file", () => {
    assert.deepEqual([...flagstone.read("a.bin", bytesOf(new Float32Array(three)), { columns: 3 }).positions], three);
  });

  test("a .pcd file is read as text", () => {
    const header = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n";
    const scan = flagstone.read("a.pcd", text(`${header}VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\n`));
    assert.deepEqual([...scan.positions], three);
  });

  test("a .ply file is read as text", () => {
    const header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const scan = flagstone.read("a.ply", text(`${header}end_header\n1 2 3\n4 5 6\n7 8 9\n`));
    assert.deepEqual([...scan.positions], three);
  });

  test("a .npy file of doubles is read", () => {
    const header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }".padEnd(117) + "\n";
    const magic = new Uint8Array([0x93, ...text("NUMPY"), 1, 0, 118, 0]);
    const scan = flagstone.read("a.npy", Buffer.concat([magic, text(header), bytesOf(new Float64Array(three))]));
    assert.deepEqual([...scan.positions], three);
  });

  test("a scan is made of numbers", () => {
    assert.deepEqual([...flagstone.scan(new Float32Array(three)).positions], three);
  });

  test("the content can be an ArrayBuffer", () => {
    assert.equal(flagstone.read("a.bin", new Float32Array(8).buffer).size, 2);
  });

  test("an empty file has no points", () => {
    const scan = flagstone.read("a.bin", new Uint8Array());
    assert.equal(scan.size, 0);
    assert.equal(flagstone.segmenter().segment(scan).labels.length, 0);
  });

  test("labels are read in all formats", () => {
    const scan = flagstone.scan(groundAndBox(), 4);
    const result = flagstone.segmenter().segment(scan);
    const codes = [...result.labels];
    for (const name of ["a.label", "a.npy"]) {
      assert.deepEqual([...flagstone.readLabels(name, result.labelFile(name), scan.size)], codes);
    }
    assert.deepEqual([...flagstone.readLabels("a.bin", new Uint8Array([3, 1]), 2)], [3, 1]);
  });
});

describe("errors are one line and name no option of the command", () => {
  const cases = {
    "an unknown extension": [() => flagstone.read("a.xyz", new Uint8Array(3)), "a.xyz: unknown file extension (expected"],
    "a truncated .bin file": [
      () => flagstone.read("a.bin", new Uint8Array(31)),
      "a.bin: byte 16: 31 bytes are not a whole number of points (expected 4 floats, 16 bytes each;",
    ],
    "a wrong number of columns": [() => flagstone.read("a.bin", new Uint8Array(32), { columns: 2 }), "2 floats per point"],
    "a bad .pcd file": [() => flagstone.read("a.pcd", text("hello\n")), "a.pcd: byte 0: 'hello' is not a PCD header line"],
    "a bad .ply file": [() => flagstone.read("a.ply", text("hello\n")), "a.ply: byte 0: "],
    "a bad .npy file": [() => flagstone.read("a.npy", text("hello\n")), "a.npy: byte 0: "],
    "labels of another scan": [
      () => flagstone.readLabels("a.label", new Uint8Array(8), 3),
      "a.label: byte 8: the file contains 2 labels, but the scan has 3 points",
    ],
    "an unknown method": [() => flagstone.segmenter({ method: "surfac" }), "did you mean 'surface'?"],
    "an unknown setting": [() => flagstone.segmenter({ sensor_heigth: 2 }), "no setting 'sensor_heigth' (did you mean"],
    "a setting of another method": [() => flagstone.segmenter({ distance_margin: 0.2 }), "(method patchwork has it)"],
    "a setting like no other": [() => flagstone.segmenter({ zzzzzzzz: 2 }), "no setting 'zzzzzzzz' (docs/reference/settings.md lists"],
    "an unknown sensor": [() => flagstone.segmenter({ sensor: "os2" }), "no sensor is named 'os2'"],
    "an unknown preset": [() => flagstone.segmenter({ method: "patchwork", preset: "papr" }), "papr"],
    "a value out of range": [
      () => flagstone.segmenter({ point: { margin: 99 } }),
      "surface: point.margin = 99 is out of range (expected 0 to 10 m)",
    ],
    "a value of the wrong type": [() => flagstone.segmenter({ max_range: "far" }), "max_range must be a number, got a string"],
    "null as a value": [() => flagstone.segmenter({ max_range: null }), "max_range: null is not a type of settings"],
    "a height that is not one": [() => flagstone.segmenter({ sensor_height: "high" }), "sensor_height: 'high' is not a height"],
    "a direction that is not one": [() => flagstone.segmenter({ tilt: [0, 1] }), "tilt: "],
    "a method that is not a string": [() => flagstone.segmenter({ method: 3 }), "method must be a string, got 3"],
    "bad TOML": [() => flagstone.segmenter({ config: "a = [" }), "config: line 1, column 6: "],
    "an unknown extension to write": [
      () => flagstone.segmenter().segment(flagstone.scan(new Float32Array(3))).scanFile("a.xyz"),
      "a.xyz: unknown file extension",
    ],
  };
  for (const [name, [work, expected]] of Object.entries(cases)) {
    test(name, () => {
      assert.throws(work, (error) => {
        assert.ok(error instanceof Error);
        assert.ok(error.message.includes(expected), error.message);
        assert.ok(!error.message.includes("\n"), error.message);
        assert.doesNotMatch(error.message, /--[a-z]/);
        return true;
      });
    });
  }

  test("a module that cannot be loaded is an error", async () => {
    await assert.rejects(load(new Uint8Array([1, 2, 3])), Error);
    await assert.rejects(load(new URL("./missing.wasm", import.meta.url)), Error);
  });
});

describe("results", () => {
  test("the ground is ground and the box is not", () => {
    const scan = flagstone.scan(groundAndBox(), 4);
    const result = flagstone.segmenter().segment(scan);
    const total = labels.map((label) => result.count(label)).reduce((sum, count) => sum + count, 0);
    assert.equal(total, scan.size);
    const { positions } = scan;
    const heights = result.heights.slice();
    result.labels.forEach((code, i) => {
      const z = positions[3 * i + 2];
      if (z > -1.2) assert.equal(labels[code], "nonground");
      if (z < -1.72) assert.equal(labels[code], "ground");
      assert.ok(Math.abs(heights[i] - (z + 1.73)) < 0.02);
    });
  });

  test("the surface has a height, a normal and grids", () => {
    const { surface } = flagstone.segmenter().segment(flagstone.scan(groundAndBox(), 4));
    assert.ok(Math.abs(surface.height(3, 4) + 1.73) < 0.01);
    const sample = surface.at(3, 4);
    assert.ok(sample.normal[2] > 0.999 && sample.slope < 0.02 && sample.confidence > 0.5);
    assert.ok(Number.isNaN(surface.height(1e6, 0)));
    for (const grid of surface.grids) assert.equal(grid.heights.length, grid.width ** 2);
  });

  test("patches have a plane and a reason", () => {
    const { patches } = flagstone.segmenter().segment(flagstone.scan(groundAndBox(), 4));
    const ground = patches.filter((patch) => patch.verdict === "ground");
    assert.ok(ground.length > 50);
    for (const patch of ground) {
      assert.ok(Math.abs(patch.mean[2] + 1.73) < 0.02 && patch.normal[2] > 0.99, JSON.stringify(patch));
    }
  });

  test("a view stays correct after the memory grows", () => {
    const scan = flagstone.scan(groundAndBox(), 4);
    const segmenter = flagstone.segmenter();
    const before = segmenter.segment(scan).labels.slice();
    const result = segmenter.segment(scan);
    flagstone.scan(new Float32Array(3 * 4_000_000)).delete();
    assert.deepEqual(result.labels, before);
  });

  test("patchwork has no heights and no surface", () => {
    const result = flagstone.segmenter({ method: "patchwork" }).segment(flagstone.scan(groundAndBox(), 4));
    assert.equal(result.heights.length, 0);
    assert.equal(result.surface.grids.length, 0);
    assert.ok(Number.isNaN(result.surface.height(0, 0)));
  });

  test("settings come from options and from TOML, and options win", () => {
    const config = "sensor_height = 2.5\n[point]\nmargin = 0.3\n";
    const { settings } = flagstone.segmenter({ config, point: { margin: 0.25 } });
    assert.equal(settings.sensor_height, 2.5);
    assert.equal(settings.point.margin, 0.25);
    assert.equal(flagstone.segmenter({ sensor: "vlp-16" }).settings.max_range, 100);
  });

  test("the height of the sensor is estimated", () => {
    const points = groundAndBox();
    for (let i = 2; i < points.length; i += 4) points[i] += 0.73;
    const result = flagstone.segmenter({ sensor_height: "estimate" }).segment(flagstone.scan(points, 4));
    assert.ok(result.mount.accepted, result.mount.decision);
    assert.ok(Math.abs(result.mount.sensor_height - 1) < 0.02);
  });

  test("the labelled scan can be written and read", () => {
    const scan = flagstone.scan(groundAndBox(), 4);
    const result = flagstone.segmenter().segment(scan);
    for (const name of ["a.pcd", "a.ply", "a.npy"]) {
      const read = flagstone.read(name, result.scanFile(name));
      assert.deepEqual([...read.values("label")], [...result.labels]);
      assert.deepEqual(new Float32Array(read.values("height")), result.heights);
    }
    const kitti = new Uint32Array(result.labelFile("a.label", "semantic-kitti").buffer);
    kitti.forEach((code, i) => assert.equal(code, labels[result.labels[i]] === "ground" ? 40 : 0));
  });

  test("doctor finds that a scan is in millimetres", () => {
    const points = groundAndBox();
    for (let i = 0; i < points.length; ++i) if (i % 4 !== 3) points[i] *= 1000;
    const report = flagstone.doctor(flagstone.scan(points, 4));
    const units = report.findings.find((finding) => finding.severity === "fix");
    assert.match(units.sentence, /millimetres/);
    assert.match(report.toml, /scale = 0\.001/);
    assert.ok(flagstone.segmenter({ config: report.toml }).settings.mount.scale < 0.002);
  });
});

test("the snippet in the docs runs", async (t) => {
  const page = readFileSync(new URL("../../docs/how-to/use-in-the-browser.md", import.meta.url), "utf8");
  const snippets = [...page.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]);
  assert.ok(snippets.length > 0);
  const file = new URL("./docs_snippet.mjs", import.meta.url);
  t.after(() => rmSync(file, { force: true }));
  writeFileSync(file, `const content = new Float32Array(${JSON.stringify([...groundAndBox()])});\n${snippets.join("\n")}`);
  await import(file);
});
