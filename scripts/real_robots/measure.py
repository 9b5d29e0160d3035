"""Derives one chain and counts the correct solutions of its solver for poses computed by Pinocchio."""

import math
import zlib
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy

import groebot
from robots import Chain
from task import Task
from witness import Witness

ORDINARY = 1e-3
"""Minimum singular value of the scaled Jacobian at an ordinary pose."""
SAME, SAME_NEAR_SINGULAR, TWICE = 1e-6, 1e-4, 1e-6
"""Joint values [rad or m] are correct within SAME, at other poses within SAME_NEAR_SINGULAR. Two solutions within TWICE are equal."""


WEAK_SPOTS = 3
"""The exit status of a derivation that was written and misses solutions at singular poses."""


@dataclass
class Row:
    """A row of the table and of the JSON."""

    id: str
    robot: str
    package: str
    task: str
    status: str = "failed"
    reason: str = ""
    exit: int = 0
    """The exit status of `groebot derive`."""
    weak: str = ""
    """The failing targets of its check, if the status is WEAK_SPOTS."""
    joints: int = 0
    given: str = ""
    wall: float = math.nan
    cpu: float = math.nan
    complex_solutions: int = 0
    most: int = 0
    poses: int = 0
    found: int = 0
    ordinary: int = 0
    ordinary_found: int = 0
    residual: float = 0.0
    doubles: int = 0
    free: int = 0
    solve_cpu: float = math.nan
    c_bytes: int = 0
    rust_bytes: int = 0
    missed: list[dict[str, float]] = field(default_factory=list)

    def json(self) -> dict:
        """All fields except NaN, which JSON cannot represent."""
        return {key: value for key, value in asdict(self).items() if value == value}


def row(chain: Chain, program: Path, out: Path, budget: float, count: int) -> Row:
    """Derives a chain within `budget` seconds, solves `count` poses of it, and returns the results."""
    result = Row(chain.id, chain.robot, chain.package, chain.asked)
    try:
        text = chain.path().read_text()
        witness = Witness(text, chain.base, chain.tip)
    except (LookupError, FileNotFoundError, ValueError) as error:
        result.reason = f"no witness: {error}"
        return result
    result.joints = len(witness.joints)
    done = groebot.derive(program, chain, out / chain.id, budget)
    result.wall, result.cpu, result.exit = done.wall, done.cpu, done.status
    if done.status not in (0, WEAK_SPOTS):
        result.status, result.reason = "refused", groebot.reason(done)
        return result
    derivation = groebot.Derivation.read(out / chain.id)
    result.weak = groebot.weak_spots(derivation)
    _describe(result, derivation)
    _solve(result, program, Task(chain, witness, derivation), count)
    return result


def seed(name: str) -> int:
    """The seed of a chain's poses."""
    return zlib.crc32(name.encode())


def _describe(result: Row, derivation: groebot.Derivation) -> None:
    """The properties of a solver that are known without running it."""
    result.given, result.complex_solutions = ", ".join(derivation.given), derivation.complex_solutions
    result.c_bytes, result.rust_bytes = derivation.size("5_solver.c"), derivation.size("5_solver.rs")


def _solve(result: Row, program: Path, task: Task, count: int) -> None:
    """Solves poses and counts the results."""
    drawn = task.witness.draw(count, seed(result.id))
    poses = [task.witness.forward(values) for values in drawn]
    targets = [task.target(pose, values) for pose, values in zip(poses, drawn)]
    done, answers = groebot.solve(program, task.derivation, targets)
    result.status, result.reason = ("failed", groebot.reason(done)) if done.status else ("derived", "")
    result.poses, result.free, result.solve_cpu = count, answers.free, done.cpu
    reach = max(numpy.linalg.norm(pose.translation) for pose in poses) or 1.0
    for values, target, solutions in zip(drawn, targets, answers.solutions):
        _count(result, task, values, target, [task.witness.chosen(solution) for solution in solutions], reach)


def _count(
    result: Row, task: Task, values: dict[str, float], target: list[float], solutions: list[dict[str, float]], reach: float
) -> None:
    """Counts the solutions of one target, which `values` reach."""
    ordinary = task.least_singular_value(values, reach) > ORDINARY
    tolerance = SAME if ordinary else SAME_NEAR_SINGULAR
    found = any(task.same(values, solution, tolerance) for solution in solutions)
    result.most = max(result.most, len(solutions))
    result.found += found
    result.ordinary += ordinary
    result.ordinary_found += ordinary and found
    result.doubles += sum(any(task.same(one, other, TWICE) for other in solutions[:i]) for i, one in enumerate(solutions))
    result.residual = max([result.residual, *(task.residual(target, solution) for solution in solutions)])
    if not found:
        result.missed.append(values)
