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
  Raycaster,
  Scene,
  ShaderMaterial,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { palettes, type Theme } from "./colors";
import type { Position } from "./messages";

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

const discVertexShader = `
  uniform float size;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = size;
  }`;

/** Discs of a size in pixels, with a hole of a part of the radius. */
function discs(size: number, hole: number): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: discVertexShader,
    fragmentShader: `
      uniform vec3 color;
      void main() {
        float away = 2.0 * length(gl_PointCoord - 0.5);
        if (away > 1.0 || away < ${hole.toFixed(2)}) discard;
        gl_FragColor = vec4(color, 1.0);
      }`,
    uniforms: { size: { value: size }, color: { value: new Color() } },
  });
}

/** The surface. Contour lines are `contour` metres apart; 0: none. */
function surfaceMaterial(contour: { value: number }): MeshLambertMaterial {
  const material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1 });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.contour = contour;
    shader.vertexShader = `varying float level;\n${shader.vertexShader.replace("#include <begin_vertex>", "#include <begin_vertex>\nlevel = position.z;")}`;
    shader.fragmentShader = `varying float level;\nuniform float contour;\n${shader.fragmentShader.replace(
      "#include <dithering_fragment>",
      `if (contour > 0.0) {
        float at = level / contour;
        float away = abs(fract(at - 0.5) - 0.5);
        gl_FragColor.rgb *= mix(0.6, 1.0, smoothstep(0.0, 1.5 * fwidth(at), away));
      }`,
    )}`;
  };
  return material;
}

/**
 * Draws the points, the surface, a marked point, and the path and moving objects of a map. It draws only when something
 * changed, and a frame neither allocates nor uploads anything: one draw call per cloud.
 */
export class View {
  readonly #renderer: WebGLRenderer;
  readonly #camera = new PerspectiveCamera(50, 1, 0.1, 2000);
  readonly #controls: OrbitControls;
  readonly #scene = new Scene();
  readonly #material = new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { size: { value: 60 } } });
  /** The result, and the compared one. Both share the positions. */
  readonly #points = [this.#newPoints(), this.#newPoints()] as const;
  readonly #contour = { value: 0 };
  readonly #mesh = new Mesh(new BufferGeometry(), surfaceMaterial(this.#contour));
  readonly #marker = new Points(
    new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(3), 3)),
    discs(18, 0.6),
  );
  readonly #path = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 3 }));
  readonly #objects = new Points(new BufferGeometry(), discs(4, 0));
  readonly #raycaster = new Raycaster();
  #grid: GridHelper | undefined;
  #positions: Float32Array = new Float32Array();
  #sideBySide = false;
  #requested = false;
  #scale = 1;
  #home = homeOfScan(-1.73);
  onmove: () => void = () => {};

  constructor(readonly canvas: HTMLCanvasElement) {
    // With small pixels, antialiasing is not visible, and it costs four times the memory and time of a frame.
    this.#renderer = new WebGLRenderer({ canvas, antialias: devicePixelRatio < 2, powerPreference: "high-performance" });
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
    const light = new HemisphereLight(0xffffff, 0x8090a0, 0.7);
    this.#scene.add(...this.#points, this.#mesh, this.#marker, this.#path, this.#objects, sun, light);
    for (const object of [this.#mesh, this.#marker, this.#path, this.#objects]) {
      object.visible = false;
      object.frustumCulled = false;
    }
    // In front of everything.
    for (const object of [this.#marker, this.#path]) {
      object.material.depthTest = false;
      object.renderOrder = 1;
    }
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

  setSurface(geometry: BufferGeometry | undefined, contour = 0): void {
    this.#mesh.geometry.dispose();
    this.#mesh.geometry = geometry ?? new BufferGeometry();
    this.#mesh.visible = geometry !== undefined;
    this.#contour.value = contour;
    this.draw();
  }

  /** The path of a run, pairs of positions, and the moving objects in it. Empty: none. */
  setRun(path: Float32Array, objects: Float32Array, theme: Theme): void {
    this.#path.geometry.dispose();
    this.#path.geometry = new LineSegmentsGeometry();
    this.#path.visible = path.length > 0;
    if (path.length > 0) this.#path.geometry.setPositions(path);
    this.#objects.geometry.dispose();
    this.#objects.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(objects, 3));
    this.#objects.visible = objects.length > 0;
    this.#path.material.color.set(palettes[theme].path);
    setColor(this.#objects.material, palettes[theme].moving);
    this.draw();
  }

  /** Metres per unit of the scan. */
  setScale(scale: number): void {
    this.#scale = scale;
    for (const object of [...this.#points, this.#mesh, this.#marker]) object.scale.setScalar(scale);
  }

  setTheme(theme: Theme): void {
    this.#scene.background = new Color(palettes[theme].background);
    setColor(this.#marker.material, theme === "dark" ? "#ffffff" : "#101318");
    if (this.#grid !== undefined) this.#scene.remove(this.#grid);
    this.#grid?.dispose();
    this.#grid = new GridHelper(200, 20, palettes[theme].grid, palettes[theme].grid);
    this.#grid.rotateX(Math.PI / 2);
    this.#scene.add(this.#grid);
    this.draw();
  }

  /** A scan: the views are around the sensor, and a grid is below the ground. */
  setHomeOfScan(ground: number): void {
    this.#home = homeOfScan(ground);
    this.#setReach(600);
    this.#grid!.visible = true;
    this.#grid!.position.z = ground - 0.6;
    this.draw();
  }

  /** A map: the views show all of it, with its longer side along the longer side of the canvas. */
  setHomeOfMap(center: Position, width: number, height: number): void {
    const target = new Vector3(...center);
    const { clientWidth, clientHeight } = this.canvas;
    const turned = width > height !== clientWidth > clientHeight;
    const [across, up] = turned ? [height, width] : [width, height];
    const half = Math.max((across * clientHeight) / Math.max(clientWidth, 1), up, 20) / 2;
    const distance = (1.1 * half) / Math.tan(((this.#camera.fov / 2) * Math.PI) / 180);
    const from = (right: number, back: number, z: number) =>
      new Vector3(turned ? -back : right, turned ? -right : -back, z).normalize().multiplyScalar(distance).add(target);
    this.#home = { reset: { target, position: from(-0.1, 0.6, 0.8) }, top: { target, position: from(0, 1e-4, 1) } };
    this.#setReach(Math.max(600, 3 * distance));
    this.#grid!.visible = false;
    this.draw();
  }

  #setReach(metres: number): void {
    this.#controls.maxDistance = metres;
    this.#camera.far = 3 * metres;
  }

  /** Marks a position of the scan or map. */
  mark(position: ArrayLike<number> | undefined): void {
    this.#marker.visible = position !== undefined;
    if (position !== undefined) {
      const attribute = this.#marker.geometry.getAttribute("position") as BufferAttribute;
      attribute.array.set(position);
      attribute.needsUpdate = true;
    }
    this.draw();
  }

  look(from: "reset" | "top"): void {
    const { target, position } = this.#home[from];
    this.#controls.target.copy(target);
    this.#camera.position.copy(position);
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

  /** The corner of the surface nearest to a position on the canvas. */
  pickSurface(x: number, y: number): number | undefined {
    const { clientWidth, clientHeight } = this.canvas;
    this.#aim(clientWidth / clientHeight);
    this.#raycaster.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.#camera);
    const [hit] = this.#raycaster.intersectObject(this.#mesh);
    if (!hit?.face) return undefined;
    const corners = this.#mesh.geometry.getAttribute("position") as BufferAttribute;
    const away = (corner: number) => new Vector3().fromBufferAttribute(corners, corner).distanceTo(hit.point);
    const { a, b, c } = hit.face;
    return [a, b, c].sort((one, two) => away(one) - away(two))[0];
  }

  draw(): void {
    if (this.#requested) return;
    this.#requested = true;
    requestAnimationFrame(this.#drawNow);
  }

  #aim(aspect: number): void {
    this.#camera.aspect = aspect;
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }

  readonly #drawNow = (): void => {
    this.#requested = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const ratio = this.#renderer.getPixelRatio();
    if (this.canvas.width !== Math.floor(width * ratio) || this.canvas.height !== Math.floor(height * ratio)) {
      this.#renderer.setSize(width, height, false);
    }
    this.#material.uniforms.size.value = 60 * ratio;
    this.#marker.material.uniforms.size.value = 18 * ratio;
    this.#objects.material.uniforms.size.value = 4 * ratio;
    const halves = this.#sideBySide ? 2 : 1;
    this.#renderer.setScissorTest(halves === 2);
    this.#aim(width / halves / height);
    for (let half = 0; half < halves; ++half) {
      const left = (half * width) / halves;
      this.#renderer.setViewport(left, 0, width / halves, height);
      this.#renderer.setScissor(left, 0, width / halves, height);
      for (let index = 0; index < 2; ++index) {
        const points = this.#points[index];
        points.visible = index === half && points.geometry.getAttribute("tint") !== undefined;
      }
      this.#renderer.render(this.#scene, this.#camera);
    }
  };
}

/** Above and behind the sensor, or straight down on it. */
function homeOfScan(ground: number): Record<"reset" | "top", { target: Vector3; position: Vector3 }> {
  return {
    reset: { target: new Vector3(4, 0, ground), position: new Vector3(-21, 9, 15) },
    top: { target: new Vector3(0, 0, ground), position: new Vector3(-0.01, 0, 75) },
  };
}

function setColor(material: ShaderMaterial, color: string): void {
  (material.uniforms.color.value as Color).set(color).convertLinearToSRGB();
}
