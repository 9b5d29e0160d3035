/** The drawn self-motion of a singular pose: the free joint is stepped, and Newton's method on the other joints keeps the tip in place. */

import type { Frame } from "./pose";

/** Maximum number of steps of the free joint in each direction. */
const MOST = 5;
/** Tolerance of the tip [m, rad], and the maximum number of Newton steps. */
const ENOUGH = 1e-9;
const TRIES = 20;
/** The step of finite differences [rad or m], and the damping of the normal equations for dependent joints. */
const DIFFERENCE = 1e-6;
const DAMPING = 1e-12;

/** Joint values along the self-motion in both directions from `start`, while they are allowed and the tip stays in place. `reach` gives the tip's frame. */
export function selfMotion(reach: (q: number[]) => Frame, start: number[], free: number, step: number, isAllowed: (q: number[]) => boolean): number[][] {
  const target = reach(start);
  const found: number[][] = [];
  for (const sign of [1, -1]) {
    let q = start;
    for (let taken = 0; taken < MOST; taken++) {
      const next = held(reach, target, q.map((value, joint) => (joint === free ? value + sign * step : value)), free);
      if (!next || !isAllowed(next)) break;
      found.push(next);
      q = next;
    }
  }
  return found;
}

/** Joint values near `near` with the tip at the target and the free joint fixed; undefined without convergence. */
function held(reach: (q: number[]) => Frame, target: Frame, near: number[], free: number): number[] | undefined {
  const q = [...near];
  const others = q.map((_, joint) => joint).filter((joint) => joint !== free);
  for (let tries = 0; tries < TRIES; tries++) {
    const here = reach(q);
    const off = difference(here, target);
    if (Math.hypot(...off) < ENOUGH) return q;
    const columns = others.map((joint) => {
      const beside = q.map((value, other) => (other === joint ? value + DIFFERENCE : value));
      return difference(here, reach(beside)).map((value) => value / DIFFERENCE);
    });
    leastSquares(columns, off).forEach((change, place) => (q[others[place]!]! += change));
  }
  return undefined;
}

/** The difference of two frames: three lengths and three small rotation angles. */
function difference(from: Frame, to: Frame): number[] {
  const turned = (row: number, column: number) => [0, 1, 2].reduce((sum, k) => sum + to[4 * row + k]! * from[4 * column + k]!, 0);
  const angle = (row: number, column: number) => 0.5 * (turned(row, column) - turned(column, row));
  return [to[3]! - from[3]!, to[7]! - from[7]!, to[11]! - from[11]!, angle(2, 1), angle(0, 2), angle(1, 0)];
}

/** The least-squares coefficients of the columns for `wanted`, from the damped normal equations. */
function leastSquares(columns: number[][], wanted: number[]): number[] {
  const dot = (a: number[], b: number[]) => a.reduce((sum, value, place) => sum + value * b[place]!, 0);
  const rows = columns.map((own, row) => [...columns.map((other, column) => dot(own, other) + (row === column ? DAMPING : 0)), dot(own, wanted)]);
  for (const [place, pivot] of rows.entries()) {
    for (const row of rows) {
      if (row === pivot) continue;
      const factor = row[place]! / pivot[place]!;
      pivot.forEach((value, column) => (row[column]! -= factor * value));
    }
  }
  return rows.map((row, place) => row.at(-1)! / row[place]!);
}
