/** The drawn room of a run: walls, furniture, goal and path. Goal and furniture can be dragged on the floor. */

import {
  BoxGeometry, CylinderGeometry, ExtrudeGeometry, Group, InstancedMesh, Matrix4, Mesh, MeshLambertMaterial, Plane, PlaneGeometry, Raycaster, Shape, Vector2, Vector3, type Object3D,
} from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Scene } from "./data";
import { colour, type Stage } from "./stage";

/** Position and yaw [m, rad]. */
export type Spot = [number, number, number];

/** A room in its current state. */
export interface Furnished {
  readonly scene: Scene;
  /** x, y and an optional heading. */
  readonly goal: number[];
  readonly state: { furniture: { name: string; at: Spot }[]; path: [number, number][] | null; enclosure?: [number, number][] };
}

/** The key of the goal among draggable things; a symbol, because furniture may have any name. */
export const GOAL = Symbol("goal");
export type Thing = string | typeof GOAL;

/** Receiver of dropped things, and of the start and end of a drag. */
export interface Dragging {
  dropped(thing: Thing, at: Spot): void;
  holds(isHeld: boolean): void;
}

/** Drawn height of walls, low for a view into the room [m]. */
const WALL = 0.25;
const FLOOR = new Plane(new Vector3(0, 0, 1), 0);
/** The side of an isolated cell [m]. */
const CELL = 0.05;
/** Centres of cells whose coordinates differ by less than this are in one row [m]. */
const SAME = 1e-4;

export class RoomView {
  readonly group = new Group();
  private readonly things = new Map<Thing, Group>();
  private readonly solid = new MeshLambertMaterial();
  private readonly wall = new MeshLambertMaterial({ transparent: true, opacity: 0.5 });
  private readonly mark = new MeshLambertMaterial();
  private readonly closed = new MeshLambertMaterial({ transparent: true, opacity: 0.35, depthWrite: false });
  private readonly line = new LineMaterial({ linewidth: 3, dashed: true, dashSize: 0.12, gapSize: 0.08, depthWrite: false });
  private readonly path = new Line2(new LineGeometry(), this.line);
  private readonly tile = new PlaneGeometry();
  private cells: InstancedMesh | undefined;
  private enclosure: [number, number][] | undefined;
  private held: { thing: Thing; group: Group; pointer: number; from: Vector3; off: Vector3 } | undefined;

  /** Without `dragging`, nothing can be dragged. */
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
    this.path.frustumCulled = false;
    this.path.position.z = 0.004;
    this.group.add(this.path);
    stage.scene.add(this.group);
    if (dragging) {
      canvas.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
      canvas.addEventListener("pointermove", (event) => this.move(event));
      canvas.addEventListener("pointerup", (event) => this.end(event, true));
      canvas.addEventListener("pointercancel", (event) => this.end(event, false));
    }
    this.show();
  }

  /** Updates all poses except that of the dragged thing. */
  show(): void {
    const { state, goal } = this.room;
    const there = new Map<Thing, Spot>(state.furniture.map(({ name, at }) => [name, at]));
    there.set(GOAL, [goal[0]!, goal[1]!, goal[2] ?? 0]);
    for (const [thing, group] of this.things) {
      if (group === this.held?.group) continue;
      const at = there.get(thing);
      group.visible = at !== undefined;
      if (at) this.put(group, at);
    }
    this.path.visible = state.path !== null && state.path.length > 1;
    if (this.path.visible) {
      this.path.geometry.dispose();
      this.path.geometry = new LineGeometry().setPositions(state.path!.flatMap(([x, y]) => [x, y, 0]));
      this.path.computeLineDistances();
    }
    this.showClosed(state.enclosure);
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

  private addThing(thing: Thing, parts: Mesh[]): void {
    const group = new Group();
    for (const part of parts) part.castShadow = part.receiveShadow = true;
    group.add(...parts);
    this.things.set(thing, group);
    this.group.add(group);
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

  /** Shows the cells that enclose start or goal if there is no path. */
  private showClosed(enclosure: [number, number][] | undefined): void {
    if (enclosure === this.enclosure) return;
    this.enclosure = enclosure;
    this.cells?.removeFromParent().dispose();
    this.cells = undefined;
    if (!enclosure?.length) return;
    const yaw = this.room.scene.origin[2];
    const side = sideOf(enclosure, yaw);
    this.cells = new InstancedMesh(this.tile, this.closed, enclosure.length);
    const turned = new Matrix4().makeRotationZ(yaw).scale(new Vector3(side, side, 1));
    enclosure.forEach(([x, y], place) => this.cells!.setMatrixAt(place, turned.setPosition(x, y, 0.003)));
    this.group.add(this.cells);
  }

  /** The point of the floor under a pointer. */
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
    if (event.button !== 0 || this.held || !this.group.visible) return;
    const ray = this.ray(event);
    const hit = ray.intersectObjects([...this.things.values()].filter(({ visible }) => visible))[0];
    const found = [...this.things].find(([, group]) => group === hit?.object.parent);
    const at = this.onFloor(event, ray);
    if (!found || !at) return;
    const [thing, group] = found;
    this.dragging?.holds(true);
    this.canvas.setPointerCapture(event.pointerId);
    this.held = { thing, group, pointer: event.pointerId, from: group.position.clone(), off: group.position.clone().sub(at) };
  }

  private move(event: PointerEvent): void {
    const at = this.held?.pointer === event.pointerId && this.onFloor(event);
    if (!this.held || !at) return;
    this.held.group.position.copy(at).add(this.held.off).setZ(0);
    this.stage.draw();
  }

  /** Ends a drag: reports the dropped thing, or restores its pose. */
  private end(event: PointerEvent, isDropped: boolean): void {
    if (this.held?.pointer !== event.pointerId) return;
    const { thing, group, from } = this.held;
    this.held = undefined;
    this.dragging?.holds(false);
    const { position: { x, y }, rotation: { z: yaw } } = group;
    if (isDropped && group.position.distanceTo(from) > 1e-6) this.dragging?.dropped(thing, [x, y, yaw]);
    else this.show();
  }
}

/** The side of square cells, from their centres in a room rotated by `yaw` [m, rad]. */
function sideOf(middles: [number, number][], yaw: number): number {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const own = [middles.map(([x, y]) => c * x + s * y), middles.map(([x, y]) => c * y - s * x)];
  const gaps = own.flatMap((along) => along.sort((a, b) => a - b).slice(1).map((value, place) => value - along[place]!));
  const side = gaps.filter((gap) => gap > SAME).reduce((least, gap) => Math.min(least, gap), Infinity);
  return Number.isFinite(side) ? side : CELL;
}
