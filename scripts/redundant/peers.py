"""Times ssik's prebuilt modules on committed poses, and a command of groebot beside them in turn.

    python peers.py ARMS_FOLDER [--only ID,...] [--poses 200] [--ours COMMAND] [--calls solve,one,charts] > benches/record/DATE-redundant-peers.csv

Contestants: `solve` gives all solutions of ssik's samples within limits, `one` the first one (max_solutions=1), `charts` all arcs within limits (exactly
spherical shoulder and wrist, or Franka's family). Poses are random joint vectors within the limits (poses.py), by the module's own forward kinematics, so
that the module is right by construction. Times are processor time, microseconds a pose: median, 90th and 99th percentile; of each pose the least of three
calls. `empty` counts poses without a solution, though each has one.

COMMAND is run once for each arm, as COMMAND ARM_URDF VECTORS_CSV, and prints CSV rows `call,pose,us,count`. The file has one joint vector a row, without a
header. Its rows are summarised like ssik's, as contestant `groebot`. Where the module was made from another description, joint vectors agree and poses differ.
"""

import argparse
import csv
import importlib
import io
import subprocess
import tempfile
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np

from arm import Arm
from chains import read
from poses import random_vectors

CALLS = ("solve", "one", "charts")
ROUNDS = 3


def timed(call, pose) -> tuple[float, int]:
    """The least processor time of some calls [us], and the number of answers."""
    least, count = np.inf, 0
    for _ in range(ROUNDS):
        start = time.process_time_ns()
        count = call(pose)
        least = min(least, (time.process_time_ns() - start) / 1e3)
    return least, count


def contestants(module_name: str) -> dict:
    """The calls of a prebuilt module, each with the number of its answers."""
    import ssik

    module = importlib.import_module(f"ssik.prebuilt.{module_name}")
    calls = {
        "solve": lambda pose: len(module.solve(pose)),
        "one": lambda pose: len(module.solve(pose, max_solutions=1)),
    }
    name = next(arm.name for arm in ssik.list_arms() if arm.import_path == module.__name__)
    arm = ssik.Manipulator.from_prebuilt(name)
    try:
        arm.self_motion(module.fk(np.full(7, 0.3)))
        calls["charts"] = lambda pose: sum(len(chart.in_limits()) for chart in arm.self_motion(pose).charts)
    except NotImplementedError:
        pass
    return {"module": module, "calls": calls}


def summary(arm: str, contestant: str, call: str, rows: list[tuple[float, int]]) -> list:
    """A row of the record."""
    times, counts = np.array([row[0] for row in rows]), np.array([row[1] for row in rows])
    return [arm, contestant, call, len(rows), *(f"{x:.1f}" for x in np.percentile(times, [50, 90, 99])), int((counts == 0).sum()), f"{counts.mean():.1f}"]


def ours(command: str, urdf: Path, vectors: np.ndarray) -> dict[str, list[tuple[float, int]]]:
    """The rows that groebot's command prints, by call."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        np.savetxt(file, vectors, fmt="%.17g", delimiter=",")
        file.flush()
        text = subprocess.run([*command.split(), str(urdf), file.name], check=True, capture_output=True, text=True).stdout
    rows: dict[str, list[tuple[float, int]]] = {}
    for call, _, us, count in csv.reader(io.StringIO(text)):
        rows.setdefault(call, []).append((float(us), int(count)))
    return rows


def within(module, arm: Arm, count: int) -> np.ndarray:
    """Random joint vectors within the limits of our description and of the module."""
    limits = np.array([bounds or (-np.inf, np.inf) for bounds in module._JOINT_LIMITS], dtype=float)
    vectors = random_vectors(arm, 20 * count, seed=2)
    return vectors[np.all((vectors >= limits[:, 0]) & (vectors <= limits[:, 1]), axis=1)][:count]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("arms", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--poses", type=int, default=200)
    parser.add_argument("--calls", default=",".join(CALLS))
    parser.add_argument("--ours", default="", metavar="COMMAND")
    args = parser.parse_args()
    print("arm,contestant,call,poses,us_median,us_90,us_99,empty,answers_mean", flush=True)
    for entry in read(args.only):
        urdf = args.arms / f"{entry['id']}.urdf"
        arm = Arm(urdf)
        vectors = random_vectors(arm, args.poses, seed=2)
        if "peer" in entry:
            peer = contestants(entry["peer"])
            vectors = within(peer["module"], arm, args.poses)
            poses = [np.asarray(peer["module"].fk(q)) for q in vectors]
            for name, call in peer["calls"].items():
                if name in args.calls.split(","):
                    call(poses[0])
                    row = summary(entry["id"], f"ssik {version('ssik')}", name, [timed(call, pose) for pose in poses])
                    print(",".join(map(str, row)), flush=True)
        if args.ours:
            for name, rows in ours(args.ours, urdf, vectors).items():
                print(",".join(map(str, summary(entry["id"], "groebot", name, rows))), flush=True)


if __name__ == "__main__":
    main()
