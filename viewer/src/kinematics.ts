/** Forward kinematics. */

import type { Joint, Robot } from "./data";
import { fromPose, multiply, shift, turn, type Frame } from "./pose";

export const REST = [0, 0, 0, 0, 0, 0, 1];

/** Whether the joint has one degree of freedom. */
export const moves = ({ kind }: Joint): boolean => kind === "revolute" || kind === "continuous" || kind === "prismatic";

/** `rad` or `m`. */
export const unit = ({ kind }: Joint): string => (kind === "prismatic" ? "m" : "rad");

/** The values of all joints: those of `given`, those of joints that follow them, and for others the value nearest to zero within the limits. */
export function complete(robot: Robot, given: Map<number, number>): number[] {
  const own = robot.joints.map((joint, place) => given.get(place) ?? nearest(0, joint));
  return robot.joints.map(({ follows }, place) =>
    follows && !given.has(place) ? follows.factor * own[follows.joint]! + follows.offset : own[place]!,
  );
}

/** The value within the limits of a joint that is nearest to `value`. */
export function nearest(value: number, { limits }: Joint): number {
  return limits ? Math.min(Math.max(value, limits[0]), limits[1]) : value;
}

/** The frames of all links in the world, for the values of all joints and the pose of the root. */
export function forward(robot: Robot, values: ArrayLike<number>, base: number[]): Frame[] {
  const frames: Frame[] = [];
  frames[robot.base] = fromPose(base);
  robot.joints.forEach((joint, place) => {
    const resting = multiply(frames[joint.parent]!, joint.origin);
    const value = values[place]!;
    if (!moves(joint)) frames[joint.child] = resting;
    else frames[joint.child] = multiply(resting, joint.kind === "prismatic" ? shift(joint.axis, value) : turn(joint.axis, value));
  });
  return frames;
}
