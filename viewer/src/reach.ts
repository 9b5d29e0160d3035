/** The panel of the reach map: the displayed quantity and the selection of places. */

import type { App } from "./app";
import { VIRIDIS } from "./cloud";
import { element, textElement } from "./user_interface";
import { along, type Choice, type Found, type Quantity, type Reached } from "./map";
import type { Picture } from "./picture";
import type { Vector } from "./pose";
import { number } from "./format";

const NAMES: Record<Quantity, string> = { share: "Share of orientations", answers: "Answers per orientation", manipulability: "Mean manipulability" };
const AXES = ["x", "y", "z"];

interface Slider {
  input: HTMLInputElement;
  output: HTMLOutputElement;
}

export class ReachPanel {
  private readonly visible = element<HTMLInputElement>("reach-visible");
  private readonly quantity = element<HTMLSelectElement>("reach-quantity");
  private readonly least: Slider;
  /** One slider for each axis with more than one place. */
  private readonly upto: (Slider | undefined)[];
  private drawn = 0;

  /** The panel of a page with a map; undefined without a map. */
  static start({ reached }: App, picture: Picture | undefined): ReachPanel | undefined {
    return reached && new ReachPanel(reached, picture);
  }

  private constructor(private readonly map: Reached, private readonly picture: Picture | undefined) {
    const { of, orientations, limited, axes } = map.data;
    const counted = `${count(orientations)} ${orientations === 1 ? "orientation" : "orientations"} at each place`;
    element("reach-of").textContent = `${of}; ${counted}${limited ? ", answers within limits" : ""}`;
    this.quantity.append(...map.quantities.map((quantity) => new Option(NAMES[quantity], quantity)));
    this.quantity.onchange = () => this.show({ quantity: this.quantity.value as Quantity });
    this.visible.onchange = () => this.show({ visible: this.visible.checked });
    this.least = this.slider("At least", 100, (percent) => this.show({ least: percent / 100 }));
    this.upto = axes.map((axis, place) => (axis[2] > 1 ? this.slider(`${AXES[place]} up to`, axis[2] - 1, (last) => this.clip(place, last)) : undefined));
    this.show({});
  }

  get places(): number {
    return this.map.places;
  }

  /** The number of selected places. */
  get shown(): number {
    return this.map.chosen.length;
  }

  /** The greatest value of the quantity. */
  get greatest(): number {
    return this.map.greatest;
  }

  at(...point: Vector): Found {
    return this.map.at(...point);
  }

  /** Changes the selection; omitted fields are unchanged. */
  show(changed: Partial<Choice>): void {
    this.map.choose(changed);
    this.drawn = this.picture?.showReach() ?? 0;
    const { quantity, least, visible } = this.map.choice;
    this.visible.checked = visible;
    this.quantity.value = quantity;
    const value = number(least * this.greatest, 3);
    fill(this.least, 100 * least, `${value} \u00b7 ${number(100 * least, 0)} %`);
    this.map.last.forEach((last, axis) => {
      const slider = this.upto[axis];
      if (slider) fill(slider, last, `${number(along(this.map.data.axes[axis]!, last), 3)} m`);
    });
    this.showLegend(NAMES[quantity], 100 * least);
    element("reach-state").textContent = this.words();
  }

  private clip(axis: number, last: number): void {
    const upto = [...this.map.choice.upto] as Vector;
    upto[axis] = along(this.map.data.axes[axis]!, last);
    this.show({ upto });
  }

  /** Shows the legend. Colours below `least` percent are covered: their places are not shown. */
  private showLegend(name: string, least: number): void {
    const legend = element("legend");
    const stops = VIRIDIS.map((colour) => `rgb(${colour.join(" ")})`).join(", ");
    legend.querySelector("div")!.style.background = `linear-gradient(to right, var(--line) ${least}%, transparent ${least}%), linear-gradient(to right, ${stops})`;
    const [, middle, most] = legend.querySelectorAll("span");
    [middle!.textContent, most!.textContent] = [number(this.greatest / 2, 3), number(this.greatest, 3)];
    legend.ariaLabel = `${name}: from violet, 0, to yellow, ${number(this.greatest, 3)}`;
  }

  private words(): string {
    const { map, shown, drawn, picture } = this;
    const reached = `${count(map.reached)} of ${count(map.places)} places are reached`;
    if (!map.choice.visible) return `${reached}; the map is hidden`;
    const evenly = picture && drawn < shown ? `, of which ${count(drawn)} evenly spread ones are drawn` : "";
    return `${reached}, ${count(shown)} shown${evenly}`;
  }

  private slider(name: string, max: number, moved: (value: number) => void): Slider {
    const [item, label] = [document.createElement("li"), document.createElement("label")];
    const [input, output] = [document.createElement("input"), document.createElement("output")];
    Object.assign(input, { type: "range", min: 0, max, step: 1, id: `reach-${name.replaceAll(" ", "-").toLowerCase()}`, ariaLabel: name });
    input.addEventListener("input", () => moved(Number(input.value)));
    label.htmlFor = input.id;
    output.htmlFor.add(input.id);
    label.append(textElement("span", name), output);
    item.append(label, input);
    element("reach").querySelector("ul")!.append(item);
    return { input, output };
  }
}

function fill({ input, output }: Slider, value: number, text: string): void {
  input.value = String(value);
  input.style.setProperty("--share", `${(100 * value) / Number(input.max)}%`);
  input.setAttribute("aria-valuetext", text.replace(" \u00b7", ","));
  output.textContent = text;
}

/** `9,261`. */
function count(value: number): string {
  return value.toLocaleString("en");
}
