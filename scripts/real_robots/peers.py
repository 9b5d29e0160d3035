"""Tries EAIK and ssik on the chains of robots.toml: which of them they solve, and of how many poses they find the joint values.

    python peers.py --json peers.json [--only ID,...]

Used once for each release, by hand; needs requirements.txt and `pip install EAIK==1.2.2 ssik==8.2.0`. Only poses are tried, of chains of six
and seven turning joints. Both get axes and points from Pinocchio. Of seven joints EAIK is given the first one with which it knows a
decomposition; ssik samples the redundancy by itself, so there a pose counts as found when some answer reaches it.
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
"""As many poses are tried, or as many as a peer solves in that time."""
REACHED, SAME = 1e-6, 1e-5
Values = numpy.ndarray
Solver = Callable[[numpy.ndarray, Values], list[Values]]
"""All joint vectors of a pose (4x4); where a joint is given, its value is taken from the vector that made the pose."""


class Screws:
    """Axes H and offsets P of a chain at zero, and the tip's rotation there."""

    def __init__(self, witness: Witness):
        zero = dict.fromkeys(witness.names, 0.0)
        base_from_tip = witness.forward(zero)
        twists = base_from_tip.toActionMatrix() @ witness.jacobian(zero)
        self.H = twists[3:].T
        points = [numpy.cross(w, v) for v, w in zip(twists[:3].T, twists[3:].T)]
        self.P = numpy.diff([numpy.zeros(3), *points, base_from_tip.translation], axis=0)
        self.tip = base_from_tip.rotation

    def target(self, pose: pinocchio.SE3) -> numpy.ndarray:
        """The pose of a tip that is not turned at zero."""
        return pinocchio.SE3(pose.rotation @ self.tip.T, pose.translation).homogeneous


def eaik_solver(screws: Screws) -> tuple[str, Solver]:
    """EAIK's way, and its solver; of seven joints one is given, for which a robot is made anew at each pose."""
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
    """Those answers that are no least squares."""
    return [numpy.array(q) for q, is_least_squares in zip(answer.Q, answer.is_LS) if not is_least_squares]


def ssik_solver(screws: Screws) -> tuple[str, Solver]:
    arm = ssik.Manipulator.from_axes(screws.H, screws.P)
    return arm.solver_name, lambda pose, _: [s.q for s in arm.solve(pose, respect_limits=False, enumerate_windings=False)]


def tried(make: Callable[[Screws], tuple[str, Solver]], witness: Witness, name: str, sampled: bool) -> dict:
    """What a peer does on a chain."""
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
    """Both peers on a chain."""
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
