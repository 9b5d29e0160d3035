"""Time of a pose in ssik and EAIK against the distance of the wrist from a singular configuration, and the number of poses that they do not solve.

    python3 -m venv peers && peers/bin/pip install ssik EAIK numpy
    peers/bin/python benches/singular/peers.py 200 >> benches/record/DATE-singular-peers.csv

The wrist joint is at 10^-k rad, the others at random. Both are called from Python pose by pose, as in normal use. The time is the processor time, the minimum
of five rounds. Without: poses with no solution within 1e-9 (m, and entries of the rotation).
"""

import math
import sys
import time
import tomllib
from importlib.metadata import version
from pathlib import Path

import numpy as np
import ssik
from eaik.IK_HP import HPRobot

ROOT = Path(__file__).resolve().parents[2]
ROBOTS = {
    "ur5": (ROOT / "tests/corpus/urdf/ur5_axes.toml", "ur5_ik"),
    "puma": (ROOT / "derivations/puma/0_chain.toml", None),
    "puma560": (None, "puma560_ik"),
    "irb120": (ROOT / "derivations/irb120/0_chain.toml", None),
}
WRIST = 4
EXPONENTS = [3, 4, 5, 6, 7, 8, 9, 10, 12, 14]
ROUNDS = 5


def hp_robot(path):
    """EAIK's robot: axes, and offsets between points on them. As many points as possible are shared."""
    table = tomllib.loads(path.read_text())
    axes = np.array([joint["axis"] for joint in table["joint"]], float)
    points = np.array([joint["point"] for joint in table["joint"]], float)
    for i in range(len(axes) - 1):
        points[i + 1] = shared(axes[i], points[i], axes[i + 1], points[i + 1])
        points[i] = shared(axes[i + 1], points[i + 1], axes[i], points[i])
    stations = np.vstack([np.zeros(3), points, np.array(table.get("tip", {}).get("point", points[-1]), float)])
    return HPRobot(axes, np.diff(stations, axis=0))


def shared(axis, point, other, place):
    """The point of the other axis that is nearest to an axis, or its own point if they are parallel."""
    normal = np.cross(axis, other)
    if normal @ normal < 1e-12:
        return place
    along = np.linalg.solve(np.array([axis, -other, normal]).T, place - point)
    return place + along[1] * other


def joint_values(count, distance):
    rng = np.random.default_rng(1)
    q = rng.uniform(-math.pi, math.pi, (count, 6))
    q[:, WRIST] = rng.choice([-distance, distance], count)
    return q


def is_reached(pose, forward, answers):
    return any(np.abs(np.asarray(forward(np.asarray(answer, float))) - pose).max() < 1e-9 for answer in answers)


def contestants(path, prebuilt):
    if path:
        robot = hp_robot(path)
        yield f"EAIK {version('EAIK')}", robot.fwdKin, robot.IK, lambda found: found.Q
    if prebuilt:
        arm = ssik.Manipulator.from_prebuilt(prebuilt)
        yield f"ssik {version('ssik')}", arm.fk, lambda pose: arm.solve(pose, respect_limits=False), lambda found: [one.q for one in found]


def row(name, exponent, count, label, forward, solve, answers):
    poses = [np.asarray(forward(q)) for q in joint_values(count, 10.0**-exponent)]
    least, without, all_answers = np.full(count, np.inf), 0, 0
    for turn in range(ROUNDS):
        for k, pose in enumerate(poses):
            begin = time.process_time_ns()
            found = solve(pose)
            least[k] = min(least[k], (time.process_time_ns() - begin) * 1e-3)
            if turn == 0:
                without += not is_reached(pose, forward, answers(found))
                all_answers += len(answers(found))
    return f'{name},{label},"wrist 1e-{exponent}",{count},{least.mean():.1f},{least.max():.1f},{without},{all_answers}'


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    print("robot,contestant,set,poses,us_mean,us_worst,without,answers")
    for name, (path, prebuilt) in ROBOTS.items():
        for contestant in contestants(path, prebuilt):
            for exponent in EXPONENTS:
                print(row(name, exponent, count, *contestant), flush=True)


if __name__ == "__main__":
    main()
