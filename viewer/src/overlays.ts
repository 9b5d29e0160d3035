/** Overlays of a walk: soles, footsteps, the support polygon, points such as the zero moment point, and their paths. */

import { BufferAttribute, BufferGeometry, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Motion, Polygon } from "./data";
import { fromPose, move, turn, type Frame, type Vector } from "./pose";
import { colour } from "./stage";
import { at, poseAt, type Place } from "./time";
import { displayName } from "./format";

/** A group of objects that can be shown or hidden. */
export interface Layer {
  name: string;
  /** Its colour in the style sheet. */
  tone: string;
  isFlat: boolean;
  group: Group;
}

type Painted = { color: { copy(colour: unknown): unknown } };

export class Overlays {
  readonly layers: Layer[] = [];
  readonly group = new Group();
  private readonly painted: [Painted, string, number][] = [];
  private readonly updates: ((place: Place) => void)[] = [];
  /** Step of heights above the floor, which separates coplanar layers [m]. */
  private readonly lift: number;

  constructor(private readonly motion: Motion, private readonly size: number) {
    this.lift = 2e-4 * size;
    if (motion.support) this.addSupport(motion.support);
    if (motion.steps.length > 0) this.addSteps();
    if (motion.contacts.length > 0) this.addSoles();
    for (const { name, at: tracks } of motion.points) this.addPoint(name, tracks as [Float64Array, Float64Array, Float64Array]);
  }

  /** Releases its geometry and materials on the graphics processor. */
  dispose(): void {
    this.group.traverse((part) => {
      if ("geometry" in part) (part.geometry as BufferGeometry).dispose();
    });
    for (const [material] of this.painted) (material as unknown as { dispose(): void }).dispose();
  }

  show(place: Place): void {
    this.updates.forEach((update) => update(place));
  }

  paint(): void {
    for (const [material, tone, faint] of this.painted) material.color.copy(colour(tone, faint));
  }

  private layer(name: string, tone: string, isFlat = true): Group {
    const group = new Group();
    this.layers.push({ name, tone, isFlat, group });
    this.group.add(group);
    return group;
  }

  private flat(tone: string, opacity: number): MeshBasicMaterial {
    const material = new MeshBasicMaterial({ transparent: true, opacity, depthWrite: false, side: 2 });
    this.painted.push([material, tone, 0]);
    return material;
  }

  /** A material of thick lines. They are opaque, because overlapping segments of transparent lines would be visible. */
  private thick(tone: string, linewidth: number, faint = 0): LineMaterial {
    const material = new LineMaterial({ linewidth, depthWrite: false });
    this.painted.push([material as unknown as Painted, tone, faint]);
    return material;
  }

  private addSupport(polygons: Polygon[]): void {
    const group = this.layer("Support polygon", "accent");
    const most = polygons.reduce((count, polygon) => Math.max(count, polygon.length / 2), 0);
    const corners = new BufferAttribute(new Float32Array(3 * most), 3);
    const fan = new BufferGeometry().setAttribute("position", corners);
    fan.setIndex(Array.from({ length: Math.max(most - 2, 0) }, (_, place) => [0, place + 1, place + 2]).flat());
    const area = new Mesh(fan, this.flat("accent", 0.16));
    const border = new Line2(new LineGeometry(), this.thick("accent", 2));
    for (const [order, part] of [area, border].entries()) {
      part.frustumCulled = false;
      part.renderOrder = order;
      group.add(part);
    }
    let shown: Polygon | undefined;
    this.updates.push(({ sample }) => {
      const polygon = polygons[sample]!;
      if (polygon === shown) return;
      shown = polygon;
      const points = this.onFloor(polygon, 2);
      corners.array.set(points.slice(0, -3));
      corners.needsUpdate = true;
      fan.setDrawRange(0, 3 * Math.max(polygon.length / 2 - 2, 0));
      border.geometry.dispose();
      border.geometry = new LineGeometry();
      border.visible = polygon.length > 2;
      if (border.visible) border.geometry.setPositions(points);
    });
  }

  /** The corners of a polygon on the floor; the first is repeated at the end. */
  private onFloor(polygon: ArrayLike<number>, level: number): number[] {
    const points: number[] = [];
    for (let place = 0; place < polygon.length; place += 2) points.push(polygon[place]!, polygon[place + 1]!, level * this.lift);
    return [...points, ...points.slice(0, 3)];
  }

  private outline(foot: string): [number, number][] {
    return this.motion.contacts.find(({ name }) => name === foot)?.outline ?? [];
  }

  private addSteps(): void {
    const group = this.layer("Footsteps", "trace");
    const material = this.thick("trace", 1.5, 0.2);
    for (const { foot, x, y, yaw } of this.motion.steps) {
      const frame = turn([0, 0, 1], yaw);
      [frame[3], frame[7]] = [x, y];
      const line = this.loop(this.outline(foot), frame, 1, material);
      if (line) group.add(line);
    }
  }

  private loop(outline: [number, number][], frame: Frame, level: number, material: LineMaterial): Line2 | undefined {
    if (outline.length < 2) return undefined;
    const points = [...outline, outline[0]!].flatMap(([x, y]) => {
      const [wx, wy, wz] = move(frame, [x, y, 0]);
      return [wx, wy, wz + level * this.lift];
    });
    const line = new Line2(new LineGeometry(), material);
    line.geometry.setPositions(points);
    return line;
  }

  /** The outlines of the soles, thick while in contact; for soles without outline the axes of their frames. */
  private addSoles(): void {
    const group = this.layer("Soles", "ink");
    const [standing, swinging] = [this.thick("ink", 2.5), this.thick("ink", 1.5, 0.5)];
    for (const { poses, stands, outline } of this.motion.contacts) {
      const arm = 0.05 * this.size;
      const corners: [number, number][] = outline.length > 1 ? outline : [[-arm, 0], [arm, 0], [0, 0], [0, -arm], [0, arm], [0, 0]];
      const line = this.loop(corners, fromPose([0, 0, 0, 0, 0, 0, 1]), 3, standing)!;
      line.matrixAutoUpdate = false;
      line.renderOrder = 2;
      group.add(line);
      this.updates.push((place) => {
        const f = fromPose(poseAt(poses, place));
        line.matrix.set(f[0]!, f[1]!, f[2]!, f[3]!, f[4]!, f[5]!, f[6]!, f[7]!, f[8]!, f[9]!, f[10]!, f[11]!, 0, 0, 0, 1);
        line.matrixWorldNeedsUpdate = true;
        line.material = stands[place.sample] === "1" ? standing : swinging;
      });
    }
  }

  /** A point, its whole path, its path so far, and a plumb line if it is above the floor. */
  private addPoint(name: string, tracks: [Float64Array, Float64Array, Float64Array]): void {
    const tone = name === "zmp" ? "accent" : name === "com" ? "ink" : "trace";
    const group = this.layer(displayName(name), tone, false);
    group.visible = name === "zmp" || name === "com";
    const level = 5 * this.lift;
    const positions = Array.from(tracks[0], (x, sample) => [x, tracks[1][sample]!, tracks[2][sample]! + level]).flat();
    const isLine = tracks[0].length > 1;
    if (isLine) group.add(this.trail(positions, this.thick(tone, 1.5, 0.65)));
    const gone = this.trail(positions, this.thick(tone, 2.5));
    gone.visible = isLine;
    const ball = new Mesh(new SphereGeometry(0.014 * this.size, 24, 16), this.flat(tone, 1));
    ball.material.depthTest = false;
    ball.renderOrder = 10;
    const plumb = new Line(new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(6), 3)), new LineBasicMaterial({ transparent: true, opacity: 0.5, depthTest: false }));
    this.painted.push([plumb.material, tone, 0]);
    plumb.frustumCulled = false;
    plumb.renderOrder = 9;
    group.add(gone, ball, plumb);
    this.updates.push((place) => {
      const point = tracks.map((track) => at(track, place)) as Vector;
      ball.position.set(...point);
      plumb.visible = point[2] > 0.05 * this.size;
      plumb.geometry.attributes["position"]!.array.set([...point, point[0], point[1], 0]);
      plumb.geometry.attributes["position"]!.needsUpdate = true;
      gone.geometry.instanceCount = place.sample;
    });
  }

  private trail(positions: number[], material: LineMaterial): Line2 {
    const line = new Line2(new LineGeometry(), material);
    if (positions.length > 3) line.geometry.setPositions(positions);
    line.frustumCulled = false;
    line.renderOrder = 3;
    return line;
  }
}
