/** The three-dimensional picture: the robot with overlays, solutions, reach map and room. */

import { Box3, Vector3 } from "three";
import type { App } from "./app";
import { Body } from "./body";
import { Cloud } from "./cloud";
import { TranslucentCopies } from "./copies";
import type { Motion, Scene } from "./data";
import { CameraControl, type View } from "./camera";
import { Overlays, type Layer } from "./overlays";
import { move, type Frame, type Vector } from "./pose";
import { RoomView, type Dragging } from "./room";
import type { Run } from "./run";
import { Stage } from "./stage";

/** The extent of a whole room for the camera. */
function furnished({ size: [length, width], origin: [x, y, yaw] }: Scene): { middle: Vector; extent: [number, number] } {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const [ahead, aside] = [length / 2, width / 2];
  return { middle: [x + c * ahead - s * aside, y + s * ahead + c * aside, 0.3], extent: [Math.hypot(ahead, aside), 0.8] };
}

export class Picture {
  readonly layers: Layer[];
  readonly isSeen: boolean;
  /** The side of a cell of the grid [m]. */
  readonly cell: number;
  private readonly stage: Stage;
  private readonly body: Body;
  private overlays: Overlays | undefined;
  private readonly camera: CameraControl;
  private copies: TranslucentCopies | undefined;
  private room: RoomView | undefined;
  private readonly cloud: Cloud | undefined;

  /** Throws NoPicture if the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly app: App) {
    const { robot, motion } = app.data;
    this.body = new Body(robot, app.values);
    const { box, size } = this.body;
    this.isSeen = this.body.isSeen;
    const floor = motion?.base || !this.isSeen ? 0 : Math.min(0, box.min.z);
    this.stage = new Stage(canvas, size, floor);
    this.cell = this.stage.cell;
    this.overlays = motion && new Overlays(motion, size);
    this.stage.scene.add(this.body.group);
    if (this.overlays) this.stage.scene.add(this.overlays.group);
    this.layers = [{ name: "Robot", tone: "bone", isFlat: true, group: this.body.group }, ...(this.overlays?.layers ?? []), { name: "Axes", tone: "trace", isFlat: true, group: this.stage.axes }];
    this.cloud = app.reached && new Cloud(app.reached, size);
    if (this.cloud) this.stage.scene.add(this.cloud.mesh);
    const { middle, extent } = this.sight();
    const { scene } = app.data.run ?? app.data.task ?? {};
    this.camera = new CameraControl(this.stage, canvas, middle, extent, scene && furnished(scene));
    if (app.task) this.room = new RoomView(app.task, this.stage, canvas);
    this.paint();
    this.stage.resize();
    this.show();
    new ResizeObserver(() => this.stage.resize()).observe(canvas);
  }

  private get root(): Vector {
    return this.app.base.slice(0, 3) as Vector;
  }

  /** The extent of the robot and its reach, from its root: the middle, and radius and height of an upright cylinder [m]. */
  private sight(): { middle: Vector; extent: [number, number] } {
    const { min, max } = this.body.box;
    const corners = this.body.isSeen ? [min, max, new Vector3(min.x, max.y, min.z), new Vector3(max.x, min.y, min.z)] : [];
    const points = corners.concat(this.reached());
    if (points.length === 0) return { middle: [0, 0, 0], extent: [Math.SQRT1_2, 1] };
    const box = new Box3().setFromPoints(points);
    const middle = box.getCenter(new Vector3());
    const radius = points.reduce((most, { x, y }) => Math.max(most, Math.hypot(x - middle.x, y - middle.y)), 0);
    return { middle: middle.toArray(), extent: [radius, box.max.z - box.min.z] };
  }

  /** The reached places, from the root [m]. */
  private reached(): Vector3[] {
    const { reached, frames } = this.app;
    const root = new Vector3(...this.root);
    return reached?.chosen.map((place) => new Vector3(...move(frames[reached.data.base]!, reached.where(place))).sub(root)) ?? [];
  }

  show(): void {
    this.body.show(this.app.frames);
    this.cloud?.show(this.app.frames);
    if (this.app.place) this.overlays?.show(this.app.place);
    if (this.app.hasNewRoom) this.room?.show();
    this.stage.moveTo(this.root);
    this.camera.go(this.root);
    this.stage.draw();
  }

  /** The position of a point on the screen [pixels]. */
  onScreen(point: Vector): [number, number] {
    return this.stage.onScreen(point);
  }

  /** Adds the translucent copies of solutions and the target. */
  withCopies(dragged: (target: Frame) => void): TranslucentCopies {
    this.copies = new TranslucentCopies(this.app, this.stage, this.canvas, dragged, (isHeld) => this.camera.hold(isHeld));
    return this.copies;
  }

  /** Draws the selected places of the reach map. Returns the number of drawn places. */
  showReach(): number {
    this.cloud?.fill();
    this.stage.draw();
    return this.cloud?.drawn ?? 0;
  }

  /** Adds the room of a run; its goal and furniture can be dragged. */
  withRoom(run: Run, dropped: Dragging["dropped"]): RoomView {
    this.room = new RoomView(run, this.stage, this.canvas, { dropped, holds: (isHeld) => this.camera.hold(isHeld) });
    this.room.paint();
    return this.room;
  }

  /** Shows a longer motion; the visibility of layers is unchanged. */
  grow(motion: Motion): void {
    const before = this.overlays;
    if (!before) return;
    this.stage.scene.remove(before.group);
    before.dispose();
    this.overlays = new Overlays(motion, this.body.size);
    this.overlays.paint();
    for (const { name, group } of this.overlays.layers) {
      const layer = this.layers.find((own) => own.name === name);
      if (!layer) continue;
      group.visible = layer.group.visible;
      layer.group = group;
    }
    this.stage.scene.add(this.overlays.group);
  }

  look(view: View): void {
    this.camera.look(view, this.root);
  }

  toggle(layer: Layer): void {
    layer.group.visible = !layer.group.visible;
    this.stage.draw();
  }

  /** Centres the picture between the parts covered at the top and at the bottom [pixels]. */
  keepClear(top: number, bottom: number): void {
    this.stage.keepClear(top, bottom);
  }

  /** Applies the colours of the theme. */
  paint(): void {
    this.body.paint();
    this.overlays?.paint();
    this.copies?.paint();
    this.room?.paint();
    this.stage.paint();
  }
}
