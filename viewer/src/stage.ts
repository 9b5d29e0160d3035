/** Renderer, light, floor, grid and axes. It draws only after changes. */

import {
  AxesHelper, Color, DirectionalLight, Group, HemisphereLight, Mesh, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Scene, ShaderMaterial,
  ShadowMaterial, Vector2, Vector3, WebGLRenderer,
} from "three";

/** A colour of the style sheet in the current theme, mixed with that of the ground by `faint`, from 0 to 1. */
export function colour(name: string, faint = 0): Color {
  const style = getComputedStyle(document.documentElement);
  const [own, ground] = [name, "scene"].map((each) => new Color(style.getPropertyValue(`--${each}`).trim())) as [Color, Color];
  return own.lerp(ground, faint);
}

const GRID_VERTEX = `
  varying vec2 place;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xy;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;
const GRID_FRAGMENT = `
  varying vec2 place;
  uniform vec2 middle;
  uniform float cell;
  uniform float reach;
  uniform vec3 fine;
  uniform vec3 coarse;
  float lines(vec2 at) {
    vec2 width = fwidth(at);
    vec2 away = abs(fract(at - 0.5) - 0.5) / width;
    vec2 seen = clamp(1.0 - away, 0.0, 1.0) * clamp(1.0 - 2.0 * width, 0.0, 1.0);
    return max(seen.x, seen.y);
  }
  void main() {
    float wide = lines(place / (5.0 * cell));
    float fade = 1.0 - smoothstep(0.25 * reach, reach, distance(place, middle));
    gl_FragColor = vec4(mix(fine, coarse, wide), max(lines(place / cell), wide) * fade);
    #include <colorspace_fragment>
  }`;

/** A round length near `length`: 1, 2 or 5 times a power of ten. */
export function roundLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * (length / power < 1.5 ? 1 : length / power < 3.5 ? 2 : length / power < 7.5 ? 5 : 10);
}

/** The browser has no WebGL. */
export class NoPicture extends Error {}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  readonly axes = new Group();
  /** The side of a cell of the grid [m]. */
  readonly cell: number;
  private readonly renderer: WebGLRenderer;
  private readonly sky = new HemisphereLight(0xffffff, 0xffffff, 1.6);
  private readonly sun = new DirectionalLight(0xffffff, 1.9);
  private readonly grid: Mesh<PlaneGeometry, ShaderMaterial>;
  private readonly shade: Mesh<PlaneGeometry, ShadowMaterial>;
  private isRequested = false;
  private covered: [number, number] = [0, 0];

  /** Throws NoPicture if the browser has no WebGL. `size` is that of the robot, `floor` the height of the floor [m]. */
  constructor(canvas: HTMLCanvasElement, private readonly size: number, floor: number) {
    try {
      this.renderer = new WebGLRenderer({ canvas, antialias: true });
    } catch {
      throw new NoPicture();
    }
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.cell = roundLength(size / 5);
    const uniforms = {
      middle: { value: new Vector3() }, cell: { value: this.cell }, reach: { value: 7 * size },
      fine: { value: new Color() }, coarse: { value: new Color() },
    };
    const material = new ShaderMaterial({ vertexShader: GRID_VERTEX, fragmentShader: GRID_FRAGMENT, uniforms, transparent: true, depthWrite: false });
    this.grid = new Mesh(new PlaneGeometry(14 * size, 14 * size), material);
    this.shade = new Mesh(new PlaneGeometry(4 * size, 4 * size), new ShadowMaterial({ opacity: 0.16, depthWrite: false }));
    this.shade.receiveShadow = true;
    for (const [order, mesh] of [this.grid, this.shade].entries()) {
      mesh.position.z = floor;
      mesh.renderOrder = order - 10;
    }
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 5;
    const { camera: lens } = this.sun.shadow;
    [lens.left, lens.right, lens.bottom, lens.top, lens.near, lens.far] = [-size, size, -size, size, 0.1 * size, 6 * size];
    const arrows = new AxesHelper(this.cell);
    arrows.position.z = floor + 0.001 * size;
    this.axes.add(arrows);
    this.camera.up.set(0, 0, 1);
    [this.camera.near, this.camera.far] = [0.01 * size, 60 * size];
    this.scene.add(this.sky, this.sun, this.sun.target, this.grid, this.shade, this.axes);
    this.moveTo([0, 0, 0]);
    this.paint();
  }

  /** Applies the colours of the theme. */
  paint(): void {
    this.renderer.setClearColor(colour("scene"));
    this.sky.groundColor.copy(colour("ground-light"));
    this.grid.material.uniforms["fine"]!.value.copy(colour("grid-fine"));
    this.grid.material.uniforms["coarse"]!.value.copy(colour("grid-coarse"));
    this.shade.material.opacity = Number(getComputedStyle(document.documentElement).getPropertyValue("--shade"));
    this.draw();
  }

  /** Moves light, shadow and grid to the robot. */
  moveTo([x, y, z]: [number, number, number]): void {
    this.sun.target.position.set(x, y, z);
    this.sun.position.set(x + 1.1 * this.size, y - 1.4 * this.size, z + 2.6 * this.size);
    this.grid.position.setX(x).setY(y);
    this.shade.position.setX(x).setY(y);
    this.grid.material.uniforms["middle"]!.value.set(x, y, 0);
  }

  /** Adapts the picture to the size of the canvas. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement;
    const { x, y } = this.renderer.getSize(new Vector2());
    if (width === 0 || height === 0 || (x === width && y === height)) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.keepClear(...this.covered);
  }

  /** Moves the middle of the picture to the middle of the uncovered part; `top` and `bottom` are covered [pixels]. */
  keepClear(top: number, bottom: number): void {
    this.covered = [top, bottom];
    const { x: width, y: height } = this.renderer.getSize(new Vector2());
    this.camera.setViewOffset(width, height, 0, 0.5 * (bottom - top), width, height);
    this.draw();
  }

  /** The uncovered share of the picture's height. */
  get clear(): number {
    const { y: height } = this.renderer.getSize(new Vector2());
    return Math.max(1 - (this.covered[0] + this.covered[1]) / height, 0.3);
  }

  /** The position of a point on the screen [pixels]. */
  onScreen(point: [number, number, number]): [number, number] {
    const { left, top, width, height } = this.renderer.domElement.getBoundingClientRect();
    // A frame that is still to be drawn would do this.
    this.camera.updateMatrixWorld();
    const { x, y } = new Vector3(...point).project(this.camera);
    return [left + (0.5 + 0.5 * x) * width, top + (0.5 - 0.5 * y) * height];
  }

  /** Requests drawing in the next animation frame. */
  draw(): void {
    if (this.isRequested) return;
    this.isRequested = true;
    requestAnimationFrame(() => {
      this.isRequested = false;
      this.renderer.render(this.scene, this.camera);
    });
  }

}
