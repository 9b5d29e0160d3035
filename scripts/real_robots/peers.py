"""Tests EAIK and ssik on the chains of robots.toml: the chains that they solve, and the number of poses whose joint values they find.

    python peers.py --json peers.json [--only ID,...]

It is run manually once for each release, and needs requirements.txt and `pip install EAIK==1.2.2 ssik==8.2.0`. Only poses are tested, of chains with six and
seven revolute joints. Both get axes and points from Pinocchio. For seven joints, EAIK gets the value of the first joint for which it has a decomposition. ssik
samples the redundant joint itself, so a pose counts as found if one solution reaches it.
"""

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path

import numpy
import pinocchio
import ssik
from eaik.IK_HP import HPRobot

from measure import seed
from robots import Chain, chosen
from witness import Witness

POSES, SECONDS = 1000, 12.0
"""Maximum number of poses, and maximum time of a peer."""
REACHED, SAME = 1e-6, 1e-5
Values = numpy.ndarray
Solver = Callable[[numpy.ndarray, Values], list[Values]]
"""All joint vectors of a pose (4x4). The value of a given joint is taken from the joint vector that reached the pose."""


class Screws:
    """Axes H and offsets P of a chain at zero, and the tip's rotation at zero."""

    def __init__(self, witness: Witness):
        zero = dict.fromkeys(witness.names, 0.0)
        base_from_tip = witness.forward(zero)
        twists = base_from_tip.toActionMatrix() @ witness.jacobian(zero)
        self.H = twists[3:].T
        points = [numpy.cross(w, v) for v, w in zip(twists[:3].T, twists[3:].T)]
        self.P = numpy.diff([numpy.zeros(3), *points, base_from_tip.translation], axis=0)
        self.tip = base_from_tip.rotation

    def target(self, pose: pinocchio.SE3) -> numpy.ndarray:
        """The pose of a tip without rotation at zero."""
        return pinocchio.SE3(pose.rotation @ self.tip.T, pose.translation).homogeneous


def eaik_solver(screws: Screws) -> tuple[str, Solver]:
    """EAIK's decomposition, and its solver. For seven joints one is given, and a new robot is built for each pose."""
    if len(screws.H) == 6:
        robot = HPRobot(screws.H, screws.P)
        return _family(robot), lambda pose, _: _exact(robot.IK(pose))
    for given in range(7):
        robot = HPRobot(screws.H, screws.P, [(given, 0.3)])
        if robot.hasKnownDecomposition():
            fixed = lambda values: HPRobot(screws.H, screws.P, [(given, values[given])])
            return f"{_family(robot)}, joint {given + 1} given", lambda pose, values: _exact(fixed(values).IK(pose))
    return "no known decomposition", lambda pose, values: []


def _family(robot: HPRobot) -> str:
    return robot.getKinematicFamily() if robot.hasKnownDecomposition() else "no known decomposition"


def _exact(answer) -> list[Values]:
    """The solutions that are not least-squares approximations."""
    return [numpy.array(q) for q, is_least_squares in zip(answer.Q, answer.is_LS) if not is_least_squares]


def ssik_solver(screws: Screws) -> tuple[str, Solver]:
    arm = ssik.Manipulator.from_axes(screws.H, screws.P)
    return arm.solver_name, lambda pose, _: [s.q for s in arm.solve(pose, respect_limits=False, enumerate_windings=False)]


def tried(make: Callable[[Screws], tuple[str, Solver]], witness: Witness, name: str, sampled: bool) -> dict:
    """The result of a peer for a chain."""
    start, screws = time.perf_counter(), Screws(witness)
    try:
        way, solver = make(screws)
        figures = {"way": str(way), "prepare_seconds": time.perf_counter() - start}
        return figures if "no known" in str(way) else figures | _counted(screws, solver, witness, name, sampled)
    except Exception as error:  # A peer's own errors, of any type, are its outcome.
        return {"error": f"{type(error).__name__}: {error}"[:300]}


def _counted(screws: Screws, solver: Solver, witness: Witness, name: str, sampled: bool) -> dict:
    count, found, most, wrong, start = 0, 0, 0, 0, time.perf_counter()
    for values in witness.draw(POSES, seed(name)):
        if time.perf_counter() - start > SECONDS:
            break
        pose, q = witness.forward(values), numpy.array(list(values.values()))
        answers = solver(screws.target(pose), q)
        reached = [_reaches(witness, answer, pose) for answer in answers]
        most, wrong = max(most, len(answers)), wrong + len(answers) - sum(reached)
        apart = [numpy.abs((answer - q + numpy.pi) % (2 * numpy.pi) - numpy.pi).max() for answer in answers]
        found += any(reached) if sampled else any(distance < SAME for distance in apart)
        count += 1
    each = (time.perf_counter() - start) / count
    return {"poses": count, "found": found, "most_answers": most, "answers_off_the_pose": wrong, "seconds_each": each}


def _reaches(witness: Witness, answer: Values, pose: pinocchio.SE3) -> bool:
    reached = witness.forward(dict(zip(witness.names, map(float, answer))))
    return bool(numpy.abs(reached.homogeneous - pose.homogeneous).max() < REACHED)


def row(chain: Chain) -> dict:
    """The results of both peers for a chain."""
    witness = Witness(chain.path().read_text(), chain.base, chain.tip)
    if len(witness.joints) not in (6, 7) or witness.sliding:
        return {"id": chain.id, "skipped": f"{len(witness.joints)} joints, {len(witness.sliding)} sliding"}
    eaik = tried(eaik_solver, witness, chain.id, sampled=False)
    return {"id": chain.id, "EAIK": eaik, "ssik": tried(ssik_solver, witness, chain.id, sampled=len(witness.joints) == 7)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="ID,...")
    parser.add_argument("--json", type=Path, required=True, metavar="FILE")
    args, rows = parser.parse_args(), []
    for chain in chosen(args.only, ci=False):
        if chain.task == "pose":
            rows.append(row(chain))
            print(json.dumps(rows[-1]), flush=True)
            args.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
