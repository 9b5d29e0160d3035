/** Starts the page. `window.groebot` is for scripts and tests; docs/simulator.md tells of it. */

import { App, type Pose } from "./app";
import { inflated, read, type Data } from "./data";
import { Desk, element, message, Theme } from "./desk";
import { Picture } from "./picture";
import type { Vector } from "./pose";
import type { Solution } from "./limbs";
import { Engine } from "./engine";
import type { Choice, Found } from "./map";
import { ReachPanel } from "./reach";
import type { Furnished, Spot } from "./room";
import { Run } from "./run";
import type { Simulator } from "./simulator";
import { Solutions } from "./solutions";
import { NoPicture } from "./stage";

export interface Groebot {
  /** Settled when the robot has been drawn; rejected, with the reason, where the page cannot be shown. */
  ready: Promise<void>;
  /** Where the motion is [s]. */
  readonly time: number;
  /** Goes to a time, held within the motion [s]; between two samples values lie on the line between theirs. */
  seek(time: number): void;
  /** Joint values, the root's pose and the frames of all links. */
  pose(): Pose;
  /** The zero moment point [m]; null where the motion has none. */
  zmp(): Vector | null;
  /** How far it is within the support polygon [m]; null where the motion does not tell. */
  margin(): number | null;
  /** Where a point of the room is on the screen [m, pixels]; null without a picture. */
  screen(point: Vector): [number, number] | null;
  /** The limbs whose solutions are shown. */
  readonly limbs: string[];
  /** Brings the tip of a limb to a target in the frame of its base: position [m], then the rotation by rows; the robot takes the nearest solution. */
  drag(limb: string, numbers: number[]): void;
  /** All solutions of the last target. */
  solutions(): Solution[];
  /** Joint values along the self-motion of a solution, by its place, within limits; none where no joint is free. */
  self_motion(place: number): number[][];
  /** How long they took, without drawing [ms]. */
  readonly update_ms: number;
  /** What the limb reaches; null without a map. */
  readonly reach: Reaching | null;
  /** The figures of the gait by their names; null where the gait has none. */
  readonly parameters: Record<string, number | null>;
  /** Another value of a figure from the next step on; throws the reason where it cannot be walked. */
  set(name: string, value: number): void;
  /** Another goal, with where to look there if that is asked for [m, rad]; throws the reason where it cannot be. */
  goal(x: number, y: number, heading?: number): void;
  /** A piece of furniture elsewhere [m, rad], or without it; throws the reason where it cannot be. */
  furniture(name: string, at: Spot | null): void;
  /** Takes the next step. */
  step(): "step" | "arrived";
  /** The corners of the way [m]; null where there is none. */
  way(): [number, number][] | null;
  /** Where the goal and the furniture are now [m, rad]. */
  room(): { goal: number[]; furniture: Record<string, Spot> };
  /** What has been walked, as crates/robot/src/motion/table.rs says. */
  csv(): string;
  /** How long the last replanning took [ms]. */
  readonly replan_ms: number;
}

/** A map of what a limb reaches. */
export interface Reaching {
  /** How many places it has. */
  readonly places: number;
  /** How many of them are shown: reached, with enough of the quantity, not beyond, and the map visible. */
  readonly shown: number;
  /** The greatest value of the quantity. */
  readonly greatest: number;
  /**
   * Shows others; what is not told stays. `quantity` is `share`, `answers` or `manipulability`, `least` a share of the greatest, `upto` x, y and z in the frame of the
   * limb's base [m]. Throws the reason where that cannot be.
   */
  show(told: Partial<Choice>): void;
  /** What was found at the place that is nearest to a point in the frame of the limb's base [m]. */
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

/** The run of a page, ready at its start: its motion is the page's. */
function begun(data: Data, engine: Engine | undefined): Run {
  if (!engine) throw new Error("This browser runs no WebAssembly, by which the robot walks");
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
    message("No picture here", "This browser gives the page no WebGL, by which the robot is drawn. Joint values, plots and the timeline work.");
  }
  const solutions = Solutions.start(app, picture, engine);
  const reach = ReachPanel.start(app, picture);
  const { simulator } = new Desk(app, picture, theme, solutions, run);
  if (picture && !picture.isSeen) message("Nothing to see", `The robot ${app.data.robot.name} has no shape, and no joint away from another one.`);
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
  if (!started) throw new Error("nothing is shown yet, or ever: wait for ready");
  return started.app;
};
const running = (): { run: Run; simulator: Simulator } => {
  const { run, simulator } = started ?? {};
  if (!run || !simulator) throw new Error("nobody walks through a room in this page");
  return { run, simulator };
};
const furnished = (): Furnished => shown().task ?? running().run;
const solved = (): Solutions => {
  if (!started?.solutions) throw new Error("this page has no limb that is solved");
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
  solutions: () => solved().solutions.map((solution) => ({ ...solution, q: [...solution.q] })),
  self_motion: (place) => solved().selfMotion(place),
  get update_ms() {
    return solved().updateMs;
  },
  get reach() {
    return started?.reach ?? null;
  },
  get parameters() {
    return Object.fromEntries(running().run.told.figures.map(({ name, value }) => [name, value]));
  },
  set: (name, value) => running().simulator.set(name, value),
  goal: (x, y, heading) => running().run.setGoal(heading === undefined ? [x, y] : [x, y, heading]),
  furniture: (name, at) => running().run.furnish(name, at),
  step: () => (running().simulator.step() ? "arrived" : "step"),
  way: () => furnished().told.way,
  room: () => ({ goal: [...furnished().goal], furniture: Object.fromEntries(furnished().told.furniture.map(({ name, at }) => [name, [...at] as Spot])) }),
  csv: () => running().run.csv(),
  get replan_ms() {
    return running().run.replanMs;
  },
};
