"""Many targets on many machines, with Dask (`pip install groebot[dask]`).

All workers must see the files under the same paths. Workers and the driver may be killed at any time. A second run computes the missing blocks, and the files
are bitwise identical.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

from distributed import Client, as_completed

from . import blocks, parquet, reach
from ._groebot import Solver
from ._reach import Grid, Measure, ReachMap


def solve_parquet(
    client: Client,
    solver: Solver,
    source: str | os.PathLike[str],
    out: str | os.PathLike[str],
    block: int = blocks.BLOCK,
    columns: Sequence[str] | None = None,
    keep: Sequence[str] = parquet.KEEP,
    threads: int = 1,
    **options: Any,
) -> blocks.Done:
    """Solves the targets of parquet files into the folder `out`, with `block` targets in each file.

    `source` is a file, a folder or a pattern. `columns` are the columns with the numbers of a target in order, as single columns or one column of lists; by
    default the solver's inputs. `keep` selects the written columns (`groebot.parquet.Solve`). `options` are those of `groebot.parquet.Solve.of`. `threads` is
    the number of threads of one task. `BadValueError` as `groebot.blocks.run` and `Solver.solve_batch`.
    """
    work = parquet.Solve.of(solver, source, columns, keep, threads, **options)
    return run(client, work, out, block)


def reach_map(
    client: Client,
    solver: Solver,
    grid: Grid,
    out: str | os.PathLike[str],
    orientations: int = 100,
    measure: Measure = "count",
    block: int | None = None,
    threads: int = 1,
    **options: Any,
) -> ReachMap:
    """Computes a reach map into the folder `out`, and reads the map.

    Arguments are as for `groebot.reach_map`; `options` are its `limits=`, `given=` and `seed=`. A block has `block` grid points, by default those of about a
    million poses. `threads` is the number of threads of one task. `BadValueError` as `groebot.blocks.run` and `groebot.reach_map`.
    """
    work = reach.Reach.of(solver, grid, orientations, measure, threads=threads, **options)
    run(client, work, out, reach.block(work) if block is None else block)
    return reach.read(out, work)


def run(client: Client, work: blocks.Work, out: str | os.PathLike[str], block: int = blocks.BLOCK) -> blocks.Done:
    """Computes all blocks of a work on the workers of `client`, otherwise as `groebot.blocks.run`."""

    def each(left: Sequence[blocks.Block]) -> Iterator[bool]:
        # A task, not scattered data: if the worker that holds it is killed, Dask computes it again.
        shared = client.submit(_same, work, key=f"groebot-work-{work.key}")
        keys = [f"groebot-block-{work.key}-{one.start}-{one.stop}" for one in left]
        futures = client.map(_write, left, work=shared, key=keys)
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            client.cancel(futures)

    return blocks.run(work, out, block, each)


def _same(work: blocks.Work) -> blocks.Work:
    return work


def _write(block: blocks.Block, work: blocks.Work) -> bool:
    return block.write(work)
