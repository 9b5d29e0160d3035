/** The room of a task that was done: where its furniture stood, where it led and by which way, at each time. */

import type { Scene, Stage, TaskData } from "./data";
import type { Furnished, Spot } from "./room";

export class Task implements Furnished {
  readonly scene: Scene;
  private readonly stages: Stage[];
  private stage: Stage;

  constructor({ scene, stages }: TaskData) {
    [this.scene, this.stages, this.stage] = [scene, stages, stages[0]!];
  }

  get goal(): number[] {
    return this.stage.goal;
  }

  get told(): { furniture: { name: string; at: Spot }[]; way: [number, number][] } {
    return { furniture: this.stage.pieces, way: this.stage.way };
  }

  /** Goes to a time [s]; whether the room is another one there. */
  seek(time: number): boolean {
    const before = this.stage;
    this.stage = this.stages.filter(({ from }) => from <= time).at(-1) ?? this.stages[0]!;
    return this.stage !== before;
  }
}
