"""groebot compared with other inverse-kinematics solvers for Python, in one run.

    python -m venv peers && peers/bin/pip install dist/groebot-*.whl ssik EAIK ik-geo py-opw-kinematics scipy
    peers/bin/python python/benches/peers.py > benches/record/DATE-python.csv

All solve poses that random joint values reach. Contestants take turns. The record has the median over the rounds of the wall time and of the processor time,
which is independent of other processes. A contestant that cannot run has a row with the reason.
"""

from __future__ import annotations

import csv
import platform
import statistics
import sys
import time
from importlib.metadata import version

import numpy as np

import groebot

ROUNDS = 15
MANY, SOME = 20_000, 400


def axes_and_offsets(solver, wrist):
    """The axes (6, 3) and the offsets (7, 3) between points on them at zero. The joints of `wrist` share a point."""
    twists = solver.jacobian(np.zeros(6), "spatial").T
    axes = twists[:, 3:]
    points = np.cross(axes, twists[:, :3])
    across = [np.eye(3) - np.outer(axis, axis) for axis in axes[wrist]]
    shared = np.linalg.solve(sum(across), sum(a @ p for a, p in zip(across, points[wrist])))
    points[wrist] = shared
    stations = np.vstack([np.zeros(3), points, solver.forward(np.zeros(6))[:3, 3]])
    return axes, np.diff(stations, axis=0)


def of_groebot(solver, poses):
    written = groebot.Solver.from_json(solver.to_json().replace(f'"name":"{solver.name}"', '"name":"interpreted"'))
    assert solver.compiled and not written.compiled
    many = np.ascontiguousarray(np.resize(poses, (MANY, 4, 4)))
    out = np.empty((8 * MANY + 22, 6))
    few = list(poses[:SOME])
    yield "groebot, batch, 1 thread", MANY, lambda: len(solver.solve_batch(many, threads=1).q)
    yield "groebot, batch, 1 thread, out=", MANY, lambda: len(solver.solve_batch(many, threads=1, out=out).q)
    yield "groebot, batch, 2 threads", MANY, lambda: len(solver.solve_batch(many, threads=2).q)
    yield "groebot, derived, batch, 1 thread", MANY, lambda: len(written.solve_batch(many, threads=1).q)
    yield "groebot, solve", SOME, lambda: sum(len(solver.solve(pose)) for pose in few)


def of_ssik(name, poses, q):
    import ssik

    arm = ssik.Manipulator.from_prebuilt(name)
    # The solver has its own zero and frames. Its poses are reached by the same joint values.
    few = [arm.fk(row) for row in q[:SOME]]
    solve = lambda pose: arm.solve(pose, respect_limits=False)
    yield f"ssik {version('ssik')}, solve", SOME, lambda: sum(len(solve(pose)) for pose in few)


def of_eaik(axes, offsets, solver, poses):
    from eaik.IK_HP import HPRobot

    robot = HPRobot(axes, offsets)
    # Axes and offsets do not include the tip's rotation at zero.
    few = turned(solver, poses)[:SOME]
    rows = list(few)
    yield f"EAIK {version('EAIK')}, IK", SOME, lambda: sum(robot.IK(pose).num_solutions() for pose in rows)
    yield f"EAIK {version('EAIK')}, IK_batched, 1 worker", SOME, lambda: sum(
        found.num_solutions() for found in robot.IK_batched(few, 1)
    )


def of_ik_geo(family, axes, offsets, solver, poses):
    from ik_geo import Robot

    robot = getattr(Robot, family)(axes.tolist(), offsets.tolist())
    few = [(pose[:3, :3], pose[:3, 3]) for pose in turned(solver, poses)[:SOME]]
    yield f"ik-geo {version('ik-geo')}, get_ik", SOME, lambda: sum(len(robot.get_ik(*pose)) for pose in few)


def of_opw(q):
    from py_opw_kinematics import KinematicModel, RigidTransform, Robot

    model = KinematicModel(a1=0, a2=-0.0203, b=-0.15005, c1=0.672, c2=0.4318, c3=0.4318, c4=0.05625)
    robot = Robot(model, degrees=False)
    few = [robot.forward(tuple(row)) for row in q[:SOME]]
    matrices = RigidTransform.from_matrix(np.stack([pose.as_matrix() for pose in few]))
    name = f"py-opw-kinematics {version('py-opw-kinematics')}"
    yield f"{name}, inverse", SOME, lambda: sum(len(robot.inverse(pose)) for pose in few)
    yield f"{name}, batch_inverse (one solution)", SOME, lambda: len(robot.batch_inverse(matrices))


def turned(solver, poses):
    """The poses in the frame of a solver that uses axes and offsets: without the tip's rotation at zero."""
    bare = poses.copy()
    bare[:, :3, :3] = poses[:, :3, :3] @ solver.forward(np.zeros(6))[:3, :3].T
    return bare


def entrants(name, wrist, family, prebuilt):
    """The contestants of a robot: each has its number of poses and its function, or the reason why it does not run."""
    solver = groebot.Solver.named(name)
    q = np.random.default_rng(1).uniform(-3, 3, (4000, 6))
    poses = solver.forward(q)
    axes, offsets = axes_and_offsets(solver, wrist)
    peers = {
        "groebot": lambda: of_groebot(solver, poses),
        "ssik": lambda: of_ssik(prebuilt, poses, q),
        "EAIK": lambda: of_eaik(axes, offsets, solver, poses),
        "ik-geo": lambda: of_ik_geo(family, axes, offsets, solver, poses),
    }
    if family.startswith("spherical"):
        peers["py-opw-kinematics"] = lambda: of_opw(q)
    for peer, make in peers.items():
        try:
            for label, count, work in make():
                yield label, count, work, f"{work() / count:.2f}"
        except Exception as error:  # noqa: BLE001 a peer may fail in any way
            yield peer, 0, None, f"does not run: {type(error).__name__}: {error}".splitlines()[0]


def measured(count, work):
    clock, processor = time.perf_counter(), time.process_time()
    work()
    return [1e9 * (end - begin) / count for end, begin in ((time.perf_counter(), clock), (time.process_time(), processor))]


def main():
    table = csv.writer(sys.stdout)
    table.writerow(["robot", "contestant", "ns_a_pose", "processor_ns_a_pose", "solutions_a_pose"])
    robots = {
        "ur5": (slice(4, 6), "three_parallel_two_intersecting", "ur5_ik"),
        "puma560": (slice(3, 6), "spherical_two_parallel", "puma560_ik"),
    }
    for robot, (wrist, family, prebuilt) in robots.items():
        field = list(entrants(robot, wrist, family, prebuilt))
        times = {label: [] for label, *_ in field}
        for _ in range(ROUNDS):
            for label, count, work, _ in field:
                if work is not None:
                    times[label].append(measured(count, work))
        for label, _, work, solutions in field:
            figures = ["", ""]
            if work is not None:
                figures = [f"{statistics.median(column):.0f}" for column in zip(*times[label])]
            table.writerow([robot, label, *figures, solutions])
    print(f"# {platform.processor() or platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}", file=sys.stderr)


if __name__ == "__main__":
    main()
