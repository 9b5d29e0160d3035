"""What longer work gives back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._groebot import Robot


@dataclass(frozen=True)
class Check:
    """A check that held: the proof was followed again, and all ordinary targets were solved right."""

    targets: int
    """Targets that were solved against the witnesses."""
    weak_spots: tuple[str, ...]
    """Singular targets at which answers are lost."""
    table: str
    """One line a target, as CSV."""


@dataclass(frozen=True)
class Explanation:
    """A derivation, told to a student. Notebooks show it; `str` is its Markdown."""

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
    """Where a path must jump from one branch to another."""

    index: int
    """The pose that is jumped to; 0 where the path begins away from `q0`."""
    joint: int
    """The joint that goes furthest."""
    step: float
    """How far [rad, or the unit of length]."""
    why: str
    """Why, in words."""


@dataclass(frozen=True, eq=False)
class Path:
    """Joint values along poses."""

    q: npt.NDArray[np.float64]
    """(N, joints); joints without limits turn on from where they were."""
    jumps: list[Jump]
    """Where branches end, in order; empty where the path is continuous."""


@dataclass(frozen=True, eq=False)
class Walk:
    """A walk over a map, every sample of it checked."""

    times: npt.NDArray[np.float64]
    """(samples,) [s]."""
    joints: list[str]
    """The names of the joints."""
    q: npt.NDArray[np.float64]
    """Joint values, (samples, joints) [rad]."""
    base: npt.NDArray[np.float64]
    """The pose of the torso in the world, (samples, 4, 4)."""
    margin: npt.NDArray[np.float64]
    """How far the zero moment point is inside of the support polygon, (samples,) [m]."""
    way: npt.NDArray[np.float64]
    """The corners of the way of the middle of the feet, (corners, 2) [m]."""
    footsteps: npt.NDArray[np.float64]
    """Where feet are put: x, y, yaw, (steps, 3) [m, rad]."""
    feet: list[str]
    """Which foot is put, left or right."""
    csv: str
    """The walk as `groebot navigate` writes it: what `groebot view` and `groebot simulate` read."""


def _robot(text: str, base: str | None, tip: str | None, floating: bool, gravity: list[float]) -> Robot:
    return Robot.from_urdf(text, base, tip, floating=floating, gravity=gravity)
