/** What a limb reaches in the picture: a box at each place that is chosen. */

import { BoxGeometry, BufferAttribute, Color, InstancedBufferAttribute, InstancedMesh, Matrix4, MeshBasicMaterial, Vector3 } from "three";
import type { Axis } from "./data";
import { matrix } from "./body";
import { along, type Reached } from "./map";
import type { Frame, Vector } from "./pose";

/** From least to greatest: viridis of matplotlib, as src/reach/drawing.rs has it. */
export const VIRIDIS = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
] as const;
/** So many colours are told apart. */
const SHADES = 256;
/** The most boxes that are drawn. */
const MOST = 100_000;
/** The sides of a box, and how thin it is across a map that is flat, in steps of the grid. */
const [SIDE, THIN] = [0.5, 0.06];
/** How bright the faces across x, y and z are, those ahead and those behind. The upper one has the colour of the legend. */
const FACES = [0.74, 0.74, 0.58, 0.58, 1, 0.45];
/** Steps of the evenly spread sequence R3 (M. Roberts, 2018): powers of the inverse of the root of x^4 = x + 1. */
const SPREAD = [0.8191725133961645, 0.6710436067037893, 0.5497004779019703] as const;

export class Cloud {
  readonly mesh: InstancedMesh<BoxGeometry, MeshBasicMaterial>;
  private readonly most: number;
  private readonly colours: InstancedBufferAttribute;
  private readonly shades = new Float32Array(3 * SHADES);

  /** `size` is that of the robot [m]. */
  constructor(private readonly map: Reached, size: number) {
    const geometry = new BoxGeometry(...sides(map.data.axes, size));
    geometry.setAttribute("color", new BufferAttribute(Float32Array.from({ length: 72 }, (_, place) => FACES[Math.floor(place / 12)]!), 3));
    this.most = Math.max(Math.min(map.reached, MOST), 1);
    // Colours are those of the legend: no light changes them.
    this.mesh = new InstancedMesh(geometry, new MeshBasicMaterial({ vertexColors: true }), this.most);
    this.mesh.instanceColor = this.colours = new InstancedBufferAttribute(new Float32Array(3 * this.most), 3);
    this.mesh.matrixAutoUpdate = false;
    this.mesh.frustumCulled = false;
    const upright = new Matrix4();
    for (let box = 0; box < this.most; box++) this.mesh.setMatrixAt(box, upright);
    for (let shade = 0; shade < SHADES; shade++) viridis(shade / (SHADES - 1)).toArray(this.shades, 3 * shade);
    this.fill();
  }

  /** How many boxes are drawn. */
  get drawn(): number {
    return this.mesh.count;
  }

  /** Where the boxes are, from a point of the room [m]. */
  places(from: Vector): Vector3[] {
    const { array } = this.mesh.instanceMatrix;
    const origin = new Vector3(...from);
    return Array.from({ length: this.drawn }, (_, box) => new Vector3().fromArray(array, 16 * box + 12).applyMatrix4(this.mesh.matrix).sub(origin));
  }

  /** Goes with the link in whose frame the map is. */
  show(frames: Frame[]): void {
    this.mesh.matrix.copy(matrix(frames[this.map.data.base]!));
    this.mesh.matrixWorldNeedsUpdate = true;
  }

  /** Draws a box at each place that is chosen, or where these are too many at some of them, evenly spread. */
  fill(): void {
    const { chosen, values, greatest, data } = this.map;
    const places = data.axes.map((axis) => Float64Array.from({ length: axis[2] }, (_, number) => along(axis, number)));
    const { instanceMatrix } = this.mesh;
    // Spread evenly they are a few more or less than asked for.
    const share = chosen.length > this.most ? (0.99 * this.most) / chosen.length : 1;
    let box = 0;
    for (const place of chosen) {
      const numbers = this.map.numbers(place);
      if ((share < 1 && spread(numbers) >= share) || box === this.most) continue;
      const shade = 3 * Math.round((SHADES - 1) * (greatest > 0 ? values[place]! / greatest : 0));
      for (let axis = 0; axis < 3; axis++) {
        instanceMatrix.array[16 * box + 12 + axis] = places[axis]![numbers[axis]!]!;
        this.colours.array[3 * box + axis] = this.shades[shade + axis]!;
      }
      box += 1;
    }
    this.mesh.count = box;
    instanceMatrix.needsUpdate = this.colours.needsUpdate = true;
  }
}

/** A number from 0 to 1 for each place, spread so evenly that those below a share are so, too. */
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

/** The colour at a share of the way from the first to the last. */
function viridis(share: number): Color {
  const at = share * (VIRIDIS.length - 1);
  const first = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const [red, green, blue] = VIRIDIS[first]!.map((from, part) => (from + (VIRIDIS[first + 1]![part]! - from) * (at - first)) / 255) as Vector;
  return new Color().setRGB(red, green, blue, "srgb");
}
