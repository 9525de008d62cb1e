// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import "./style.css";
import { heightRange, palettes, pointColors, rampColor, type ColorMode, type Theme } from "./colors";
import { chosenFiles, droppedFiles, type Dropped } from "./dropped";
import { Engine } from "./engine";
import { fromFragment, toFragment } from "./link";
import { aboutCell, contourOf, extentOf, mapGeometry, obstacleColors, rampOf, scaleOf, type MapColor } from "./map_panel";
import { noPatch, type MapCopy, type Options, type Points, type Report, type Result, type Verdict } from "./messages";
import { sensorHeight, sliders, valueOf, type Slider } from "./settings";
import { surfaceMesh } from "./surface_mesh";
import { View } from "./view";
import { aboutPoint, labelTitles, metres, verdictTitles } from "./words";

const at = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const count = (value: number) => value.toLocaleString("en-GB");
const percent = (part: number, whole: number) =>
  part > 0 && part / whole < 0.0005 ? "< 0.1 %" : `${((100 * part) / Math.max(whole, 1)).toFixed(1)} %`;

function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  properties: Partial<HTMLElementTagNameMap[K]> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

interface Sample {
  name: string;
  title: string;
  files: string[];
}

let shared = fromFragment(location.hash);
const engine = new Engine();
const view = new View(at<HTMLCanvasElement>("view"));
let doctor: Engine | undefined;
let samples: Sample[] = [];
let files: File[] = [];
let frame = 0;
/** Floats per point in `.bin` files; 0: by file extension. */
let columns = 0;
let mapFiles: { name: string; files: Map<string, File> } | undefined;
let map: MapCopy | undefined;
let points: Points | undefined;
let result: Result | undefined;
let other: Result | undefined;
let heights: Float32Array = new Float32Array();
let recommended: string | undefined;
let picked: number | undefined;
const hidden = new Set<number>();

// ---- Theme

const systemTheme = matchMedia("(prefers-color-scheme: light)");
let chosenTheme = localStorageTheme();

function localStorageTheme(): Theme | undefined {
  try {
    const theme = localStorage.getItem("theme");
    return theme === "light" || theme === "dark" ? theme : undefined;
  } catch {
    return undefined; // storage is blocked
  }
}

const theme = (): Theme => chosenTheme ?? (systemTheme.matches ? "light" : "dark");

function showTheme(): void {
  document.documentElement.dataset.theme = theme();
  view.setTheme(theme());
  if (map === undefined) view.setHomeOfScan(groundHeight());
  showColors();
  showMap();
}

at("theme").onclick = () => {
  chosenTheme = theme() === "dark" ? "light" : "dark";
  try {
    localStorage.setItem("theme", chosenTheme);
  } catch {
    // The choice lasts until the page is closed.
  }
  showTheme();
};
systemTheme.onchange = showTheme;

// ---- Errors

function showFault(error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  const close = element("button", { type: "button", className: "quiet", ariaLabel: "Close the message" }, "×");
  const fault = element("div", { className: "fault" }, element("p", { tabIndex: 0 }, message), close);
  close.onclick = () => fault.remove();
  const list = at("faults");
  while (list.children.length >= 3) list.firstChild?.remove();
  list.append(fault);
}

const clearFaults = () => at("faults").replaceChildren();

// ---- Requests: one at a time, and of the waiting ones only the last

type Work = "segment" | "open" | "map";
let running = false;
let wanted: Work | undefined;

function request(what: Work): void {
  if (what !== "segment" || wanted === undefined) wanted = what;
  if (!running) void work();
}

async function work(): Promise<void> {
  running = true;
  while (wanted !== undefined) {
    const what = wanted;
    wanted = undefined;
    document.body.setAttribute("aria-busy", "true");
    try {
      if (what === "map") await openMap();
      if (what === "open") await open();
      if (points !== undefined) await segment(what === "open");
    } catch (error) {
      showFault(error);
    }
  }
  document.body.removeAttribute("aria-busy");
  running = false;
}

async function open(): Promise<void> {
  const opened = await engine.ask("open", { file: files[frame], columns });
  const first = points === undefined;
  points = opened;
  result = other = undefined;
  unpick();
  view.setPositions(opened.positions);
  if (!first) return;
  const fromMap = map !== undefined;
  map = undefined;
  showKind();
  view.setRun(new Float32Array(), new Float32Array(), theme());
  view.setHomeOfScan(groundHeight());
  if (shared.camera.length === 6) view.camera = shared.camera;
  else if (fromMap) view.look("reset");
}

async function openMap(): Promise<void> {
  const opened = await engine.ask("map", mapFiles!);
  map = opened;
  points = result = other = undefined;
  unpick();
  clearFaults();
  opened.problems.forEach(showFault);
  showKind();
  at("scan-name").textContent = at("scan-name").title = opened.name;
  const path = opened.path.length > 0 ? `, ${count(Math.round(opened.length))} m of path` : "";
  at("scan-facts").textContent = `${count(opened.scans)} scans${path}, ${count(Math.round(opened.area))} m² of ground`;
  view.setScale(1);
  view.setPositions(opened.points.positions);
  const { center, width, height } = extentOf(opened.ground);
  view.setHomeOfMap(center, width, height);
  if (shared.camera.length === 6) view.camera = shared.camera;
  else view.look("reset");
  showMap();
}

/** Shows the controls of a scan or of a map. */
function showKind(): void {
  document.body.dataset.shows = map === undefined ? "scan" : "map";
  at("scan-title").textContent = map === undefined ? "Scan" : "Map";
}

function options(method = shared.method): Options {
  const made: Options = { method };
  if (shared.config !== "") made.config = shared.config;
  else if (shared.height === "auto") made.sensor_height = "estimate";
  if (shared.height !== "auto") made.sensor_height = shared.height;
  if (method !== shared.method) return made;
  for (const [name, value] of Object.entries(shared.changes)) {
    const keys = name.split(".");
    const last = keys.pop() as string;
    let table = made as Record<string, unknown>;
    for (const key of keys) table = (table[key] ??= {}) as Record<string, unknown>;
    table[last] = value;
  }
  return made;
}

const otherMethod = () => (shared.method === "surface" ? "patchwork" : "surface");

async function segment(opened: boolean): Promise<void> {
  const current = points as Points;
  const next = await engine.ask("segment", { options: options() });
  const compared =
    shared.compare === "off" ? undefined : await engine.ask("compare", { options: options(otherMethod()) });
  result = next;
  other = compared;
  heights = heightsOf(current, next);
  clearFaults();
  showResult();
  if (opened) void examine(files[frame]);
}

/** Heights above the ground; without a surface, above the ground that is expected below the sensor. */
function heightsOf({ positions }: Points, { heights: found, mount }: Result): Float32Array {
  if (found.length > 0) return found;
  return new Float32Array(positions.length / 3).map((_, i) => positions[3 * i + 2] * mount.scale - mount.origin[2] + mount.sensor_height);
}

const groundHeight = () =>
  result === undefined ? -1.73 : result.mount.origin[2] - result.mount.sensor_height;

// ---- Files

/** Opens the map among the files, otherwise the scans. */
function openFiles(list: Dropped[], sample = ""): void {
  if (list.length === 0) return;
  clearFaults();
  shared.sample = sample;
  at<HTMLSelectElement>("sample").value = sample;
  showLink();
  const maps = list.filter(({ file }) => file.name === "map.json");
  if (maps.length > 1) return showFault(`${maps[1].path}: is a second map (open one map at a time)`);
  if (maps.length === 1) {
    // Of files with the same name, the one that is less deep belongs to the map.
    const depth = ({ path }: Dropped) => path.split("/").length;
    const byDepth = [...list].sort((a, b) => depth(b) - depth(a));
    const name = list[0].path.split("/").slice(0, -1)[0] ?? "map.json";
    mapFiles = { name, files: new Map(byDepth.map(({ file }) => [file.name, file])) };
    return request("map");
  }
  const isInDirectory = list.some(({ path }) => path.includes("/"));
  const scans = isInDirectory ? list.filter(({ path }) => /\.(bin|pcd|ply|npy)$/.test(path)) : list;
  if (scans.length === 0) return showFault(`${list[0].path.split("/")[0]}: contains neither scans nor a map (expected .bin, .pcd, .ply or .npy files, or a map.json)`);
  files = scans.map(({ file }) => file).sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  at("sequence").hidden = files.length < 2;
  at<HTMLInputElement>("frame").max = String(files.length);
  columns = 0;
  at<HTMLSelectElement>("columns").value = "0";
  at("columns-row").hidden = sample !== "" || !files[0].name.endsWith(".bin");
  showFrame(0);
}

function showFrame(index: number): void {
  frame = index;
  at<HTMLInputElement>("frame").value = String(index + 1);
  at("frame-text").textContent = `${index + 1} of ${files.length}`;
  request("open");
  showLink();
}

at<HTMLInputElement>("frame").oninput = (event) => showFrame(Number((event.target as HTMLInputElement).value) - 1);
at<HTMLSelectElement>("columns").onchange = (event) => {
  columns = Number((event.target as HTMLSelectElement).value);
  clearFaults();
  request("open");
};
for (const [button, input] of [["open", "files"], ["open-directory", "directory"]]) {
  at(button).onclick = () => at(input).click();
  at<HTMLInputElement>(input).onchange = (event) => {
    const { files: chosen } = event.target as HTMLInputElement;
    openFiles(chosenFiles(chosen ?? []));
    at<HTMLInputElement>(input).value = "";
  };
}

addEventListener("dragover", (event) => {
  event.preventDefault();
  at("drop").hidden = false;
});
addEventListener("dragleave", (event) => {
  if (event.relatedTarget === null) at("drop").hidden = true;
});
addEventListener("drop", (event) => {
  event.preventDefault();
  at("drop").hidden = true;
  if (event.dataTransfer !== null) droppedFiles(event.dataTransfer).then(openFiles).catch(showFault);
});

async function startSamples(): Promise<void> {
  const response = await fetch("./samples/samples.json");
  if (!response.ok) throw new Error("samples/samples.json: cannot be loaded (expected next to this page; open a scan instead)");
  samples = await response.json();
  at("sample").append(...samples.map(({ name, title }) => element("option", { value: name }, title)));
  const chosen = samples.find(({ name }) => name === shared.sample) ?? samples[0];
  if (files.length === 0 && chosen !== undefined) await openSample(chosen);
}

async function openSample({ name, files: names }: Sample): Promise<void> {
  const loaded = await Promise.all(
    names.map(async (file) => {
      const response = await fetch(`./samples/${file}`);
      if (!response.ok) throw new Error(`samples/${file}: cannot be loaded (expected next to this page; open a scan instead)`);
      return { path: file, file: new File([await response.blob()], file.replace(/^.*\//, "")) };
    }),
  );
  openFiles(loaded, name);
}

at<HTMLSelectElement>("sample").onchange = (event) => {
  const chosen = samples.find(({ name }) => name === (event.target as HTMLSelectElement).value);
  if (chosen !== undefined) openSample(chosen).catch(showFault);
};

// ---- Results

function showResult(): void {
  const current = points as Points;
  const found = result as Result;
  at("scan-name").textContent = current.name;
  at("scan-name").title = current.name;
  at("scan-facts").textContent =
    `${count(current.size)} points, segmented in ${found.milliseconds.toFixed(0)} ms`;
  at("mount").textContent = sentence(found.mount.decision);
  at("mount").classList.toggle("warning", shared.config === "" && shared.height === "auto" && !found.mount.accepted);
  showSliders();
  view.setScale(found.mount.scale);
  view.setHomeOfScan(groundHeight());
  showSurface();
  showColors();
  if (picked !== undefined) showPicked(picked);
}

const sentence = (text: string) => (text === "" ? "" : `${text[0].toUpperCase()}${text.slice(1)}.`.replace(/\.\.$/, "."));

function showSurface(): void {
  const has = result !== undefined && result.grids.length > 0;
  const box = at<HTMLInputElement>("show-surface");
  box.disabled = result !== undefined && !has;
  box.checked = shared.surface;
  (box.parentElement as HTMLElement).title = box.disabled ? "Only the method surface computes a surface" : "";
  view.setSurface(has && shared.surface && result !== undefined ? surfaceMesh(result.grids, result.mount) : undefined);
}

function showColors(): void {
  if (result === undefined) return;
  const difference = shared.compare === "difference" && other !== undefined;
  const mode: ColorMode = difference ? "difference" : shared.color;
  const none = shared.points ? hidden : new Set(labelTitles.keys());
  const colors = pointColors(mode, result, other, heights, none, theme());
  const side = shared.compare === "side" && other !== undefined;
  view.setColors(
    colors,
    side ? pointColors(mode, other as Result, undefined, heightsOf(points as Points, other as Result), none, theme()) : undefined,
  );
  at("sides").hidden = !side;
  at("side-one").textContent = shared.method;
  at("side-two").textContent = otherMethod();
  showLegend(mode);
}

function swatch(color: string): HTMLElement {
  const made = element("span", { className: "swatch" });
  made.style.background = color;
  return made;
}

/** Colours from a low to a high value, and the texts below them. */
function ramp(colorAt: (value: number) => number[], ...texts: string[]): HTMLElement[] {
  const colors = element("span", { className: "ramp" });
  const stops = Array.from({ length: 12 }, (_, i) => `rgb(${colorAt(i / 11).map(Math.round).join(" ")})`);
  colors.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
  return [colors, element("p", { className: "ends" }, ...texts.map((text) => element("span", {}, text)))];
}

function entry(color: string, title: string, value: string): HTMLElement {
  return element("p", {}, swatch(color), title, element("span", { className: "count" }, value));
}

function showLegend(mode: ColorMode): void {
  const found = result as Result;
  const palette = palettes[theme()];
  const whole = found.labels.length;
  const legend = at("legend");
  if (mode === "label") {
    const focused = legend.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset.label : undefined;
    const order = [1, 0, 2, 3, 4].filter((label) => label < 2 || found.counts[label] > 0);
    legend.replaceChildren(
      ...order.map((label) => {
        const box = element("input", { type: "checkbox", checked: !hidden.has(label) });
        box.dataset.label = String(label);
        box.onchange = () => {
          if (box.checked) hidden.delete(label);
          else hidden.add(label);
          showColors();
        };
        const value = element("span", { className: "count" }, percent(found.counts[label], whole));
        value.title = `${count(found.counts[label])} points`;
        return element("label", {}, box, swatch(palette.labels[label]), labelTitles[label], value);
      }),
    );
    if (focused !== undefined) legend.querySelector<HTMLElement>(`[data-label="${focused}"]`)?.focus();
  } else if (mode === "height") {
    const [low, high] = heightRange.map((value) => `${String(value).replace("-", "−")} m`);
    legend.replaceChildren(...ramp(rampColor, low, found.heights.length > 0 ? "above the surface" : "above the base of the sensor", high));
  } else if (mode === "patch") {
    const numbers = new Map<Verdict, number>();
    for (const { verdict } of found.patches) numbers.set(verdict, (numbers.get(verdict) ?? 0) + 1);
    const without = found.patchOf.filter((patch) => patch === noPatch).length;
    legend.replaceChildren(
      ...(Object.keys(palette.verdicts) as Verdict[])
        .filter((verdict) => numbers.has(verdict))
        .map((verdict) => entry(palette.verdicts[verdict], verdictTitles[verdict], `${count(numbers.get(verdict) ?? 0)} patches`)),
      ...(without > 0 ? [entry(palette.noPatch, "no patch", `${count(without)} points`)] : []),
    );
  } else {
    const numbers = [0, 0, 0, 0];
    found.labels.forEach((label, i) => {
      const second = other?.labels[i] === 1;
      ++numbers[label === 1 ? (second ? 0 : 2) : second ? 3 : 1];
    });
    const titles = ["ground in both", "ground in neither", `ground only in ${shared.method}`, `ground only in ${otherMethod()}`];
    legend.replaceChildren(...titles.map((title, i) => entry(palette.difference[i], title, percent(numbers[i], whole))));
  }
}

// ---- Settings

function makeSlider(slider: Slider): HTMLElement {
  const id = `set-${slider.name.replace(".", "-")}`;
  const input = element("input", { type: "range", id, title: `${slider.name}: ${slider.hint}` });
  Object.assign(input, { min: slider.low, max: slider.high, step: slider.step });
  const output = element("output", {});
  output.setAttribute("for", id);
  const box = element("div", { className: "slider" }, element("label", { htmlFor: id, title: slider.hint }, slider.title), output, input);
  box.dataset.name = slider.name;
  const change = (value: number) => {
    if (slider === sensorHeight) shared.height = value;
    else shared.changes[slider.name] = value;
    showValue(box, slider, value);
    showLink();
    request("segment");
  };
  input.oninput = () => change(Number(input.value));
  if (slider === sensorHeight) {
    const automatic = element("input", { type: "checkbox", id: "automatic" });
    automatic.onchange = () => {
      shared.height = automatic.checked ? "auto" : Number(input.value);
      showLink();
      request("segment");
    };
    box.append(element("label", { className: "automatic" }, automatic, " Estimate from the scan"));
  }
  return box;
}

function showValue(box: HTMLElement, slider: Slider, value: number): void {
  const input = box.querySelector("input[type=range]") as HTMLInputElement;
  const digits = slider.step >= 1 ? 0 : slider.step < 0.01 ? 3 : 2;
  const text = `${value.toFixed(digits)} ${slider.unit}`;
  input.value = String(value);
  input.setAttribute("aria-valuetext", text);
  (box.querySelector("output") as HTMLElement).textContent = text;
  box.classList.toggle("changed", slider === sensorHeight ? shared.height !== "auto" : slider.name in shared.changes);
}

let slidersOf = "";

function showSliders(): void {
  const list = at("sliders");
  const all = [sensorHeight, ...sliders[shared.method]];
  if (slidersOf !== shared.method) {
    slidersOf = shared.method;
    list.replaceChildren(...all.map(makeSlider));
  }
  for (const slider of all) {
    const box = list.querySelector(`[data-name="${slider.name}"]`) as HTMLElement;
    const used = slider === sensorHeight ? result?.mount.sensor_height : valueOf(result?.settings ?? {}, slider.name);
    // While a slider moves, its own value is newer than the result.
    const value = slider === sensorHeight && shared.height !== "auto" ? shared.height : (shared.changes[slider.name] ?? used);
    if (value !== undefined) showValue(box, slider, value);
  }
  at<HTMLInputElement>("automatic").checked = shared.height === "auto";
  (at("automatic").parentElement as HTMLElement).lastChild!.textContent =
    shared.config === "" ? " Estimate from the scan" : " As recommended by the doctor";
  const changed = shared.height !== "auto" || Object.keys(shared.changes).length > 0 || shared.config !== "";
  at<HTMLButtonElement>("reset").disabled = !changed;
}

at("reset").onclick = () => {
  Object.assign(shared, { height: "auto", changes: {}, config: "" });
  settingsChanged();
  at("view").focus();
};

function settingsChanged(): void {
  showChoices();
  showLink();
  showReport();
  request("segment");
}

// ---- Choices

function showChoices(): void {
  for (const [name, value] of [["color", shared.color], ["method", shared.method]]) {
    (document.querySelector(`input[name=${name}][value=${value}]`) as HTMLInputElement).checked = true;
  }
  at<HTMLSelectElement>("compare").value = shared.compare;
  at<HTMLInputElement>("show-points").checked = shared.points;
  at<HTMLInputElement>("show-surface").checked = shared.surface;
  at("other-name").textContent = otherMethod();
  showSliders();
}

document.querySelectorAll<HTMLInputElement>("input[name=color]").forEach((input) => {
  input.onchange = () => setColor(input.value as typeof shared.color);
});

function setColor(color: typeof shared.color): void {
  shared.color = color;
  if (shared.compare === "difference") shared.compare = "off";
  showChoices();
  showLink();
  showColors();
}

document.querySelectorAll<HTMLInputElement>("input[name=method]").forEach((input) => {
  input.onchange = () => {
    shared.method = input.value as typeof shared.method;
    shared.changes = {};
    settingsChanged();
  };
});

at<HTMLSelectElement>("compare").onchange = (event) => {
  shared.compare = (event.target as HTMLSelectElement).value as typeof shared.compare;
  settingsChanged();
};

function setShown(what: "points" | "surface", shown: boolean): void {
  shared[what] = shown;
  showChoices();
  showLink();
  if (what === "surface") showSurface();
  else showColors();
}

for (const what of ["points", "surface"] as const) {
  const box = at<HTMLInputElement>(`show-${what}`);
  box.onchange = () => setShown(what, box.checked);
}

// ---- Map

let mapColor: MapColor = "height";

function showMap(): void {
  if (map === undefined) return;
  const shown = (what: string) => at<HTMLInputElement>(`map-${what}`).checked;
  const nothing = new Float32Array();
  view.setColors(obstacleColors(map, theme(), shown("points")));
  view.setSurface(shown("ground") ? mapGeometry(map, mapColor) : undefined, contourOf(map));
  view.setRun(shown("path") ? map.path : nothing, shown("objects") ? map.objects : nothing, theme());
  const { low, high, text, format } = scaleOf(map, mapColor);
  at("map-legend").replaceChildren(
    ...ramp(rampOf(mapColor), format(low), text, format(high)),
    element("p", { className: "facts" }, `Contour lines every ${metres(contourOf(map)).replace(/\.?0+ /, " ")}`),
  );
  const palette = palettes[theme()];
  for (const [what, color] of [["path", palette.path], ["objects", palette.moving]]) {
    at(`map-${what}-color`).style.background = color;
  }
  for (const [what, values] of [["path", map.path], ["objects", map.objects], ["points", map.points.heights]] as const) {
    (at(`map-${what}`).parentElement as HTMLElement).hidden = values.length === 0;
  }
}

function setMapColor(color: MapColor): void {
  mapColor = color;
  (document.querySelector(`input[name=map-color][value=${color}]`) as HTMLInputElement).checked = true;
  showMap();
}

document.querySelectorAll<HTMLInputElement>("input[name=map-color]").forEach((input) => {
  input.onchange = () => setMapColor(input.value as MapColor);
});
for (const what of ["ground", "points", "path", "objects"]) at(`map-${what}`).onchange = showMap;

// ---- Doctor

let report: Report | undefined;

async function examine(file: File): Promise<void> {
  report = undefined;
  showReport();
  try {
    doctor ??= new Engine();
    await doctor.ask("open", { file, columns });
    const found = await doctor.ask("doctor", { options: {} });
    if (file !== files[frame]) return; // another scan is open now
    report = found;
    showReport();
  } catch (error) {
    if (file === files[frame]) at("doctor-summary").textContent = sentence(error instanceof Error ? error.message : String(error));
  }
}

function findingItem({ severity, sentence: text, remedy }: Report["findings"][number]): HTMLElement {
  const item = element("li", { className: severity });
  if (severity !== "fine") item.append(element("b", {}, severity === "fix" ? "Fix" : "Note"));
  item.append(text);
  if (remedy !== "") item.append(" ", element("span", { className: "remedy" }, remedy));
  return item;
}

function showReport(): void {
  const fine = at<HTMLDetailsElement>("doctor-fine");
  const apply = at<HTMLButtonElement>("doctor-apply");
  fine.hidden = report === undefined;
  apply.hidden = report?.toml == null || report.fix + report.note === 0;
  const first = report?.findings.find(({ severity }) => severity === "fix");
  at("advice").hidden = first === undefined || report?.toml === shared.config;
  at("advice-text").textContent = first === undefined ? "" : `Doctor: ${first.sentence}`;
  at("advice-apply").hidden = report?.toml == null;
  if (report === undefined) {
    at("doctor-summary").textContent = "The scan is being checked.";
    at("doctor-findings").replaceChildren();
    return;
  }
  const { fix, note, findings } = report;
  at("doctor-summary").textContent =
    fix + note === 0 ? "No problem was found." : `${fix} to fix, ${note} ${note === 1 ? "note" : "notes"}.`;
  const order = { fix: 0, note: 1, fine: 2 };
  const problems = findings.filter(({ severity }) => severity !== "fine");
  problems.sort((a, b) => order[a.severity] - order[b.severity]);
  at("doctor-findings").replaceChildren(...problems.map(findingItem));
  const others = findings.filter(({ severity }) => severity === "fine");
  (fine.querySelector("summary") as HTMLElement).textContent = `${others.length} checks without a problem`;
  (fine.querySelector("ul") as HTMLElement).replaceChildren(...others.map(findingItem));
  recommended = report.toml ?? undefined;
  apply.disabled = recommended === shared.config;
  apply.textContent = apply.disabled ? "Recommended settings are used" : "Use recommended settings";
  apply.title = recommended ?? "";
}

at("doctor-apply").onclick = at("advice-apply").onclick = () => {
  Object.assign(shared, { height: "auto", changes: {}, config: recommended ?? "" });
  settingsChanged();
  view.canvas.focus();
};

// ---- Points

/** Shows a point of the scan, or a cell of the map. */
function showPicked(index: number): void {
  picked = index;
  const positions = map?.ground.positions ?? (points as Points).positions;
  view.mark(positions.subarray(3 * index, 3 * index + 3));
  at("card-title").textContent = map === undefined ? `Point ${count(index)}` : "Ground";
  const rows = map === undefined ? aboutPoint(points as Points, result as Result, heights, index) : aboutCell(map, index);
  at("card-rows").replaceChildren(...rows.flatMap(([term, text]) => [element("dt", {}, term), element("dd", {}, text)]));
  at("card").hidden = false;
}

function unpick(): void {
  picked = undefined;
  at("card").hidden = true;
  view.mark(undefined);
}

function pick(x: number, y: number): void {
  const index = map !== undefined ? view.pickSurface(x, y) : result !== undefined ? view.pick(x, y) : undefined;
  if (index === undefined) unpick();
  else showPicked(index);
}

let pressed: { x: number; y: number } | undefined;
view.canvas.onpointerdown = ({ offsetX: x, offsetY: y, isPrimary }) => {
  pressed = isPrimary ? { x, y } : undefined;
};
view.canvas.onpointerup = ({ offsetX: x, offsetY: y }) => {
  if (pressed !== undefined && Math.hypot(x - pressed.x, y - pressed.y) < 5) pick(x, y);
  pressed = undefined;
};
at("card-close").onclick = () => {
  unpick();
  view.canvas.focus();
};

// ---- Keyboard

view.canvas.onkeydown = (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const step = 0.09;
  const shift = event.shiftKey;
  const actions: Record<string, () => void> = {
    ArrowLeft: () => (shift ? view.move(-step, 0) : view.turn(-step, 0)),
    ArrowRight: () => (shift ? view.move(step, 0) : view.turn(step, 0)),
    ArrowUp: () => (shift ? view.move(0, step) : view.turn(0, -step)),
    ArrowDown: () => (shift ? view.move(0, -step) : view.turn(0, step)),
    "+": () => view.turn(0, 0, 0.85),
    "=": () => view.turn(0, 0, 0.85),
    "-": () => view.turn(0, 0, 1 / 0.85),
    Enter: () => pick(view.canvas.clientWidth / (shared.compare === "side" ? 4 : 2), view.canvas.clientHeight / 2),
    Escape: unpick,
    "1": () => (map === undefined ? setColor("label") : setMapColor("height")),
    "2": () => (map === undefined ? setColor("height") : setMapColor("deviation")),
    "3": () => (map === undefined ? setColor("patch") : setMapColor("scans")),
    s: () => (map === undefined ? setShown("surface", !shared.surface) : at("map-ground").click()),
    p: () => (map === undefined ? setShown("points", !shared.points) : at("map-points").click()),
    t: () => view.look("top"),
    r: () => view.look("reset"),
  };
  const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (action === undefined) return;
  event.preventDefault();
  action();
};
at("look-reset").onclick = () => view.look("reset");
at("look-top").onclick = () => view.look("top");

// ---- Link

let linkTimer = 0;

function showLink(): void {
  clearTimeout(linkTimer);
  linkTimer = window.setTimeout(() => history.replaceState(null, "", toFragment(shared)), 150);
}

view.onmove = () => {
  if (points === undefined && map === undefined) return;
  shared.camera = view.camera;
  showLink();
};

addEventListener("hashchange", () => {
  const { sample } = shared;
  shared = fromFragment(location.hash);
  if (shared.camera.length === 6) view.camera = shared.camera;
  const chosen = samples.find(({ name }) => name === shared.sample);
  if (chosen !== undefined && chosen.name !== sample) openSample(chosen).catch(showFault);
  settingsChanged();
});

at("share").onclick = async () => {
  const link = new URL(toFragment(shared), location.href).href;
  history.replaceState(null, "", link);
  const button = at("share");
  try {
    await navigator.clipboard.writeText(link);
    button.textContent = "Copied";
  } catch {
    button.textContent = "In the address bar";
  }
  setTimeout(() => (button.textContent = "Copy link"), 1600);
};

// ---- Save

at("save").onclick = async () => {
  const format = at<HTMLSelectElement>("format").value;
  const stem = (points?.name ?? "scan").replace(/(\.pcd)?\.[^.]*$/, "");
  const name = { label: ".label", kitti: ".label", npy: ".labels.npy", ply: ".ground.ply", pcd: ".ground.pcd" }[format];
  try {
    const content = await engine.ask("save", {
      name: `${stem}${name}`,
      map: format === "kitti" ? "semantic-kitti" : "flagstone",
    });
    const link = element("a", { href: URL.createObjectURL(new Blob([content as BlobPart])), download: `${stem}${name}` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  } catch (error) {
    showFault(error);
  }
};

// ---- Start

showChoices();
showTheme();
startSamples().catch(showFault);
