/** The reach map of a limb, and the selection of its places. */

import type { Axis, Reach } from "./data";
import type { Vector } from "./pose";

export type Quantity = "share" | "answers" | "manipulability";

/** The values at a place. */
export interface Found {
  /** The number of reached orientations. */
  reached: number;
  answers: number;
  /** The share of reached orientations. */
  share: number;
  /** The mean over the reached orientations of the greatest manipulability, if it was measured. */
  manipulability?: number;
}

/** The selection of a map's places. */
export interface Choice {
  quantity: Quantity;
  /** Places with less of the quantity than this share of the greatest are not shown. */
  least: number;
  /** For each axis, the greatest shown coordinate [m]. */
  upto: Vector;
  visible: boolean;
}

/** The coordinate with this index on an axis [m]. */
export function along([from, to, count]: Axis, number: number): number {
  const share = count === 1 ? 0 : number / (count - 1);
  return from * (1 - share) + to * share;
}

/** The index on an axis of a coordinate, rounded by `round` and clamped. */
function numberAt([from, to, count]: Axis, value: number, round: (number: number) => number): number {
  const number = to > from ? round(((value - from) / (to - from)) * (count - 1)) : 0;
  return Math.min(Math.max(number, 0), count - 1);
}

/** Rounds down, with a tolerance for rounding errors. */
const floor = (number: number) => Math.floor(number + 1e-9);

export class Reached {
  readonly places: number;
  /** The number of reached places. */
  readonly reached: number;
  /** The greatest value of the selected quantity. */
  greatest = 0;
  /** The selected places. */
  chosen: number[] = [];
  /** The selected quantity of each place. */
  values: Float64Array = new Float64Array();
  choice: Readonly<Choice>;

  constructor(readonly data: Reach) {
    this.places = data.reached.length;
    this.reached = data.reached.reduce((sum, count) => sum + (count > 0 ? 1 : 0), 0);
    this.choice = { quantity: "share", least: 0, upto: data.axes.map(([, to]) => to) as Vector, visible: true };
    this.choose({});
  }

  /** The available quantities. */
  get quantities(): Quantity[] {
    return this.data.manipulability ? ["share", "answers", "manipulability"] : ["share", "answers"];
  }

  /** For each axis, the index of the last shown coordinate. */
  get last(): Vector {
    return this.choice.upto.map((upto, axis) => numberAt(this.data.axes[axis]!, upto, floor)) as Vector;
  }

  /** Changes the selection; omitted fields are unchanged. Throws the reason if a value is invalid. */
  choose(changed: Partial<Choice>): void {
    const choice = { ...this.choice, ...changed };
    const { quantity, least, upto } = choice;
    if (!this.quantities.includes(quantity)) throw new Error(`the map has no ${quantity}; it has ${this.quantities.join(", ")}`);
    if (!(least >= 0 && least <= 1)) throw new Error("`least` is a share of the greatest value, from 0 to 1");
    if (upto.length !== 3 || !upto.every((value) => typeof value === "number" && !Number.isNaN(value))) throw new Error("`upto` is three numbers: x, y and z");
    const isNew = quantity !== this.choice.quantity || this.values.length === 0;
    this.choice = { ...choice, upto: [...upto] };
    if (isNew) this.measure(quantity);
    this.chosen = choice.visible ? this.filtered() : [];
  }

  /** The values at the place nearest to a point [m]. */
  at(...point: Vector): Found {
    if (point.length !== 3 || !point.every(Number.isFinite)) throw new Error("a place is three finite numbers");
    const { axes, reached, answers, manipulability, orientations } = this.data;
    const [x, y, z] = point.map((value, axis) => numberAt(axes[axis]!, value, Math.round)) as Vector;
    const place = (x * axes[1][2] + y) * axes[2][2] + z;
    const found = { reached: reached[place]!, answers: answers[place]!, share: reached[place]! / orientations };
    return manipulability ? { ...found, manipulability: manipulability[place]! } : found;
  }

  /** The indices of a place on the axes. */
  numbers(place: number): Vector {
    const [, [, , rows], [, , layers]] = this.data.axes;
    return [Math.floor(place / (rows * layers)), Math.floor(place / layers) % rows, place % layers];
  }

  /** The coordinates of a place [m]. */
  where(place: number): Vector {
    return this.numbers(place).map((number, axis) => along(this.data.axes[axis]!, number)) as Vector;
  }

  private measure(quantity: Quantity): void {
    const { reached, answers, manipulability, orientations } = this.data;
    this.values = quantity === "manipulability" ? manipulability! : (quantity === "share" ? reached : answers).map((count) => count / orientations);
    this.greatest = this.values.reduce((greatest, value, place) => (reached[place]! > 0 ? Math.max(greatest, value) : greatest), 0);
  }

  /** The reached places with enough of the quantity and within `upto`. */
  private filtered(): number[] {
    const { axes, reached } = this.data;
    const [lastX, lastY, lastZ] = this.last;
    const [rows, layers] = [axes[1][2], axes[2][2]];
    const enough = this.choice.least * this.greatest;
    const found: number[] = [];
    for (let x = 0; x <= lastX; x++) {
      for (let y = 0; y <= lastY; y++) {
        const first = (x * rows + y) * layers;
        for (let place = first; place <= first + lastZ; place++) if (reached[place]! > 0 && this.values[place]! >= enough) found.push(place);
      }
    }
    return found;
  }
}
