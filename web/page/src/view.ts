// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  GridHelper,
  HemisphereLight,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Points,
  Scene,
  ShaderMaterial,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { palettes, type Theme } from "./colors";

const vertexShader = `
  attribute vec4 tint;
  varying vec3 shade;
  uniform float size;
  void main() {
    shade = tint.rgb;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    gl_Position = tint.a < 0.5 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * seen;
    gl_PointSize = clamp(size / max(-seen.z, 0.1), 1.6 * size / 60.0, 8.0 * size / 60.0);
  }`;
const fragmentShader = `
  varying vec3 shade;
  void main() { gl_FragColor = vec4(shade, 1.0); }`;

/** Draws the points, the surface and a marked point. It draws only when something changed. */
export class View {
  readonly #renderer: WebGLRenderer;
  readonly #camera = new PerspectiveCamera(50, 1, 0.1, 2000);
  readonly #controls: OrbitControls;
  readonly #scene = new Scene();
  readonly #material = new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { size: { value: 60 } } });
  /** The result, and the compared one. Both share the positions. */
  readonly #points = [this.#newPoints(), this.#newPoints()] as const;
  readonly #mesh = new Mesh(
    new BufferGeometry(),
    new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1 }),
  );
  readonly #marker = new Points(
    new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(3), 3)),
    new ShaderMaterial({
      vertexShader: `
        uniform float size;
        void main() {
          gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
          gl_PointSize = size;
        }`,
      fragmentShader: `
        uniform vec3 color;
        void main() {
          float away = length(gl_PointCoord - 0.5);
          if (away > 0.5 || away < 0.3) discard;
          gl_FragColor = vec4(color, 1.0);
        }`,
      uniforms: { size: { value: 18 }, color: { value: new Color() } },
      depthTest: false,
    }),
  );
  #grid: GridHelper | undefined;
  #positions: Float32Array = new Float32Array();
  #sideBySide = false;
  #requested = false;
  #ground = -1.73;
  #scale = 1;
  onmove: () => void = () => {};

  constructor(readonly canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.maxPolarAngle = Math.PI * 0.499 + 0.35;
    this.#controls.maxDistance = 600;
    this.#controls.zoomToCursor = true;
    this.#controls.addEventListener("change", () => {
      this.draw();
      this.onmove();
    });
    const sun = new DirectionalLight(0xffffff, 2.4);
    sun.position.set(-1, 1, 0.9);
    this.#scene.add(...this.#points, this.#mesh, this.#marker, sun, new HemisphereLight(0xffffff, 0x8090a0, 0.7));
    this.#mesh.visible = false;
    this.#marker.visible = false;
    this.#marker.frustumCulled = false;
    this.#marker.renderOrder = 1;
    this.look("reset");
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  #newPoints(): Points<BufferGeometry, ShaderMaterial> {
    const points = new Points(new BufferGeometry(), this.#material);
    points.frustumCulled = false;
    points.visible = false;
    return points;
  }

  setPositions(positions: Float32Array): void {
    this.#positions = positions;
    const attribute = new BufferAttribute(positions, 3);
    for (const points of this.#points) {
      points.geometry.dispose();
      points.geometry = new BufferGeometry().setAttribute("position", attribute);
      points.visible = false;
    }
    this.mark(undefined);
  }

  /** Colours of the result, and of the compared one for a second half. */
  setColors(colors: Uint8Array, compared?: Uint8Array): void {
    [colors, compared].forEach((each, index) => {
      const { geometry } = this.#points[index];
      if (each === undefined) return;
      const attribute = geometry.getAttribute("tint") as BufferAttribute | undefined;
      if (attribute?.array.length === each.length) {
        attribute.array.set(each);
        attribute.needsUpdate = true;
      } else {
        geometry.setAttribute("tint", new BufferAttribute(each, 4, true));
      }
    });
    this.#sideBySide = compared !== undefined;
    this.#controls.zoomToCursor = !this.#sideBySide; // the cursor is in one half only
    this.draw();
  }

  setSurface(geometry: BufferGeometry | undefined): void {
    this.#mesh.geometry.dispose();
    this.#mesh.geometry = geometry ?? new BufferGeometry();
    this.#mesh.visible = geometry !== undefined;
    this.draw();
  }

  /** Metres per unit of the scan. */
  setScale(scale: number): void {
    this.#scale = scale;
    for (const object of [...this.#points, this.#mesh, this.#marker]) object.scale.setScalar(scale);
  }

  setGround(height: number, theme: Theme): void {
    this.#ground = height;
    if (this.#grid !== undefined) {
      this.#scene.remove(this.#grid);
      this.#grid.dispose();
    }
    this.#grid = new GridHelper(200, 20, palettes[theme].grid, palettes[theme].grid);
    this.#grid.rotateX(Math.PI / 2);
    this.#grid.position.z = height - 0.6;
    this.#scene.add(this.#grid);
    this.#scene.background = new Color(palettes[theme].background);
    const marker = this.#marker.material as ShaderMaterial;
    (marker.uniforms.color.value as Color).set(theme === "dark" ? "#ffffff" : "#101318").convertLinearToSRGB();
    this.draw();
  }

  /** Marks a point by its index. */
  mark(index: number | undefined): void {
    this.#marker.visible = index !== undefined;
    if (index !== undefined) {
      const attribute = this.#marker.geometry.getAttribute("position") as BufferAttribute;
      attribute.array.set(this.#positions.subarray(3 * index, 3 * index + 3));
      attribute.needsUpdate = true;
    }
    this.draw();
  }

  look(from: "reset" | "top"): void {
    const target = new Vector3(from === "top" ? 0 : 4, 0, this.#ground);
    this.#controls.target.copy(target);
    if (from === "top") this.#camera.position.set(-0.01, 0, 75);
    else this.#camera.position.set(-21, 9, 15);
    this.#controls.update();
    this.draw();
  }

  /** Turns and zooms, for the keyboard: angles in radians, the factor multiplies the distance. */
  turn(around: number, up: number, factor = 1): void {
    const offset = this.#camera.position.clone().sub(this.#controls.target);
    const distance = Math.min(Math.max(offset.length() * factor, 2), 500);
    const polar = Math.min(Math.max(Math.acos(offset.z / offset.length()) + up, 0.01), 1.75);
    const azimuth = Math.atan2(offset.y, offset.x) + around;
    offset.set(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar));
    this.#camera.position.copy(this.#controls.target).addScaledVector(offset, distance);
    this.#controls.update();
  }

  /** Moves the view, in parts of the distance: right, and forward. */
  move(right: number, forward: number): void {
    const { target } = this.#controls;
    const ahead = target.clone().sub(this.#camera.position).setZ(0);
    const distance = this.#camera.position.distanceTo(target);
    ahead.normalize();
    const step = ahead.clone().multiplyScalar(forward * distance);
    step.add(new Vector3(ahead.y, -ahead.x, 0).multiplyScalar(right * distance));
    target.add(step);
    this.#camera.position.add(step);
    this.#controls.update();
  }

  /** Position and target of the camera, in decimetres. */
  get camera(): number[] {
    return [...this.#camera.position.toArray(), ...this.#controls.target.toArray()].map((x) => Math.round(x * 10));
  }

  set camera(decimetres: number[]) {
    const [x, y, z, tx, ty, tz] = decimetres.map((value) => value / 10);
    this.#camera.position.set(x, y, z);
    this.#controls.target.set(tx, ty, tz);
    this.#controls.update();
  }

  /** The nearest visible point within 12 pixels of a position on the canvas; of several, the one in front. */
  pick(x: number, y: number): number | undefined {
    const { clientWidth, clientHeight } = this.canvas;
    const width = this.#sideBySide ? clientWidth / 2 : clientWidth;
    const second = this.#sideBySide && x > width;
    this.#aim(width / clientHeight);
    const matrix = this.#camera.projectionMatrix.clone().multiply(this.#camera.matrixWorldInverse).elements;
    const tints = this.#points[second ? 1 : 0].geometry.getAttribute("tint")?.array;
    if (tints === undefined) return undefined;
    const column = second ? x - width : x;
    let found: number | undefined;
    let least = Infinity;
    for (let i = 0; i < this.#positions.length / 3; ++i) {
      if (tints[4 * i + 3] === 0) continue;
      const px = this.#positions[3 * i] * this.#scale;
      const py = this.#positions[3 * i + 1] * this.#scale;
      const pz = this.#positions[3 * i + 2] * this.#scale;
      const w = matrix[3] * px + matrix[7] * py + matrix[11] * pz + matrix[15];
      if (!(w > 0.1)) continue;
      const dx = ((matrix[0] * px + matrix[4] * py + matrix[8] * pz + matrix[12]) / w + 1) * 0.5 * width - column;
      const dy = (1 - (matrix[1] * px + matrix[5] * py + matrix[9] * pz + matrix[13]) / w) * 0.5 * clientHeight - y;
      const away = Math.hypot(dx, dy);
      // 1 pixel counts as 2 % of the distance.
      if (away <= 12 && w * (1 + 0.02 * away) < least) {
        least = w * (1 + 0.02 * away);
        found = i;
      }
    }
    return found;
  }

  draw(): void {
    if (this.#requested) return;
    this.#requested = true;
    requestAnimationFrame(() => {
      this.#requested = false;
      this.#drawNow();
    });
  }

  #aim(aspect: number): void {
    this.#camera.aspect = aspect;
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }

  #drawNow(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const ratio = this.#renderer.getPixelRatio();
    if (this.canvas.width !== Math.floor(width * ratio) || this.canvas.height !== Math.floor(height * ratio)) {
      this.#renderer.setSize(width, height, false);
    }
    this.#material.uniforms.size.value = 60 * ratio;
    (this.#marker.material as ShaderMaterial).uniforms.size.value = 18 * ratio;
    const halves = this.#sideBySide ? 2 : 1;
    this.#renderer.setScissorTest(halves === 2);
    this.#aim(width / halves / height);
    for (let half = 0; half < halves; ++half) {
      const left = (half * width) / halves;
      this.#renderer.setViewport(left, 0, width / halves, height);
      this.#renderer.setScissor(left, 0, width / halves, height);
      this.#points.forEach((points, index) => {
        points.visible = index === half && points.geometry.getAttribute("tint") !== undefined;
      });
      this.#renderer.render(this.#scene, this.#camera);
    }
  }
}
