"""The solutions of many targets."""

from __future__ import annotations

import operator
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, SupportsIndex, overload

import numpy as np
import numpy.typing as npt

from ._errors import BadValueError

Floats = npt.NDArray[np.floating[Any]]


class Status(IntEnum):
    """Reason why a row has no solution, or not all."""

    SOLVED = 0
    """The row has solutions."""
    UNREACHABLE = 1
    """The target is out of reach."""
    NOT_FINITE = 2
    """A number is infinite or NaN."""
    NOT_ROTATION = 3
    """The rotation matrix, the quaternion or the last row of the matrix is invalid."""
    NOT_UNIT = 4
    """The direction does not have length one."""
    OPEN = 5
    """The target is on a stratum that could not be derived."""
    BEYOND_LIMITS = 6
    """All solutions are beyond the limits."""
    UNSETTLED = 7
    """Other solutions may be missing: the maximum number of polishing steps was reached, or arcs of a redundant solver are unsure."""


@dataclass(frozen=True, eq=False)
class Batch:
    """The solutions of N targets, M in total. Those of row i are the rows `starts[i]` to `starts[i + 1]` of the other arrays, sorted by branch. For a redundant
    solver they are the best ones of each arc, the largest margin first."""

    q: Floats
    """Joint values, (M, joints): radians in (-pi, pi], of a redundant solver within limits; lengths in the solver's unit."""
    starts: npt.NDArray[np.int64]
    """Index of the first solution of each row, (N + 1,)."""
    residual: Floats
    """The largest residual of the equations, (M,)."""
    branch: npt.NDArray[np.int32]
    """Branch number, (M,): which roots of which equations were used. A branch keeps its number from target to target. For a redundant solver it is the index of
    the arc."""
    free: npt.NDArray[np.uint32]
    """Bit j is set if joint j is free at a singular target, (M,)."""
    status: npt.NDArray[np.uint8]
    """The `Status` of each row, (N,)."""
    joints: tuple[str, ...]
    """The names of the joints."""

    def __len__(self) -> int:
        return len(self.status)

    def __iter__(self) -> Iterator[Floats]:
        """The joint values of each row, (solutions, joints)."""
        return (self[row] for row in range(len(self)))

    @overload
    def __getitem__(self, row: SupportsIndex) -> Floats: ...
    @overload
    def __getitem__(self, row: slice) -> Batch: ...
    def __getitem__(self, row: SupportsIndex | slice) -> Floats | Batch:
        """The joint values of a row, (solutions, joints); of a slice, the batch of its rows."""
        if isinstance(row, slice):
            return self._rows(np.arange(len(self))[row])
        row = operator.index(row)
        if not -len(self) <= row < len(self):
            raise IndexError(f"row {row} of {len(self)}")
        row %= len(self)
        return self.q[self.starts[row] : self.starts[row + 1]]

    def _rows(self, rows: npt.NDArray[np.int64]) -> Batch:
        counts = self.counts[rows]
        starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        taken = np.repeat(self.starts[rows] - starts[:-1], counts) + np.arange(starts[-1])
        return Batch(self.q[taken], starts, self.residual[taken], self.branch[taken], self.free[taken], self.status[rows], self.joints)

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """Number of solutions of each row, (N,)."""
        return np.diff(self.starts)

    @property
    def row(self) -> npt.NDArray[np.int64]:
        """Row of each solution, (M,)."""
        return np.repeat(np.arange(len(self)), self.counts)

    def padded(self, width: int | None = None) -> PaddedBatch:
        """Converts to arrays with `width` solutions per row, by default the maximum number of a row."""
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
    """The solutions of N targets in arrays with K solutions per row. Unused entries are NaN, and -1 for the branch."""

    q: Floats
    """Joint values, (N, K, joints)."""
    counts: npt.NDArray[np.int64]
    """Number of solutions of each row, (N,)."""
    residual: Floats
    """(N, K)."""
    branch: npt.NDArray[np.int32]
    """(N, K)."""
    free: npt.NDArray[np.uint32]
    """(N, K)."""
    status: npt.NDArray[np.uint8]
    """The `Status` of each row, (N,)."""
    joints: tuple[str, ...]
    """The names of the joints."""

    def __len__(self) -> int:
        return len(self.status)


def made(arrays: tuple[Any, ...], joints: list[str], layout: str, dtype: npt.DTypeLike | None) -> Batch | PaddedBatch:
    """Builds the batch of the solutions, in a layout and with a floating-point type."""
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
