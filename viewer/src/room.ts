/** The room of a run: walls, furniture, goal and way, dragged on the floor. */

import {
  BoxGeometry, CylinderGeometry, ExtrudeGeometry, Group, Mesh, MeshLambertMaterial, Plane, PlaneGeometry, Raycaster, Shape, Vector2, Vector3, type Object3D,
} from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Scene } from "./data";
import { colour, type Stage } from "./stage";

/** Place and yaw [m, rad]. */
export type Spot = [number, number, number];

/** A room with what is in it now. */
export interface Furnished {
  readonly scene: Scene;
  /** x, y and perhaps where to look. */
  readonly goal: number[];
  readonly told: { furniture: { name: string; at: Spot }[]; way: [number, number][] | null; enclosure?: [number, number][] };
}

/** Hears where something was put, and of the beginning and end of a drag. */
export interface Dragging {
  dropped(name: string, at: Spot): void;
  holds(isHeld: boolean): void;
}

/** How high walls are drawn: low, so that one sees over them [m]. */
const WALL = 0.25;
const FLOOR = new Plane(new Vector3(0, 0, 1), 0);
/** The name of the goal among what is dragged. */
export const GOAL = "goal";

export class RoomView {
  readonly group = new Group();
  private readonly things = new Map<string, Group>();
  private readonly solid = new MeshLambertMaterial();
  private readonly wall = new MeshLambertMaterial({ transparent: true, opacity: 0.5 });
  private readonly mark = new MeshLambertMaterial();
  private readonly closed = new MeshLambertMaterial({ transparent: true, opacity: 0.35, depthWrite: false });
  private readonly line = new LineMaterial({ linewidth: 3, dashed: true, dashSize: 0.12, gapSize: 0.08, depthWrite: false });
  private readonly way = new Line2(new LineGeometry(), this.line);
  private readonly cells = new Group();
  private held: { name: string; group: Group; from: Vector3; off: Vector3 } | undefined;

  /** Without `dragging` all stays where it is. */
  constructor(
    private readonly room: Furnished,
    private readonly stage: Stage,
    private readonly canvas: HTMLCanvasElement,
    private readonly dragging?: Dragging,
  ) {
    this.addWalls();
    for (const piece of room.scene.pieces) this.addThing(piece.name, [this.piece(piece.outline, piece.height)]);
    const pole = new Mesh(new CylinderGeometry(0.012, 0.012, 0.5, 12).rotateX(Math.PI / 2).translate(0, 0, 0.25), this.mark);
    const foot = new Mesh(new CylinderGeometry(0.12, 0.12, 0.01, 32).rotateX(Math.PI / 2).translate(0, 0, 0.005), this.mark);
    const flag = new Mesh(new BoxGeometry(0.2, 0.012, 0.12).translate(0.1, 0, 0.44), this.mark);
    this.addThing(GOAL, [pole, foot, flag]);
    this.way.frustumCulled = false;
    this.way.position.z = 0.004;
    this.group.add(this.way, this.cells);
    stage.scene.add(this.group);
    if (dragging) {
      canvas.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
      canvas.addEventListener("pointermove", (event) => this.move(event));
      for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, () => this.up());
    }
    this.show();
  }

  /** Puts all where the room has it. */
  show(): void {
    const { told, goal } = this.room;
    const there = new Map(told.furniture.map(({ name, at }) => [name, at]));
    there.set(GOAL, [goal[0]!, goal[1]!, goal[2] ?? 0]);
    for (const [name, thing] of this.things) {
      const at = there.get(name);
      thing.visible = at !== undefined;
      if (at) this.put(thing, at);
    }
    this.way.visible = told.way !== null && told.way.length > 1;
    if (this.way.visible) {
      this.way.geometry.dispose();
      this.way.geometry = new LineGeometry().setPositions(told.way!.flatMap(([x, y]) => [x, y, 0]));
      this.way.computeLineDistances();
    }
    this.showClosed(told.enclosure ?? []);
    this.stage.draw();
  }

  paint(): void {
    this.solid.color.copy(colour("trace", 0.35));
    this.wall.color.copy(colour("trace", 0.2));
    this.mark.color.copy(colour("accent"));
    this.line.color.copy(colour("accent"));
    this.closed.color.copy(colour("fault"));
  }

  private put(thing: Object3D, [x, y, yaw]: Spot): void {
    thing.position.set(x, y, 0);
    thing.rotation.z = yaw;
  }

  private addThing(name: string, parts: Mesh[]): void {
    const thing = new Group();
    thing.name = name;
    for (const part of parts) part.castShadow = part.receiveShadow = true;
    thing.add(...parts);
    this.things.set(name, thing);
    this.group.add(thing);
  }

  private piece(outline: [number, number][], height: number): Mesh {
    const shape = new Shape(outline.map(([x, y]) => new Vector2(x, y)));
    return new Mesh(new ExtrudeGeometry(shape, { depth: height, bevelEnabled: false }), this.solid);
  }

  private addWalls(): void {
    const { size: [length, width], wall, origin: [x, y, yaw] } = this.room.scene;
    const walls = new Group();
    this.put(walls, [x, y, yaw]);
    if (wall > 0) {
      for (const [w, d, cx, cy] of [[length, wall, length / 2, wall / 2], [length, wall, length / 2, width - wall / 2], [wall, width, wall / 2, width / 2], [wall, width, length - wall / 2, width / 2]] as const) {
        walls.add(new Mesh(new BoxGeometry(w, d, WALL).translate(cx, cy, WALL / 2), this.wall));
      }
    }
    this.group.add(walls);
  }

  /** The cells that enclose start or goal, where there is no way. */
  private showClosed(cells: [number, number][]): void {
    this.cells.clear();
    if (cells.length === 0) return;
    const [xs, ys] = [cells.map(([x]) => x), cells.map(([, y]) => y)];
    const side = Math.min(...[...new Set(xs.map((x) => x.toFixed(6)))].map(Number).sort((a, b) => a - b).map((x, place, all) => (place ? x - all[place - 1]! : Infinity)));
    const tile = new PlaneGeometry(Number.isFinite(side) ? side : 0.05, Number.isFinite(side) ? side : 0.05);
    cells.forEach((_, place) => {
      const mesh = new Mesh(tile, this.closed);
      mesh.position.set(xs[place]!, ys[place]!, 0.003);
      this.cells.add(mesh);
    });
  }

  /** Where a pointer is on the floor. */
  private onFloor(event: PointerEvent, ray = this.ray(event)): Vector3 | undefined {
    return ray.ray.intersectPlane(FLOOR, new Vector3()) ?? undefined;
  }

  private ray({ clientX, clientY }: PointerEvent): Raycaster {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height), this.stage.camera);
    return ray;
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || !this.group.visible) return;
    const ray = this.ray(event);
    const hit = ray.intersectObjects([...this.things.values()].filter(({ visible }) => visible))[0];
    const group = hit?.object.parent as Group | undefined;
    const at = this.onFloor(event, ray);
    if (!group || !at) return;
    this.dragging?.holds(true);
    this.canvas.setPointerCapture(event.pointerId);
    this.held = { name: group.name, group, from: group.position.clone(), off: group.position.clone().sub(at) };
  }

  private move(event: PointerEvent): void {
    const at = this.held && this.onFloor(event);
    if (!this.held || !at) return;
    this.held.group.position.copy(at).add(this.held.off).setZ(0);
    this.stage.draw();
  }

  private up(): void {
    if (!this.held) return;
    const { name, group, from } = this.held;
    this.held = undefined;
    this.dragging?.holds(false);
    if (group.position.distanceTo(from) > 1e-6) this.dragging?.dropped(name, [group.position.x, group.position.y, group.rotation.z]);
  }
}
