/** The reach map in three dimensions: a box at each selected place. */

import { BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Vector3 } from "three";
import type { Axis } from "./data";
import { matrix } from "./body";
import type { Reached } from "./map";
import type { Frame, Vector } from "./pose";

/** Colours from least to greatest: viridis of matplotlib, as in crates/ik/src/reach/drawing.rs. */
export const VIRIDIS = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
] as const;
/** The maximum number of boxes. */
const MOST = 100_000;
/** The sides of a box, and its thickness normal to a flat map, in steps of the grid. */
const [SIDE, THIN] = [0.5, 0.06];
/** The corners of a box by their signs, and its triangles, anticlockwise from outside. */
const CORNERS: Vector[] = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]];
const TRIANGLES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
/** Steps of the evenly spread sequence R3 (M. Roberts, 2018): powers of the inverse of the root of x^4 = x + 1. */
const SPREAD = [0.8191725133961645, 0.6710436067037893, 0.5497004779019703] as const;

const VERTEX = `
  attribute vec3 middle;
  attribute float share;
  uniform vec3 colours[9];
  varying vec3 place;
  varying vec3 tone;
  void main() {
    int first = min(int(8.0 * share), 7);
    tone = mix(colours[first], colours[first + 1], 8.0 * share - float(first));
    place = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(middle + position, 1.0);
  }`;
/** The upper faces have the colours of the legend and the others darker ones, independent of the light. */
const FRAGMENT = `
  varying vec3 place;
  varying vec3 tone;
  void main() {
    vec3 across = normalize(cross(dFdx(place), dFdy(place)));
    float bright = abs(across.x) > 0.6 ? 0.87 : abs(across.y) > 0.6 ? 0.78 : across.z > 0.0 ? 1.0 : 0.7;
    gl_FragColor = vec4(bright * tone, 1.0);
  }`;

export class Cloud {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly most: number;
  private readonly middles: InstancedBufferAttribute;
  private readonly shares: InstancedBufferAttribute;

  /** `size` is that of the robot [m]. */
  constructor(private readonly map: Reached, size: number) {
    this.most = Math.max(Math.min(map.reached, MOST), 1);
    const half = sides(map.data.axes, size).map((side) => side / 2);
    const corners = Float32Array.from(CORNERS.flatMap((signs) => signs.map((sign, axis) => sign * half[axis]!)));
    this.middles = new InstancedBufferAttribute(new Float32Array(3 * this.most), 3);
    this.shares = new InstancedBufferAttribute(new Float32Array(this.most), 1);
    const boxes = new InstancedBufferGeometry().setIndex(TRIANGLES);
    boxes.setAttribute("position", new BufferAttribute(corners, 3)).setAttribute("middle", this.middles).setAttribute("share", this.shares);
    const colours = { value: VIRIDIS.map((colour) => new Vector3(...colour).divideScalar(255)) };
    this.mesh = new Mesh(boxes, new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { colours } }));
    this.mesh.matrixAutoUpdate = false;
    this.mesh.frustumCulled = false;
    this.fill();
  }

  /** The number of drawn boxes. */
  get drawn(): number {
    return this.mesh.geometry.instanceCount;
  }

  /** Moves with the link in whose frame the map is. */
  show(frames: Frame[]): void {
    this.mesh.matrix.copy(matrix(frames[this.map.data.base]!));
    this.mesh.matrixWorldNeedsUpdate = true;
  }

  /** Draws a box at each selected place, or, if there are too many, at an evenly spread subset. */
  fill(): void {
    const { chosen, values, greatest } = this.map;
    // Points are spread evenly, so their number differs slightly from the requested one.
    const part = chosen.length > this.most ? (0.99 * this.most) / chosen.length : 1;
    let box = 0;
    for (const place of chosen) {
      if (box === this.most) break;
      if (part < 1 && spread(this.map.numbers(place)) >= part) continue;
      this.middles.setXYZ(box, ...this.map.where(place));
      this.shares.setX(box, greatest > 0 ? values[place]! / greatest : 0);
      box += 1;
    }
    this.middles.needsUpdate = this.shares.needsUpdate = true;
    this.mesh.geometry.instanceCount = box;
  }
}

/** A number from 0 to 1 for each place. The places with numbers below any share are evenly spread. */
function spread(numbers: Vector): number {
  const sum = numbers.reduce((sum, number, axis) => sum + number * SPREAD[axis]!, 0);
  return sum - Math.floor(sum);
}

/** The sides of a box [m]. */
function sides(axes: Axis[], size: number): Vector {
  const steps = axes.map(([from, to, count]) => (count > 1 ? (to - from) / (count - 1) : 0));
  const least = Math.min(...steps.filter((step) => step > 0), 0.05 * size);
  const isFlat = steps.filter((step) => step === 0).length === 1;
  return steps.map((step) => (step > 0 ? SIDE * step : (isFlat ? THIN : SIDE) * least)) as Vector;
}
