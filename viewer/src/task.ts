/** The room of a recorded task: furniture, goal and path at each time. */

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

  get state(): { furniture: { name: string; at: Spot }[]; path: [number, number][] } {
    return { furniture: this.stage.pieces, path: this.stage.path };
  }

  /** Sets the time [s]. Returns whether the room changed. */
  seek(time: number): boolean {
    const before = this.stage;
    this.stage = this.stages.filter(({ from }) => from <= time).at(-1) ?? this.stages[0]!;
    return this.stage !== before;
  }
}
