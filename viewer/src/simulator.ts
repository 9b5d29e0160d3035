/** The panel of a run: the parameters of the gait with their presets, poses of goal and furniture, and recording. */

import type { App } from "./app";
import { element, textElement } from "./user_interface";
import type { Picture } from "./picture";
import { GOAL, type RoomView, type Spot, type Thing } from "./room";
import type { Run } from "./run";

/** x, y and heading: name, unit, step. */
const PLACE: [string, string, number][] = [["x", "m", 0.1], ["y", "m", 0.1], ["Heading", "\u00b0", 5]];
const DEGREE = Math.PI / 180;

export class Simulator {
  private readonly fields = new Map<string, HTMLInputElement>();
  private readonly spot: HTMLInputElement[];
  private readonly choice = element<HTMLSelectElement>("thing");
  private readonly room: RoomView | undefined;
  private recorder: MediaRecorder | undefined;

  /** `grown` is called after new samples. */
  constructor(private readonly run: Run, private readonly app: App, private readonly canvas: HTMLCanvasElement, picture: Picture | undefined, private readonly grown: () => void) {
    this.room = picture?.withRoom(run, (thing, at) => this.attempt(() => this.dropped(thing, at)));
    for (const { name, what, unit, value } of run.state.figures) if (value !== null) this.addFigure(name, what, unit);
    element<HTMLSelectElement>("preset").append(...run.state.presets.map(({ name }) => new Option(name)));
    element("preset").onchange = () => this.preset();
    this.choice.append(...["goal", ...run.state.furniture.map(({ name }) => name)].map((name) => new Option(name, name)));
    this.choice.onchange = () => this.show();
    this.spot = PLACE.map(([name, unit, step]) => this.input("place", name, unit, step, () => this.typed()));
    element("run-step").onclick = () => this.attempt(() => this.step());
    element("run-reset").onclick = () => this.attempt(() => this.reset());
    element("run-video").onclick = () => this.toggleVideo();
    element<HTMLButtonElement>("run-video").disabled = !picture;
    element("run-csv").onclick = () => offer(new Blob([run.csv()], { type: "text/csv" }), "walk.csv");
    run.watchers.push(() => this.show());
    this.show();
  }

  /** Takes the next step if it is feasible. Returns whether the motion was extended. */
  more(): boolean {
    let hasArrived = true;
    this.attempt(() => (hasArrived = this.step()));
    return !hasArrived;
  }

  /** Takes a step. Returns whether the robot has arrived. */
  step(): boolean {
    const hasArrived = this.run.step();
    this.grown();
    return hasArrived;
  }

  set(name: string, value: number): void {
    this.run.set(name, value);
    this.grown();
  }

  /** The selected thing; the goal is the first option. */
  private get chosen(): Thing {
    return this.choice.selectedIndex === 0 ? GOAL : this.choice.value;
  }

  private place(thing: Thing, at: number[]): void {
    if (thing === GOAL) this.run.setGoal(at);
    else this.run.furnish(thing, at as Spot);
  }

  private dropped(thing: Thing, at: Spot): void {
    this.place(thing, thing === GOAL ? at.slice(0, this.run.goal.length) : at);
  }

  private reset(): void {
    this.run.begin();
    this.run.watchers.forEach((watcher) => watcher());
    this.grown();
    this.app.seek(0);
  }

  /** Runs an action that may be refused and shows the reason. All fields then show current values, `typed` too. */
  private attempt(act: () => void, typed?: HTMLInputElement): void {
    try {
      act();
      this.show(typed);
    } catch (error) {
      this.show(typed);
      this.state(error instanceof Error ? error.message : String(error), true);
    }
  }

  private state(text: string, isFault = false): void {
    element("run-state").textContent = text;
    element("run-state").classList.toggle("fault", isFault);
  }

  private show(typed?: HTMLInputElement): void {
    const { state, hasArrived } = this.run;
    this.room?.show();
    this.fill(typed);
    if (state.blocked) this.state(state.blocked, true);
    else this.state(hasArrived ? "The robot has reached the goal" : `${this.run.motion.steps.length} steps`);
  }

  /** Writes current values into all fields except the focused one, unless that is `typed`. */
  private fill(typed?: HTMLInputElement): void {
    const write = (input: HTMLInputElement | undefined, value: string) => {
      if (input && (input === typed || document.activeElement !== input)) input.value = value;
    };
    const { figures, furniture } = this.run.state;
    for (const { name, value } of figures) if (value !== null) write(this.fields.get(name), String(Number(value.toPrecision(4))));
    const own: number[] = this.chosen === GOAL ? this.run.goal : (furniture.find(({ name }) => name === this.chosen)?.at ?? []);
    this.spot.forEach((input, place) => {
      const value = own[place];
      write(input, value === undefined ? "" : String(Number((place < 2 ? value : value / DEGREE).toFixed(4))));
    });
  }

  private addFigure(name: string, what: string, unit: string): void {
    const label = unit === "1" ? "" : unit === "deg" ? "\u00b0" : unit;
    const input = this.input("figures", name, label, "any", () => this.set(name, input.valueAsNumber));
    input.parentElement!.title = what;
    input.ariaLabel = `${name}, ${what}, ${unit}`;
    this.fields.set(name, input);
  }

  private input(parent: string, name: string, unit: string, step: number | "any", changed: () => void): HTMLInputElement {
    const [label, input] = [document.createElement("label"), document.createElement("input")];
    Object.assign(input, { type: "number", step, inputMode: "decimal" });
    input.addEventListener("change", () => this.attempt(changed, input));
    input.addEventListener("blur", () => this.fill());
    label.append(`${name} `, textElement("small", unit), input);
    element(parent).append(label);
    return input;
  }

  /** Applies x, y and heading; the heading of a goal is optional. */
  private typed(): void {
    const [x, y, heading] = this.spot.map(({ valueAsNumber }) => valueAsNumber) as Spot;
    const { value, validity } = this.spot[2]!;
    const isBare = this.chosen === GOAL && value === "" && !validity.badInput;
    this.place(this.chosen, isBare ? [x, y] : [x, y, heading * DEGREE]);
  }

  /** Applies the parameters of a preset one by one; refused ones are unchanged. */
  private preset(): void {
    const chosen = this.run.state.presets[element<HTMLSelectElement>("preset").selectedIndex - 1];
    if (!chosen) return;
    const refused: string[] = [];
    this.run.state.figures.forEach(({ name, value }, place) => {
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

  private toggleVideo(): void {
    if (this.recorder) return this.recorder.stop();
    const parts: Blob[] = [];
    const stream = this.canvas.captureStream(30);
    const release = () => stream.getTracks().forEach((track) => track.stop());
    try {
      this.recorder = new MediaRecorder(stream, { mimeType: "video/webm" });
    } catch {
      release();
      return this.state("This browser cannot record video", true);
    }
    this.recorder.ondataavailable = ({ data }) => parts.push(data);
    this.recorder.onstop = () => {
      this.recorder = undefined;
      release();
      element("run-video").ariaPressed = "false";
      offer(new Blob(parts, { type: "video/webm" }), "walk.webm");
    };
    this.recorder.start();
    element("run-video").ariaPressed = "true";
  }
}

/** Offers a file for download. */
function offer(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
