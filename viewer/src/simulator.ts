/** The panel of a run: the figures of the gait with their presets, what stands where, and recording. */

import type { App } from "./app";
import { element, worded } from "./desk";
import type { Picture } from "./picture";
import { GOAL, type RoomView, type Spot } from "./room";
import type { Run } from "./run";

/** x, y and heading: name, unit, step. */
const PLACE: [string, string, number][] = [["x", "m", 0.1], ["y", "m", 0.1], ["Heading", "\u00b0", 5]];

export class Simulator {
  private readonly fields = new Map<string, HTMLInputElement>();
  private readonly spot: HTMLInputElement[];
  private readonly choice = element<HTMLSelectElement>("thing");
  private readonly room: RoomView | undefined;
  private film: MediaRecorder | undefined;

  /** `grown` hears of new samples. */
  constructor(private readonly run: Run, private readonly app: App, private readonly canvas: HTMLCanvasElement, picture: Picture | undefined, private readonly grown: () => void) {
    this.room = picture?.withRoom(run, (name, at) => this.attempt(() => this.place(name, at)));
    for (const { name, what, unit, value } of run.told.figures) if (value !== null) this.addFigure(name, what, unit);
    element<HTMLSelectElement>("preset").append(...run.told.presets.map(({ name }) => new Option(name)));
    element("preset").onchange = () => this.preset();
    this.choice.append(...[GOAL, ...run.told.furniture.map(({ name }) => name)].map((name) => new Option(name)));
    this.choice.onchange = () => this.show();
    this.spot = PLACE.map(([name, unit, step]) => this.input("place", name, unit, step, () => this.attempt(() => this.typed())));
    element("run-step").onclick = () => this.attempt(() => this.step());
    element("run-reset").onclick = () => this.attempt(() => this.reset());
    element("run-film").onclick = () => this.toggleFilm();
    element("run-csv").onclick = () => offer(new Blob([run.csv()], { type: "text/csv" }), "walk.csv");
    run.watchers.push(() => this.show());
    this.show();
  }

  /** Whether there is more to be played: the next step, if it can be taken. */
  more(): boolean {
    let hasArrived = true;
    this.attempt(() => (hasArrived = this.step()));
    return !hasArrived;
  }

  /** Takes a step; whether the robot has arrived. */
  step(): boolean {
    const hasArrived = this.run.step();
    this.grown();
    return hasArrived;
  }

  set(name: string, value: number): void {
    this.run.set(name, value);
    this.grown();
  }

  place(name: string, at: Spot): void {
    if (name === GOAL) this.run.setGoal(this.run.goal.length > 2 ? at : at.slice(0, 2));
    else this.run.furnish(name, at);
  }

  private reset(): void {
    this.run.begin();
    this.run.watchers.forEach((watcher) => watcher());
    this.grown();
    this.app.seek(0);
  }

  /** Does something that may be refused; the reason is told, and all fields show what holds. */
  private attempt(act: () => void): void {
    try {
      act();
      this.show();
    } catch (error) {
      this.show();
      this.state(error instanceof Error ? error.message : String(error), true);
    }
  }

  private state(text: string, isFault = false): void {
    element("run-state").textContent = text;
    element("run-state").classList.toggle("fault", isFault);
  }

  private show(): void {
    const { told, goal, hasArrived } = this.run;
    this.room?.show();
    for (const { name, value } of told.figures) {
      const field = this.fields.get(name);
      if (field && value !== null) field.value = String(Number(value.toPrecision(4)));
    }
    const own = this.choice.value === GOAL ? goal : told.furniture.find(({ name }) => name === this.choice.value)?.at;
    [own?.[0], own?.[1], ((own?.[2] ?? 0) * 180) / Math.PI].forEach((value, place) => {
      const input = this.spot[place]!;
      if (document.activeElement !== input) input.value = value === undefined ? "" : String(Number(value.toFixed(4)));
    });
    this.spot[2]!.disabled = this.choice.value === GOAL && goal.length < 3;
    if (told.blocked) this.state(told.blocked, true);
    else this.state(hasArrived ? "It stands at the goal" : `${this.run.motion.steps.length} steps`);
  }

  private addFigure(name: string, what: string, unit: string): void {
    const label = unit === "1" ? "" : unit === "deg" ? "\u00b0" : unit;
    const input = this.input("figures", name, label, "any", () => this.attempt(() => this.set(name, input.valueAsNumber)));
    input.parentElement!.title = what;
    input.ariaLabel = `${name}, ${what}, ${unit}`;
    this.fields.set(name, input);
  }

  private input(parent: string, name: string, unit: string, step: number | "any", changed: () => void): HTMLInputElement {
    const [label, input] = [document.createElement("label"), document.createElement("input")];
    Object.assign(input, { type: "number", step, inputMode: "decimal" });
    input.addEventListener("change", changed);
    label.append(`${name} `, worded("small", unit), input);
    element(parent).append(label);
    return input;
  }

  private typed(): void {
    const [x, y, heading] = this.spot.map(({ valueAsNumber }) => valueAsNumber) as Spot;
    if (![x, y, heading].every(Number.isFinite)) throw new Error("give numbers for x, y and heading");
    this.place(this.choice.value, [x, y, (heading * Math.PI) / 180]);
  }

  /** Takes the figures of a preset, one by one; what is refused stays as it was. */
  private preset(): void {
    const chosen = this.run.told.presets[element<HTMLSelectElement>("preset").selectedIndex - 1];
    if (!chosen) return;
    const refused: string[] = [];
    this.run.told.figures.forEach(({ name, value }, place) => {
      const wanted = chosen.values[place]!;
      if (value === null || Math.abs(value - wanted) < 1e-9) return;
      try {
        this.set(name, wanted);
      } catch (error) {
        refused.push(`${name}: ${error instanceof Error ? error.message : error}`);
      }
    });
    this.show();
    if (refused.length > 0) this.state(refused.join("; "), true);
  }

  private toggleFilm(): void {
    if (this.film) return this.film.stop();
    const parts: Blob[] = [];
    try {
      this.film = new MediaRecorder(this.canvas.captureStream(30), { mimeType: "video/webm" });
    } catch {
      return this.state("This browser records no film", true);
    }
    this.film.ondataavailable = ({ data }) => parts.push(data);
    this.film.onstop = () => {
      this.film = undefined;
      element("run-film").ariaPressed = "false";
      offer(new Blob(parts, { type: "video/webm" }), "walk.webm");
    };
    this.film.start();
    element("run-film").ariaPressed = "true";
  }
}

/** Lets the browser save a file. */
function offer(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
