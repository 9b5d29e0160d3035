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
  /** The branch number, which is continuous from target to target. */
  branch: number;
  /** The largest residual of the equations, in their own unit. */
  residual: number;
  /** Whether all joints are within their limits, and which are not. */
  within: boolean;
  outside: string[];
  /** Joints that are free at this singular pose: each of their values has a solution with other values of the remaining joints. */
  free: string[];
}

interface Answer {
  solutions: { q: number[]; branch: number; residual: number; free: number[] }[];
}

/** Tolerance of joint limits [rad or m]. */
const ROUNDING = 1e-9;
/** Step of a free joint [rad or m]. */
const FREE = { turns: Math.PI / 6, slides: 0.05 };

export class LimbSolver {
  readonly solutions: Solution[] = [];
  /** For each solution, the frames of all links. */
  readonly frames: Frame[][] = [];
  /** The target: the frame of the tip in that of the base [m]. */
  target: Frame;
  /** Duration of the last update, without drawing [ms]. */
  updateMs = 0;
  private readonly solver: number;

  constructor(private readonly engine: Engine, private readonly app: App, readonly limb: Limb) {
    const opened = engine.request<{ solver: number; inputs: string[] }>({ open: limb.program });
    if (opened.inputs.length !== 12) throw new Error(`${limb.name} is not solved for a pose of its tip`);
    this.solver = opened.solver;
    this.target = this.reached();
  }

  /** The frame of the tip in that of the base. */
  reached(frames = this.app.frames): Frame {
    return multiply(inverse(frames[this.limb.base]!), frames[this.limb.tip]!);
  }

  /** Solves for a target frame. */
  solve(target: Frame): void {
    const started = performance.now();
    this.target = target;
    const at = (place: number) => target[place]! / this.limb.metres;
    const numbers = [at(3), at(7), at(11), ...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((place) => target[place]!)];
    const { solutions } = this.engine.request<Answer>({ solve: { solver: this.solver, target: numbers } });
    const { joints } = this;
    this.solutions.length = this.frames.length = 0;
    for (const { q, branch, residual, free } of solutions) {
      const values = q.map((value, place) => (joints[place]!.kind === "prismatic" ? value * this.limb.metres : value));
      const outside = this.outside(values);
      this.solutions.push({ q: values, branch, residual, within: outside.length === 0, outside, free: free.map((place) => joints[place]!.name) });
      this.frames.push(this.framesOf(values));
    }
    this.updateMs = performance.now() - started;
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

  /** Joint values along the self-motion of the first free joint of a solution, within limits; empty if no joint is free. */
  selfMotion(place: number): number[][] {
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

  private get joints(): Joint[] {
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
