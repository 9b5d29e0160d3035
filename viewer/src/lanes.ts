/** The lanes under the timeline: phases, which contacts stand, and figures as plots; all of them scrub. */

import type { Motion } from "./data";
import { at, nearestSample, phaseAt, placeOf, type Place } from "./time";
import { named, quantity } from "./words";

/** So many figures of one unit are told one by one beside their plot. */
const MOST_TOLD = 3;

interface Figure {
  name: string;
  unit: string;
  values: Float64Array;
}

interface Lane {
  canvas: HTMLCanvasElement;
  draw(pen: CanvasRenderingContext2D, width: number, height: number): void;
  /** Writes what holds at a place beside the lane. */
  tell?(place: Place): void;
}

export class Lanes {
  private readonly lanes: Lane[] = [];
  private readonly playhead = document.createElement("div");
  private readonly from: number;
  private readonly span: number;
  private shown: Place | undefined;
  private readonly observer = new ResizeObserver(() => {
    this.paint();
    if (this.shown) this.show(this.shown);
  });

  constructor(private readonly root: HTMLElement, private readonly motion: Motion, private readonly seek: (time: number) => void) {
    this.from = motion.times[0]!;
    this.span = motion.times.at(-1)! - this.from || 1;
    if (motion.phases.length > 0) this.addPhases();
    for (const { name, stands } of motion.contacts) this.addContact(name, stands);
    const units = [...new Set(motion.figures.map(({ unit }) => unit))];
    for (const unit of units) this.addPlot(motion.figures.filter((figure) => figure.unit === unit));
    this.playhead.id = "playhead";
    root.append(this.playhead);
    this.observer.observe(root);
  }

  /** Takes the lanes away. */
  remove(): void {
    this.observer.disconnect();
    this.playhead.remove();
    for (const { canvas } of this.lanes) canvas.parentElement!.remove();
  }

  show(place: Place): void {
    this.shown = place;
    const share = (place.time - this.from) / this.span;
    this.playhead.style.transform = `translateX(${share * (this.lanes[0]?.canvas.clientWidth ?? 0)}px)`;
    this.playhead.hidden = this.lanes.length === 0;
    for (const lane of this.lanes) lane.tell?.(place);
  }

  /** Draws all lanes in the colours of the theme. */
  paint(): void {
    for (const { canvas, draw } of this.lanes) {
      const { clientWidth: width, clientHeight: height } = canvas;
      const ratio = devicePixelRatio;
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
      const pen = canvas.getContext("2d");
      if (!pen) continue;
      pen.scale(ratio, ratio);
      draw(pen, width, height);
    }
  }

  /** A row: what it is, its picture, what it says now. */
  private add(label: string, height: number, text: string, draw: Lane["draw"]): [Lane, HTMLElement] {
    const row = document.createElement("div");
    row.className = "lane";
    const [name, said] = [document.createElement("span"), document.createElement("span")];
    name.textContent = label;
    name.title = label;
    const canvas = document.createElement("canvas");
    canvas.style.setProperty("--height", `${height}px`);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", text);
    row.append(name, canvas, said);
    this.root.append(row);
    this.scrubs(canvas);
    const lane: Lane = { canvas, draw };
    this.lanes.push(lane);
    return [lane, said];
  }

  private scrubs(canvas: HTMLCanvasElement): void {
    const go = ({ clientX }: PointerEvent) => {
      const { left, width } = canvas.getBoundingClientRect();
      const place = placeOf(this.motion.times, this.from + ((clientX - left) / width) * this.span);
      this.seek(this.motion.times[nearestSample(place)]!);
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) go(event);
    });
  }

  private x(time: number, width: number): number {
    return ((time - this.from) / this.span) * width;
  }

  private addPhases(): void {
    const { phases } = this.motion;
    const [lane, said] = this.add("Phase", 16, `${phases.length} phases`, (pen, width, height) => {
      for (const { action, from, to } of phases) {
        pen.fillStyle = tone(action === "swing" ? "accent" : "muted");
        pen.globalAlpha = action === "swing" ? 0.75 : 0.25;
        pen.fillRect(this.x(from, width) + 0.5, 4, Math.max(this.x(to, width) - this.x(from, width) - 1, 0.5), height - 8);
      }
    });
    lane.tell = ({ time }) => write(said, [phaseAt(this.motion, time)?.action ?? ""]);
  }

  private addContact(name: string, stands: string): void {
    const { times } = this.motion;
    const share = [...stands].filter((letter) => letter === "1").length / stands.length;
    const text = `${named(name)} is in contact in ${Math.round(100 * share)} % of the samples`;
    const [lane, said] = this.add(named(name), 16, text, (pen, width, height) => {
      pen.fillStyle = tone("ink");
      pen.globalAlpha = 0.7;
      for (let sample = 0; sample < times.length; sample++) {
        if (stands[sample] !== "1") continue;
        const first = sample;
        while (stands[sample + 1] === "1") sample++;
        const end = times[Math.min(sample + 1, times.length - 1)]!;
        pen.fillRect(this.x(times[first]!, width), 6, Math.max(this.x(end, width) - this.x(times[first]!, width), 1), height - 12);
      }
    });
    lane.tell = ({ sample }) => write(said, [stands[sample] === "1" ? "stands" : "swings"]);
  }

  /** The plot of figures of one unit, the margin in the accent's colour; zero as a line where it is near. */
  private addPlot(figures: Figure[]): void {
    const { times } = this.motion;
    const first = figures.find(({ name }) => name === "margin") ?? figures[0]!;
    const ordered = [first, ...figures.filter((figure) => figure !== first)];
    const all = ordered.flatMap(({ values }) => extremes(values));
    let [low, high] = [Math.min(...all), Math.max(...all)];
    if (low > 0 && low < 0.6 * high) low = 0;
    const room = 0.08 * (high - low) || 1;
    const [bottom, top] = [low - room, high + room];
    const text = ordered
      .map(({ name, unit, values }) => `${named(name)} from ${extremes(values).map((value) => quantity(value, unit)).join(" to ")}`)
      .join("; ");
    const [lane, said] = this.add(ordered.map(({ name }) => named(name)).join(", "), ordered.length > MOST_TOLD ? 56 : 64, text, (pen, width, height) => {
      const y = (value: number) => height - 4 - ((value - bottom) / (top - bottom)) * (height - 8);
      pen.strokeStyle = tone("line");
      for (const level of bottom <= 0 && top >= 0 ? [0] : []) line(pen, [[0, y(level)], [width, y(level)]]);
      for (const { values } of [...ordered].reverse()) {
        pen.strokeStyle = tone(values === first.values && ordered.length <= MOST_TOLD ? "accent" : "trace");
        pen.lineWidth = values === first.values ? 1.75 : 1.25;
        pen.lineJoin = "round";
        line(pen, Array.from(values, (value, sample) => [this.x(times[sample]!, width), y(value)]));
      }
    });
    const label = lane.canvas.parentElement!.firstElementChild!;
    if (ordered.length > MOST_TOLD) {
      // Of many values the largest one is shown.
      label.replaceChildren(item(`${ordered.length} in ${first.unit}`, false));
      lane.tell = (place) => {
        const size = (figure: Figure) => Math.abs(at(figure.values, place));
        const greatest = ordered.reduce((a, b) => (size(b) > size(a) ? b : a));
        write(said, [quantity(at(greatest.values, place), first.unit), greatest.name]);
      };
      return;
    }
    label.replaceChildren(...ordered.map(({ name }, place) => item(named(name), place === 0)));
    const most = Math.max(Math.abs(low), Math.abs(high));
    lane.tell = (place) => {
      const values = ordered.map(({ values }) => at(values, place));
      write(said, values.map((value) => quantity(value, first.unit, most)));
      said.firstElementChild?.classList.add("first");
      said.firstElementChild?.classList.toggle("fault", first.name === "margin" && values[0]! < 0);
    };
  }
}

const tone = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

function extremes(values: Float64Array): number[] {
  return [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
}

function line(pen: CanvasRenderingContext2D, points: number[][]): void {
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x!, y!);
  pen.stroke();
}

function item(text: string, isFirst: boolean): HTMLElement {
  const made = document.createElement("em");
  made.textContent = text;
  if (isFirst) made.className = "first";
  return made;
}

function write(element: HTMLElement, texts: string[]): void {
  if (element.textContent !== texts.join("")) element.replaceChildren(...texts.map((text) => item(text, false)));
}
