/** Starts the page. `window.groebot` is for scripts and tests; docs/simulator.md describes it. */

import { App, type Pose } from "./app";
import { inflated, read, type Data } from "./data";
import { UserInterface, element, message, Theme } from "./user_interface";
import { Picture } from "./picture";
import type { Vector } from "./pose";
import type { Solution } from "./limb_solver";
import { Engine } from "./engine";
import type { Choice, Found } from "./map";
import { ReachPanel } from "./reach";
import type { Furnished, Spot } from "./room";
import { Run } from "./run";
import type { Simulator } from "./simulator";
import { Solutions } from "./solutions";
import { NoPicture } from "./stage";

export interface Groebot {
  /** Resolved when the robot has been drawn; rejected with the reason if the page cannot be shown. */
  ready: Promise<void>;
  /** The current time [s]. */
  readonly time: number;
  /** Sets the time, clamped to the motion [s]; values are interpolated linearly between samples. */
  seek(time: number): void;
  /** Joint values, the root's pose and the frames of all links. */
  pose(): Pose;
  /** The zero moment point [m]; null if the motion has none. */
  zmp(): Vector | null;
  /** Distance of the zero moment point inside the support polygon [m]; null if the motion does not contain it. */
  margin(): number | null;
  /** The position of a point on the screen [m, pixels]; null without WebGL. */
  screen(point: Vector): [number, number] | null;
  /** The limbs whose solutions are shown. */
  readonly limbs: string[];
  /** Moves the tip of a limb to a target in the frame of its base: position [m], then the rotation by rows. The robot takes the nearest solution. */
  drag(limb: string, numbers: number[]): void;
  /** All solutions of the last target; of a redundant limb, one solution of each arc. */
  solutions(): Solution[];
  /** The outcome of the last target as text, with the reason if there is no solution. */
  readonly outcome: string;
  /** Joint values along the self-motion of the solution with this index, within limits; empty if no joint is free. Of a redundant limb, along the arc. */
  self_motion(place: number): number[][];
  /** Moves the robot along the arc with this index, to a distance from its start [rad]. */
  slide(place: number, s: number): void;
  /** Time to compute the solutions, without drawing [ms]. */
  readonly update_ms: number;
  /** The reach map of the limb; null without a map. */
  readonly reach: Reaching | null;
  /** The parameters of the gait by their names; null if the gait does not have one. */
  readonly parameters: Record<string, number | null>;
  /** Sets a parameter from the next step on; throws the reason if it is infeasible. */
  set(name: string, value: number): void;
  /** Sets the goal, with an optional heading [m, rad]; throws the reason if it is refused. */
  goal(x: number, y: number, heading?: number): void;
  /** Moves a piece of furniture [m, rad], or removes it; throws the reason if it is refused. */
  furniture(name: string, at: Spot | null): void;
  /** Takes the next step. */
  step(): "step" | "arrived";
  /** The corners of the path [m]; null if there is none. */
  path(): [number, number][] | null;
  /** The current poses of the goal and the furniture [m, rad]. */
  room(): { goal: number[]; furniture: Record<string, Spot> };
  /** The walk so far as CSV, in the format of crates/robot/src/motion/table.rs. */
  csv(): string;
  /** Duration of the last replanning [ms]. */
  readonly replan_ms: number;
}

/** A reach map. */
export interface Reaching {
  /** The number of places. */
  readonly places: number;
  /** The number of shown places: reached, with enough of the quantity, within `upto`, while the map is visible. */
  readonly shown: number;
  /** The greatest value of the quantity. */
  readonly greatest: number;
  /**
   * Changes the selection; omitted fields are unchanged. `quantity` is `share`, `answers` or `manipulability`, `least` a share of the
   * greatest, `upto` x, y and z in the frame of the limb's base [m]. Throws the reason if a value is invalid.
   */
  show(changed: Partial<Choice>): void;
  /** The values at the place nearest to a point in the frame of the limb's base [m]. */
  at(x: number, y: number, z: number): Found;
}

declare global {
  interface Window {
    groebot: Groebot;
  }
}

interface Started {
  app: App;
  picture: Picture | undefined;
  solutions: Solutions | undefined;
  reach: ReachPanel | undefined;
  run: Run | undefined;
  simulator: Simulator | undefined;
}

/** The run of a page, at its start. Its motion is that of the page. */
function begun(data: Data, engine: Engine | undefined): Run {
  if (!engine) throw new Error("This browser has no WebAssembly, which the simulator needs");
  const run = new Run(engine, data.robot, data.run!);
  data.motion = run.motion;
  return run;
}

async function start(): Promise<Started> {
  // The theme is created before the picture, which uses its colours.
  const theme = new Theme();
  const data = await read(element("groebot-data").textContent ?? "");
  const engine = data.wasm ? await Engine.start(await inflated(data.wasm)).catch(() => undefined) : undefined;
  const run = data.run && begun(data, engine);
  const app = new App(data);
  let picture: Picture | undefined;
  try {
    picture = new Picture(element<HTMLCanvasElement>("canvas"), app);
  } catch (error) {
    if (!(error instanceof NoPicture)) throw error;
    element("canvas").hidden = true;
    message("No picture", "This browser has no WebGL, which draws the robot. Joint values, plots and the timeline work.");
  }
  const solutions = Solutions.start(app, picture, engine);
  const reach = ReachPanel.start(app, picture);
  const { simulator } = new UserInterface(app, picture, theme, solutions, run);
  if (picture && !picture.isSeen) message("Nothing to see", `The robot ${app.data.robot.name} has no shapes, and all its joints are at one point.`);
  return { app, picture, solutions, reach, run, simulator };
}

let started: Started | undefined;
const ready = start().then(
  (begun) => {
    started = begun;
    // The timer runs after the next frame is on the screen.
    return new Promise<void>((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  },
  (error: unknown) => {
    const reason = error instanceof Error ? error.message : String(error);
    for (const useless of document.querySelectorAll<HTMLElement>("#canvas, #dock, nav")) useless.hidden = true;
    message("This page cannot be shown", `${reason}. Write it anew by groebot view.`);
    throw error;
  },
);
ready.catch(() => {});

const shown = (): App => {
  if (!started) throw new Error("the page is not ready: wait for `groebot.ready`");
  return started.app;
};
const running = (): { run: Run; simulator: Simulator } => {
  const { run, simulator } = started ?? {};
  if (!run || !simulator) throw new Error("this page has no simulator");
  return { run, simulator };
};
const furnished = (): Furnished => shown().task ?? running().run;
const solved = (): Solutions => {
  if (!started?.solutions) throw new Error("this page has no limb with a solver");
  return started.solutions;
};

window.groebot = {
  ready,
  get time() {
    return shown().time;
  },
  seek: (time) => shown().seek(time),
  pose: () => shown().pose(),
  zmp: () => shown().point("zmp"),
  margin: () => shown().figure("margin"),
  screen: (point) => started?.picture?.onScreen(point) ?? null,
  get limbs() {
    return started?.solutions?.names ?? [];
  },
  drag: (limb, numbers) => solved().drag(limb, numbers),
  solutions: () => solved().solutions.map((solution) => structuredClone(solution)),
  get outcome() {
    return solved().outcome;
  },
  self_motion: (place) => solved().selfMotion(place),
  slide: (place, s) => solved().slide(place, s),
  get update_ms() {
    return solved().updateMs;
  },
  get reach() {
    return started?.reach ?? null;
  },
  get parameters() {
    return Object.fromEntries(running().run.state.figures.map(({ name, value }) => [name, value]));
  },
  set: (name, value) => running().simulator.set(name, value),
  goal: (x, y, heading) => running().run.setGoal(heading === undefined ? [x, y] : [x, y, heading]),
  furniture: (name, at) => running().run.furnish(name, at),
  step: () => (running().simulator.step() ? "arrived" : "step"),
  path: () => furnished().state.path,
  room: () => ({ goal: [...furnished().goal], furniture: Object.fromEntries(furnished().state.furniture.map(({ name, at }) => [name, [...at] as Spot])) }),
  csv: () => running().run.csv(),
  get replan_ms() {
    return running().run.replanMs;
  },
};
