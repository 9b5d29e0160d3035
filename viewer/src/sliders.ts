/** The panel of joint values: sliders, read-only while a motion determines them. */

import type { Robot } from "./data";
import { moves, unit } from "./kinematics";
import { jointValue, range } from "./format";

interface Row {
  input: HTMLInputElement;
  output: HTMLOutputElement;
  place: number;
}

export class Sliders {
  private readonly rows: Row[];

  /** `moved` is called when a slider is moved; without it the sliders are read-only. */
  constructor(private readonly panel: HTMLElement, private readonly robot: Robot, moved?: (joint: number, value: number) => void) {
    const places = [...robot.joints.keys()].filter((place) => moves(robot.joints[place]!));
    this.rows = places.map((place) => this.row(place, moved));
  }

  /** Shows the values of all joints. */
  show(values: number[]): void {
    if (this.panel.hidden) return;
    for (const { input, output, place } of this.rows) {
      const value = values[place]!;
      const joint = this.robot.joints[place]!;
      if (Number(input.value) !== value) input.value = String(value);
      const text = jointValue(value, unit(joint));
      if (output.textContent === text) continue;
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
      const [low, high] = [Number(input.min), Number(input.max)];
      input.style.setProperty("--share", `${(100 * (value - low)) / (high - low || 1)}%`);
    }
  }

  private row(place: number, moved?: (joint: number, value: number) => void): Row {
    const joint = this.robot.joints[place]!;
    const [item, label, name] = [document.createElement("li"), document.createElement("label"), document.createElement("span")];
    const [input, output, small] = [document.createElement("input"), document.createElement("output"), document.createElement("small")];
    const [low, high] = joint.limits ?? (joint.kind === "prismatic" ? [-1, 1] : [-Math.PI, Math.PI]);
    Object.assign(input, { type: "range", min: low, max: high, step: "any", id: `joint-${place}` });
    input.disabled = !moved || joint.follows !== undefined;
    input.addEventListener("input", () => moved?.(place, Number(input.value)));
    name.textContent = joint.name;
    input.ariaLabel = joint.name;
    label.htmlFor = input.id;
    output.htmlFor.add(input.id);
    const leader = joint.follows && this.robot.joints[joint.follows.joint]!.name;
    small.textContent = range(joint.limits, unit(joint)) + (leader ? `, follows ${leader}` : "");
    label.append(name, output);
    item.append(label, input, small);
    this.panel.querySelector("ul")!.append(item);
    return { input, output, place };
  }
}
