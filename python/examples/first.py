"""First steps: one pose, many poses, a solver of your own robot, and its proof."""

from pathlib import Path

import numpy as np

import groebot

ur5 = groebot.Solver.named("ur5")
pose = ur5.forward([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
for solution in ur5.solve(pose):
    print(f"branch {solution.branch}: {solution.q}, residual {solution.residual:.1e}")

poses = ur5.forward(np.random.default_rng(1).uniform(-3, 3, (10_000, 6)))
batch = ur5.solve_batch(poses)
print(len(batch.q), "solutions of", len(batch), "poses; of row 7:", len(batch[7]))
print("most solutions of a pose:", max(len(rows) for rows in batch), "; of the first hundred:", len(batch[:100].q))
nearest = ur5.solve_batch(poses, near=np.zeros(6))
print(f"nearest to zero: {nearest.q[0]}")

robot = groebot.Robot.from_urdf(Path(__file__).parents[2] / "tests/corpus/dynamics/ur5.urdf", tip="wrist_3_link")
solver = groebot.derive(robot)
print(solver, "proved again:", solver.check().targets, "targets")
print(str(solver.explain()).splitlines()[0])
print(f"torques that hold it: {robot.gravity_torques(np.zeros(6))}")
