/** The drawn solutions: translucent copies of the limb, and the target that the user drags. */

import { Group, Matrix4 } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { App } from "./app";
import { Body, matrix } from "./body";
import type { Limb } from "./data";
import { inverse, multiply, type Frame } from "./pose";
import type { Stage } from "./stage";

/** Opacity of a translucent copy, and of a highlighted one. */
const SINGLE = [0.16, 0.6] as const;
/** The same of copies along arcs; `sum` bounds the sum of all, because they overlap. */
const ALONG = { faint: 0.07, strong: 0.2, sum: 1.5 };

/** A translucent copy of the limb. */
export interface Copy {
  /** The index of its row in the list of solutions or arcs. */
  row: number;
  /** The frames of all links. */
  frames: Frame[];
}

export class TranslucentCopies {
  private readonly bodies: Body[] = [];
  /** The copies along a self-motion. */
  private readonly along: Body[] = [];
  private readonly group = new Group();
  private readonly handle = new Group();
  private readonly controls: TransformControls;
  private limb: Limb | undefined;
  private copies: Copy[] = [];
  /** The arc that is highlighted while the user points at no row; undefined for single solutions. */
  private arc: number | undefined;
  private moving = false;

  /** `dragged` is called with every dragged target, `holds` when dragging starts and ends. */
  constructor(private readonly app: App, private readonly stage: Stage, canvas: HTMLCanvasElement, dragged: (target: Frame) => void, holds: (isHeld: boolean) => void) {
    this.controls = new TransformControls(stage.camera, canvas);
    this.controls.size = 0.7;
    this.controls.attach(this.handle);
    this.controls.addEventListener("change", () => stage.draw());
    this.controls.addEventListener("dragging-changed", ({ value }) => holds(Boolean(value)));
    this.controls.addEventListener("objectChange", () => {
      if (!this.moving && this.limb) dragged(this.fromHandle(this.limb));
    });
    stage.scene.add(this.group, this.handle, this.controls.getHelper());
    this.hide();
  }

  /** Whether dragging rotates the target instead of moving it. */
  set turns(isTurned: boolean) {
    this.controls.setMode(isTurned ? "rotate" : "translate");
    this.controls.setSpace(isTurned ? "local" : "world");
    this.stage.draw();
  }

  /** Shows copies of a limb, and its target. Copies along arcs have the row of their arc, of which `arc` is highlighted. */
  show(limb: Limb, target: Frame, copies: Copy[], arc?: number): void {
    if (this.limb !== limb) this.clear();
    [this.limb, this.copies, this.arc] = [limb, copies, arc];
    this.group.visible = this.controls.getHelper().visible = this.controls.enabled = true;
    this.place(this.bodies, copies.map(({ frames }) => frames));
    this.moving = true;
    matrix(multiply(this.app.frames[limb.base]!, target)).decompose(this.handle.position, this.handle.quaternion, this.handle.scale);
    this.handle.updateMatrixWorld(true);
    this.moving = false;
    this.point(undefined);
  }

  /** Highlights the copies of one row and shows its self-motion; undefined highlights those of the present arc. */
  point(row: number | undefined, motion: Frame[][] = []): void {
    this.place(this.along, motion);
    const along = [Math.min(ALONG.faint, ALONG.sum / this.copies.length), ALONG.strong] as const;
    const [faint, strong] = this.arc === undefined ? SINGLE : along;
    const highlighted = row ?? this.arc;
    this.copies.forEach((copy, place) => this.bodies[place]!.fade(copy.row === highlighted ? strong : faint));
    this.stage.draw();
  }

  hide(): void {
    this.group.visible = this.controls.getHelper().visible = this.controls.enabled = false;
    this.stage.draw();
  }

  paint(): void {
    for (const body of [...this.bodies, ...this.along]) body.paint("accent");
  }

  private clear(): void {
    this.group.clear();
    for (const body of [...this.bodies, ...this.along]) body.dispose();
    this.bodies.length = this.along.length = 0;
  }

  /** Shows one of `bodies` at each of `frames`, and hides the others. */
  private place(bodies: Body[], frames: Frame[][]): void {
    while (this.limb && bodies.length < frames.length) bodies.push(this.copy(this.limb));
    bodies.forEach((body, place) => {
      body.group.visible = place < frames.length;
      if (body.group.visible) body.show(frames[place]!);
    });
  }

  private copy(limb: Limb): Body {
    const body = new Body(this.app.data.robot, this.app.values, this.links(limb));
    body.fade(SINGLE[0]);
    body.paint("accent");
    this.group.add(body.group);
    return body;
  }

  /** The links that the limb moves while its tip is at the target: those before its last joint. */
  private links(limb: Limb): Set<number> {
    const found = new Set<number>();
    const own = new Set(limb.joints);
    const last = Math.max(...limb.joints);
    for (const [place, { parent, child }] of this.app.data.robot.joints.entries()) {
      if (place !== last && (own.has(place) || found.has(parent))) found.add(child);
    }
    return found;
  }

  private fromHandle(limb: Limb): Frame {
    this.handle.updateMatrix();
    const rows = new Matrix4().copy(this.handle.matrix).transpose().elements;
    return multiply(inverse(this.app.frames[limb.base]!), rows.slice(0, 12));
  }
}
