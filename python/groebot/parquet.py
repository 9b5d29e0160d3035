"""Targets and solutions in parquet files (`pip install groebot[parquet]`).

`groebot.blocks.run(Solve.of(solver, "targets.parquet"), "solutions")` solves targets in this process, `groebot.dask.solve_parquet` on many machines. `batches`
reads the solutions.
"""

from __future__ import annotations

import glob
import hashlib
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as arrow
import pyarrow.compute as compute
import pyarrow.parquet as parquet

from . import blocks
from ._arrays import plain_limits
from ._batch import Batch
from ._errors import BadValueError
from ._groebot import Solver

KEEP = ("status", "q", "residual", "branch", "free")
"""The columns that are written for each target."""
PIECE = 1 << 15
"""Number of rows that are solved and written together."""
_JOINT = "q_"


@dataclass(frozen=True)
class Part:
    """A parquet file with targets."""

    path: str
    rows: int
    footer: str
    """The SHA-256 hash of its footer, which changes with the content."""


@dataclass(frozen=True)
class Targets:
    """Targets in parquet files, one per row. Their numbers are in single columns or in one column of lists."""

    parts: tuple[Part, ...]
    columns: tuple[str, ...]

    @staticmethod
    def of(source: str | os.PathLike[str], columns: Sequence[str]) -> Targets:
        """The targets of a file, of all `*.parquet` of a folder sorted by name, or of all files that match a pattern with `*`."""
        where = Path(source).absolute()
        if where.is_dir():
            files = sorted(where.glob("*.parquet"))
        else:
            files = sorted(map(Path, glob.glob(str(where)))) if "*" in where.name else [where]
        if not files:
            raise BadValueError(f"{where}: there is no parquet file", "bad_value")
        for file in files:
            missing = [name for name in columns if name not in (known := parquet.read_schema(file).names)]
            if missing:
                raise BadValueError(f"{file}: no column is called {missing[0]}; there are {', '.join(known)}", "unknown_name")
        return Targets(tuple(map(_part, files)), tuple(columns))

    @property
    def rows(self) -> int:
        return sum(part.rows for part in self.parts)

    def read(self, start: int, stop: int) -> npt.NDArray[np.float64]:
        """The numbers of the targets from `start` to before `stop`: (rows, numbers)."""
        pieces, first = [], 0
        for part in self.parts:
            low, high = max(start - first, 0), min(stop - first, part.rows)
            if low < high:
                pieces.append(_read(part.path, self.columns, low, high))
            first += part.rows
        return np.concatenate(pieces)


def _part(path: Path) -> Part:
    with open(path, "rb") as file:
        file.seek(-8, os.SEEK_END)
        length = int.from_bytes(file.read(4), "little")
        file.seek(-8 - length, os.SEEK_END)
        footer = hashlib.sha256(file.read()).hexdigest()
    return Part(str(path), parquet.read_metadata(path).num_rows, footer)


def _read(path: str, columns: tuple[str, ...], start: int, stop: int) -> npt.NDArray[np.float64]:
    with parquet.ParquetFile(path) as file:
        edges = np.cumsum([0, *(file.metadata.row_group(group).num_rows for group in range(file.num_row_groups))])
        groups = [group for group in range(file.num_row_groups) if edges[group] < stop and edges[group + 1] > start]
        table = file.read_row_groups(groups, columns=list(columns), use_threads=False)
    table = table.slice(start - edges[groups[0]], stop - start)
    return np.concatenate([_numbers(name, table[name]) for name in columns], 1)


def _numbers(name: str, column: arrow.ChunkedArray) -> npt.NDArray[np.float64]:
    array, rows, width = column.combine_chunks(), len(column), 1
    is_list = any(is_it(array.type) for is_it in (arrow.types.is_list, arrow.types.is_large_list, arrow.types.is_fixed_size_list))
    if is_list and not array.null_count:
        lengths = set(compute.list_value_length(array).unique().to_pylist())
        if len(lengths) > 1:
            raise BadValueError(f"column {name}: its lists have {min(lengths)} to {max(lengths)} numbers; give all as many", "bad_value")
        array, width = array.flatten(), lengths.pop()
    if array.null_count:
        raise BadValueError(f"column {name}: {array.null_count} values are null; give NaN where there is no target", "bad_value")
    if not (arrow.types.is_floating(array.type) or arrow.types.is_integer(array.type)):
        raise BadValueError(f"column {name}: {array.type} has no real numbers; give doubles, or lists of them", "bad_value")
    return np.asarray(array.to_numpy(zero_copy_only=False), np.float64).reshape(rows, width)


@dataclass(frozen=True)
class Solve(blocks.Work):
    """Solves targets: each row of a table has all solutions of one target.

    `status` is a `groebot.Status`. Each joint has a column `q_JOINT`, a list of its values in the solutions. `residual`, `branch` and `free` are lists of the
    same length, and `count` is this length.
    """

    solver: str
    """The result of `Solver.to_json`."""
    targets: Targets
    keep: tuple[str, ...] = KEEP
    options: dict[str, Any] = field(default_factory=dict)
    """Options of `Solver.solve_batch`: numbers, lists, dicts and texts."""
    threads: int = 1

    @staticmethod
    def of(
        solver: Solver,
        source: str | os.PathLike[str],
        columns: Sequence[str] | None = None,
        keep: Sequence[str] = KEEP,
        threads: int = 1,
        **options: Any,
    ) -> Solve:
        """Builds the work for targets in parquet files, and checks it before it is sent to workers.

        `columns` are by default those of the solver's inputs and given joints. `options` are `limits=`, `near=` (one for all), `given=`, `dtype=`
        and `tolerance=` of `solve_batch`. Invalid targets are reported by their status.
        """
        unknown = set(options) - {"limits", "near", "given", "dtype", "tolerance"}
        if unknown:
            raise BadValueError(f"the option {min(unknown)} is not known; give limits, near, given, dtype or tolerance", "bad_value")
        if not keep or (wrong := set(keep) - {*KEEP, "count"}):
            raise BadValueError(f"of a target there are {', '.join(KEEP)} and count; not {sorted(wrong) if keep else 'nothing'}", "bad_value")
        plain = {name: _plain(name, value) for name, value in options.items() if value is not None}
        constant = solver.given if "given" in plain else []
        names = [name for name in solver.inputs if name not in constant] if columns is None else columns
        work = Solve(solver.to_json(), Targets.of(source, names), tuple(keep), plain, threads)
        if work.rows:
            # Wrong shapes are reported here, not by a remote worker.
            next(work.solved(0, 1))
        return work

    @property
    def rows(self) -> int:
        return self.targets.rows

    def parameters(self) -> dict[str, Any]:
        parts = [[Path(part.path).name, part.rows, part.footer] for part in self.targets.parts]
        return {
            "work": "solve",
            "solver": self.solver,
            "targets": parts,
            "columns": self.targets.columns,
            "keep": self.keep,
            "options": self.options,
        }

    def solved(self, start: int, stop: int) -> Iterator[Batch]:
        """The solutions of the rows from `start` to before `stop`, in parts that fit into the processor's cache."""
        solver = _solver(self.solver)
        numbers = self.targets.read(start, stop)
        if numbers.shape[1] == 16:
            numbers = numbers.reshape(-1, 4, 4)
        for first in range(0, len(numbers), PIECE):
            yield solver.solve_batch(numbers[first : first + PIECE], threads=self.threads, **self.options)

    def tables(self, start: int, stop: int) -> Iterator[arrow.Table]:
        for batch in self.solved(start, stop):
            columns = {}
            for name in self.keep:
                columns.update(_columns(name, batch))
            yield arrow.table(columns)


@lru_cache(maxsize=4)
def _solver(text: str) -> Solver:
    return Solver.from_json(text)


def _plain(name: str, value: Any) -> Any:
    if name == "dtype":
        return np.dtype(value).name
    if name == "limits":
        return plain_limits(value)
    if name == "given" and isinstance(value, Mapping):
        return {joint: float(number) for joint, number in value.items()}
    array = np.asarray(value, np.float64)
    if name in ("near", "given") and array.ndim != 1:
        raise BadValueError(f"{name} of shape {array.shape} is not one for all targets; give (joints,)", "bad_value")
    return array.tolist()


def _columns(name: str, batch: Batch) -> dict[str, arrow.Array]:
    if name == "status":
        return {name: arrow.array(batch.status)}
    if name == "count":
        return {name: arrow.array(batch.counts.astype(np.uint32))}
    starts = arrow.array(batch.starts)

    def lists(values: npt.NDArray[Any]) -> arrow.Array:
        return arrow.LargeListArray.from_arrays(starts, arrow.array(values))

    if name == "q":
        return {_JOINT + joint: lists(values) for joint, values in zip(batch.joints, batch.q.T.copy())}
    return {name: lists(getattr(batch, name))}


def batches(out: str | os.PathLike[str]) -> Iterator[tuple[int, Batch]]:
    """Reads the output of `Solve`, block by block: the first row of each, and its solutions. All columns must have been written.

    `BadValueError` as `groebot.blocks.finished`, and if a column is missing.
    """
    for start, path in blocks.finished(out):
        yield start, _batch(path)


def _batch(path: Path) -> Batch:
    table = blocks.read(path)
    joints = [name for name in table.column_names if name.startswith(_JOINT)]
    missing = {*KEEP[:1], *KEEP[2:]} - set(table.column_names)
    if missing or not joints:
        raise BadValueError(f"{path}: {min(missing, default='q')} was not kept", "bad_value")

    def flat(name: str) -> npt.NDArray[Any]:
        values: npt.NDArray[Any] = table[name].combine_chunks().flatten().to_numpy()
        return values

    starts = table["residual"].combine_chunks().offsets.to_numpy()
    q = np.stack([flat(name) for name in joints], 1)
    names = tuple(name.removeprefix(_JOINT) for name in joints)
    return Batch(q, starts, flat("residual"), flat("branch"), flat("free"), table["status"].to_numpy(), names)
