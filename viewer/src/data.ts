/**
 * The data of the page, which `groebot view` writes into `<script type="application/json" id="groebot-data">`. The same types in Rust are in
 * crates/humanoid/src/view/data.rs. Metres, radians, seconds; frames are the twelve numbers of a 3x4 matrix by rows; poses are position and quaternion xyzw.
 */

/**
 * One number for each sample: a constant, or packed doubles. Packed data are the first bytes of all little-endian doubles, then all second bytes and so on,
 * compressed with zlib, in base64. They are lossless.
 */
export type Column = number | string;

export type Solid =
  | { kind: "box"; size: [number, number, number] }
  | { kind: "cylinder" | "capsule"; radius: number; length: number }
  | { kind: "sphere"; radius: number }
  /** 32-bit floats and 32-bit unsigned integers, little-endian in base64. */
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
  /** Indices of links. */
  parent: number;
  child: number;
  /** Its frame in the parent's, at the value zero. */
  origin: number[];
  /** A unit vector in its own frame. */
  axis: [number, number, number];
  limits?: [number, number];
  speed?: number;
  /** value = factor * value of `joint` + offset, unless the motion has a column for this joint. */
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

/** `C` is Column in the file, and number or Track when unpacked. */
interface WrittenMotion<C> {
  times: C;
  joints: number[];
  q: C[];
  base?: C[];
  contacts: { name: string; poses: C[]; stands: string; outline?: [number, number][] }[];
  points: { name: string; at: C[] }[];
  figures: { name: string; unit: string; values: C }[];
  /** For each polygon its first sample and its number of corners; x and y of all corners. */
  support?: { starts: C; counts: C; corners: C };
  steps?: Step[];
  phases?: Phase[];
}

/** Numbers of all samples. */
export type Track = Float64Array;

export interface Contact {
  name: string;
  poses: Track[];
  /** One letter for each sample: `1` in contact. */
  stands: string;
  outline: [number, number][];
}

/** A polygon on the floor: x and y of its corners. */
export type Polygon = Float64Array;

export interface Motion {
  times: Track;
  /** The index of the joint of each track of `q`. */
  joints: number[];
  q: Track[];
  base?: Track[];
  contacts: Contact[];
  points: { name: string; at: Track[] }[];
  figures: { name: string; unit: string; values: Track }[];
  /** One for each sample. */
  support?: Polygon[];
  steps: Step[];
  phases: Phase[];
}

/** A limb whose solutions are shown. */
export interface Limb {
  name: string;
  /** The links of the target: the pose of `tip` in `base`. */
  base: number;
  tip: number;
  /** Joints in the solver's order. */
  joints: number[];
  /** The solver's unit of length [m]. */
  metres: number;
  /** The text of its 5_program.json; packed in the file. */
  program: string;
  /** The SHA-256 of its certificate. */
  certificate?: string;
}

/** A run of the simulator: its request, and the drawn room. */
export interface RunData {
  /** The name of a walking robot of groebot. */
  robot: string;
  /** TOML. */
  room: string;
  start: [number, number, number];
  goal: number[];
  apart: number;
  scene: Scene;
}

/** A furnished room. */
export interface Scene {
  size: [number, number];
  wall: number;
  origin: [number, number, number];
  pieces: Piece[];
}

/** Furniture; its outline is relative to its own origin. */
export interface Piece {
  name: string;
  outline: [number, number][];
  height: number;
  at: [number, number, number];
}

/** The room of a recorded task, and the paths through it, each with its start time. */
export interface TaskData {
  scene: Scene;
  stages: Stage[];
}

export interface Stage {
  from: number;
  goal: number[];
  path: [number, number][];
  pieces: Piece[];
}

/** `C` as in a motion. */
interface WrittenReach<C> {
  /** The index of the link in whose frame the grid is. */
  base: number;
  /** The solver and its task, as text. */
  of: string;
  /** For x, y and z: from, to [m], and the number of places. */
  axes: [Axis, Axis, Axis];
  /** The number of orientations of each place. */
  orientations: number;
  /** Whether only solutions within limits were counted. */
  limited: boolean;
  /** For each place, with z changing fastest: the number of reached orientations, the number of solutions, and the mean manipulability. */
  reached: C;
  answers: C;
  manipulability?: C;
}

export type Axis = [from: number, to: number, count: number];

/** A reach map of a limb: the values of each place of a grid. */
export type Reach = WrittenReach<Track>;

export interface Data {
  title: string;
  robot: Robot;
  motion?: Motion;
  limbs: Limb[];
  run?: RunData;
  task?: TaskData;
  reach?: Reach;
  /** The packed WebAssembly of groebot. */
  wasm?: string;
}

const FORMAT = 1;
/** The maximum number of places of a grid, as in crates/ik/src/reach/grid.rs. */
const MOST_PLACES = 1e8;

/** Reads the data of `text`; rejected with an Error that names the fault. */
export async function read(text: string): Promise<Data> {
  let data;
  try {
    data = JSON.parse(text);
  } catch {
    throw new Error("Its data are not JSON; the file is cut off or changed");
  }
  if (data?.format !== FORMAT) throw new Error(`Its data have the format ${data?.format}; this page reads ${FORMAT}`);
  try {
    checkRobot(data.robot);
    const motion = data.motion && readMotion(await unpacked(data.motion), data.robot);
    const limbs: Limb[] = data.limbs ?? [];
    for (const limb of limbs) {
      checkLimb(limb, data.robot);
      limb.program = new TextDecoder().decode(await inflated(limb.program));
    }
    if (data.task) checkTask(data.task);
    const reach = data.reach && (await readReach(data.reach, data.robot));
    return { title: String(data.title), robot: data.robot, motion, limbs, run: data.run, task: data.task, reach, wasm: data.wasm };
  } catch (error) {
    throw new Error(`Its data are damaged: ${error instanceof Error ? error.message : error}`);
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

function checkLimb({ name, base, tip, joints }: Limb, robot: Robot): void {
  const isThere = [base, tip].every((link) => robot.links[link]) && joints.every((joint) => robot.joints[joint]);
  if (!isThere) throw new Error(`limb ${name} has a link or a joint that does not exist`);
}

function checkTask({ scene, stages }: TaskData): void {
  const isWhole = Array.isArray(scene?.pieces) && stages?.length > 0 && stages.every(({ goal, path, pieces }) => goal.length > 1 && Array.isArray(path) && Array.isArray(pieces));
  if (!isWhole) throw new Error("the task has no room or no path");
}

type Unpacked = number | Track;

async function unpack(column: Column): Promise<Unpacked> {
  return typeof column === "number" ? column : doubles(await inflated(column));
}

/** The motion with all its columns unpacked. */
async function unpacked(written: WrittenMotion<Column>): Promise<WrittenMotion<Unpacked>> {
  const all = (columns: Column[]) => Promise.all(columns.map(unpack));
  const { base, support } = written;
  return {
    ...written,
    times: await unpack(written.times),
    q: await all(written.q),
    base: base && (await all(base)),
    contacts: await Promise.all(written.contacts.map(async (own) => ({ ...own, poses: await all(own.poses) }))),
    points: await Promise.all(written.points.map(async (own) => ({ ...own, at: await all(own.at) }))),
    figures: await Promise.all(written.figures.map(async (own) => ({ ...own, values: await unpack(own.values) }))),
    support: support && { starts: await unpack(support.starts), counts: await unpack(support.counts), corners: await unpack(support.corners) },
  };
}

function readMotion(written: WrittenMotion<Unpacked>, robot: Robot): Motion {
  const times = typeof written.times === "number" ? Float64Array.of(written.times) : written.times;
  const count = times.length;
  const track = (column: Unpacked) => {
    const values = typeof column === "number" ? new Float64Array(count).fill(column) : column;
    if (values.length !== count) throw new Error(`a track has ${values.length} of ${count} samples`);
    return values;
  };
  const tracks = (columns: Unpacked[], width: number) => {
    if (columns.length !== width) throw new Error(`${columns.length} tracks instead of ${width}`);
    return columns.map(track);
  };
  if (count === 0) throw new Error("the motion has no sample");
  if (!written.joints.every((joint) => robot.joints[joint])) throw new Error("the motion moves a joint that does not exist");
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

function polygons(written: { starts: Unpacked; counts: Unpacked; corners: Unpacked }, count: number): Polygon[] {
  const [from, sizes, numbers] = [written.starts, written.counts, written.corners].map((each) => (typeof each === "number" ? Float64Array.of(each) : each)) as [Track, Track, Track];
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

/** The reach map with all its columns unpacked. */
async function readReach(written: WrittenReach<Column>, robot: Robot): Promise<Reach> {
  const { base, axes, orientations } = written;
  if (!robot.links[base]) throw new Error("the reach map starts at a link that does not exist");
  if (axes.length !== 3 || !axes.every(isAxis)) throw new Error("the reach map has an invalid axis");
  if (!Number.isInteger(orientations) || orientations < 1) throw new Error("the reach map has no orientations");
  const places = axes.reduce((product, [, , count]) => product * count, 1);
  if (places > MOST_PLACES) throw new Error(`the reach map has ${places} places; at most ${MOST_PLACES} are allowed`);
  const column = async (packed: Column, isAllowed: (value: number, place: number) => boolean) => {
    const found = await unpack(packed);
    const values = typeof found === "number" ? new Float64Array(places).fill(found) : found;
    if (values.length !== places) throw new Error(`a column of the reach map has ${values.length} of ${places} places`);
    if (!values.every(isAllowed)) throw new Error("the reach map has invalid counts");
    return values;
  };
  const reached = await column(written.reached, (value) => Number.isInteger(value) && value >= 0 && value <= orientations);
  const answers = await column(written.answers, (value, place) => Number.isInteger(value) && value >= reached[place]!);
  const { manipulability: mean } = written;
  const manipulability = mean === undefined ? undefined : await column(mean, (value) => Number.isFinite(value) && value >= 0);
  return { ...written, reached, answers, manipulability };
}

function isAxis([from, to, count]: Axis): boolean {
  if (!Number.isFinite(from) || !Number.isFinite(to) || !Number.isInteger(count)) return false;
  return count === 1 ? from === to : count > 1 && from < to;
}

function bytes(base64: string): ArrayBuffer {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
}

/** Decodes base64 and zlib. */
export async function inflated(base64: string): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes(base64)]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/** Decodes doubles from byte planes: all first bytes, then all second bytes and so on. */
function doubles(buffer: ArrayBuffer): Track {
  const planes = new Uint8Array(buffer);
  const count = planes.length / 8;
  const view = new DataView(new ArrayBuffer(planes.length));
  planes.forEach((byte, place) => view.setUint8(8 * (place % count) + Math.floor(place / count), byte));
  // The values are read through a view: the byte order is that of the file, not of the machine.
  return Float64Array.from({ length: count }, (_, sample) => view.getFloat64(8 * sample, true));
}

/** Points and triangles of a mesh. */
export function surface(mesh: { positions: string; triangles: string }): { positions: Float32Array; triangles: Uint32Array } {
  return { positions: new Float32Array(bytes(mesh.positions)), triangles: new Uint32Array(bytes(mesh.triangles)) };
}
