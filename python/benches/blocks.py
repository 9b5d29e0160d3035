"""Overhead of Dask compared with the blocks themselves, and the time of each part of a block of a million poses of a UR5.

    pip install dist/groebot-*.whl[dask]
    python python/benches/blocks.py [rounds] [blocks] > benches/record/DATE-blocks.csv

The workers measure the time of each `Block.write`. The overhead is the rest of a run's time, because the single worker does nothing else.
"""

from __future__ import annotations

import csv
import shutil
import sys
import tempfile
import time
from collections import deque
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pyarrow as arrow
import pyarrow.parquet as parquet
from distributed import Client, LocalCluster

import groebot
from groebot import blocks, dask
from groebot.parquet import Solve

BLOCK = 1_000_000


def targets(path: Path, rows: int) -> Path:
    ur5 = groebot.Solver.named("ur5")
    poses = ur5.forward(np.random.default_rng(1).uniform(-3, 3, (rows, 6)))
    numbers = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9)], 1)
    parquet.write_table(arrow.table(dict(zip(ur5.inputs, numbers.T.copy()))), path, compression="none", use_dictionary=False)
    return path


def timed(log: str, block: blocks.Block, work: blocks.Work) -> bool:
    clock, processor = time.perf_counter(), time.process_time()
    is_written = block.write(work)
    with open(log, "a") as file:
        file.write(f"{time.perf_counter() - clock} {time.process_time() - processor}\n")
    return is_written


def took(run: Callable[[], object]) -> float:
    begun = time.perf_counter()
    run()
    return time.perf_counter() - begun


def main(rounds: int = 3, number: int = 4) -> None:
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["round", "run", "seconds", "of_them_in_blocks", "overhead_percent", "processor_seconds_in_blocks"])
    with tempfile.TemporaryDirectory() as place, LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        work = Solve.of(groebot.Solver.named("ur5"), targets(Path(place, "targets.parquet"), number * BLOCK))
        out, log = Path(place, "out"), Path(place, "log")
        dask._write = partial(timed, str(log))
        for turn in range(rounds):
            here = lambda: blocks.run(work, out, BLOCK, lambda left: (timed(str(log), one, work) for one in left))
            there = lambda: dask.run(client, work, out, BLOCK)
            for name, run in (("one process", here), ("Dask, one worker", there)):
                shutil.rmtree(out, ignore_errors=True)
                log.write_text("")
                seconds = took(run)
                inside, processor = np.loadtxt(log, ndmin=2).sum(0)
                table.writerow([turn, name, f"{seconds:.3f}", f"{inside:.3f}", f"{100 * (seconds / inside - 1):.2f}", f"{processor:.3f}"])
                sys.stdout.flush()
            read = took(lambda: work.targets.read(0, BLOCK))
            solved = took(lambda: deque(work.solved(0, BLOCK), maxlen=0))
            made = took(lambda: deque(work.tables(0, BLOCK), maxlen=0))
            for name, seconds in (("a block: reads", read), ("a block: reads and solves", solved), ("a block: reads, solves, makes tables", made)):
                table.writerow([turn, name, f"{seconds:.3f}", "", "", ""])


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
