/** Interpolation of tracks in time. */

import type { Motion, Phase, Track } from "./data";
import { between } from "./pose";

/** A time as a sample and the fraction of the interval to the next one; the fraction is zero at a sample. */
export interface Place {
  time: number;
  sample: number;
  share: number;
}

/** The place of a time, clamped to the first and the last sample. */
export function placeOf(times: Track, asked: number): Place {
  const last = times.length - 1;
  const time = Math.min(Math.max(Number.isFinite(asked) ? asked : 0, times[0]!), times[last]!);
  let [low, high] = [0, last];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  return { time, sample: low, share: low < last ? (time - times[low]!) / (times[low + 1]! - times[low]!) : 0 };
}

/** The sample nearest to a place. */
export const nearestSample = ({ sample, share }: Place): number => (share > 0.5 ? sample + 1 : sample);

/** The value of a track: exact at a sample, linear between two. */
export function at(track: Track, { sample, share }: Place): number {
  const value = track[sample]!;
  return share === 0 ? value : value + (track[sample + 1]! - value) * share;
}

/** The interpolated pose of seven tracks. */
export function poseAt(tracks: Track[], place: Place): number[] {
  const pose = tracks.map((track) => track[place.sample]!);
  return place.share === 0 ? pose : between(pose, tracks.map((track) => track[place.sample + 1]!), place.share);
}

/** The phase at a time. */
export function phaseAt({ phases }: Motion, time: number): Phase | undefined {
  return phases.find(({ from, to }) => from <= time && time < to) ?? phases.at(-1);
}
