"""groebot compared with generated Rust and with other inverse-kinematics solvers for Python, in one run.

    python -m venv peers && peers/bin/pip install dist/groebot-*.whl -r python/benches/peers-requirements.txt
    cargo build --release --manifest-path python/benches/printed/Cargo.toml
    peers/bin/python python/benches/peers.py python/benches/printed/target/release/libgroebot_printed.so > benches/record/DATE-python.csv

Three robots are compiled in the wheel; three are derived in this run, from numbers that no built-in robot has. All solve poses that random joint values reach.
Contestants take turns. The record has medians over the rounds: the wall time, the processor time, which is nearly independent of other processes, and the ratio of
the processor time to that of the robot's first contestant in the same round. A contestant that cannot run has a row with the reason.
"""

from __future__ import annotations

import csv
import ctypes
import os
import platform
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

import groebot

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 21
MANY, SOME = 20_000, 400

# Six joints with the signs of alpha of Universal Robots, and lengths of no robot: a, alpha in degrees, d.
UR_TYPE = [(0, 90, 0.131), (-0.47, 0, 0), (-0.41, 0, 0), (0, 90, 0.117), (0, -90, 0.101), (0, 0, 0.087)]


@dataclass
class Case:
    """A robot: the joints whose axes share a point, its family in ik-geo, its name in ssik, and the parameters of an ortho-parallel base with a wrist."""

    solver: groebot.Solver
    wrist: slice
    family: str
    prebuilt: str | None = None
    opw: dict[str, float] | None = None


def ur_type(folder: Path) -> groebot.Solver:
    rows = [f'[[joint]]\nname = "j{i}"\ntype = "revolute"\na = {a}\nalpha = {alpha}\nd = {d}\n' for i, (a, alpha, d) in enumerate(UR_TYPE, 1)]
    path = folder / "ur_type.toml"
    head = 'name = "ur_type"\nangle_unit = "deg"\ntask = { kind = "pose" }\n[dh]\nconvention = "standard"\n'
    path.write_text("\n".join([head, *rows]))
    return groebot.derive(path)


def cases(folder: Path) -> dict[str, Case]:
    of_ur = slice(4, 6), "three_parallel_two_intersecting"
    of_puma = slice(3, 6), "spherical_two_parallel"
    puma560 = dict(a1=0, a2=-0.0203, b=-0.15005, c1=0.672, c2=0.4318, c3=0.4318, c4=0.05625)
    kr6_r900 = dict(a1=0.025, a2=-0.035, b=0, c1=0.4, c2=0.455, c3=0.42, c4=0.08)
    return {
        "ur5": Case(groebot.Solver.named("ur5"), *of_ur, "ur5_ik"),
        "irb120": Case(groebot.Solver.named("irb120"), *of_puma),
        "puma560": Case(groebot.Solver.named("puma560"), *of_puma, "puma560_ik", puma560),
        "ur_type, derived from a DH table": Case(ur_type(folder), *of_ur),
        "kr6_r900, derived from a URDF": Case(groebot.derive(ROOT / "tests/corpus/urdf/kr6_r900.urdf"), *of_puma, None, kr6_r900),
        "ur5, derived from a URDF with 1.5708": Case(groebot.derive(ROOT / "tests/corpus/urdf/ur5.urdf"), *of_ur),
    }


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


def of_printed(library, name, poses):
    """Generated Rust, called by ctypes: one call solves all targets."""
    many = np.resize(poses, (MANY, 4, 4))
    numbers = np.ascontiguousarray(np.concatenate([many[:, :3, 3], many[:, :3, :3].reshape(-1, 9)], 1))
    for label, kind in [("generated Rust, solutions kept", "all"), ("generated Rust, memory of 256 poses reused", "pieces")]:
        solve = getattr(ctypes.CDLL(library), f"{name}_{kind}")
        solve.restype, solve.argtypes = ctypes.c_size_t, [ctypes.c_void_p, ctypes.c_size_t]
        yield label, MANY, lambda solve=solve: solve(numbers.ctypes.data, MANY)


def of_groebot(solver, poses):
    many = np.ascontiguousarray(np.resize(poses, (MANY, 4, 4)))
    out = np.empty((8 * MANY + 22, 6))
    few = list(poses[:SOME])
    kind = "groebot" if solver.compiled else "groebot, derived"
    yield f"{kind}, batch, 1 thread, out=", MANY, lambda: len(solver.solve_batch(many, threads=1, out=out).q)
    yield f"{kind}, batch, 1 thread", MANY, lambda: len(solver.solve_batch(many, threads=1).q)
    yield f"{kind}, batch, 2 threads", MANY, lambda: len(solver.solve_batch(many, threads=2).q)
    yield f"{kind}, solve", SOME, lambda: sum(len(solver.solve(pose)) for pose in few)
    yield f"{kind}, solve, as_array", SOME, lambda: sum(len(solver.solve(pose, as_array=True)) for pose in few)


def of_ssik(case, poses, q):
    import ssik

    if case.prebuilt:
        arm = ssik.Manipulator.from_prebuilt(case.prebuilt)
        # The solver has its own zero and frames. Its poses are reached by the same joint values.
        few = [arm.fk(row) for row in q[:SOME]]
    else:
        arm = ssik.Manipulator.from_axes(*axes_and_offsets(case.solver, case.wrist))
        few = list(turned(case.solver, poses)[:SOME])
    yield f"ssik {version('ssik')}, solve", SOME, lambda: sum(len(arm.solve(pose, respect_limits=False)) for pose in few)


def of_eaik(case, poses):
    from eaik.IK_HP import HPRobot

    robot = HPRobot(*axes_and_offsets(case.solver, case.wrist))
    # Axes and offsets do not include the tip's rotation at zero.
    few = turned(case.solver, poses)[:SOME]
    rows = list(few)
    yield f"EAIK {version('EAIK')}, IK", SOME, lambda: sum(robot.IK(pose).num_solutions() for pose in rows)
    yield f"EAIK {version('EAIK')}, IK_batched, 1 worker", SOME, lambda: sum(
        found.num_solutions() for found in robot.IK_batched(few, 1)
    )


def of_ik_geo(case, poses):
    from ik_geo import Robot

    axes, offsets = axes_and_offsets(case.solver, case.wrist)
    robot = getattr(Robot, case.family)(axes.tolist(), offsets.tolist())
    few = [(pose[:3, :3], pose[:3, 3]) for pose in turned(case.solver, poses)[:SOME]]
    yield f"ik-geo {version('ik-geo')}, get_ik", SOME, lambda: sum(len(robot.get_ik(*pose)) for pose in few)


def of_opw(parameters, q):
    from py_opw_kinematics import KinematicModel, RigidTransform, Robot

    robot = Robot(KinematicModel(**parameters), degrees=False)
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


def entrants(case: Case, library: str | None):
    """The contestants of a robot: each has its number of poses and its function, or the reason why it does not run."""
    solver = case.solver
    q = np.random.default_rng(1).uniform(-3, 3, (4000, 6))
    poses = solver.forward(q)
    peers = {
        "groebot": lambda: of_groebot(solver, poses),
        "ssik": lambda: of_ssik(case, poses, q),
        "EAIK": lambda: of_eaik(case, poses),
        "ik-geo": lambda: of_ik_geo(case, poses),
    }
    if solver.compiled and library:
        peers = {"generated Rust": lambda: of_printed(library, solver.name, poses)} | peers
    if case.opw:
        peers["py-opw-kinematics"] = lambda: of_opw(case.opw, q)
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


def rows(case: Case, library: str | None):
    field = list(entrants(case, library))
    times = {label: [] for label, *_ in field}
    for _ in range(ROUNDS):
        for label, count, work, _ in field:
            if work is not None:
                times[label].append(measured(count, work))
    first = [processor for _, processor in next(iter(times.values()))]
    for label, _, work, solutions in field:
        figures = ["", "", ""]
        if work is not None:
            wall, processor = (list(column) for column in zip(*times[label]))
            ratio = statistics.median(own / other for own, other in zip(processor, first))
            figures = [f"{statistics.median(wall):.0f}", f"{statistics.median(processor):.0f}", f"{ratio:.3f}"]
        yield [label, *figures, solutions]


def main(library: str | None = None):
    load = "{:.1f}, {:.1f}".format(*os.getloadavg()[:2])
    machine = f"{platform.processor() or platform.machine()}, {os.cpu_count()} processors, load averages at the start {load}"
    print(f"# python/benches/peers.py, groebot {groebot.__version__}: {machine}; Python {platform.python_version()}, numpy {np.__version__}")
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["robot", "contestant", "ns_a_pose", "processor_ns_a_pose", "ratio_to_first", "solutions_a_pose"])
    with tempfile.TemporaryDirectory() as folder:
        for robot, case in cases(Path(folder)).items():
            table.writerows([robot, *row] for row in rows(case, library))
            sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
