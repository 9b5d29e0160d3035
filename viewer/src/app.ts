/** The state of the robot at the current time, which all parts of the page display and `window.groebot` returns. */

import type { Data, Motion } from "./data";
import { complete, forward, REST } from "./kinematics";
import { Reached } from "./map";
import type { Frame, Vector } from "./pose";
import { Task } from "./task";
import { at, placeOf, poseAt, type Place } from "./time";

/** The pose of the robot at a time. */
export interface Pose {
  /** The value of each revolute or prismatic joint; zero for other joints [rad or m]. */
  joints: Record<string, number>;
  /** Position and quaternion xyzw of the root in the world. */
  base: number[];
  /** The frame of each link in the world: twelve numbers by rows. */
  links: Record<string, number[]>;
}

export class App {
  /** The current place in the motion; undefined without a motion. */
  place: Place | undefined;
  values: number[] = [];
  base: number[] = REST;
  frames: Frame[] = [];
  /** The room of a recorded task. */
  readonly task: Task | undefined;
  /** The reach map of a limb. */
  readonly reached: Reached | undefined;
  /** Whether the last change of time changed the room. */
  hasNewRoom = false;
  /** Functions called after every change. */
  readonly watchers: (() => void)[] = [];
  private readonly moved = new Map<number, number>();

  constructor(readonly data: Data) {
    this.task = data.task && new Task(data.task);
    this.reached = data.reach && new Reached(data.reach);
    this.seek(data.motion?.times[0] ?? 0);
  }

  get time(): number {
    return this.place?.time ?? 0;
  }

  /** Sets the time, clamped to the motion [s]. */
  seek(time: number): void {
    const { motion, robot } = this.data;
    if (motion) {
      const place = placeOf(motion.times, time);
      this.hasNewRoom = this.task?.seek(place.time) ?? false;
      this.place = place;
      this.base = motion.base ? poseAt(motion.base, place) : REST;
      this.values = complete(robot, new Map(motion.joints.map((joint, column) => [joint, at(motion.q[column]!, place)])));
    } else {
      this.values = complete(robot, this.moved);
    }
    this.frames = forward(robot, this.values, this.base);
    this.watchers.forEach((watcher) => watcher());
  }

  /** Replaces the motion by a longer or another one; the time is unchanged. */
  grow(motion: Motion): void {
    this.data.motion = motion;
    this.seek(this.time);
  }

  /** Moves by a number of samples, forward or backward; from between two samples, first to the nearer end in that direction. */
  step(samples: number): void {
    const times = this.data.motion?.times;
    if (!times || !this.place) return;
    const from = samples < 0 && this.place.share > 0 ? this.place.sample + 1 : this.place.sample;
    this.seek(times[Math.min(Math.max(from + samples, 0), times.length - 1)]!);
  }

  /** Sets the value of a joint. */
  move(joint: number, value: number): void {
    this.moved.set(joint, value);
    this.seek(0);
  }

  /** Sets several joints: pairs of index and value. */
  moveAll(moved: [number, number][]): void {
    moved.forEach(([joint, value]) => this.moved.set(joint, value));
    this.seek(0);
  }

  /** Resets all joints. */
  rest(): void {
    this.moved.clear();
    this.seek(0);
  }

  pose(): Pose {
    const { joints, links } = this.data.robot;
    const named = <T>(items: { name: string }[], value: (place: number) => T) => Object.fromEntries(items.map(({ name }, place) => [name, value(place)]));
    return {
      joints: named(joints, (place) => this.values[place]!),
      base: [...this.base],
      links: named(links, (place) => Array.from(this.frames[place]!)),
    };
  }

  /** A point of the motion by its name; null if there is none [m]. */
  point(name: string): Vector | null {
    const found = this.data.motion?.points.find((point) => point.name === name);
    return found && this.place ? (found.at.map((track) => at(track, this.place!)) as Vector) : null;
  }

  /** A quantity of the motion by its name; null if there is none. */
  figure(name: string): number | null {
    const found = this.data.motion?.figures.find((figure) => figure.name === name);
    return found && this.place ? at(found.values, this.place) : null;
  }
}
