/** The user interface: title, buttons, keys, timeline, messages, and texts for screen readers. */

import type { App } from "./app";
import { VIEW_NAMES, type View } from "./camera";
import { moves } from "./kinematics";
import { Plots } from "./plots";
import type { Picture } from "./picture";
import { Player } from "./player";
import type { Run } from "./run";
import { Simulator } from "./simulator";
import { Sliders } from "./sliders";
import type { Solutions } from "./solutions";
import { nearestSample, phaseAt } from "./time";
import { displayName, number, phaseName, quantity } from "./format";

const KEYS: [string, string][] = [
  ["Space", "play, pause"],
  ["\u2190 \u2192", "previous, next sample; with Shift ten samples"],
  ["Home End", "first, last sample"],
  ["1 \u2013 5", "front, side, top, iso, follow"],
  ["J", "joints"],
  ["S, M, R", "solutions, reach map, simulator, if the page has them"],
  ["T", "dark, light"],
  ["?", "this help"],
];
const PLAY = '<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M4.500 2.8v10.4L13 8z" fill="currentColor"/></svg>';
const PAUSE = '<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M4 3h3v10H4zM9 3h3v10H9z" fill="currentColor"/></svg>';
const PANELS = ["joints", "reach", "solutions", "run"] as const;
type Panel = (typeof PANELS)[number];
/** Minimum interval between announcements of the screen reader [ms]. */
const ANNOUNCE_EVERY = 700;

export function element<E extends HTMLElement>(id: string): E {
  return document.getElementById(id) as E;
}

/** Shows a message over the picture. */
export function message(head: string, text: string): void {
  const box = element("message");
  box.replaceChildren(textElement("strong", head), text);
  box.hidden = false;
}

/** The theme. It follows the system until the user switches it. */
export class Theme {
  /** Functions called after every change. */
  readonly watchers: (() => void)[] = [];
  private readonly system = matchMedia("(prefers-color-scheme: dark)");
  private chosen: boolean | undefined;

  constructor() {
    this.apply();
    this.system.addEventListener("change", () => this.apply());
  }

  toggle(): void {
    this.chosen = !this.isDark;
    this.apply();
  }

  private get isDark(): boolean {
    return this.chosen ?? this.system.matches;
  }

  private apply(): void {
    document.documentElement.dataset["theme"] = this.isDark ? "dark" : "light";
    this.watchers.forEach((watcher) => watcher());
  }
}

export class UserInterface {
  private readonly player: Player;
  private plots: Plots | undefined;
  private readonly sliders: Sliders;
  private announcement: number | undefined;
  /** The simulator; undefined if the page has none. */
  readonly simulator: Simulator | undefined;

  constructor(
    private readonly app: App,
    private readonly picture: Picture | undefined,
    private readonly theme: Theme,
    private readonly solutions?: Solutions,
    run?: Run,
  ) {
    const { motion, robot } = app.data;
    this.player = new Player(app, () => this.showPlaying());
    element("dock").hidden = !motion;
    this.plots = this.makePlots();
    if (run) this.simulator = this.simulate(run);
    this.sliders = new Sliders(element("joints"), robot, motion ? undefined : (joint, value) => this.move(joint, value));
    theme.watchers.push(() => {
      picture?.paint();
      this.plots?.paint();
    });
    this.writeTitle();
    this.addButtons();
    if (motion) this.addTimeline();
    addEventListener("keydown", (event) => this.key(event));
    const hasSliders = !motion && robot.joints.some(moves);
    this.open(run ? "run" : app.reached ? "reach" : app.data.limbs.length > 0 ? "solutions" : hasSliders ? "joints" : undefined);
    this.keepClear();
    new ResizeObserver(() => this.keepClear()).observe(element("stage"));
    picture?.look(this.firstView);
    app.watchers.push(() => this.show());
    this.show();
    this.showPlaying();
  }

  private get firstView(): View {
    const { motion, run, task } = this.app.data;
    return motion?.base && !run && !task ? "follow" : "iso";
  }

  /** Creates the plots of the current motion. */
  private makePlots(): Plots | undefined {
    const { motion } = this.app.data;
    return motion && new Plots(element("lanes"), motion, (time) => this.go(() => this.app.seek(time)));
  }

  private simulate(run: Run): Simulator {
    const simulator = new Simulator(run, this.app, element<HTMLCanvasElement>("canvas"), this.picture, () => this.grow(run));
    this.player.more = () => simulator.more();
    return simulator;
  }

  /** Shows a motion that has become longer. */
  private grow(run: Run): void {
    this.plots?.remove();
    this.picture?.grow(run.motion);
    this.app.data.motion = run.motion;
    this.plots = this.makePlots();
    this.plots?.paint();
    element<HTMLInputElement>("scrub").max = String(run.motion.times.length - 1);
    this.app.grow(run.motion);
  }

  private writeTitle(): void {
    const { title, robot, run } = this.app.data;
    // A walk in the page becomes longer while it is simulated.
    const motion = run ? undefined : this.app.data.motion;
    const count = robot.joints.filter(moves).length;
    const facts = [`${count} ${count === 1 ? "joint" : "joints"}`];
    if (motion) facts.unshift(...(title === robot.name ? [] : [robot.name]), `${motion.times.length} samples`);
    if (this.picture) facts.push(`grid ${quantity(this.picture.cell, "m", 1).replace(/\.?0+ m$/, " m")}`);
    element("title").textContent = title;
    element("subtitle").textContent = facts.join(" \u00b7 ");
    const seconds = motion ? `, moving for ${number(motion.times.at(-1)! - motion.times[0]!, 2)} seconds` : "";
    element("canvas").setAttribute("aria-label", `${robot.name} in three dimensions: ${robot.links.length} links, ${count} joints${seconds}`);
    const notes = element("notes");
    notes.hidden = robot.notes.length === 0;
    notes.querySelector("summary")!.textContent = robot.notes.length === 1 ? "1 note" : `${robot.notes.length} notes`;
    notes.querySelector("ul")!.replaceChildren(...robot.notes.map((note) => textElement("li", note)));
  }

  private addButtons(): void {
    for (const view of VIEW_NAMES) {
      const made = button(view.charAt(0).toUpperCase() + view.slice(1), () => this.look(view));
      made.dataset["view"] = view;
      made.disabled = !this.picture;
      element("views").append(made);
    }
    if (this.picture) this.mark(this.firstView);
    for (const layer of this.picture?.layers ?? []) {
      const made = button(layer.name, () => {
        this.picture?.toggle(layer);
        made.ariaPressed = String(layer.group.visible);
      });
      made.style.setProperty("--tone", `var(--${layer.tone})`);
      made.ariaPressed = String(layer.group.visible);
      made.classList.toggle("flat", layer.isFlat);
      element("layers").append(made);
    }
    for (const panel of PANELS) element(`${panel}-button`).onclick = () => this.toggle(panel);
    element("solutions-button").hidden = this.app.data.limbs.length === 0;
    element("reach-button").hidden = !this.app.reached;
    element("run-button").hidden = !this.app.data.run;
    element("rest-button").hidden = this.app.data.motion !== undefined;
    element("rest-button").onclick = () => {
      this.app.rest();
      this.solutions?.follow();
    };
    element("theme-button").onclick = () => this.theme.toggle();
    element("help-button").onclick = () => this.help();
    element("keys").append(...KEYS.flatMap(([key, what]) => [textElement("dt", key), textElement("dd", what)]));
  }

  private addTimeline(): void {
    const scrub = element<HTMLInputElement>("scrub");
    scrub.max = String(this.app.data.motion!.times.length - 1);
    scrub.addEventListener("input", () => this.go(() => this.app.seek(this.app.data.motion!.times[Number(scrub.value)]!)));
    element("play").onclick = () => this.player.toggle();
    element("back").onclick = () => this.go(() => this.app.step(-1));
    element("forward").onclick = () => this.go(() => this.app.step(1));
    const speed = element<HTMLSelectElement>("speed");
    speed.onchange = () => (this.player.speed = Number(speed.value));
  }

  /** Changes the time and pauses playback. */
  private go(move: () => void): void {
    this.player.pause();
    move();
  }

  private look(view: View): void {
    this.picture?.look(view);
    this.mark(view);
    this.announce(`Camera: ${view}`);
  }

  private mark(view: View): void {
    for (const other of element("views").children) other.ariaPressed = String((other as HTMLElement).dataset["view"] === view);
  }

  /** Keeps the picture clear of the title and buttons at the top, if they are stacked, and of the layers at the bottom. */
  private keepClear(): void {
    const [header, layers] = [document.querySelector("header")!, element("layers")];
    const [name, views] = [header.querySelector<HTMLElement>(".name")!, header.querySelector("nav")!];
    const isHigh = header.clientWidth <= 640 || views.offsetTop > name.offsetTop;
    this.picture?.keepClear(isHigh ? header.offsetHeight : 20, layers.offsetHeight + 16);
  }

  /** Opens a panel and closes the others. */
  private open(opened: Panel | undefined): void {
    for (const panel of PANELS) {
      element(panel).hidden = panel !== opened;
      element(`${panel}-button`).ariaPressed = String(panel === opened);
    }
    this.sliders.show(this.app.values);
    this.solutions?.open(opened === "solutions");
  }

  private toggle(panel: Panel): void {
    this.open(element(panel).hidden ? panel : undefined);
  }

  private move(joint: number, value: number): void {
    this.app.move(joint, value);
    this.solutions?.follow();
  }

  private help(): void {
    const dialog = element<HTMLDialogElement>("help");
    if (dialog.open) dialog.close();
    else dialog.showModal();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const takes = (kinds: string) => target.matches(kinds);
    // Keys belong to the field in which the user types.
    if (takes("input:not([type=range]), select, textarea")) return;
    const { app } = this;
    const times = app.data.motion?.times;
    const actions: Record<string, () => void> = {
      j: () => this.toggle("joints"),
      t: () => this.theme.toggle(),
      "?": () => this.help(),
    };
    if (app.data.limbs.length > 0) actions["s"] = () => this.toggle("solutions");
    if (app.reached) actions["m"] = () => this.toggle("reach");
    if (app.data.run) actions["r"] = () => this.toggle("run");
    if (this.picture) VIEW_NAMES.forEach((view, place) => (actions[String(place + 1)] = () => this.look(view)));
    if (times && !takes("button, summary")) actions[" "] = () => this.player.toggle();
    if (times && !takes("aside input")) {
      const far = event.shiftKey ? 10 : 1;
      actions["ArrowLeft"] = () => this.go(() => app.step(-far));
      actions["ArrowRight"] = () => this.go(() => app.step(far));
      actions["Home"] = () => this.go(() => app.seek(times[0]!));
      actions["End"] = () => this.go(() => app.seek(times.at(-1)!));
    }
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || (element<HTMLDialogElement>("help").open && event.key !== "?")) return;
    event.preventDefault();
    action();
  }

  private showPlaying(): void {
    const play = element("play");
    play.innerHTML = this.player.isPlaying ? PAUSE : PLAY;
    play.ariaLabel = this.player.isPlaying ? "Pause" : "Play";
    if (!this.player.isPlaying) this.announce(this.status());
  }

  private show(): void {
    const { place, data } = this.app;
    this.sliders.show(this.app.values);
    this.picture?.show();
    if (!place || !data.motion) return;
    this.plots?.show(place);
    const { times } = data.motion;
    const scrub = element<HTMLInputElement>("scrub");
    const sample = nearestSample(place);
    scrub.value = String(sample);
    scrub.style.setProperty("--share", `${(100 * (place.time - times[0]!)) / (times.at(-1)! - times[0]! || 1)}%`);
    scrub.setAttribute("aria-valuetext", `${number(place.time, 2)} seconds`);
    element("clock").replaceChildren(number(place.time, 2), textElement("small", ` / ${number(times.at(-1)!, 2)} s`));
    const phase = phaseAt(data.motion, place.time);
    element("phase").textContent = phase ? phaseName(phase) : `sample ${sample + 1} of ${times.length}`;
    if (!this.player.isPlaying) this.announce(this.status());
  }

  /** The current state of the motion as text. */
  private status(): string {
    const { place, data, base } = this.app;
    if (!place || !data.motion) return "";
    const phase = phaseAt(data.motion, place.time);
    const standing = data.motion.contacts.filter(({ stands }) => stands[place.sample] === "1").map(({ name }) => displayName(name).toLowerCase());
    const margin = this.app.figure("margin");
    const parts = [`${number(place.time, 2)} seconds`];
    if (phase) parts.push(phaseName(phase));
    if (data.motion.contacts.length > 0) parts.push(standing.length > 0 ? `standing on ${standing.join(" and ")}` : "no contact");
    if (data.motion.base) parts.push(`root at ${base.slice(0, 3).map((value) => number(value, 3)).join(", ")} metres`);
    if (margin !== null) parts.push(`margin ${quantity(margin, "m")}`);
    return parts.join("; ");
  }

  /** Announces a text to screen readers; of texts in quick succession only the last. */
  private announce(text: string): void {
    clearTimeout(this.announcement);
    this.announcement = setTimeout(() => (element("live").textContent = text), ANNOUNCE_EVERY);
  }
}

/** Creates an element with a text. */
export function textElement<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, text: string): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  made.textContent = text;
  return made;
}

function button(text: string, press: () => void): HTMLButtonElement {
  const made = textElement("button", text);
  made.type = "button";
  made.addEventListener("click", press);
  return made;
}
