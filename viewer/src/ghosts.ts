/** The drawn solutions: one translucent copy of the limb each, and the target that the user drags. */

import { Group, Matrix4 } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { App } from "./app";
import { Body, matrix } from "./body";
import type { Limb } from "./data";
import { inverse, multiply, type Frame } from "./pose";
import type { Stage } from "./stage";

/** Opacity of a translucent copy, and of the highlighted one. */
const OPACITY = [0.16, 0.6] as const;

export class Ghosts {
  private readonly bodies: Body[] = [];
  /** The copies along a self-motion. */
  private readonly fan: Body[] = [];
  private readonly group = new Group();
  private readonly handle = new Group();
  private readonly controls: TransformControls;
  private limb: Limb | undefined;
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

  /** Shows the solutions of a limb, except the one that the robot has. */
  show(limb: Limb, target: Frame, frames: Frame[][], taken: number): void {
    if (this.limb !== limb) this.clear();
    this.limb = limb;
    this.group.visible = this.controls.getHelper().visible = this.controls.enabled = true;
    while (this.bodies.length < frames.length) this.bodies.push(this.ghost(limb));
    this.bodies.forEach((body, place) => {
      body.group.visible = place < frames.length && place !== taken;
      if (body.group.visible) body.show(frames[place]!);
    });
    this.spread([]);
    this.moving = true;
    matrix(multiply(this.app.frames[limb.base]!, target)).decompose(this.handle.position, this.handle.quaternion, this.handle.scale);
    this.handle.updateMatrixWorld(true);
    this.moving = false;
    this.stage.draw();
  }

  /** Highlights one copy and shows its self-motion; undefined highlights none. */
  point(place: number | undefined, along: Frame[][] = []): void {
    this.spread(along);
    this.bodies.forEach((body, own) => body.fade(OPACITY[own === place ? 1 : 0]));
    this.stage.draw();
  }

  hide(): void {
    this.group.visible = this.controls.getHelper().visible = this.controls.enabled = false;
    this.stage.draw();
  }

  paint(): void {
    for (const body of [...this.bodies, ...this.fan]) body.paint("accent");
  }

  private clear(): void {
    this.group.clear();
    for (const body of [...this.bodies, ...this.fan]) body.dispose();
    this.bodies.length = this.fan.length = 0;
  }

  private spread(along: Frame[][]): void {
    while (this.limb && this.fan.length < along.length) this.fan.push(this.ghost(this.limb));
    this.fan.forEach((body, place) => {
      body.group.visible = place < along.length;
      if (body.group.visible) body.show(along[place]!);
    });
  }

  private ghost(limb: Limb): Body {
    const body = new Body(this.app.data.robot, this.app.values, this.links(limb));
    body.fade(OPACITY[0]);
    body.paint("accent");
    this.group.add(body.group);
    return body;
  }

  /** The links that the limb moves. */
  private links(limb: Limb): Set<number> {
    const found = new Set<number>();
    const own = new Set(limb.joints);
    for (const [place, { parent, child }] of this.app.data.robot.joints.entries()) if (own.has(place) || found.has(parent)) found.add(child);
    return found;
  }

  private fromHandle(limb: Limb): Frame {
    this.handle.updateMatrix();
    const rows = new Matrix4().copy(this.handle.matrix).transpose().elements;
    return multiply(inverse(this.app.frames[limb.base]!), rows.slice(0, 12));
  }
}
