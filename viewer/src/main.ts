/** Starts the page. `window.groebot` is for scripts and tests; docs/simulator.md tells of it. */

import { App, type Pose } from "./app";
import { read } from "./data";
import { Desk, element, message, Theme } from "./desk";
import { Picture } from "./picture";
import type { Vector } from "./pose";
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
}

declare global {
  interface Window {
    groebot: Groebot;
  }
}

async function start(): Promise<App> {
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
  new Desk(app, picture, theme);
  if (picture && !picture.isSeen) message("Nothing to see", `The robot ${app.data.robot.name} has no shape, and no joint away from another one.`);
  return app;
}

let app: App | undefined;
const ready = start().then(
  (started) => {
    app = started;
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
  if (!app) throw new Error("nothing is shown yet, or ever: wait for ready");
  return app;
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
};
