/** The drawn robot: its shapes, and rods between joints where it has none. */

import {
  Box3, BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, DoubleSide, Group, Matrix4, Mesh, MeshLambertMaterial,
  SphereGeometry, Vector3,
} from "three";
import { surface, type Joint, type Robot, type Shape } from "./data";
import { forward, moves, REST } from "./kinematics";
import type { Frame } from "./pose";
import { colour } from "./stage";

/** three's matrix of a frame. */
export function matrix(frame: ArrayLike<number>): Matrix4 {
  const m = Array.from(frame) as number[];
  return new Matrix4(m[0]!, m[1]!, m[2]!, m[3]!, m[4]!, m[5]!, m[6]!, m[7]!, m[8]!, m[9]!, m[10]!, m[11]!, 0, 0, 0, 1);
}

export class Body {
  readonly group = new Group();
  private readonly links: Group[];
  private readonly plain = new MeshLambertMaterial();
  private readonly bone = new MeshLambertMaterial();
  /** Whether there is any shape or rod. */
  readonly isSeen: boolean;
  /** Size of the robot at the given joint values [m], and its bounding box with the root at the origin. */
  readonly size: number;
  readonly box: Box3;

  /** With `only`, a copy of those links without shadow. */
  constructor(private readonly robot: Robot, values: number[], private readonly only?: Set<number>) {
    this.links = robot.links.map(() => {
      const link = new Group();
      link.matrixAutoUpdate = false;
      return link;
    });
    this.group.add(...this.links);
    robot.links.forEach(({ shapes }, place) => {
      if (this.isIn(place)) shapes.forEach((shape) => this.links[place]!.add(this.shape(shape)));
    });
    const frames = forward(robot, values, REST);
    this.show(frames);
    const span = this.extent(frames);
    this.addBones(span);
    if (only) this.group.traverse((part) => (part.castShadow = false));
    this.show(frames);
    this.box = new Box3().setFromObject(this.group);
    this.isSeen = !this.box.isEmpty();
    this.size = this.isSeen ? Math.max(this.box.getSize(new Vector3()).length(), 1e-3) : 1;
  }

  /** Sets the frames of the links. */
  show(frames: Frame[]): void {
    frames.forEach((frame, place) => {
      const link = this.links[place]!;
      link.matrix.copy(matrix(frame));
      link.matrixWorldNeedsUpdate = true;
    });
    this.group.updateMatrixWorld(true);
  }

  /** Applies the colours of the theme, or the colour `all` to every part. */
  paint(all?: string): void {
    this.plain.color.copy(colour(all ?? "robot"));
    this.bone.color.copy(colour(all ?? "bone"));
  }

  /** Makes the body translucent. */
  fade(opacity: number): void {
    for (const material of [this.plain, this.bone]) Object.assign(material, { opacity, transparent: true, depthWrite: false });
  }

  /** Releases its geometry and materials on the graphics processor. */
  dispose(): void {
    this.group.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      part.geometry.dispose();
      part.material.dispose();
    });
  }

  private isIn(link: number): boolean {
    return this.only?.has(link) ?? true;
  }

  /** The diagonal of the bounding box of all shapes and joints. */
  private extent(frames: Frame[]): number {
    const box = new Box3().setFromObject(this.group);
    for (const frame of frames) box.expandByPoint(new Vector3(frame[3], frame[7], frame[11]));
    return box.getSize(new Vector3()).length();
  }

  private shape(shape: Shape): Mesh {
    const [red, green, blue, opacity = 1] = shape.colour ?? [];
    const material = red === undefined || this.only
      ? this.plain
      : new MeshLambertMaterial({ color: new Color().setRGB(red, green!, blue!, "srgb"), transparent: opacity < 1, opacity });
    const solid = mesh(geometry(shape), material);
    if (shape.kind === "mesh") {
      solid.material = material.clone();
      solid.material.side = DoubleSide;
      solid.material.flatShading = true;
      if (material === this.plain) solid.material.color = this.plain.color;
    }
    solid.matrix.copy(matrix(shape.pose));
    solid.matrixAutoUpdate = false;
    return solid;
  }

  /** Adds thin rods between shapes; a robot without shapes has thick rods, and cylinders along its axes. */
  private addBones(span: number): void {
    const { links, joints } = this.robot;
    const isBare = links.every(({ shapes }) => shapes.length === 0);
    const hasMeshes = links.some(({ shapes }) => shapes.some(({ kind }) => kind === "mesh"));
    const radius = (isBare ? 0.016 : 0.008) * span;
    const matters = this.mattering();
    for (const joint of joints) {
      const offset = new Vector3(joint.origin[3], joint.origin[7], joint.origin[11]);
      const isCovered = hasMeshes && links[joint.parent]!.shapes.length > 0;
      if ((!isBare && !matters.has(joint)) || isCovered) continue;
      if (offset.length() > 1e-3 * span && this.isIn(joint.parent)) {
        const bone = mesh(new CapsuleGeometry(radius, offset.length(), 4, 12).rotateX(Math.PI / 2), this.bone);
        bone.position.copy(offset).multiplyScalar(0.5);
        bone.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), offset.clone().normalize());
        this.links[joint.parent]!.add(bone);
      }
      if (isBare && moves(joint) && this.isIn(joint.child)) this.links[joint.child]!.add(this.axle(joint, radius));
    }
  }

  /** A cylinder along the axis of a joint. */
  private axle(joint: Joint, radius: number): Mesh {
    const axle = mesh(new CylinderGeometry(1.9 * radius, 1.9 * radius, 4.5 * radius, 24).rotateX(Math.PI / 2), this.plain);
    axle.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...joint.axis));
    return axle;
  }

  /** The joints that move, or that carry a shape or another such joint. */
  private mattering(): Set<Joint> {
    const found = new Set<Joint>();
    const links = new Set<number>();
    for (const joint of [...this.robot.joints].reverse()) {
      const { shapes, hidden } = this.robot.links[joint.child]!;
      if (moves(joint) || shapes.length > 0 || hidden || links.has(joint.child)) {
        found.add(joint);
        links.add(joint.parent);
      }
    }
    return found;
  }
}

function mesh(geometry: BufferGeometry, material: MeshLambertMaterial): Mesh<BufferGeometry, MeshLambertMaterial> {
  const made = new Mesh(geometry, material);
  made.castShadow = true;
  return made;
}

/** The solid; cylinders and capsules are along z. */
function geometry(shape: Shape): BufferGeometry {
  switch (shape.kind) {
    case "box":
      return new BoxGeometry(...shape.size);
    case "cylinder":
      return new CylinderGeometry(shape.radius, shape.radius, shape.length, 32).rotateX(Math.PI / 2);
    case "capsule":
      return new CapsuleGeometry(shape.radius, shape.length, 10, 28).rotateX(Math.PI / 2);
    case "sphere":
      return new SphereGeometry(shape.radius, 32, 20);
    case "mesh": {
      const { positions, triangles } = surface(shape);
      const made = new BufferGeometry();
      made.setAttribute("position", new BufferAttribute(positions, 3));
      made.setIndex(new BufferAttribute(triangles, 1));
      return made;
    }
  }
}
