/**
 * What the page shows, as `groebot view` writes it into `<script type="application/json" id="groebot-data">`; src/view/data.rs says the same in
 * Rust. Metres, radians, seconds; frames are the twelve numbers of a 3x4 matrix by rows; poses are position and quaternion xyzw.
 */

/** A number for each sample: the same for all, or little-endian doubles in base64. */
export type Column = number | string;

export type Solid =
  | { kind: "box"; size: [number, number, number] }
  | { kind: "cylinder" | "capsule"; radius: number; length: number }
  | { kind: "sphere"; radius: number }
  /** Singles and whole numbers of 32 bits, little-endian in base64. */
  | { kind: "mesh"; positions: string; triangles: string };

export type Shape = Solid & { pose: number[]; colour?: [number, number, number, number] };

export interface Link {
  name: string;
  shapes: Shape[];
  /** Whether it has a shape that is not shown. */
  hidden?: boolean;
}

export interface Joint {
  name: string;
  kind: "fixed" | "revolute" | "continuous" | "prismatic" | "floating" | "planar";
  /** Places of links. */
  parent: number;
  child: number;
  /** Its frame in the parent's, at the value zero. */
  origin: number[];
  /** A unit vector in its own frame. */
  axis: [number, number, number];
  limits?: [number, number];
  speed?: number;
  /** value = factor * value of `joint` + offset, where no column of the motion says another. */
  follows?: { joint: number; factor: number; offset: number };
}

export interface Robot {
  name: string;
  /** The root, whose pose is the motion's base. */
  base: number;
  links: Link[];
  /** Parents before children. */
  joints: Joint[];
  /** What could not be shown, and why. */
  notes: string[];
}

export interface Step {
  foot: string;
  x: number;
  y: number;
  yaw: number;
}

export interface Phase {
  action: string;
  step?: number;
  from: number;
  to: number;
}

interface WrittenMotion {
  times: Column;
  joints: number[];
  q: Column[];
  base?: Column[];
  contacts: { name: string; poses: Column[]; stands: string; outline?: [number, number][] }[];
  points: { name: string; at: Column[] }[];
  figures: { name: string; unit: string; values: Column }[];
  support?: { starts: string; counts: string; corners: string };
  steps?: Step[];
  phases?: Phase[];
}

/** Numbers of all samples, exactly as they were written. */
export type Track = Float64Array;

export interface Contact {
  name: string;
  poses: Track[];
  /** `1` where it stands: a letter a sample. */
  stands: string;
  outline: [number, number][];
}

/** A polygon on the floor: x and y of its corners. */
export type Polygon = Float64Array;

export interface Motion {
  times: Track;
  /** The joint of each track of `q`, by its place. */
  joints: number[];
  q: Track[];
  base?: Track[];
  contacts: Contact[];
  points: { name: string; at: Track[] }[];
  figures: { name: string; unit: string; values: Track }[];
  /** One a sample. */
  support?: Polygon[];
  steps: Step[];
  phases: Phase[];
}

export interface Data {
  title: string;
  robot: Robot;
  motion?: Motion;
}

const FORMAT = 1;

/** The data that `text` holds; throws an Error that says what is wrong with them. */
export function read(text: string): Data {
  let data;
  try {
    data = JSON.parse(text);
  } catch {
    throw new Error("its data are no JSON; the file is cut off or changed");
  }
  if (data?.format !== FORMAT) throw new Error(`its data have the format ${data?.format}; this page reads ${FORMAT}`);
  try {
    checkRobot(data.robot);
    return { title: String(data.title), robot: data.robot, motion: data.motion && readMotion(data.motion, data.robot) };
  } catch (error) {
    throw new Error(`its data are damaged: ${error instanceof Error ? error.message : error}`);
  }
}

function checkRobot(robot: Robot): void {
  const isLink = (place: number) => robot.links[place] !== undefined;
  if (!isLink(robot.base)) throw new Error("the robot has no base");
  const placed = new Set([robot.base]);
  for (const { name, parent, child, origin, axis } of robot.joints) {
    if (!placed.has(parent) || !isLink(child) || placed.has(child)) throw new Error(`joint ${name} is out of order`);
    if (origin.length !== 12 || axis.length !== 3) throw new Error(`joint ${name} has no frame`);
    placed.add(child);
  }
}

function readMotion(written: WrittenMotion, robot: Robot): Motion {
  const times = typeof written.times === "number" ? Float64Array.of(written.times) : doubles(written.times);
  const count = times.length;
  const track = (column: Column) => {
    const values = typeof column === "number" ? new Float64Array(count).fill(column) : doubles(column);
    if (values.length !== count) throw new Error(`a track has ${values.length} of ${count} samples`);
    return values;
  };
  const tracks = (columns: Column[], width: number) => {
    if (columns.length !== width) throw new Error(`${columns.length} tracks where ${width} belong`);
    return columns.map(track);
  };
  if (count === 0) throw new Error("the motion has no sample");
  if (!written.joints.every((joint) => robot.joints[joint])) throw new Error("the motion moves a joint that is not there");
  const contacts = written.contacts.map(({ name, poses, stands, outline = [] }) => {
    if (stands.length !== count) throw new Error(`contact ${name} has ${stands.length} of ${count} samples`);
    return { name, poses: tracks(poses, 7), stands, outline };
  });
  return {
    times,
    joints: written.joints,
    q: tracks(written.q, written.joints.length),
    base: written.base && tracks(written.base, 7),
    contacts,
    points: written.points.map(({ name, at }) => ({ name, at: tracks(at, 3) })),
    figures: written.figures.map(({ name, unit, values }) => ({ name, unit, values: track(values) })),
    support: written.support && polygons(written.support, count),
    steps: written.steps ?? [],
    phases: written.phases ?? [],
  };
}

function polygons({ starts, counts, corners }: { starts: string; counts: string; corners: string }, count: number): Polygon[] {
  const [from, sizes, numbers] = [starts, counts, corners].map(doubles) as [Track, Track, Track];
  const found: Polygon[] = [];
  let first = 0;
  from.forEach((start, place) => {
    const next = first + 2 * sizes[place]!;
    const polygon = numbers.subarray(first, next);
    const end = from[place + 1] ?? count;
    if (end > count) throw new Error("a support polygon lasts beyond the motion");
    for (let sample = start; sample < end; sample++) found[sample] = polygon;
    first = next;
  });
  if (found.length !== count || first !== numbers.length) throw new Error("support polygons are missing");
  return found;
}

function bytes(base64: string): ArrayBuffer {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
}

function doubles(base64: string): Float64Array {
  // Read through a view: the order of bytes is the file's, not the machine's.
  const view = new DataView(bytes(base64));
  return Float64Array.from({ length: view.byteLength / 8 }, (_, place) => view.getFloat64(8 * place, true));
}

/** Points and triangles of a mesh. */
export function surface(mesh: { positions: string; triangles: string }): { positions: Float32Array; triangles: Uint32Array } {
  return { positions: new Float32Array(bytes(mesh.positions)), triangles: new Uint32Array(bytes(mesh.triangles)) };
}
