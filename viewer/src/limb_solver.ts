/** All solutions of a limb for a target, with the frames of the links. */

import type { App } from "./app";
import type { Joint, Limb } from "./data";
import type { Engine } from "./engine";
import { complete, forward } from "./kinematics";
import { inverse, multiply, type Frame } from "./pose";
import { selfMotion } from "./selfmotion";

/** A solution, as `groebot.solutions()` returns it. */
export interface Solution {
  /** Joint values in the solver's order [rad or m]. */
  q: number[];
  /** The branch number, which is continuous from target to target; of a redundant limb the number of the arc. */
  branch: number;
  /** The largest residual of the equations, in their own unit. */
  residual: number;
  /** Whether all joints are within their limits, and which are not. */
  within: boolean;
  outside: string[];
  /** Joints that are free at this singular pose: each of their values has a solution with other values of the remaining joints. */
  free: string[];
  /** The arc that contains the solution; only of a redundant limb. */
  arc?: Arc;
}

/** A curve of solutions within limits. Lengths are in the space of joint values: rad, where lengths are relative to the size of the limb. */
export interface Arc {
  /** Its start and its end: joint values, and a text such as `A3 at its lower limit`, which is empty for closed curves and where the end is not known. */
  ends: [ArcEnd, ArcEnd];
  length: number;
  closed: boolean;
  /** Whether something about it was not decided. */
  unsure: boolean;
  /** Distance of the solution from the start. */
  s: number;
}

export interface ArcEnd {
  q: number[];
  limit: string;
}

interface Point {
  q: number[];
  residual: number;
}

interface Arcs {
  arcs: (Arc & Point)[];
  /** Why there is no solution within limits. */
  reason: string | null;
  unsure: boolean;
  surface: boolean;
}

/** Tolerance of joint limits [rad or m]. */
const ROUNDING = 1e-9;
/** Step of a free joint [rad or m]. */
const FREE = { turns: Math.PI / 6, slides: 0.05 };
/** The copies along arcs: greatest number on all arcs and on one arc, and least distance [rad]. */
const COPIES = { all: 48, arc: 9, spacing: 0.3 };
/** The share of its range at which a joint of a redundant limb is first; in the middle many are singular, too. */
const FIRST = 0.35;

export class LimbSolver {
  readonly solutions: Solution[] = [];
  /** For each solution, the frames of all links. */
  readonly frames: Frame[][] = [];
  /** The target: the frame of the tip in that of the base [m]. */
  target: Frame;
  /** Duration of the last update, without drawing [ms]. */
  updateMs = 0;
  /** Whether the limb has one joint more than its target determines: its solutions are arcs. */
  readonly isRedundant: boolean;
  /** The outcome of the last target, as text. */
  outcome = "";
  private readonly solver: number;
  /** For each arc, joint values along it. */
  private readonly samples: number[][][] = [];

  constructor(private readonly engine: Engine, private readonly app: App, readonly limb: Limb) {
    const opened = engine.request<{ solver: number; inputs: string[]; redundant: boolean }>({ open: limb.program });
    if (opened.inputs.length !== 12) throw new Error(`${limb.name} is not solved for a pose of its tip`);
    [this.solver, this.isRedundant] = [opened.solver, opened.redundant];
    this.target = this.reached();
  }

  /** Moves a redundant limb from zero, where many are singular. */
  start(): void {
    const first = ({ limits: [low, high] = [-Math.PI, Math.PI] }: Joint) => low + FIRST * (high - low);
    if (this.isRedundant) this.app.moveAll(this.joints.map((joint, place) => [this.limb.joints[place]!, first(joint)]));
  }

  /** The frame of the tip in that of the base. */
  reached(frames = this.app.frames): Frame {
    return multiply(inverse(frames[this.limb.base]!), frames[this.limb.tip]!);
  }

  /** Solves for a target frame. */
  solve(target: Frame): void {
    const started = performance.now();
    this.target = target;
    this.solutions.length = this.frames.length = this.samples.length = 0;
    const at = (place: number) => target[place]! / this.limb.metres;
    const numbers = [at(3), at(7), at(11), ...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((place) => target[place]!)];
    if (this.isRedundant) this.solveArcs(numbers);
    else this.solveAll(numbers);
    this.updateMs = performance.now() - started;
  }

  /** The solutions of a limb that is not redundant. */
  private solveAll(target: number[]): void {
    const { solutions } = this.engine.request<{ solutions: (Point & { branch: number; free: number[] })[] }>({ solve: { solver: this.solver, target } });
    for (const { q, branch, residual, free } of solutions) {
      const values = this.metric(q);
      const outside = this.outside(values);
      this.solutions.push({ q: values, branch, residual, within: outside.length === 0, outside, free: free.map((place) => this.joints[place]!.name) });
      this.frames.push(this.framesOf(values));
    }
    const within = this.solutions.filter((solution) => solution.within).length;
    const count = `${solutions.length} ${solutions.length === 1 ? "solution" : "solutions"}`;
    this.outcome = solutions.length === 0 ? "Out of reach: no solution" : `${count}, ${within} within limits`;
  }

  /** The arcs of a redundant limb, each with its solution that is nearest to the robot's joint values. */
  private solveArcs(target: number[]): void {
    const near = this.metric(this.limb.joints.map((joint) => this.app.values[joint]!), 1 / this.limb.metres);
    const { arcs, reason, unsure, surface } = this.engine.request<Arcs>({ arcs: { solver: this.solver, target, near } });
    const most = Math.max(3, Math.min(COPIES.arc, Math.floor(COPIES.all / arcs.length)));
    for (const [place, { q, residual, ends: [start, end], ...arc }] of arcs.entries()) {
      const ends: [ArcEnd, ArcEnd] = [{ ...start, q: this.metric(start.q) }, { ...end, q: this.metric(end.q) }];
      const values = this.metric(q);
      this.solutions.push({ q: values, branch: place + 1, residual, within: true, outside: [], free: [], arc: { ...arc, ends } });
      this.frames.push(this.framesOf(values));
      const count = Math.min(most, 1 + Math.ceil(arc.length / COPIES.spacing));
      const distances = Array.from({ length: count }, (_, k) => (k * arc.length) / (arc.closed ? count : Math.max(count - 1, 1)));
      this.samples.push(this.points(place, distances).map((point) => point.q));
    }
    const count = `${arcs.length} ${arcs.length === 1 ? "arc" : "arcs"} of solutions within limits`;
    const found = surface ? "The solutions are a surface; one of them is shown" : count;
    const doubt = unsure ? ". Unsure: other solutions within limits may exist" : "";
    this.outcome = (reason === null ? found : `No solution within limits: ${reason}`) + doubt;
  }

  /** Moves a solution along its arc, to a distance from the start. */
  slide(place: number, s: number): void {
    const solution = this.solutions[place];
    if (!solution?.arc) throw new Error(`there is no arc ${place}; there are ${this.samples.length}`);
    if (!Number.isFinite(s)) throw new Error("a distance is a finite number");
    solution.arc.s = Math.min(Math.max(s, 0), solution.arc.length);
    Object.assign(solution, this.points(place, [s])[0]);
    this.frames[place] = this.framesOf(solution.q);
  }

  /** Solutions at distances from the start of an arc. */
  private points(arc: number, distances: number[]): Point[] {
    const { points } = this.engine.request<{ points: Point[] }>({ points: { solver: this.solver, arc, distances } });
    return points.map(({ q, residual }) => ({ q: this.metric(q), residual }));
  }

  /** Joint values with lengths in metres, from those of the solver. */
  private metric(q: number[], metres = this.limb.metres): number[] {
    return q.map((value, place) => (this.joints[place]!.kind === "prismatic" ? value * metres : value));
  }

  /** The index of the solution nearest to the robot's joint values, preferably within limits; -1 without solutions. */
  nearest(): number {
    const away = ({ q, within }: Solution) => {
      const turns = q.map((value, place) => Math.abs(Math.sin((value - this.app.values[this.limb.joints[place]!]!) / 2)));
      return Math.max(...turns) + (within ? 0 : 10);
    };
    let best = -1;
    this.solutions.forEach((solution, place) => {
      if (best < 0 || away(solution) < away(this.solutions[best]!)) best = place;
    });
    return best;
  }

  /** Joint values along an arc, or along the self-motion of the first free joint of a solution within limits; empty if no joint is free. */
  selfMotion(place: number): number[][] {
    if (this.isRedundant) return this.samples[place] ?? [];
    const solution = this.solutions[place];
    const free = this.joints.findIndex(({ name }) => name === solution?.free[0]);
    if (!solution || free < 0) return [];
    const step = this.joints[free]!.kind === "prismatic" ? FREE.slides : FREE.turns;
    return selfMotion((q) => this.reached(this.framesOf(q)), solution.q, free, step, (q) => this.outside(q).length === 0);
  }

  /** The frames of all links at the limb's joint values. */
  framesOf(q: number[]): Frame[] {
    return forward(this.app.data.robot, this.valuesOf(q), this.app.base);
  }

  get joints(): Joint[] {
    return this.limb.joints.map((place) => this.app.data.robot.joints[place]!);
  }

  /** The names of the joints that are beyond their limits. */
  private outside(q: number[]): string[] {
    const isOutside = ({ limits }: Joint, value: number) => limits !== undefined && (value < limits[0] - ROUNDING || value > limits[1] + ROUNDING);
    return this.joints.filter((joint, place) => isOutside(joint, q[place]!)).map(({ name }) => name);
  }

  private valuesOf(q: number[]): number[] {
    const given = new Map(this.app.values.map((value, place) => [place, value]));
    for (const [place, joint] of this.app.data.robot.joints.entries()) if (joint.follows) given.delete(place);
    this.limb.joints.forEach((joint, place) => given.set(joint, q[place]!));
    return complete(this.app.data.robot, given);
  }
}
