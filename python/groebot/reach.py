"""Reach maps in blocks of parquet files (`pip install groebot[parquet]`).

`groebot.blocks.run(Reach.of(solver, grid), "map")` computes a map in this process, `groebot.dask.reach_map` on many machines. `read` reads the map.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pyarrow as arrow

from . import blocks
from ._groebot import Solver
from ._reach import _COLUMNS, Ask, Grid, Measure, ReachMap, requested

if TYPE_CHECKING:
    from ._groebot import _Limits

PIECE = 1 << 16
"""Number of grid points that are computed and written together."""


@dataclass(frozen=True)
class Reach(blocks.Work):
    """Computes grid points: each row of a table is a point of the grid, with `x`, `y`, `z` and the columns of `groebot.ReachMap`."""

    solver: str
    """The result of `Solver.to_json`."""
    ask: Ask
    threads: int = 1

    @staticmethod
    def of(
        solver: Solver,
        grid: Grid,
        orientations: int = 100,
        measure: Measure = "count",
        *,
        limits: _Limits | None = None,
        given: npt.ArrayLike | None = None,
        seed: int | None = None,
        threads: int = 1,
    ) -> Reach:
        """Builds the work for a grid, and checks it before it is sent to workers. Arguments are as for `groebot.reach_map`; `threads` is the number of threads
        of one block.
        """
        ask = requested(grid, orientations, measure, limits, given, seed)
        # Errors are reported here, not by a remote worker.
        ask.columns(solver, 0, 0, 1)
        return Reach(solver.to_json(), ask, threads)

    @property
    def rows(self) -> int:
        return self.ask.places

    def parameters(self) -> dict[str, Any]:
        ask = self.ask
        parameters = {"work": "reach", "solver": self.solver, "axes": ask.axes, "orientations": ask.orientations, "measure": ask.measure}
        return {**parameters, "limits": ask.limits, "given": ask.given, "seed": ask.seed}

    def tables(self, start: int, stop: int) -> Iterator[arrow.Table]:
        solver, shape = _solver(self.solver), tuple(axis.num for axis in self.ask.axes)
        for first in range(start, stop, PIECE):
            last = min(first + PIECE, stop)
            numbers = np.unravel_index(np.arange(first, last), shape)
            columns = {name: axis.places[number] for name, axis, number in zip("xyz", self.ask.axes, numbers)}
            counted = self.ask.columns(solver, first, last, self.threads)
            columns |= {name: counted[name] for name in _COLUMNS if name in counted}
            yield arrow.table(columns)


def block(work: Reach, poses: int = blocks.BLOCK) -> int:
    """Number of grid points with about this number of poses."""
    orientations: int = work.ask.columns(_solver(work.solver), 0, 0, 1)["orientations"]
    return max(1, poses // orientations)


def read(out: str | os.PathLike[str], work: Reach) -> ReachMap:
    """The map of a finished work. `BadValueError` as `groebot.blocks.finished`."""
    files = [path for _, path in blocks.finished(out, work)]
    table = arrow.concat_tables(blocks.read(path) for path in files)
    columns: dict[str, Any] = {name: table[name].to_numpy() for name in _COLUMNS if name in table.column_names}
    solver = _solver(work.solver)
    columns["orientations"] = work.ask.columns(solver, 0, 0, 1)["orientations"]
    return ReachMap.of(solver, work.ask, columns)


@lru_cache(maxsize=4)
def _solver(text: str) -> Solver:
    return Solver.from_json(text)
