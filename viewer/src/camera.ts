/** Camera control: dragging, preset views, and following the robot. */

import { Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Vector } from "./pose";
import type { Stage } from "./stage";

/** Direction of the camera from the robot; x is forward, y to the left. */
const VIEWS = {
  front: [1, 0, 0.12],
  side: [0, -1, 0.12],
  top: [-0.001, 0, 1],
  iso: [0.85, -1.1, 0.55],
  follow: [0.85, -1.1, 0.55],
} as const;

/** Ratio of the visible extent to that of the robot. */
const ROOM = 1.06;

export type View = keyof typeof VIEWS;
export const VIEW_NAMES = Object.keys(VIEWS) as View[];

export class CameraControl {
  private readonly controls: OrbitControls;
  private followed: Vector | undefined;

  /**
   * `middle` is the target of the camera, from the robot's root; `extent` is radius and height of an upright cylinder round the robot [m]. In a room all views
   * except `follow` show the whole room.
   */
  constructor(
    private readonly stage: Stage,
    canvas: HTMLCanvasElement,
    private readonly middle: Vector,
    private readonly extent: [number, number],
    private readonly room?: { middle: Vector; extent: [number, number] },
  ) {
    this.controls = new OrbitControls(stage.camera, canvas);
    const size = Math.max(...extent);
    this.controls.minDistance = 0.2 * size;
    this.controls.maxDistance = 25 * Math.max(size, 0.2 * (room?.extent[0] ?? 0));
    this.controls.addEventListener("change", () => stage.draw());
  }

  /** Selects a preset view of the robot, whose root is at `root`; `follow` then moves with it. */
  look(view: View, root: Vector): void {
    this.followed = view === "follow" ? root : undefined;
    const { camera } = this.stage;
    const room = view === "follow" ? undefined : this.room;
    if (room) this.controls.target.set(...room.middle);
    else this.controls.target.set(root[0] + this.middle[0], root[1] + this.middle[1], root[2] + this.middle[2]);
    const away = new Vector3(...VIEWS[view]).normalize();
    away.multiplyScalar(this.distance(away.z, room?.extent ?? this.extent));
    camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.stage.draw();
  }

  /** The distance at which the whole cylinder is visible; `sine` is that of the camera's elevation. */
  private distance(sine: number, [radius, height]: [number, number]): number {
    const { fov, aspect } = this.stage.camera;
    const tangent = Math.tan((fov / 360) * Math.PI);
    const upright = 0.5 * height * Math.sqrt(1 - sine * sine) + radius * sine;
    return ROOM * Math.max(upright / (tangent * this.stage.clear), radius / (tangent * aspect)) + radius;
  }

  /** Disables camera dragging while something else is dragged. */
  hold(isHeld: boolean): void {
    this.controls.enabled = !isHeld;
  }

  /** Moves with the root in the view `follow`. */
  go(root: Vector): void {
    if (!this.followed) return;
    const step = new Vector3(root[0] - this.followed[0], root[1] - this.followed[1], 0);
    this.followed = root;
    this.controls.target.add(step);
    this.stage.camera.position.add(step);
    this.controls.update();
  }
}
