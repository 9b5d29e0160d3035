/** Rigid transforms in doubles: the twelve numbers of a 3x4 matrix by rows. */

export type Frame = Float64Array;
export type Vector = [number, number, number];

export const identity = (): Frame => Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);

/** The product a b. */
export function multiply(a: ArrayLike<number>, b: ArrayLike<number>): Frame {
  const product = new Float64Array(12);
  for (let row = 0; row < 12; row += 4) {
    for (let column = 0; column < 4; column++) {
      product[row + column] = a[row]! * b[column]! + a[row + 1]! * b[4 + column]! + a[row + 2]! * b[8 + column]!;
    }
    product[row + 3]! += a[row + 3]!;
  }
  return product;
}

/** The inverse of a frame. */
export function inverse(frame: ArrayLike<number>): Frame {
  const undone = new Float64Array(12);
  for (let row = 0; row < 3; row++) {
    for (let column = 0; column < 3; column++) {
      undone[4 * row + column] = frame[4 * column + row]!;
      undone[4 * row + 3]! -= frame[4 * column + row]! * frame[4 * column + 3]!;
    }
  }
  return undone;
}

/** A point transformed by a frame. */
export function move(frame: ArrayLike<number>, [x, y, z]: Vector): Vector {
  const row = (r: number) => frame[r]! * x + frame[r + 1]! * y + frame[r + 2]! * z + frame[r + 3]!;
  return [row(0), row(4), row(8)];
}

/** The rotation about a unit vector, by Rodrigues' formula. */
export function turn([x, y, z]: Vector, angle: number): Frame {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const half = Math.sin(angle / 2);
  const v = 2 * half * half;
  return Float64Array.of(
    c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0,
    x * y * v + z * s, c + y * y * v, y * z * v - x * s, 0,
    x * z * v - y * s, y * z * v + x * s, c + z * z * v, 0,
  );
}

/** The translation along a unit vector. */
export function shift([x, y, z]: Vector, distance: number): Frame {
  return Float64Array.of(1, 0, 0, x * distance, 0, 1, 0, y * distance, 0, 0, 1, z * distance);
}

/** The frame of a position and a unit quaternion xyzw. */
export function fromPose([px, py, pz, x, y, z, w]: number[]): Frame {
  return Float64Array.of(
    1 - 2 * (y! * y! + z! * z!), 2 * (x! * y! - z! * w!), 2 * (x! * z! + y! * w!), px!,
    2 * (x! * y! + z! * w!), 1 - 2 * (x! * x! + z! * z!), 2 * (y! * z! - x! * w!), py!,
    2 * (x! * z! - y! * w!), 2 * (y! * z! + x! * w!), 1 - 2 * (x! * x! + y! * y!), pz!,
  );
}

/** Roll, pitch and yaw of a frame, as in URDF [rad]. */
export function toAngles(frame: ArrayLike<number>): Vector {
  const [r11, r21, r31, r32, r33] = [0, 4, 8, 9, 10].map((place) => frame[place]!) as [number, number, number, number, number];
  return [Math.atan2(r32, r33), Math.atan2(-r31, Math.hypot(r11, r21)), Math.atan2(r21, r11)];
}

/** The frame at a position with roll, pitch and yaw [rad]. */
export function fromAngles([x, y, z]: ArrayLike<number> & Iterable<number>, [roll, pitch, yaw]: Vector): Frame {
  const turned = multiply(turn([0, 0, 1], yaw), multiply(turn([0, 1, 0], pitch), turn([1, 0, 0], roll)));
  [turned[3], turned[7], turned[11]] = [x!, y!, z!];
  return turned;
}

/** The interpolated pose at a share of the path between two: linear in position, normalised linear in the quaternion, by the shorter arc. */
export function between(a: number[], b: number[], share: number): number[] {
  const sign = a[3]! * b[3]! + a[4]! * b[4]! + a[5]! * b[5]! + a[6]! * b[6]! < 0 ? -1 : 1;
  const mixed = a.map((value, place) => value + ((place < 3 ? 1 : sign) * b[place]! - value) * share);
  const length = Math.hypot(mixed[3]!, mixed[4]!, mixed[5]!, mixed[6]!);
  return mixed.map((value, place) => (place < 3 ? value : value / length));
}
