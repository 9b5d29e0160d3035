/** Starts the page. `window.groebot` is for scripts and tests; docs/simulator.md tells of it. */

import { App, type Pose } from "./app";
import { read } from "./data";
import { Desk, element, message, Theme } from "./desk";
import { Picture } from "./picture";
import type { Vector } from "./pose";
import type { Solution } from "./limbs";
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
  /** The limbs whose solutions are shown. */
  readonly limbs: string[];
  /** Brings the tip of a limb to a target in the frame of its base: position [m], then the rotation by rows; the robot takes the nearest solution. */
  drag(limb: string, numbers: number[]): void;
  /** Where the target is on the screen [pixels]; null without a picture. */
  target(): [number, number] | null;
  /** All solutions of the last target. */
  solutions(): Solution[];
  /** How long they took, without drawing [ms]. */
  readonly update_ms: number;
}

declare global {
  interface Window {
    groebot: Groebot;
  }
}

interface Started {
  app: App;
  solutions: Solutions | undefined;
}

async function start(): Promise<Started> {
  // The theme comes before the picture, which takes its colours.
  const theme = new Theme();
  const app = new App(await read(element("groebot-data").textContent ?? ""));
  let picture: Picture | undefined;
  try {
    picture = new Picture(element<HTMLCanvasElement>("canvas"), app);
  } catch (error) {
    if (!(error instanceof NoPicture)) throw error;
    element("canvas").hidden = true;
    message("No picture here", "This browser gives the page no WebGL, by which the robot is drawn. Joint values, plots and the timeline work.");
  }
  const solutions = await Solutions.start(app, picture);
  new Desk(app, picture, theme, solutions);
  if (picture && !picture.isSeen) message("Nothing to see", `The robot ${app.data.robot.name} has no shape, and no joint away from another one.`);
  return { app, solutions };
}

let started: Started | undefined;
const ready = start().then(
  (begun) => {
    started = begun;
    // What the next frame draws is on the screen behind it.
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
  get limbs() {
    return started?.solutions?.names ?? [];
  },
  drag: (limb, numbers) => solved().drag(limb, numbers),
  target: () => solved().target,
  solutions: () => solved().solutions.map((solution) => ({ ...solution, q: [...solution.q] })),
  get update_ms() {
    return solved().updateMs;
  },
};
