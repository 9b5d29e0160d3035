"""Two worker processes. They or the driver are killed, and the files are bitwise identical."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from tools import need
from witness import UR5_DH, dh_forward

need("dask", "distributed", "pyarrow")

import pyarrow as arrow
import pyarrow.parquet as parquet
from distributed import Client, LocalCluster

import groebot.dask
from groebot import BadValueError, Solver, blocks, reach_map
from groebot.dask import run, solve_parquet
from groebot.parquet import Solve, batches

ROWS, BLOCK = 40_000, 1_000
BLOCKS = ROWS // BLOCK


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.fixture(scope="module")
def q():
    return np.random.default_rng(9).uniform(-3, 3, (ROWS, 6))


@pytest.fixture(scope="module")
def source(tmp_path_factory, ur5, q):
    poses = dh_forward(UR5_DH, q)
    numbers = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9)], 1)
    path = tmp_path_factory.mktemp("targets") / "targets.parquet"
    parquet.write_table(arrow.table(dict(zip(ur5.inputs, numbers.T.copy()))), path, row_group_size=15_000)
    return path


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, ur5, source):
    """The files of one process without Dask."""
    out = tmp_path_factory.mktemp("undisturbed")
    blocks.run(Solve.of(ur5, source), out, BLOCK)
    return contents(out)


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


def contents(folder):
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def count(out):
    return len(list(out.glob("block-*.parquet")))


def wait_for(out, blocks):
    until = time.monotonic() + 300
    while count(out) < blocks:
        assert time.monotonic() < until, "no block is done"
        time.sleep(0.002)


def test_two_workers_write_what_one_process_does(tmp_path, client, ur5, q, source, undisturbed):
    done = solve_parquet(client, ur5, source, tmp_path / "out", BLOCK)
    assert (done.written, done.found) == (BLOCKS, 0) and len(undisturbed) == BLOCKS
    assert contents(tmp_path / "out") == undisturbed
    for start, batch in batches(tmp_path / "out"):
        own = q[start : start + len(batch)][batch.row]
        apart = np.abs((batch.q - own + np.pi) % (2 * np.pi) - np.pi).max(1)
        assert np.minimum.reduceat(apart, batch.starts[:-1]).max() < 1e-5
    again = solve_parquet(client, ur5, source, tmp_path / "out", BLOCK)
    assert (again.written, again.found) == (0, BLOCKS)


def test_a_worker_is_killed(tmp_path, client, ur5, source, undisturbed):
    out, killed = tmp_path / "out", []

    def kill():
        wait_for(out, 4)
        killed.append(next(iter(workers.values())))
        os.kill(killed[0], signal.SIGKILL)

    workers = client.run(os.getpid)
    assert len(set(workers.values())) == 2
    killer = threading.Thread(target=kill)
    killer.start()
    done = solve_parquet(client, ur5, source, out, BLOCK)
    killer.join()
    assert len(killed) == 1 and len(done.files) == BLOCKS
    assert contents(out) == undisturbed
    # Dask may start a worker in its place; on a busy machine it gives up. The other worker is enough.
    assert killed[0] not in client.run(os.getpid).values()


def test_the_driver_is_killed_and_runs_again(tmp_path, source, undisturbed):
    out = tmp_path / "out"
    command = [sys.executable, str(Path(__file__).with_name("killed.py")), str(source), str(out), str(BLOCK)]
    driver = subprocess.Popen(command, cwd=tmp_path)
    wait_for(out, 4)
    driver.send_signal(signal.SIGKILL)
    assert driver.wait() == -signal.SIGKILL
    before = count(out)
    assert 4 <= before < BLOCKS
    # The workers may finish a block before they detect that the driver has ended.
    again = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True, timeout=600)
    written, found = map(int, again.stdout.split())
    assert found >= before and written + found == BLOCKS and written > 0
    assert {name: data for name, data in contents(out).items() if not name.startswith(".")} == undisturbed


def test_an_error_of_a_block_comes_to_the_driver(tmp_path, client, ur5, source):
    broken = tmp_path / "broken.parquet"
    table = parquet.read_table(source).slice(0, 10_000)
    nulls = arrow.array([None if row == 7_000 else 0.5 for row in range(10_000)])
    parquet.write_table(table.set_column(0, "px", nulls), broken, row_group_size=1_000)
    with pytest.raises(BadValueError, match="px.*null"):
        solve_parquet(client, ur5, broken, tmp_path / "out", 1_000)
    assert not list((tmp_path / "out").glob("block-000000007000-*"))


def test_work_of_ones_own(tmp_path, client):
    run(client, Squares(), tmp_path / "out", 100)
    read = np.concatenate([parquet.read_table(path)["square"].to_numpy() for _, path in blocks.finished(tmp_path / "out")])
    assert np.array_equal(read, np.arange(1_050) ** 2)


class Squares(blocks.Work):
    rows = 1_050

    def parameters(self):
        return {"work": "squares"}

    def tables(self, start, stop):
        yield arrow.table({"square": np.arange(start, stop) ** 2})


def test_a_map_on_two_workers_is_that_of_one_process(tmp_path, client, ur5):
    grid = {"x": (-0.8, 0.8, 6), "y": 0.3, "z": (0.0, 0.6, 4)}
    here = reach_map(ur5, grid, 200, seed=1)
    there = groebot.dask.reach_map(client, ur5, grid, tmp_path / "map", 200, block=5, seed=1)
    assert count(tmp_path / "map") == 5
    np.testing.assert_array_equal(there.answers, here.answers)
    np.testing.assert_array_equal(there.reached, here.reached)
