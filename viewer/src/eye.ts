/** The camera: dragged by hand, put to presets, and going with the robot. */

import { Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Vector } from "./pose";
import type { Stage } from "./stage";

/** Where the eye is, seen from the robot; x is ahead, y to its left. */
const VIEWS = {
  front: [1, 0, 0.12],
  side: [0, -1, 0.12],
  top: [-0.001, 0, 1],
  iso: [0.85, -1.1, 0.55],
  follow: [0.85, -1.1, 0.55],
} as const;

/** How much more is seen than the robot. */
const ROOM = 1.06;

export type View = keyof typeof VIEWS;
export const VIEW_NAMES = Object.keys(VIEWS) as View[];

export class Eye {
  private readonly controls: OrbitControls;
  private followed: Vector | undefined;

  /**
   * `middle` is what is looked at, from the robot's root; `[radius, height]` are those of an upright cylinder about the robot [m]. In a room all of it is
   * seen, but where the eye follows the robot.
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

  /** Looks at the robot, whose root is at `root`, from one side; from then on it follows, or not. */
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

  /** How far away the cylinder is seen as a whole, from so far above as the sine says. */
  private distance(sine: number, [radius, height]: [number, number]): number {
    const { fov, aspect } = this.stage.camera;
    const tangent = Math.tan((fov / 360) * Math.PI);
    const upright = 0.5 * height * Math.sqrt(1 - sine * sine) + radius * sine;
    return ROOM * Math.max(upright / (tangent * this.stage.clear), radius / (tangent * aspect)) + radius;
  }

  /** Lets go of the picture while something else is dragged. */
  hold(isHeld: boolean): void {
    this.controls.enabled = !isHeld;
  }

  /** Goes with the root, where it follows. */
  go(root: Vector): void {
    if (!this.followed) return;
    const step = new Vector3(root[0] - this.followed[0], root[1] - this.followed[1], 0);
    this.followed = root;
    this.controls.target.add(step);
    this.stage.camera.position.add(step);
    this.controls.update();
  }
}
