/** The panel of all solutions: limb, numbers of the target, and one row for each solution or arc. */

import type { App } from "./app";
import { element, textElement } from "./user_interface";
import type { Copy, TranslucentCopies } from "./copies";
import type { Engine } from "./engine";
import { jointValue, number } from "./format";
import { unit } from "./kinematics";
import { LimbSolver, type Arc, type Solution } from "./limb_solver";
import type { Picture } from "./picture";
import { fromAngles, toAngles, type Frame } from "./pose";

/** The numbers of the target: name, unit, step. */
const FIELDS: [string, string, number][] = [
  ["x", "m", 0.01], ["y", "m", 0.01], ["z", "m", 0.01], ["Roll", "\u00b0", 1], ["Pitch", "\u00b0", 1], ["Yaw", "\u00b0", 1],
];

export class Solutions {
  private readonly panel = element("solutions");
  private readonly list = this.panel.querySelector("ol")!;
  private readonly inputs: HTMLInputElement[];
  private readonly copies: TranslucentCopies | undefined;
  /** Joint values of the robot, and the slider along its arc. */
  private readonly shown = element("shown");
  private readonly slider = element<HTMLInputElement>("along-slider");
  private chosen: LimbSolver;
  /** The index of the solution that the robot has. */
  private taken = -1;

  /** The panel of a page with limbs; undefined without limbs. Without WebAssembly it shows a message and returns undefined. */
  static start(app: App, picture: Picture | undefined, engine: Engine | undefined): Solutions | undefined {
    const { limbs } = app.data;
    if (limbs.length === 0) return undefined;
    try {
      if (!engine) throw new Error("this browser has no WebAssembly");
      return new Solutions(app, picture, limbs.map((limb) => new LimbSolver(engine, app, limb)));
    } catch (error) {
      element("solutions-state").textContent = `Solutions are unavailable: ${error instanceof Error ? error.message : error}.`;
      for (const id of ["limb-choice", "shown", "target-move", "target-turn"]) element(id).hidden = true;
      return undefined;
    }
  }

  private constructor(private readonly app: App, picture: Picture | undefined, private readonly solvers: LimbSolver[]) {
    this.chosen = solvers[0]!;
    this.copies = picture?.withCopies((target) => this.solve(target));
    this.inputs = FIELDS.map((field) => this.field(field));
    const choice = element<HTMLSelectElement>("limb");
    choice.append(...solvers.map(({ limb }) => new Option(limb.name)));
    element("limb-choice").hidden = solvers.length < 2;
    choice.onchange = () => this.choose(solvers[choice.selectedIndex]!);
    for (const [id, turns] of [["target-move", false], ["target-turn", true]] as const) {
      element(id).onclick = () => this.turn(turns);
      element(id).hidden = !picture;
    }
    solvers.forEach((solver) => solver.start());
    this.slider.oninput = () => this.slide(this.taken, Number(this.slider.value));
    this.choose(this.chosen);
  }

  get names(): string[] {
    return this.solvers.map(({ limb }) => limb.name);
  }

  get outcome(): string {
    return this.chosen.outcome;
  }

  get solutions(): Solution[] {
    return this.chosen.solutions;
  }

  selfMotion(place: number): number[][] {
    return this.chosen.selfMotion(place);
  }

  /** Moves the robot along an arc, to a distance from its start. */
  slide(place: number, s: number): void {
    this.chosen.slide(place, s);
    this.take(place);
  }

  get updateMs(): number {
    return this.chosen.updateMs;
  }

  /** Shows or hides the translucent copies with the panel. */
  open(isOpen: boolean): void {
    if (isOpen) this.show();
    else this.copies?.hide();
  }

  /** Solves a limb for a target, twelve numbers: position, then the rotation by rows. */
  drag(name: string, numbers: number[]): void {
    const solver = this.solvers.find(({ limb }) => limb.name === name);
    if (!solver) throw new Error(`there is no limb ${name}; there are ${this.names.join(", ")}`);
    if (numbers.length !== 12 || !numbers.every(Number.isFinite)) throw new Error("a target is twelve finite numbers");
    if (solver !== this.chosen) this.choose(solver);
    const [x, y, z, ...r] = numbers as [number, number, number, ...number[]];
    this.solve(Float64Array.of(r[0]!, r[1]!, r[2]!, x, r[3]!, r[4]!, r[5]!, y, r[6]!, r[7]!, r[8]!, z));
  }

  /** Sets the target to the current pose of the tip. */
  follow(): void {
    this.choose(this.chosen);
  }

  private choose(solver: LimbSolver): void {
    this.chosen = solver;
    this.showCertificate(solver.limb.certificate);
    this.solve(solver.reached(), false);
  }

  private showCertificate(hash: string | undefined): void {
    const [shown, copy] = [element("certificate"), element("certificate-copy")];
    const hashText = textElement("code", hash ?? "");
    shown.replaceChildren(...(hash ? ["Certificate ", hashText] : []));
    copy.hidden = !hash;
    copy.onclick = async () => {
      try {
        await navigator.clipboard.writeText(hash!);
      } catch {
        // If the browser does not permit copying, the text is selected for manual copying.
        getSelection()?.selectAllChildren(hashText);
      }
    };
  }

  /** Solves for a target. The robot takes the nearest solution, unless it has the target's pose already. */
  private solve(target: Frame, moves = true): void {
    const { chosen } = this;
    try {
      chosen.solve(target);
    } catch (error) {
      chosen.outcome = error instanceof Error ? error.message : String(error);
    }
    if (moves) return this.take(chosen.nearest());
    this.taken = chosen.nearest();
    this.show();
  }

  /** Sets the robot to a solution. */
  private take(place: number): void {
    this.taken = place;
    const solution = this.chosen.solutions[place];
    if (solution) this.app.moveAll(solution.q.map((value, joint) => [this.chosen.limb.joints[joint]!, value]));
    this.show();
  }

  private turn(isTurned: boolean): void {
    if (this.copies) this.copies.turns = isTurned;
    element("target-move").ariaPressed = String(!isTurned);
    element("target-turn").ariaPressed = String(isTurned);
  }

  private show(): void {
    if (this.panel.hidden) return;
    const { solutions, target, limb } = this.chosen;
    this.copies?.show(limb, target, this.drawn(), this.chosen.isRedundant ? this.taken : undefined);
    element("solutions-state").textContent = this.chosen.outcome;
    const angles = toAngles(target).map((angle) => (180 / Math.PI) * angle);
    [target[3]!, target[7]!, target[11]!, ...angles].forEach((value, place) => {
      const input = this.inputs[place]!;
      if (document.activeElement !== input) input.value = value.toFixed(place < 3 ? 4 : 2);
    });
    while (this.list.children.length < solutions.length) this.list.append(this.row(this.list.children.length));
    [...this.list.children].forEach((row, place) => this.fill(row as HTMLElement, solutions[place], place));
    this.showValues();
  }

  /** The copies of all arcs, or of the solutions that the robot does not have. */
  private drawn(): Copy[] {
    const { chosen } = this;
    if (!chosen.isRedundant) return chosen.frames.map((frames, row) => ({ row, frames })).filter(({ row }) => row !== this.taken);
    return chosen.solutions.flatMap((_, row) => chosen.selfMotion(row).map((q) => ({ row, frames: chosen.framesOf(q) })));
  }

  private fill(row: HTMLElement, solution: Solution | undefined, place: number): void {
    row.hidden = !solution;
    if (!solution) return;
    const [head, facts] = row.querySelectorAll<HTMLElement>("strong, small");
    row.querySelector("button")!.ariaPressed = String(place === this.taken);
    const { arc, residual } = solution;
    head!.textContent = arc ? `Arc ${place + 1}, length ${number(arc.length, 3)} rad` : `Branch ${solution.branch}`;
    const limits = solution.within ? "within limits" : `beyond the limits of ${solution.outside.join(", ")}`;
    const words = [arc ? endTexts(arc).join(" to ") : limits];
    if (arc?.unsure) words.push("unsure");
    if (solution.free.length > 0) words.push(`self-motion about ${solution.free.join(", ")}`);
    facts!.textContent = [...words, `residual ${residual.toExponential(1)}`].join(" \u00b7 ");
  }

  /** Shows the joint values of the robot, with the slider along its arc. */
  private showValues(): void {
    const { chosen, shown, slider } = this;
    const solution = chosen.solutions[this.taken];
    shown.hidden = !solution;
    if (!solution) return;
    const values = chosen.joints.map((joint, place) => jointValue(this.app.values[chosen.limb.joints[place]!]!, unit(joint)));
    shown.querySelector("dl")!.replaceChildren(...chosen.joints.flatMap(({ name }, place) => [textElement("dt", name), textElement("dd", values[place]!)]));
    const { arc } = solution;
    element("along").hidden = !arc;
    if (!arc) return;
    [slider.max, slider.value] = [String(arc.length), String(arc.s)];
    shown.querySelector("label")!.textContent = `Along arc ${this.taken + 1}`;
    slider.style.setProperty("--share", `${(100 * arc.s) / (arc.length || 1)}%`);
    const text = `${number(arc.s, 3)} of ${number(arc.length, 3)} rad`;
    slider.setAttribute("aria-valuetext", text);
    shown.querySelector("output")!.textContent = text;
    const limits = element("along-ends").children;
    [0, 1].forEach((end) => (limits[end]!.textContent = endTexts(arc)[end] ?? ""));
  }

  /** Highlights a solution with its self-motion if it has one, or an arc. */
  private point(place: number): void {
    const { chosen } = this;
    this.copies?.point(place, chosen.isRedundant ? [] : chosen.selfMotion(place).map((q) => chosen.framesOf(q)));
  }

  private row(place: number): HTMLLIElement {
    const [item, press] = [document.createElement("li"), document.createElement("button")];
    press.type = "button";
    press.append(textElement("strong", ""), textElement("small", ""));
    press.addEventListener("click", () => {
      this.take(place);
      this.point(place);
    });
    for (const [begin, end] of [["pointerenter", "pointerleave"], ["focus", "blur"]] as const) {
      press.addEventListener(begin, () => this.point(place));
      press.addEventListener(end, () => this.copies?.point(undefined));
    }
    item.append(press);
    return item;
  }

  private field([name, unit, step]: [string, string, number]): HTMLInputElement {
    const [label, input] = [document.createElement("label"), document.createElement("input")];
    Object.assign(input, { type: "number", step, inputMode: "decimal" });
    input.ariaLabel = `Target ${name.toLowerCase()}, ${unit === "m" ? "metres" : "degrees"}`;
    label.append(`${name} `, textElement("small", unit), input);
    element("target").append(label);
    input.addEventListener("input", () => this.type());
    return input;
  }

  /** Solves for the numbers of the fields if all are finite. */
  private type(): void {
    const numbers = this.inputs.map(({ valueAsNumber }) => valueAsNumber);
    if (!numbers.every(Number.isFinite)) return;
    const angles = numbers.slice(3).map((degrees) => (Math.PI / 180) * degrees) as [number, number, number];
    this.solve(fromAngles(numbers as [number, number, number], angles));
  }
}

/** The limits at the ends of an arc; one text for a closed curve. */
function endTexts({ ends, closed }: Arc): string[] {
  return closed ? ["closed curve"] : ends.map(({ limit }) => limit || "end not known");
}
