/** Formats of numbers and names. */

import type { Phase } from "./data";

/** A number with a fixed number of decimals and a typographic minus sign. */
export function number(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text.replace("-", "\u2212");
}

/** A value with its unit; short lengths in millimetres. */
export function quantity(value: number, unit: string, most = Math.abs(value)): string {
  if (unit === "m" && most < 1) return `${number(1000 * value, 1)} mm`;
  return `${number(value, most >= 100 ? 1 : 3)}${unit === "1" ? "" : ` ${unit}`}`;
}

/** A joint value; angles in rad and degrees. */
export function jointValue(value: number, unit: string): string {
  return unit === "m" ? `${number(value, 3)} m` : `${number(value, 3)} rad\u2002${number((180 / Math.PI) * value, 1)}\u00b0`;
}

const NAMES: Record<string, string> = { com: "Centre of mass", zmp: "ZMP", pendulum: "Pendulum ZMP" };

/** The displayed name of a point or quantity. */
export function displayName(name: string): string {
  return NAMES[name] ?? (name.charAt(0).toUpperCase() + name.slice(1)).replaceAll("_", " ");
}

/** `swing, step 3`. */
export function phaseName(phase: Phase): string {
  return phase.step === undefined ? phase.action : `${phase.action}, step ${phase.step}`;
}

/** Limits such as `-2.09 to 2.09 rad`. */
export function range(limits: [number, number] | undefined, unit: string): string {
  return limits ? `${number(limits[0], 2)} to ${number(limits[1], 2)} ${unit}` : `no limits, ${unit}`;
}
