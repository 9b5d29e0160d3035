"""Blocks: their content equals the results of `solve_batch`. A file is complete or absent, and is not computed twice."""

import os
import socket
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from tools import need
from witness import KUKA_URDF, UR5_DH, dh_forward

need("pyarrow")

import pyarrow as arrow
import pyarrow.parquet as parquet

import groebot
from groebot import BadValueError, Solver, Status, blocks
from groebot.parquet import Solve, batches

ROWS = 2_500


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.fixture(scope="module")
def poses():
    poses = dh_forward(UR5_DH, np.random.default_rng(5).uniform(-3, 3, (ROWS, 6)))
    poses[3, 0, 3] = np.nan
    poses[4, :3, 3] = 9.0
    return poses


def rows_of(poses):
    return np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9)], 1)


def in_columns(path, solver, numbers, **options):
    parquet.write_table(arrow.table(dict(zip(solver.inputs, numbers.T.copy()))), path, **options)
    return path


def in_lists(path, numbers):
    values = arrow.FixedSizeListArray.from_arrays(arrow.array(numbers.reshape(-1)), numbers.reshape(len(numbers), -1).shape[1])
    parquet.write_table(arrow.table({"pose": values, "name": ["x"] * len(numbers)}), path, row_group_size=700)
    return path


@pytest.fixture
def source(tmp_path, ur5, poses):
    return in_columns(tmp_path / "targets.parquet", ur5, rows_of(poses), row_group_size=300)


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_what_is_written_is_what_solve_batch_finds(tmp_path, ur5, poses, source, monkeypatch):
    monkeypatch.setattr("groebot.parquet.PIECE", 300)
    done = blocks.run(Solve.of(ur5, source), tmp_path / "out", block=1_000)
    assert (done.written, done.found) == (3, 0) and [path.name for path in done.files] == sorted(os.listdir(tmp_path / "out"))
    wanted, seen = ur5.solve_batch(poses), 0
    for start, batch in batches(tmp_path / "out"):
        assert start == seen and batch.joints == tuple(ur5.joints)
        for row in range(len(batch)):
            assert np.array_equal(batch[row], wanted[start + row])
        solutions = slice(wanted.starts[start], wanted.starts[start + len(batch)])
        assert np.array_equal(batch.branch, wanted.branch[solutions]) and np.array_equal(batch.free, wanted.free[solutions])
        assert np.array_equal(batch.residual, wanted.residual[solutions])
        assert np.array_equal(batch.status, wanted.status[start : start + len(batch)])
        seen += len(batch)
    assert seen == ROWS
    first = next(batches(tmp_path / "out"))[1]
    assert first.status[3] == Status.NOT_FINITE and first.status[4] == Status.UNREACHABLE
    reached = dh_forward(UR5_DH, first.q)
    assert np.abs(reached - poses[first.row]).max() < 1e-9


def test_other_readers_see_one_row_a_target(tmp_path, ur5, poses, source):
    (file,) = blocks.run(Solve.of(ur5, source, keep=["count", "status", "q"]), tmp_path / "out").files
    table = parquet.read_table(file).to_pylist()
    assert len(table) == ROWS and table[3]["count"] == 0 and table[3]["status"] == 2
    assert list(table[0]) == ["count", "status", *(f"q_{joint}" for joint in ur5.joints)]
    q = [[table[0][f"q_{joint}"][k] for joint in ur5.joints] for k in range(table[0]["count"])]
    assert np.array_equal(q, [solution.q for solution in ur5.solve(poses[0])])
    with pytest.raises(BadValueError, match="not kept"):
        list(batches(tmp_path / "out"))


def test_targets_in_columns_in_lists_and_in_several_files_are_the_same(tmp_path, ur5, poses, source):
    folder = tmp_path / "folder"
    folder.mkdir()
    in_columns(folder / "a.parquet", ur5, rows_of(poses[:777]))
    in_columns(folder / "b.parquet", ur5, rows_of(poses[777:]))
    sources = [
        (source, None),
        (folder, None),
        (folder / "*.parquet", None),
        (in_lists(tmp_path / "twelve.parquet", rows_of(poses)), ["pose"]),
        (in_lists(tmp_path / "sixteen.parquet", poses), ["pose"]),
    ]
    for number, (place, columns) in enumerate(sources):
        out = tmp_path / f"out{number}"
        blocks.run(Solve.of(ur5, place, columns), out, block=1_000)
        for (_, one), (_, other) in zip(batches(tmp_path / "out0"), batches(out), strict=True):
            assert np.array_equal(one.q, other.q) and np.array_equal(one.status, other.status)


def test_options_are_those_of_solve_batch(tmp_path, ur5, poses, source):
    limits = np.tile([-2.0, 2.0], (6, 1))
    blocks.run(Solve.of(ur5, source, limits=limits, near=np.zeros(6), dtype="float32", threads=2), tmp_path / "out")
    ((_, batch),) = batches(tmp_path / "out")
    wanted = ur5.solve_batch(poses, limits=limits, near=np.zeros(6), dtype="float32")
    assert batch.q.dtype == np.float32 and np.array_equal(batch.q, wanted.q) and np.array_equal(batch.status, wanted.status)
    named = dict(zip(ur5.joints, limits))
    blocks.run(Solve.of(ur5, source, limits=named, near=np.zeros(6), dtype="float32"), tmp_path / "named")
    assert np.array_equal(next(batches(tmp_path / "named"))[1].q, wanted.q)
    with pytest.raises(BadValueError, match="there is no joint `elbow`"):
        Solve.of(ur5, source, limits={"elbow": (0.0, 1.0)})


def test_given_joints_are_after_the_inputs(tmp_path, random):
    robot = groebot.Robot.from_urdf(KUKA_URDF)
    solver = groebot.derive(robot, task="position", given=robot.joints[3:])
    q = random.uniform(-1, 1, (50, 6))
    numbers = np.concatenate([solver.forward(q), q[:, 3:]], 1)
    in_columns(tmp_path / "in.parquet", solver, numbers)
    blocks.run(Solve.of(solver, tmp_path / "in.parquet"), tmp_path / "out", block=20)
    for start, batch in batches(tmp_path / "out"):
        assert all(np.abs(batch[row] - q[start + row]).max(1).min() < 1e-6 for row in range(len(batch)))
    (_, solutions) = next(batches(tmp_path / "out"))
    blocks.run(Solve.of(solver, tmp_path / "in.parquet", given=q[0, 3:]), tmp_path / "all", block=1)
    assert np.array_equal(next(batches(tmp_path / "all"))[1].q, solutions[0])


def test_what_is_done_is_not_done_again_and_what_is_broken_is(tmp_path, ur5, source):
    work, out = Solve.of(ur5, source), tmp_path / "out"
    blocks.run(work, out, block=500)
    whole, times = contents(out), {path: path.stat().st_mtime_ns for path in out.iterdir()}
    again = blocks.run(Solve.of(ur5, source, threads=2), out, block=500)
    assert (again.written, again.found) == (0, 5) and times == {path: path.stat().st_mtime_ns for path in out.iterdir()}
    files = again.files
    files[1].unlink()
    files[2].write_bytes(files[2].read_bytes()[:1000])
    files[3].write_bytes(b"")
    asides = [out / f".{files[1].stem}-{host}-{pid}-0.aside" for host, pid in ((socket.gethostname(), ended_process()), ("else-where", 1))]
    for aside in asides:
        aside.write_bytes(b"half")
    hours = time.time() - 2 * 3600
    os.utime(asides[1], (hours, hours))
    assert blocks.run(work, out, block=500).written == 3
    assert contents(out) == whole


def ended_process():
    """The number of a process that has ended."""
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def test_temporary_files_of_other_drivers_are_kept(tmp_path, ur5, source):
    work, out = Solve.of(ur5, source), tmp_path / "out"
    out.mkdir()
    others = [out / f".block-000000000000-000000000500-{host}-{pid}-0.aside" for host, pid in ((socket.gethostname(), os.getpid()), ("elsewhere", 1))]
    for other in others:
        other.write_bytes(b"half")
    blocks.run(work, out, block=500)
    assert all(other.exists() for other in others)


def test_two_drivers_share_a_folder(tmp_path, ur5, source):
    """Both drivers end, and the files are those of one."""
    work, out, results = Solve.of(ur5, source), tmp_path / "out", []
    drivers = [threading.Thread(target=lambda: results.append(blocks.run(work, out, block=250))) for _ in range(3)]
    for driver in drivers:
        driver.start()
    for driver in drivers:
        driver.join()
    assert len(results) == 3 and all(len(done.files) == 10 for done in results)
    blocks.run(work, tmp_path / "alone", block=250)
    assert contents(out) == contents(tmp_path / "alone")


def test_a_flipped_bit_is_found_when_work_continues(tmp_path, ur5, poses):
    """No damaged number and no damaged name is kept: the block is computed again, or refused if its description is damaged. Statistics may stay damaged."""
    few = in_columns(tmp_path / "few.parquet", ur5, rows_of(poses[:100]))
    work, out = Solve.of(ur5, few), tmp_path / "out"
    (file,) = blocks.run(work, out).files
    whole, wanted = file.read_bytes(), parquet.read_table(file)
    again = refused = unread = 0
    for place in np.random.default_rng(3).integers(0, 8 * len(whole), 60):
        damaged = bytearray(whole)
        damaged[place // 8] ^= 1 << place % 8
        file.write_bytes(damaged)
        try:
            written = blocks.run(work, out).written
            again, unread = again + written, unread + 1 - written
            assert parquet.read_table(file).equals(wanted) and (not written or file.read_bytes() == whole)
        except BadValueError:
            refused += 1
            file.unlink()
    assert again + refused + unread == 60 and again > 40


def test_a_block_that_cannot_be_written_leaves_nothing(tmp_path, ur5, source):
    work = Solve.of(ur5, source)
    block = blocks.Block(str(tmp_path / "out"), 0, ROWS)
    os.mkdir(block.folder)
    source.unlink()
    with pytest.raises(FileNotFoundError):
        block.write(work)
    assert os.listdir(block.folder) == []


class Watched(blocks.Work):
    """Records the content of the folder while it is written. It can interrupt the work."""

    def __init__(self, folder, breaks=False):
        self.folder, self.breaks, self.seen = folder, breaks, []

    rows = 10

    def parameters(self):
        return {}

    def tables(self, start, stop):
        for row in range(start, stop):
            self.seen += os.listdir(self.folder)
            if self.breaks and row == 7:
                raise ArithmeticError("row 7")
            yield arrow.table({"row": [row]})


def test_a_block_has_its_name_when_it_is_whole(tmp_path):
    work, block = Watched(tmp_path), blocks.Block(str(tmp_path), 0, 10)
    assert block.write(work) and not block.write(work)
    assert work.seen and all(name.startswith(".block") and name.endswith(".aside") for name in work.seen)
    assert os.listdir(tmp_path) == [block.path.name]
    assert parquet.read_table(block.path)["row"].to_pylist() == list(range(10))


def test_a_block_that_breaks_off_leaves_nothing(tmp_path):
    work, block = Watched(tmp_path, breaks=True), blocks.Block(str(tmp_path), 0, 10)
    with pytest.raises(ArithmeticError):
        block.write(work)
    assert work.seen and os.listdir(tmp_path) == []


def test_blocks_of_other_work_are_kept(tmp_path, ur5, source, poses):
    out = tmp_path / "out"
    blocks.run(Solve.of(ur5, source), out, block=1_000)
    whole = contents(out)
    for work, block in [
        (Solve.of(ur5, source), 900),
        (Solve.of(ur5, source, dtype="float32"), 1_000),
        (Solve.of(Solver.named("irb120"), source), 1_000),
        (Solve.of(ur5, in_columns(source, ur5, rows_of(poses[::-1]))), 1_000),
    ]:
        with pytest.raises(BadValueError, match="other work"):
            blocks.run(work, out, block)
    assert contents(out) == whole


def test_a_missing_block_is_reported(tmp_path, ur5, source):
    done = blocks.run(Solve.of(ur5, source), tmp_path / "out", block=500)
    for number in (4, 1):
        done.files[number].unlink()
        with pytest.raises(BadValueError, match=f"rows from {number * 500}"):
            list(batches(tmp_path / "out"))
    with pytest.raises(BadValueError):
        list(batches(tmp_path))


@pytest.mark.parametrize(
    ("options", "reported"),
    [
        ({"columns": ["px"]}, r"\(4, 4\)"),
        ({"columns": ["elbow"]}, "elbow.*px"),
        ({"keep": ["branches"]}, "branches"),
        ({"keep": []}, "nothing"),
        ({"layout": "padded"}, "layout"),
        ({"strict": True}, "strict"),
        ({"near": np.zeros((3, 6))}, "near"),
        ({"limits": np.zeros((5, 2))}, "limits"),
        ({"dtype": int}, "dtype"),
    ],
)
def test_wrong_words_are_reported_before_anything_is_done(ur5, source, options, reported):
    with pytest.raises(ValueError, match=reported):
        Solve.of(ur5, source, **options)


def test_what_is_no_table_of_targets_is_refused(tmp_path, ur5, source):
    with pytest.raises(BadValueError, match="no parquet file"):
        Solve.of(ur5, tmp_path / "none*.parquet")
    with pytest.raises(BadValueError, match="block of 0"):
        blocks.run(Solve.of(ur5, source), tmp_path / "out", block=0)
    for values, reported in [
        (arrow.array(["a"] * 3), "no real numbers"),
        (arrow.array([[0.0] * 12, [0.0] * 11, [0.0] * 13]), "11 to 13"),
        (arrow.array([[0.0] * 12, None, [0.0] * 12]), "null"),
        (arrow.array([[0.0] * 11 + [None]] * 3), "null"),
    ]:
        parquet.write_table(arrow.table({"pose": values}), tmp_path / "bad.parquet")
        with pytest.raises(BadValueError, match=reported):
            blocks.run(Solve.of(ur5, tmp_path / "bad.parquet", ["pose"]), tmp_path / "out")
