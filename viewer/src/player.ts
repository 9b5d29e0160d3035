/** Playback of a motion. */

import type { App } from "./app";

export class Player {
  speed = 1;
  /** Called at the end of the motion to extend it. Returns whether it was extended. */
  more: (() => boolean) | undefined;
  private last: number | undefined;
  private frame = 0;

  /** `changed` is called when playback starts and stops. */
  constructor(private readonly app: App, private readonly changed: () => void) {}

  get isPlaying(): boolean {
    return this.last !== undefined;
  }

  toggle(): void {
    if (this.isPlaying) return this.pause();
    const times = this.app.data.motion?.times;
    if (!times) return;
    if (this.app.time >= times.at(-1)! && !this.more) this.app.seek(times[0]!);
    this.last = performance.now();
    this.changed();
    this.requestFrame();
  }

  pause(): void {
    if (!this.isPlaying) return;
    this.last = undefined;
    cancelAnimationFrame(this.frame);
    this.changed();
  }

  /** Requests the next animation frame. */
  private requestFrame(): void {
    this.frame = requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    if (this.last === undefined) return;
    const passed = Math.max(now - this.last, 0) / 1000;
    this.last = now;
    this.app.seek(this.app.time + this.speed * passed);
    if (this.app.time >= this.app.data.motion!.times.at(-1)! && !this.more?.()) return this.pause();
    this.requestFrame();
  }
}
