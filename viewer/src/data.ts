/**
 * What the page shows, as `groebot view` writes it into `<script type="application/json" id="groebot-data">`; crates/humanoid/src/view/data.rs says the same in
 * Rust. Metres, radians, seconds; frames are the twelve numbers of a 3x4 matrix by rows; poses are position and quaternion xyzw.
 */

/**
 * A number for each sample: the same for all, or doubles packed. Packed are the little-endian doubles' first bytes, then their second ones and so on, as
 * zlib in base64: no bit is lost.
 */
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

/** `C` is Column as it is written, and number or Track when it is unpacked. */
interface WrittenMotion<C> {
  times: C;
  joints: number[];
  q: C[];
  base?: C[];
  contacts: { name: string; poses: C[]; stands: string; outline?: [number, number][] }[];
  points: { name: string; at: C[] }[];
  figures: { name: string; unit: string; values: C }[];
  /** The sample from which on each polygon holds, its number of corners, and x and y of the corners of all. */
  support?: { starts: C; counts: C; corners: C };
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

/** A limb whose solutions are shown. */
export interface Limb {
  name: string;
  /** The links between which the target is: the pose of `tip` in `base`. */
  base: number;
  tip: number;
  /** Joints in the solver's order. */
  joints: number[];
  /** The solver's unit of length [m]. */
  metres: number;
  /** The text of its 5_program.json. */
  program: string;
  /** The SHA-256 of its certificate. */
  certificate?: string;
}

/** A run of the simulator: what it is asked for, and the room as it is drawn. */
export interface RunData {
  /** A robot of groebot that walks. */
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

/** Furniture; its outline is about its own origin. */
export interface Piece {
  name: string;
  outline: [number, number][];
  height: number;
  at: [number, number, number];
}

/** The room of a task that was done, and the ways through it, each from its time on. */
export interface TaskData {
  scene: Scene;
  stages: Stage[];
}

export interface Stage {
  from: number;
  goal: number[];
  way: [number, number][];
  pieces: Piece[];
}

/** `C` as of a motion. */
interface WrittenReach<C> {
  /** The link in whose frame the grid is, by its place. */
  base: number;
  /** The solver and what is asked of its tip, in words. */
  of: string;
  /** By x, y and z: from, to [m], and how many. */
  axes: [Axis, Axis, Axis];
  /** How many orientations each place has. */
  orientations: number;
  /** Whether only answers within limits were counted. */
  limited: boolean;
  /** By place, of which z changes first: how many orientations have an answer, how many answers there are, and the mean manipulability. */
  reached: C;
  answers: C;
  manipulability?: C;
}

export type Axis = [from: number, to: number, count: number];

/** What a limb reaches, place by place of a grid. */
export type Reach = WrittenReach<Track>;

export interface Data {
  title: string;
  robot: Robot;
  motion?: Motion;
  limbs: Limb[];
  run?: RunData;
  task?: TaskData;
  reach?: Reach;
  /** The WebAssembly that solves and walks, packed. */
  wasm?: string;
}

const FORMAT = 1;
/** The most places of a grid, as crates/ik/src/reach/grid.rs says. */
const MOST_PLACES = 1e8;

/** The data that `text` holds; rejected with an Error that says what is wrong with them. */
export async function read(text: string): Promise<Data> {
  let data;
  try {
    data = JSON.parse(text);
  } catch {
    throw new Error("Its data are no JSON; the file is cut off or changed");
  }
  if (data?.format !== FORMAT) throw new Error(`Its data have the format ${data?.format}; this page reads ${FORMAT}`);
  try {
    checkRobot(data.robot);
    const motion = data.motion && readMotion(await unpacked(data.motion), data.robot);
    const limbs: Limb[] = data.limbs ?? [];
    limbs.forEach((limb) => checkLimb(limb, data.robot));
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
  if (!isThere) throw new Error(`limb ${name} has a link or a joint that is not there`);
}

function checkTask({ scene, stages }: TaskData): void {
  const isWhole = Array.isArray(scene?.pieces) && stages?.length > 0 && stages.every(({ goal, way, pieces }) => goal.length > 1 && Array.isArray(way) && Array.isArray(pieces));
  if (!isWhole) throw new Error("the task has no room or no way");
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

/** The reach with a number for each place in all its columns. */
async function readReach(written: WrittenReach<Column>, robot: Robot): Promise<Reach> {
  const { base, axes, orientations } = written;
  if (!robot.links[base]) throw new Error("the reach starts at a link that is not there");
  if (axes.length !== 3 || !axes.every(isAxis)) throw new Error("the reach has an axis that is none");
  if (!Number.isInteger(orientations) || orientations < 1) throw new Error("the reach has no orientations");
  const places = axes.reduce((product, [, , count]) => product * count, 1);
  if (places > MOST_PLACES) throw new Error(`the reach has ${places} places; at most ${MOST_PLACES} are allowed`);
  const column = async (packed: Column, isAllowed: (value: number, place: number) => boolean) => {
    const found = await unpack(packed);
    const values = typeof found === "number" ? new Float64Array(places).fill(found) : found;
    if (values.length !== places) throw new Error(`a column of the reach has ${values.length} of ${places} places`);
    if (!values.every(isAllowed)) throw new Error("the reach counts what cannot be");
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

/** What zlib and base64 have packed. */
export async function inflated(base64: string): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes(base64)]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/** Doubles of which the first bytes stand first, then the second ones and so on. */
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
