// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Opens the built page in headless Chromium, from a plain file server and under a path.
import assert from "node:assert/strict";
import { once } from "node:events";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, extname, join, normalize } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { fileURLToPath } from "node:url";
import { load, labels } from "flagstone";
import { chromium } from "playwright-core";

const folder = fileURLToPath(new URL("..", import.meta.url));
const screenshots = join(folder, "screenshots");
const sample = (name) => join(folder, "public/samples", name);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const data = process.env.FLAGSTONE_DATA;
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".json": "application/json" };

let server, address, browser, context, page, problems;

before(async () => {
  mkdirSync(screenshots, { recursive: true });
  server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    let file = join(folder, "dist", normalize(path.replace(/^\/any\/path\//, "/")));
    if (path.endsWith("/")) file = join(file, "index.html");
    if (!path.startsWith("/any/path/") || !existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": types[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
  }).listen(0, "127.0.0.1");
  await once(server, "listening");
  address = `http://127.0.0.1:${server.address().port}/any/path/`;
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
});

after(async () => {
  await browser?.close();
  server?.close();
});

beforeEach(async () => {
  await start({});
});

afterEach(async () => {
  await context.close();
  assert.deepEqual(problems, []);
});

async function start({ fragment = "", ...settings }) {
  await context?.close();
  problems = [];
  context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "dark", ...settings });
  page = await context.newPage();
  page.setDefaultTimeout(60_000);
  page.on("console", (message) => {
    // Messages of the software renderer are about its speed.
    if (["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text())) problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1|blob:|data:)/.test(request.url())) problems.push(`request to ${request.url()}`);
  });
  await page.goto(address + fragment);
  await settled();
}

/** Waits until the page has a result and no work left. */
async function settled() {
  await page.waitForFunction(() => !document.body.hasAttribute("aria-busy") && document.querySelector("#scan-facts")?.textContent.includes("segmented"));
}

async function openSample(name) {
  await page.selectOption("#sample", name);
  await page.waitForFunction((start) => document.querySelector("#scan-name").textContent.startsWith(start), `${name}-`);
  await settled();
}

const text = (selector) => page.locator(selector).innerText();

/** Drops files on the page, as a user does. */
async function drop(files) {
  const parts = files.map(({ name, content }) => ({ name, content: Buffer.from(content).toString("base64") }));
  return page.evaluate(async (list) => {
    const transfer = new DataTransfer();
    for (const { name, content } of list) {
      const bytes = await (await new Response(Uint8Array.from(atob(content), (c) => c.charCodeAt(0)))).arrayBuffer();
      transfer.items.add(new File([bytes], name));
    }
    document.body.setAttribute("aria-busy", "true");
    const start = performance.now();
    dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
    return await new Promise((resolve) => {
      const watch = () => {
        if (!document.body.hasAttribute("aria-busy")) requestAnimationFrame(() => resolve(performance.now() - start));
        else setTimeout(watch, 4);
      };
      watch();
    });
  }, parts);
}

async function accessible(when) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => `${when}: ${id}: ${nodes.map(({ html }) => html).join(" ")}`), []);
}

const flagstone = await load(readFileSync(join(folder, "../dist/flagstone.wasm")));

/** A simulated scan in each format that can be written. */
function scanAs(name) {
  const scan = flagstone.read("a.bin", readFileSync(sample("park-000000.bin")));
  const segmenter = flagstone.segmenter({ sensor_height: "estimate" });
  const content = segmenter.segment(scan).scanFile(name).slice();
  segmenter.delete();
  scan.delete();
  return { name, content };
}

test("the first simulated scan is shown with its labels", async () => {
  assert.match(await text("#scan-facts"), /^\d[\d,]+ points, segmented in \d+ ms$/);
  assert.match(await text("#legend"), /^ground\s+\d+\.\d %/);
  await page.waitForFunction(() => document.querySelector("#doctor-fine:not([hidden])"));
  await accessible("start");
  await page.screenshot({ path: join(screenshots, "desktop-dark.png") });
});

test("a dropped scan shows its labels, equal to those of the module in Node", async () => {
  const kitti = data && join(data, "kitti/velodyne/00-000000.bin");
  const path = kitti && existsSync(kitti) ? kitti : sample("street-000000.bin");
  const content = readFileSync(path);
  const milliseconds = await drop([{ name: "dropped.bin", content }]);
  console.log(`${path === kitti ? "KITTI scan 00-000000" : "simulated scan"}: labels ${milliseconds.toFixed(0)} ms after the drop`);
  assert.equal(await text("#scan-name"), "dropped.bin");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  assert.equal(download.suggestedFilename(), "dropped.label");
  const scan = flagstone.read("a.bin", content);
  const expected = flagstone.segmenter({ sensor_height: "estimate" }).segment(scan).labelFile("a.label");
  assert.ok(readFileSync(await download.path()).equals(expected));
  assert.match(await text("#mount"), /^Sensor 1\.7\d m above the ground, confidence/);
  await page.screenshot({ path: join(screenshots, "dropped.png") });
});

for (const name of ["scan.pcd", "scan.ply", "scan.npy"]) {
  test(`a ${name.slice(4)} file is read`, async () => {
    const scan = scanAs(name);
    await drop([scan]);
    assert.equal(await text("#scan-name"), name);
    assert.match(await text("#scan-facts"), /26,249 points/);
    assert.equal(await page.locator(".fault").count(), 0);
  });
}

test("a .pcd.bin file is read", async () => {
  const four = new Float32Array(readFileSync(sample("park-000000.bin")).buffer.slice(0));
  const points = new Float32Array(readFileSync(sample("park-000000.bin")).length / 16 * 5);
  for (let i = 0; i < points.length / 5; ++i) points.set(four.subarray(4 * i, 4 * i + 4), 5 * i);
  await drop([{ name: "sweep.pcd.bin", content: new Uint8Array(points.buffer) }]);
  assert.match(await text("#scan-facts"), /26,249 points/);
});

const broken = [
  ["cut.bin", new Uint8Array(45), /^cut\.bin: .*whole number of points.*\(expected/],
  ["cut.pcd", new TextEncoder().encode("oops"), /^cut\.pcd: byte 0: .*\(expected/],
  ["cut.ply", new TextEncoder().encode("ply\nformat wrong 1.0\n"), /^cut\.ply: .*\(expected/],
  ["cut.npy", new Uint8Array(20), /^cut\.npy: .*\(expected/],
  ["photo.jpg", new Uint8Array(9), /^photo\.jpg: unknown file extension \(expected/],
];

test("each broken file is reported on one line, and the page goes on", async () => {
  for (const [name, content, expected] of broken) {
    await drop([{ name, content }]);
    const message = await text(".fault p");
    assert.match(message, expected);
    assert.ok(!message.includes("\n"));
  }
  await accessible("error");
  await page.screenshot({ path: join(screenshots, "error.png") });
  await drop([{ name: "good.bin", content: readFileSync(sample("park-000000.bin")) }]);
  assert.equal(await page.locator(".fault").count(), 0);
});

test("several files are a sequence with a slider", async () => {
  await openSample("crossroads");
  assert.equal(await text("#frame-text"), "1 of 6");
  await page.locator("#frame").focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector("#scan-name").textContent === "crossroads-000001.bin");
  assert.equal(await text("#frame-text"), "2 of 6");
});

test("a slider changes the labels and the link, and the link restores the view", async () => {
  const first = await text("#legend");
  await page.locator("#set-point-margin").focus();
  for (let i = 0; i < 12; ++i) await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector("[data-name='point.margin'] output").textContent === "0.36 m");
  await settled();
  await page.waitForFunction((before) => document.querySelector("#legend").innerText !== before, first);
  const changed = await text("#legend");
  await page.waitForFunction(() => location.hash.includes("point.margin=0.36"));
  await start({ fragment: new URL(page.url()).hash });
  assert.equal(await text("#legend"), changed);
  assert.equal(await text("[data-name='point.margin'] output"), "0.36 m");
  await page.click("#reset");
  await page.waitForFunction((before) => document.querySelector("#legend").innerText === before, first);
});

test("a value outside its limits in a link is reported", async () => {
  await context.close();
  context = await browser.newContext();
  page = await context.newPage();
  await page.goto(`${address}#point.margin=99`);
  await page.waitForSelector(".fault");
  assert.match(await text(".fault p"), /point\.margin = 99 is out of range \(expected 0 to 10 m\)/);
});

test("the methods are compared", async () => {
  await page.selectOption("#compare", "difference");
  await page.waitForFunction(() => document.querySelector("#legend").textContent.includes("ground only in patchwork"));
  await page.screenshot({ path: join(screenshots, "difference.png") });
  await page.selectOption("#compare", "side");
  await page.waitForSelector("#sides:not([hidden])");
  await settled();
  await page.screenshot({ path: join(screenshots, "side-by-side.png") });
});

test("the doctor reports a scan in millimetres, and its settings fix the labels", async () => {
  const points = new Float32Array(new Uint8Array(readFileSync(sample("street-000000.bin"))).buffer);
  for (let i = 0; i < points.length; ++i) if (i % 4 < 3) points[i] *= 1000;
  await drop([{ name: "millimetres.bin", content: new Uint8Array(points.buffer) }]);
  await page.waitForSelector("#advice:not([hidden])");
  assert.match(await text("#advice-text"), /^Doctor: .*mm|millimet/i);
  await accessible("advice");
  await page.screenshot({ path: join(screenshots, "doctor.png") });
  await page.click("#advice-apply");
  await page.waitForFunction(() => document.querySelector("#legend").innerText.startsWith("ground") && parseFloat(document.querySelector("#legend .count").innerText) > 40);
  assert.equal(await page.locator(".fault").count(), 0);
  assert.ok(await page.locator("#advice").isHidden());
});

test("colours, surface and patchwork", async () => {
  await page.click(".of-scan >> text=Height");
  await page.check("#show-surface");
  await settled();
  await page.screenshot({ path: join(screenshots, "height-surface.png") });
  await page.uncheck("#show-points");
  await page.screenshot({ path: join(screenshots, "surface.png") });
  await page.check("#show-points");
  await page.click(".of-scan >> text=Patches");
  await page.uncheck("#show-surface");
  await page.screenshot({ path: join(screenshots, "patches.png") });
  await page.locator("input[name=method][value=patchwork]").check({ force: true });
  await page.waitForSelector("#set-distance_margin");
  await settled();
  await page.click("#look-top");
  await page.screenshot({ path: join(screenshots, "patchwork.png") });
  assert.ok(await page.locator("#show-surface").isDisabled());
  await accessible("patchwork");
});

test("a click shows the point, with its reason", async () => {
  const box = await page.locator("#view").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.72);
  await page.waitForSelector("#card:not([hidden])");
  const card = await text("#card-rows");
  assert.match(card, /Label\s+\S+/);
  assert.match(card, /Height\s+.*m above the surface/);
  assert.match(card, /Reason\s+The point is/);
  await accessible("card");
  await page.screenshot({ path: join(screenshots, "card.png") });
});

test("the keyboard does what the mouse does", async () => {
  await page.focus("#view");
  await page.keyboard.press("t");
  await page.keyboard.press("2");
  await page.waitForFunction(() => location.hash.includes("color=height") && location.hash.includes("camera="));
  const camera = new URL(page.url()).hash;
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  await page.keyboard.press("Shift+ArrowUp");
  await page.waitForFunction((before) => location.hash !== before, camera);
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowUp");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#card:not([hidden])");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#card", { state: "hidden" });
  await page.keyboard.press("s");
  assert.ok(await page.locator("#show-surface").isChecked());
});

test("every control is reachable with Tab", async () => {
  const reached = new Set();
  await page.evaluate(() => document.body.focus());
  for (let i = 0; i < 45; ++i) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.name));
  }
  for (const id of ["sample", "open", "share", "theme", "view", "color", "method", "compare", "automatic", "set-point-margin", "format", "save"]) {
    assert.ok(reached.has(id), id);
  }
});

test("phone, light", async () => {
  await start({ viewport: { width: 390, height: 844 }, colorScheme: "light", hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.screenshot({ path: join(screenshots, "phone-light.png") });
  await accessible("phone");
  await page.screenshot({ path: join(screenshots, "phone-light-full.png"), fullPage: true });
});

test("light, and the switch of the theme", async () => {
  await start({ colorScheme: "light" });
  await page.screenshot({ path: join(screenshots, "desktop-light.png") });
  await accessible("light");
  await page.click("#theme");
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
});

test("a map is shown, and a click describes the ground", async () => {
  await page.selectOption("#sample", "map");
  await mapShown();
  assert.equal(await text("#scan-title"), "MAP");
  assert.match(await text("#scan-facts"), /^60 scans, 2\d\d m of path, \d,\d{3} m² of ground$/);
  assert.ok(await page.locator("#sliders").isHidden());
  await accessible("map");
  await page.screenshot({ path: join(screenshots, "map.png") });
  await page.click("#look-top");
  await page.screenshot({ path: join(screenshots, "map-top.png") });
  for (const [key, legend] of [["2", "expected error"], ["3", "scans per cell"], ["1", "height"]]) {
    await page.locator("#view").press(key);
    assert.match(await text("#map-legend"), new RegExp(legend));
  }
  const before = await page.locator("#view").screenshot();
  for (const layer of ["path", "objects", "points"]) await page.click(`#map-${layer}`);
  await page.screenshot({ path: join(screenshots, "map-points.png") });
  assert.ok(!(await page.locator("#view").screenshot()).equals(before));
  await page.click("#look-reset");
  const box = await page.locator("#view").boundingBox();
  for (let y = 0.85; y > 0.4 && !(await page.locator("#card").isVisible()); y -= 0.04) {
    await page.mouse.click(box.x + box.width / 2, box.y + box.height * y);
  }
  assert.match(await text("#card-rows"), /Height\s+−?\d+\.\d\d m\s+Error\s+0\.\d\d m \(expected\)\s+Measured\s+by \d+ of 60 scans/);
  await accessible("ground of a map");
  await page.screenshot({ path: join(screenshots, "map-ground.png") });
  await openSample("park");
  assert.equal(await text("#scan-title"), "SCAN");
  assert.ok(await page.locator("#sliders").isVisible());
});

test("a link shows the simulated map", async () => {
  await context.close();
  context = await browser.newContext({ viewport: { width: 390, height: 844 }, colorScheme: "light", isMobile: true, deviceScaleFactor: 2 });
  page = await context.newPage();
  await page.goto(`${address}#scan=map`);
  await mapShown();
  await page.screenshot({ path: join(screenshots, "map-phone-light.png") });
  await accessible("map, light");
});

test("the output directory of flagstone map is opened, dropped or chosen", async (t) => {
  const directory = mapDirectory(t);
  await dropPaths([directory]);
  await mapShown();
  assert.equal(await text("#scan-name"), basename(directory));
  assert.equal(await page.locator(".fault").count(), 0);
  await openSample("park");
  await page.locator("#directory").setInputFiles(directory);
  await mapShown();
  rmSync(join(directory, "poses.txt"));
  await dropPaths([directory]);
  await page.waitForFunction(() => !document.querySelector("#scan-facts").textContent.includes("path"));
  assert.ok(await page.locator("#map-path").isHidden());
});

test("the scans of a dropped directory are a sequence", async (t) => {
  const directory = mkdtempSync(join(tmpdir(), "flagstone-page-"));
  t.after(() => rmSync(directory, { recursive: true }));
  for (const index of [0, 1]) cpSync(sample(`crossroads-00000${index}.bin`), join(directory, `scan-${index}.bin`));
  writeFileSync(join(directory, "times.txt"), "0\n1\n");
  await dropPaths([directory]);
  await page.waitForFunction(() => document.querySelector("#scan-name").textContent === "scan-0.bin");
  assert.equal(await text("#frame-text"), "1 of 2");
  rmSync(join(directory, "scan-0.bin"));
  rmSync(join(directory, "scan-1.bin"));
  await dropPaths([directory]);
  await page.waitForSelector(".fault");
  assert.match(await text(".fault p"), /: contains neither scans nor a map \(expected /);
});

/** What is damaged, and the message. */
const damages = [
  [(name) => truncate(name("map.json")), /^map\.json: is not JSON \(expected/],
  [(name) => replace(name("map.json"), '"version": 1', '"version": 2'), /^map\.json: is not a ground map \(expected .*version 1\)$/],
  [(name) => replace(name("map.json"), '"cell": 0.5', '"cell": -1'), /^map\.json: cell is -1 \(expected/],
  [(name) => replace(name("map.json"), /"tiles": \[[^]*\]/, '"tiles": []'), /^map\.json: the map has no tiles/],
  [(name) => rmSync(name(".npy")), /\.npy: the tile is missing \(expected every tile of map\.json\)$/],
  [(name) => truncate(name(".npy")), /\.npy: \d+ bytes are not a tile \(expected 6\d+ bytes; the file may be truncated\)$/],
  [(name) => writeFileSync(name(".npy"), "oops"), /\.npy: is not a tile \(expected a NumPy array of 64 x 64 records with height, /],
  [(name) => truncate(name("poses.txt")), /^poses\.txt: line \d+: is incomplete \(the file may be truncated\)$/],
  [(name) => replace(name("poses.txt"), /\S+ /, ""), /^poses\.txt: line 1: 11 numbers \(expected 12, /],
  [(name) => replace(name("poses.txt"), /\S+ /, "one "), /^poses\.txt: line 1: 'one' is not a number$/],
  [(name) => truncate(name("objects.csv")), /^objects\.csv: line \d+: is incomplete \(the file may be truncated\)$/],
  [(name) => replace(name("objects.csv"), /,1,/, ","), /^objects\.csv: line 2: is not an object \(expected 10 values\)$/],
  [(name) => replace(name("objects.csv"), "min_x", "x"), /^objects\.csv: line 1: columns are missing \(expected scan, min_x, /],
  [(name) => truncate(name("run.json")), /^run\.json: is not JSON \(expected/],
  [(name) => truncate(name("static.ply")), /^static\.ply: .*byte/],
];

test("each damaged file of a map is reported on one line, and what can be shown is shown", async (t) => {
  for (const [damage, expected] of damages) {
    const directory = mapDirectory(t);
    const names = readdirSync(directory, { recursive: true }).sort();
    damage((end) => join(directory, names.find((name) => name.endsWith(end))));
    await dropPaths([directory]);
    await page.waitForSelector(".fault", { timeout: 20_000 });
    const message = await text(".fault p");
    assert.match(message, expected);
    assert.ok(!message.includes("\n"));
    const needed = /^(map\.json|.*\.npy)/.test(message);
    assert.equal(await page.evaluate(() => document.body.dataset.shows), needed ? "scan" : "map");
    await openSample("park");
    assert.equal(await page.locator(".fault").count(), 0);
  }
});

const mapShown = () => page.waitForFunction(() => !document.body.hasAttribute("aria-busy") && document.body.dataset.shows === "map");

/** A copy of the simulated map, until the end of the test. */
function mapDirectory(t) {
  const directory = mkdtempSync(join(tmpdir(), "flagstone-page-"));
  t.after(() => rmSync(directory, { recursive: true }));
  cpSync(sample("map"), directory, { recursive: true });
  return directory;
}

function truncate(path) {
  const content = readFileSync(path);
  writeFileSync(path, content.subarray(0, Math.floor(content.length / 2)));
}

function replace(path, from, to) {
  const content = readFileSync(path, "utf8");
  assert.ok(content.search(from) >= 0, `${path}: ${from}`);
  writeFileSync(path, content.replace(from, to));
}

/** Drops files and directories of the file system on the page. */
async function dropPaths(files) {
  const session = await context.newCDPSession(page);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) await session.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data });
  await session.detach();
}

test("the number of floats per point of a .bin file can be set", async () => {
  const four = new Float32Array(new Uint8Array(readFileSync(sample("park-000000.bin"))).buffer);
  const six = new Float32Array((four.length / 4) * 6);
  for (let i = 0; i < four.length / 4; ++i) six.set(four.subarray(4 * i, 4 * i + 4), 6 * i);
  await drop([{ name: "six.bin", content: new Uint8Array(six.buffer, 0, 6 * 4 * 26_247) }]);
  assert.match(await text(".fault p"), /check the number of columns/);
  await page.selectOption("#columns", "6");
  await page.waitForFunction(() => document.querySelector("#scan-facts").textContent.startsWith("26,247 points"));
  assert.equal(await page.locator(".fault").count(), 0);
});

test("a frame with a million points is one draw call, uploads nothing, and is drawn only after a change", async () => {
  await context.addInitScript(() => {
    const counts = (globalThis.counts = { draws: 0, points: 0, uploads: 0, uploaded: 0 });
    const watch = (name, note) => {
      const original = WebGL2RenderingContext.prototype[name];
      WebGL2RenderingContext.prototype[name] = function (...args) {
        note(args);
        return original.apply(this, args);
      };
    };
    for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
      watch(name, ([mode]) => {
        ++counts.draws;
        if (mode === WebGL2RenderingContext.POINTS) ++counts.points;
      });
    }
    for (const name of ["bufferData", "bufferSubData", "texImage2D", "texSubImage2D", "texStorage2D"]) {
      watch(name, (args) => {
        ++counts.uploads;
        counts.uploaded += args.find((argument) => ArrayBuffer.isView(argument))?.byteLength ?? 0;
      });
    }
  });
  await page.setViewportSize({ width: 640, height: 400 }); // Chromium without a GPU draws slowly
  await page.reload();
  await settled();
  await page.waitForFunction(() => document.querySelector("#doctor-fine:not([hidden])"));
  const counts = () => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve({ ...counts })))));
  const before = await counts();
  const part = readFileSync(sample("street-000000.bin"));
  const content = Buffer.concat(Array.from({ length: Math.ceil(16e6 / part.length) }, () => part));
  const size = content.length / 16;
  const milliseconds = await drop([{ name: "million.bin", content }]);
  assert.match(await text("#scan-facts"), /^1,\d{3},\d{3} points/);
  await page.waitForFunction(() => document.querySelector("#doctor-fine:not([hidden])"));
  const loaded = await counts();
  const bytes = (loaded.uploaded - before.uploaded) / size;
  assert.ok(bytes <= 16.1, `${bytes} bytes per point`);

  const session = await context.newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const seconds = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    const value = (name) => metrics.find((metric) => metric.name === name).value;
    return { script: value("ScriptDuration"), all: value("TaskDuration") };
  };
  const orbit = (frames) =>
    page.evaluate(async (count) => {
      const view = document.querySelector("#view");
      for (let i = 0; i < count; ++i) {
        view.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
        await new Promise(requestAnimationFrame);
      }
    }, frames);
  await orbit(5);
  const still = await counts();
  const start = await seconds();
  const frames = 20;
  await orbit(frames);
  const end = await seconds();
  const turned = await counts();
  await session.send("HeapProfiler.enable");
  await session.send("HeapProfiler.startSampling", { samplingInterval: 256, includeObjectsCollectedByMinorGC: true, includeObjectsCollectedByMajorGC: true });
  await orbit(frames);
  const { profile } = await session.send("HeapProfiler.stopSampling");
  const allocated = (node) => node.selfSize + node.children.reduce((sum, child) => sum + allocated(child), 0);

  assert.equal(turned.uploads - still.uploads, 0);
  assert.equal(turned.points - still.points, frames);
  assert.equal(turned.draws - still.draws, 2 * frames); // the points and the grid below them
  const quiet = await counts();
  await page.waitForTimeout(500);
  assert.equal((await counts()).draws, quiet.draws);
  const perFrame = (name) => ((1000 * (end[name] - start[name])) / frames).toFixed(2);
  console.log(`${size} points: labels ${milliseconds.toFixed(0)} ms after the drop, ${bytes.toFixed(1)} bytes per point on the GPU`);
  console.log(
    `each frame: ${perFrame("script")} ms CPU time in JavaScript, ${perFrame("all")} ms in the main thread; 2 draw calls, no upload, ` +
      `${(allocated(profile.head) / frames / 1024).toFixed(1)} KiB of garbage`,
  );
});

test("the real scans of each set are read", { skip: data ? false : "FLAGSTONE_DATA is not set" }, async () => {
  const first = (name, extension) => {
    const found = readdirSync(join(data, name)).filter((file) => file.endsWith(extension)).sort()[0];
    return { name: found, content: readFileSync(join(data, name, found)) };
  };
  const scans = [first("nuscenes", ".pcd.bin"), first("livox/velodyne", ".bin"), first("ouster", ".pcd"), first("pandaset/velodyne", ".bin")];
  for (const scan of scans) {
    await drop([scan]);
    assert.equal(await page.locator(".fault").count(), 0);
    assert.equal(await text("#scan-name"), scan.name);
    console.log(`${scan.name}: ${await text("#scan-facts")}; ${await text("#mount")}`);
    await page.screenshot({ path: join(screenshots, `real-${scan.name.split(".")[0]}.png`) });
  }
  assert.equal(labels.length, 5);
});
