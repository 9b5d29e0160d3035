"""The blocks of `groebot.blocks` on Ray, as an alternative to `groebot.dask.solve_parquet`. `pip install groebot[parquet] ray`."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pyarrow as arrow
import pyarrow.parquet as parquet
import ray

import groebot
from groebot.blocks import Block, Work, run
from groebot.parquet import Solve, batches


def write(block: Block, work: Work) -> bool:
    return block.write(work)


def on_ray(work: Work, left: Sequence[Block]) -> Iterator[bool]:
    # Ray repeats a task whose worker was killed. Its file is complete, or does not exist.
    task = ray.remote(max_retries=3)(write)
    shared = ray.put(work)
    running = [task.remote(block, shared) for block in left]
    while running:
        done, running = ray.wait(running)
        yield from ray.get(done)


ur5 = groebot.Solver.named("ur5")
with tempfile.TemporaryDirectory() as place:
    folder = Path(place)
    poses = ur5.forward(np.random.default_rng(1).uniform(-3, 3, (100_000, 6)))
    numbers = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9)], axis=1)
    parquet.write_table(arrow.table(dict(zip(ur5.inputs, numbers.T.copy()))), folder / "poses.parquet")

    work = Solve.of(ur5, folder / "poses.parquet")
    ray.init(num_cpus=2, include_dashboard=False)
    done = run(work, folder / "ray", block=10_000, each=lambda left: on_ray(work, left))
    print(done.written, "blocks,", sum(len(batch.q) for _, batch in batches(folder / "ray")), "solutions")
    again = run(work, folder / "ray", block=10_000, each=lambda left: on_ray(work, left))
    here = run(work, folder / "here", block=10_000)
    assert again.written == 0
    assert all(one.read_bytes() == other.read_bytes() for one, other in zip(done.files, here.files))
    print("the same as here, to the last byte")
