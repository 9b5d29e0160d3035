"""Results of long computations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._groebot import PlacedSolver, Robot, Solver


@dataclass(frozen=True)
class Check:
    """A successful check: the proof was verified again, and all ordinary targets were solved correctly."""

    targets: int
    """Number of targets that were compared with independent solvers."""
    weak_spots: tuple[str, ...]
    """Singular targets at which solutions are lost."""
    table: str
    """One line for each target, as CSV."""


@dataclass(frozen=True, eq=False)
class Closest:
    """The joint values whose target has the least error."""

    q: npt.NDArray[np.float64]
    """The joint values. Angles are in (-pi, pi] unless limits were given, or the solver is redundant."""
    reached: npt.NDArray[np.float64]
    """The target that they reach: (4, 4) for a pose, else the numbers of `inputs` without those of given joints."""
    distance: float
    """The distance of `reached` from the target, in the solver's unit of length."""
    angle: float
    """The angle between `reached` and the target [rad]."""
    reachable: bool
    """Whether the target is reachable, within the limits if these were given. `q` is then one of its solutions. Of a redundant solver, false does not prove
    that the target is out of reach."""
    is_minimum: bool
    """Whether `q` is a local minimum of the error, by its first and second derivatives."""
    starts: int
    """Number of starting points of the search; zero for a reachable target."""
    agreeing: int
    """Number of starting points from which the search ended at this error. If it is small, another minimum may have been missed."""


@dataclass(frozen=True)
class Explanation:
    """An explanation of a derivation for students. Notebooks display it; `str` is its Markdown."""

    markdown: str
    latex: str

    def __str__(self) -> str:
        return self.markdown

    def __repr__(self) -> str:
        return f"<groebot.Explanation of {len(self.markdown.splitlines())} lines>"

    def _repr_markdown_(self) -> str:
        return self.markdown

    def _repr_latex_(self) -> str:
        return self.latex


@dataclass(frozen=True)
class Jump:
    """A jump of a path from one branch to another."""

    index: int
    """The index of the pose after the jump; 0 if the path does not begin at `q0`."""
    joint: int
    """The joint with the largest step."""
    step: float
    """The size of this step [rad, or the unit of length]."""
    why: str
    """The reason, as text."""


@dataclass(frozen=True, eq=False)
class Path:
    """Joint values along poses."""

    q: npt.NDArray[np.float64]
    """(N, joints). Joints without limits are continuous over whole turns."""
    jumps: list[Jump]
    """The jumps between branches, in order; empty if the path is continuous."""
    is_unsure: bool = False
    """Whether the arcs of some target of a redundant solver are unsure."""
    arcs: npt.NDArray[np.int64] | None = None
    """The index of each target's arc among those of `Solver.arcs`, (N,); None for a solver that is not redundant, and with scanned joints."""


@dataclass(frozen=True, eq=False)
class Walk:
    """A walk over a map, with every sample checked."""

    times: npt.NDArray[np.float64]
    """(samples,) [s]."""
    joints: list[str]
    """The names of the joints."""
    q: npt.NDArray[np.float64]
    """Joint values, (samples, joints) [rad]."""
    base: npt.NDArray[np.float64]
    """The pose of the torso in the world frame, (samples, 4, 4)."""
    margin: npt.NDArray[np.float64]
    """The distance of the zero moment point from the border of the support polygon, (samples,) [m]."""
    path: npt.NDArray[np.float64]
    """The corners of the path of the midpoint of the feet, (corners, 2) [m]."""
    footsteps: npt.NDArray[np.float64]
    """The footsteps: x, y, yaw, (steps, 3) [m, rad]."""
    feet: list[str]
    """The foot of each footstep: left or right."""
    csv: str
    """Converts the walk to the CSV of `groebot navigate`, which `groebot view` and `groebot simulate` read."""
    notes: list[str]
    """What differs from the requested walk, such as the reason why the robot rests after each step; usually empty."""


def _robot(text: str, base: str | None, tip: str | None, floating: bool, gravity: list[float]) -> Robot:
    return Robot.from_urdf(text, base, tip, floating=floating, gravity=gravity)


def _placed(text: str, base: npt.NDArray[np.float64], tool: npt.NDArray[np.float64]) -> PlacedSolver:
    return Solver.from_json(text).placed(base=base, tool=tool)
