/** The robot at a time: what `window.groebot` tells, and what all parts of the page show. */

import type { Data, Motion } from "./data";
import { complete, forward, REST } from "./kinematics";
import { Reached } from "./map";
import type { Frame, Vector } from "./pose";
import { Task } from "./task";
import { at, placeOf, poseAt, type Place } from "./time";

/** The pose of the robot at a time. */
export interface Pose {
  /** The value of each joint that turns or slides, and of the others zero [rad or m]. */
  joints: Record<string, number>;
  /** Position and quaternion xyzw of the root in the world. */
  base: number[];
  /** The frame of each link in the world: twelve numbers by rows. */
  links: Record<string, number[]>;
}

export class App {
  /** Where the motion is; undefined without one. */
  place: Place | undefined;
  values: number[] = [];
  base: number[] = REST;
  frames: Frame[] = [];
  /** The room of a task that was done. */
  readonly task: Task | undefined;
  /** What a limb reaches. */
  readonly reached: Reached | undefined;
  /** Whether the room has become another one with the last change of time. */
  hasNewRoom = false;
  /** Hear of every change. */
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

  /** Goes to a time, held within the motion [s]. */
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

  /** Takes a motion that has become longer, or another one; stays where it is. */
  grow(motion: Motion): void {
    this.data.motion = motion;
    this.seek(this.time);
  }

  /** Goes so many samples on or back, first to the next one. */
  step(samples: number): void {
    const times = this.data.motion?.times;
    if (!times || !this.place) return;
    const from = samples < 0 && this.place.share > 0 ? this.place.sample + 1 : this.place.sample;
    this.seek(times[Math.min(Math.max(from + samples, 0), times.length - 1)]!);
  }

  /** Moves a joint by hand. */
  move(joint: number, value: number): void {
    this.moved.set(joint, value);
    this.seek(0);
  }

  /** Moves several joints by hand: pairs of their places and values. */
  moveAll(moved: [number, number][]): void {
    moved.forEach(([joint, value]) => this.moved.set(joint, value));
    this.seek(0);
  }

  /** Brings all joints back. */
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

  /** A point of the motion by its name; null where there is none [m]. */
  point(name: string): Vector | null {
    const found = this.data.motion?.points.find((point) => point.name === name);
    return found && this.place ? (found.at.map((track) => at(track, this.place!)) as Vector) : null;
  }

  /** A figure of the motion by its name; null where there is none. */
  figure(name: string): number | null {
    const found = this.data.motion?.figures.find((figure) => figure.name === name);
    return found && this.place ? at(found.values, this.place) : null;
  }
}
