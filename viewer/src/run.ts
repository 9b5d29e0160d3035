/** A robot that walks through a room while its goal, the furniture and the parameters of its gait change. */

import type { Contact, Motion, Polygon, Robot, RunData, Scene } from "./data";
import type { Engine } from "./engine";
import type { Furnished, Spot } from "./room";

/** A parameter of the gait. */
export interface Figure {
  name: string;
  what: string;
  unit: string;
  /** Null if the gait does not have it. */
  value: number | null;
}

/** A preset from the thesis, in the order of the run's parameters. */
export interface Preset {
  name: string;
  values: number[];
}

interface Sample {
  time: number;
  q: number[];
  torso: number[];
  soles: [number[], number[]];
  stands: [boolean, boolean];
  com: number[];
  zmp: number[];
  margin: number;
  support: [number, number][];
}

interface Walked {
  samples: Sample[];
  steps: Motion["steps"];
  arrived?: boolean;
}

interface RunState extends Walked {
  joints: string[];
  outlines: [[number, number][], [number, number][]];
  figures: Figure[];
  presets: Preset[];
  path: [number, number][] | null;
  blocked?: string;
  enclosure?: [number, number][];
  furniture: { name: string; at: Spot }[];
}

const SIDES = ["left", "right"] as const;
const PLACE = ["x", "y", "heading"] as const;

/** A growing column of numbers: appending takes amortised constant time, and earlier views stay valid. */
class Column {
  private held = new Float64Array(512);
  private count = 0;

  push(value: number): void {
    if (this.count === this.held.length) {
      const before = this.held;
      this.held = new Float64Array(2 * before.length);
      this.held.set(before);
    }
    this.held[this.count++] = value;
  }

  get view(): Float64Array {
    return this.held.subarray(0, this.count);
  }
}

/** The values of a sample, one for each track: time, joints, torso, soles, centre of mass, zero moment point, margin. */
function row({ time, q, torso, soles, com, zmp, margin }: Sample): number[] {
  return [time, ...q, ...torso, ...soles.flat(), ...com, ...zmp, 0, margin];
}

/** Throws an Error if a value is not a finite number. */
function check(values: readonly number[], names: readonly string[]): void {
  const place = values.findIndex((value) => !Number.isFinite(value));
  if (place >= 0) throw new Error(`give a number for ${names[place]}`);
}

export class Run implements Furnished {
  /** The last response, without its samples. */
  state!: RunState;
  /** The motion so far. */
  motion!: Motion;
  goal: number[] = [];
  hasArrived = false;
  /** Duration of the last replanning [ms]. */
  replanMs = 0;
  /** Functions called after new samples and new plans. */
  readonly watchers: (() => void)[] = [];
  private samples: Sample[] = [];
  private columns: Column[] = [];
  private stands: [string, string] = ["", ""];
  private support: Polygon[] = [];

  constructor(private readonly engine: Engine, private readonly robot: Robot, readonly data: RunData) {
    this.begin();
  }

  get scene(): Scene {
    return this.data.scene;
  }

  /** Restarts the run in its initial state. */
  begin(): void {
    const { robot, room, start, goal, apart } = this.data;
    [this.samples, this.columns, this.stands, this.support] = [[], [], ["", ""], []];
    this.goal = [...goal];
    this.take(this.engine.request({ run: { robot, room, start, goal, apart } }));
  }

  /** Takes the next step. Returns whether the robot has arrived. Throws an Error with the reason if it is infeasible. */
  step(): boolean {
    const walked = this.engine.request<Walked>("step");
    this.hasArrived = walked.arrived === true;
    if (!this.hasArrived) this.grow(walked);
    this.notify();
    return this.hasArrived;
  }

  setGoal(goal: number[]): void {
    check(goal, PLACE);
    this.replan({ goal });
    this.goal = goal;
    this.notify();
  }

  /** Moves a piece of furniture; null removes it. */
  furnish(name: string, at: Spot | null): void {
    if (at) check(at, PLACE);
    this.replan({ furniture: { name, at } });
    this.notify();
  }

  set(name: string, value: number): void {
    check([value], [name]);
    this.replan({ set: { name, value } });
    this.notify();
  }

  /** The walk as CSV, in the format of crates/robot/src/motion/table.rs. */
  csv(): string {
    const pose = (name: string) => ["x [m]", "y [m]", "z [m]", "qx [1]", "qy [1]", "qz [1]", "qw [1]"].map((end) => `${name}_${end}`);
    const point = (name: string) => ["x", "y", "z"].map((end) => `${name}_${end} [m]`);
    const names = ["time [s]", ...this.state.joints.map((joint) => `q:${joint} [rad]`), ...pose("base")];
    for (const side of SIDES) names.push(...pose(side), `${side}_stands [1]`);
    names.push(...point("com"), ...point("zmp"), "margin [m]");
    const row = ({ time, q, torso, soles, stands, com, zmp, margin }: Sample) => {
      const feet = soles.flatMap((sole, side) => [...sole, stands[side] ? 1 : 0]);
      return [time, ...q, ...torso, ...feet, ...com, ...zmp, 0, margin].map((value) => value.toFixed(9)).join(",");
    };
    return `# groebot trajectory 1\n# robot: ${this.robot.name}\n${names.join(",")}\n${this.samples.map(row).join("\n")}\n`;
  }

  private replan(request: unknown): void {
    const started = performance.now();
    const state = this.engine.request<RunState>(request);
    this.replanMs = performance.now() - started;
    this.take(state);
  }

  private take(state: RunState): void {
    this.state = { ...state, path: state.path ?? null };
    this.hasArrived = false;
    this.grow(state);
  }

  private notify(): void {
    this.watchers.forEach((watcher) => watcher());
  }

  private grow({ samples, steps }: Walked): void {
    if (samples.length === 0 && this.samples.length > 0) return;
    samples.forEach((sample) => this.append(sample));
    const views = this.columns.map(({ view }) => view);
    const next = (width: number) => views.splice(0, width);
    const contact = (side: 0 | 1): Contact => ({ name: SIDES[side], poses: next(7), stands: this.stands[side], outline: this.state.outlines[side] });
    // In the order of `row`.
    this.motion = {
      times: next(1)[0]!,
      joints: this.state.joints.map((name) => this.robot.joints.findIndex((joint) => joint.name === name)),
      q: next(this.state.joints.length),
      base: next(7),
      contacts: [contact(0), contact(1)],
      points: [{ name: "com", at: next(3) }, { name: "zmp", at: next(3) }],
      figures: [{ name: "margin", unit: "m", values: next(1)[0]! }],
      support: this.support,
      steps,
      phases: [],
    };
  }

  private append(sample: Sample): void {
    this.samples.push(sample);
    row(sample).forEach((value, place) => (this.columns[place] ??= new Column()).push(value));
    sample.stands.forEach((stands, side) => (this.stands[side] += stands ? "1" : "0"));
    this.support.push(Float64Array.from(sample.support.flat()));
  }
}
