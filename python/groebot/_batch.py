"""The solutions of many targets."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import BadValueError

Floats = npt.NDArray[np.floating[Any]]


class Status(IntEnum):
    """Why a row has no solution, or not all."""

    SOLVED = 0
    """It has some."""
    UNREACHABLE = 1
    """It is out of reach."""
    NOT_FINITE = 2
    """A number is infinite or none."""
    NOT_ROTATION = 3
    """The rotation, the quaternion or the last row of the matrix is none."""
    NOT_UNIT = 4
    """The direction is not of length one."""
    OPEN = 5
    """It lies on a stratum that could not be derived."""
    BEYOND_LIMITS = 6
    """All solutions are beyond the limits."""
    UNSETTLED = 7
    """The steps of polishing that a target may take were spent: other solutions may be missing."""


@dataclass(frozen=True, eq=False)
class Batch:
    """The solutions of N targets, M in all: those of row i are the rows `starts[i]` to `starts[i + 1]` of the other arrays, by branch."""

    q: Floats
    """Joint values, (M, joints): radians in (-pi, pi], lengths in the solver's unit."""
    starts: npt.NDArray[np.int64]
    """Where the solutions of each row begin, (N + 1,)."""
    residual: Floats
    """The largest magnitude among the equations' values, (M,)."""
    branch: npt.NDArray[np.int32]
    """Which roots of which equations, (M,): a branch keeps its number from target to target."""
    free: npt.NDArray[np.uint32]
    """Bit j is set where joint j may take any value at a singular target, (M,)."""
    status: npt.NDArray[np.uint8]
    """Why a row has no solution, (N,): a `Status`."""
    joints: tuple[str, ...]
    """The names of the joints."""

    def __len__(self) -> int:
        return len(self.status)

    def __getitem__(self, row: int) -> Floats:
        """The joint values of a row, (solutions, joints)."""
        if not -len(self) <= row < len(self):
            raise IndexError(f"row {row} of {len(self)}")
        row %= len(self)
        return self.q[self.starts[row] : self.starts[row + 1]]

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """How many solutions each row has, (N,)."""
        return np.diff(self.starts)

    @property
    def row(self) -> npt.NDArray[np.int64]:
        """The row that each solution is of, (M,)."""
        return np.repeat(np.arange(len(self)), self.counts)

    def padded(self, width: int | None = None) -> PaddedBatch:
        """The same with room for `width` solutions in each row, by default for as many as a row has at most."""
        most = int(self.counts.max(initial=0))
        width = most if width is None else width
        if width < most:
            raise BadValueError(f"a row has {most} solutions; a width of {width} is too little", "bad_value")
        taken = np.arange(width) < self.counts[:, None]
        q = np.full((*taken.shape, self.q.shape[1]), np.nan, self.q.dtype)
        residual = np.full(taken.shape, np.nan, self.residual.dtype)
        branch = np.full(taken.shape, -1, np.int32)
        free = np.zeros(taken.shape, np.uint32)
        q[taken], residual[taken], branch[taken], free[taken] = self.q, self.residual, self.branch, self.free
        return PaddedBatch(q, self.counts, residual, branch, free, self.status, self.joints)


@dataclass(frozen=True, eq=False)
class PaddedBatch:
    """The solutions of N targets in arrays with room for K in each row; NaN, and branch -1, stand where there is none."""

    q: Floats
    """Joint values, (N, K, joints)."""
    counts: npt.NDArray[np.int64]
    """How many solutions each row has, (N,)."""
    residual: Floats
    """(N, K)."""
    branch: npt.NDArray[np.int32]
    """(N, K)."""
    free: npt.NDArray[np.uint32]
    """(N, K)."""
    status: npt.NDArray[np.uint8]
    """Why a row has no solution, (N,): a `Status`."""
    joints: tuple[str, ...]
    """The names of the joints."""

    def __len__(self) -> int:
        return len(self.status)


def made(arrays: tuple[Any, ...], joints: list[str], layout: str, dtype: npt.DTypeLike | None) -> Batch | PaddedBatch:
    """The batch of what was solved, in a layout and with a type of floats."""
    if layout not in ("ragged", "padded"):
        raise BadValueError(f"the layout `{layout}` is not known; give ragged or padded", "bad_value")
    q, starts, residual, branch, free, status = arrays
    if dtype is not None:
        wanted = np.dtype(dtype)
        if wanted.kind != "f":
            raise BadValueError(f"dtype={wanted} has no fractions; give float64 or float32", "bad_value")
        q, residual = q.astype(wanted, copy=False), residual.astype(wanted, copy=False)
    batch = Batch(q, starts, residual, branch, free, status, tuple(joints))
    return batch.padded() if layout == "padded" else batch
