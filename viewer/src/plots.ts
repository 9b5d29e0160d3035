/** The plots under the timeline: phases, contacts, and quantities. Dragging in any of them sets the time. */

import type { Motion } from "./data";
import { at, nearestSample, phaseAt, placeOf, type Place } from "./time";
import { displayName, quantity } from "./format";

/** Maximum number of quantities of one unit whose values are listed beside their plot. */
const MAX_LISTED = 3;

interface Figure {
  name: string;
  unit: string;
  values: Float64Array;
}

interface Plot {
  canvas: HTMLCanvasElement;
  draw(pen: CanvasRenderingContext2D, width: number, height: number): void;
  /** Writes the current values beside the plot. */
  update?(place: Place): void;
}

export class Plots {
  private readonly plots: Plot[] = [];
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

  /** Removes the plots. */
  remove(): void {
    this.observer.disconnect();
    this.playhead.remove();
    for (const { canvas } of this.plots) canvas.parentElement!.remove();
  }

  show(place: Place): void {
    this.shown = place;
    const share = (place.time - this.from) / this.span;
    this.playhead.style.transform = `translateX(${share * (this.plots[0]?.canvas.clientWidth ?? 0)}px)`;
    this.playhead.hidden = this.plots.length === 0;
    for (const plot of this.plots) plot.update?.(place);
  }

  /** Draws all plots in the colours of the theme. */
  paint(): void {
    for (const { canvas, draw } of this.plots) {
      const { clientWidth: width, clientHeight: height } = canvas;
      const ratio = devicePixelRatio;
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
      const pen = canvas.getContext("2d");
      if (!pen) continue;
      pen.scale(ratio, ratio);
      draw(pen, width, height);
    }
  }

  /** Adds a row: label, plot, current value. */
  private add(label: string, height: number, text: string, draw: Plot["draw"]): [Plot, HTMLElement] {
    const row = document.createElement("div");
    row.className = "lane";
    const [name, valueText] = [document.createElement("span"), document.createElement("span")];
    name.textContent = label;
    name.title = label;
    const canvas = document.createElement("canvas");
    canvas.style.setProperty("--height", `${height}px`);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", text);
    row.append(name, canvas, valueText);
    this.root.append(row);
    this.scrubs(canvas);
    const plot: Plot = { canvas, draw };
    this.plots.push(plot);
    return [plot, valueText];
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
    const [plot, valueText] = this.add("Phase", 16, `${phases.length} phases`, (pen, width, height) => {
      for (const { action, from, to } of phases) {
        pen.fillStyle = tone(action === "swing" ? "accent" : "muted");
        pen.globalAlpha = action === "swing" ? 0.75 : 0.25;
        pen.fillRect(this.x(from, width) + 0.5, 4, Math.max(this.x(to, width) - this.x(from, width) - 1, 0.5), height - 8);
      }
    });
    plot.update = ({ time }) => write(valueText, [phaseAt(this.motion, time)?.action ?? ""]);
  }

  private addContact(name: string, stands: string): void {
    const { times } = this.motion;
    const share = [...stands].filter((letter) => letter === "1").length / stands.length;
    const text = `${displayName(name)} is in contact in ${Math.round(100 * share)} % of the samples`;
    const [plot, valueText] = this.add(displayName(name), 16, text, (pen, width, height) => {
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
    plot.update = ({ sample }) => write(valueText, [stands[sample] === "1" ? "stands" : "swings"]);
  }

  /** Adds the plot of the quantities of one unit, the margin in the accent colour, with a line at zero if it is in range. */
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
      .map(({ name, unit, values }) => `${displayName(name)} from ${extremes(values).map((value) => quantity(value, unit)).join(" to ")}`)
      .join("; ");
    const [plot, valueText] = this.add(ordered.map(({ name }) => displayName(name)).join(", "), ordered.length > MAX_LISTED ? 56 : 64, text, (pen, width, height) => {
      const y = (value: number) => height - 4 - ((value - bottom) / (top - bottom)) * (height - 8);
      pen.strokeStyle = tone("line");
      for (const level of bottom <= 0 && top >= 0 ? [0] : []) line(pen, [[0, y(level)], [width, y(level)]]);
      for (const { values } of [...ordered].reverse()) {
        pen.strokeStyle = tone(values === first.values && ordered.length <= MAX_LISTED ? "accent" : "trace");
        pen.lineWidth = values === first.values ? 1.75 : 1.25;
        pen.lineJoin = "round";
        line(pen, Array.from(values, (value, sample) => [this.x(times[sample]!, width), y(value)]));
      }
    });
    const label = plot.canvas.parentElement!.firstElementChild!;
    if (ordered.length > MAX_LISTED) {
      // The largest of many values is shown.
      label.replaceChildren(item(`${ordered.length} in ${first.unit}`, false));
      plot.update = (place) => {
        const size = (figure: Figure) => Math.abs(at(figure.values, place));
        const greatest = ordered.reduce((a, b) => (size(b) > size(a) ? b : a));
        write(valueText, [quantity(at(greatest.values, place), first.unit), greatest.name]);
      };
      return;
    }
    label.replaceChildren(...ordered.map(({ name }, place) => item(displayName(name), place === 0)));
    const most = Math.max(Math.abs(low), Math.abs(high));
    plot.update = (place) => {
      const values = ordered.map(({ values }) => at(values, place));
      write(valueText, values.map((value) => quantity(value, first.unit, most)));
      valueText.firstElementChild?.classList.add("first");
      valueText.firstElementChild?.classList.toggle("fault", first.name === "margin" && values[0]! < 0);
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
