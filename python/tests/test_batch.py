"""Many targets: rows equal those of single targets, for all layouts, types and numbers of threads."""

import multiprocessing
import threading

import numpy as np
import pytest
from witness import DERIVATIONS, UR5_DH, dh_forward

from groebot import BadValueError, Solver, Status


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.fixture
def targets(random):
    return dh_forward(UR5_DH, random.uniform(-3, 3, (3000, 6)))


def test_each_row_is_what_solve_finds(ur5, targets):
    batch = ur5.solve_batch(targets)
    assert len(batch) == 3000 and batch.starts[-1] == len(batch.q)
    assert (batch.status == Status.SOLVED).all()
    reached = dh_forward(UR5_DH, batch.q)
    assert np.abs(reached - targets[batch.row]).max() < 1e-9
    for row in range(0, 3000, 97):
        assert np.array_equal(batch[row], [solution.q for solution in ur5.solve(targets[row])])


def test_threads_do_not_matter(ur5, targets):
    one = ur5.solve_batch(targets, threads=1)
    for threads in (2, 3, 7):
        other = ur5.solve_batch(targets, threads=threads)
        assert np.array_equal(one.q, other.q) and np.array_equal(one.starts, other.starts)


def test_padded(ur5, targets):
    ragged, padded = ur5.solve_batch(targets), ur5.solve_batch(targets, layout="padded")
    assert padded.q.shape == (3000, padded.counts.max(), 6)
    for row in (0, 5, 2999):
        assert np.array_equal(padded.q[row, : padded.counts[row]], ragged[row])
        assert np.isnan(padded.q[row, padded.counts[row] :]).all()
    assert (padded.branch[np.isnan(padded.residual)] == -1).all()


def test_out_takes_the_joint_values(ur5, targets):
    out = np.empty((3000 * 8, 6))
    batch = ur5.solve_batch(targets, out=out)
    assert np.shares_memory(batch.q, out)
    assert np.array_equal(batch.q, ur5.solve_batch(targets).q)
    with pytest.raises(BadValueError, match="too few rows"):
        ur5.solve_batch(targets, out=np.empty((10, 6)))
    with pytest.raises(BadValueError, match="float64"):
        ur5.solve_batch(targets, out=np.empty((10, 6), np.float32))


def test_single_precision(ur5, targets):
    batch = ur5.solve_batch(targets.astype(np.float32), dtype=np.float32)
    assert batch.q.dtype == np.float32
    solved = batch.status == Status.SOLVED
    assert solved.mean() > 0.99
    reached = dh_forward(UR5_DH, batch.q)
    assert np.abs(reached - targets[batch.row]).max() < 1e-5


def test_rows_that_are_no_targets_are_reported_and_the_others_solved(ur5, targets):
    rows = targets[:8].copy()
    rows[1, 0, 3] = np.nan
    rows[2, :3, :3] *= 1.1
    rows[3, :3, 3] = 9.0
    rows[4, 3] = 0.0
    rows[5, :3, :3] *= -1.0
    rows[6, 2, 2] = np.inf
    batch = ur5.solve_batch(rows)
    wanted = [0, Status.NOT_FINITE, Status.NOT_ROTATION, Status.UNREACHABLE, Status.NOT_ROTATION, Status.NOT_ROTATION, Status.NOT_FINITE, 0]
    assert batch.status.tolist() == wanted
    assert np.array_equal(batch[0], ur5.solve_batch(targets[:1]).q) and len(batch[1]) == 0
    with pytest.raises(BadValueError, match=r"row 1 .*\[1, 2, 4, 5, 6\]"):
        ur5.solve_batch(rows, strict=True)


def test_quaternions(ur5, targets):
    Rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    quaternions = Rotation.from_matrix(targets[:, :3, :3]).as_quat()
    batch = ur5.solve_batch(np.concatenate([targets[:, :3, 3], quaternions], 1))
    assert np.abs(dh_forward(UR5_DH, batch.q) - targets[batch.row]).max() < 1e-9
    batch = ur5.solve_batch(np.concatenate([targets[:, :3, 3], 1.01 * quaternions], 1))
    assert (batch.status == Status.NOT_ROTATION).all()


def test_limits_and_near(ur5, random):
    q = random.uniform(-3, 3, (500, 6))
    targets = dh_forward(UR5_DH, q)
    batch = ur5.solve_batch(targets, near=q + 2 * np.pi)
    assert (batch.counts == 1).all() and np.abs(batch.q - q - 2 * np.pi).max() < 1e-6
    limits = np.tile([-1.0, 1.0], (6, 1))
    batch = ur5.solve_batch(targets, limits=limits)
    everything = ur5.solve_batch(targets)
    within = (np.abs(everything.q) <= 1.0).all(1)
    assert np.array_equal(batch.q, everything.q[within])
    assert (batch.status[batch.counts == 0] == Status.BEYOND_LIMITS).all()


def test_singular_rows_have_more_solutions_than_ordinary_ones(ur5):
    q = np.tile([0.3, -1.0, 1.2, 0.4, 0.0, 0.2], (600, 1))
    q[:, 0] = np.linspace(-3, 3, 600)
    targets = dh_forward(UR5_DH, q)
    batch = ur5.solve_batch(targets)
    assert batch.free.any() and np.abs(dh_forward(UR5_DH, batch.q) - targets[batch.row]).max() < 1e-9
    limited = ur5.solve_batch(targets[:50], limits=np.tile([-np.pi, np.pi], (6, 1)))
    assert len(limited.q) > 0


@pytest.mark.parametrize(("name", "wrist", "free"), [("ur5", 0.0, 5), ("puma", np.pi / 2, 3), ("puma560", 0.0, 3), ("irb120", np.pi / 2, 3)])
def test_members_that_are_moved_within_limits_along_self_motions_stay_free(name, wrist, free):
    printed = Solver.named(name)
    program = Solver.from_json((DERIVATIONS / name / "5_program.json").read_text().replace(f'"{name}"', '"other"', 1))
    target = printed.forward([0.3, -1.0, 1.2, 0.4, wrist, 0.2])
    (member, *_) = (solution for solution in printed.solve(target) if solution.free)
    limits = np.tile([-np.pi, np.pi], (6, 1))
    limits[free] = member.q[free] + [1.0, 1.5]
    kept = printed.solve(target, limits=limits)
    moved = [solution for solution in kept if solution.branch == member.branch]
    assert [solution.free for solution in moved] == [(free,)]
    # Definition of a free joint: it can move while the tip is at rest.
    *_, still = np.linalg.svd(printed.jacobian(moved[0].q))[2]
    assert abs(still[free]) > 0.1 and np.abs(printed.jacobian(moved[0].q) @ still).max() < 1e-9
    assert np.abs(printed.forward(moved[0].q) - target).max() < 1e-9
    for solver in (printed, program):
        batch = solver.solve_batch(target[None], limits=limits)
        assert np.array_equal(batch.q, [solution.q for solution in kept])
        assert batch.free.tolist() == [sum(1 << joint for joint in solution.free) for solution in kept]
        assert [solution.free for solution in solver.solve(target, limits=limits)] == [solution.free for solution in kept]


def test_no_rows_are_a_batch_as_well(ur5):
    batch = ur5.solve_batch(np.empty((0, 4, 4)))
    assert len(batch) == 0 and batch.q.shape == (0, 6) and batch.starts.tolist() == [0]
    assert ur5.solve_batch(np.empty((0, 4, 4)), layout="padded").q.shape == (0, 0, 6)


def test_several_threads_of_python_share_a_solver(ur5, targets):
    wanted, found = ur5.solve_batch(targets).q, []
    workers = [threading.Thread(target=lambda: found.append(ur5.solve_batch(targets).q)) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert len(found) == 4 and all(np.array_equal(q, wanted) for q in found)


def _solved(work):
    solver, targets = work
    return solver.solve_batch(targets).q


def test_a_forked_process_solves(ur5, targets):
    wanted = ur5.solve_batch(targets, threads=2).q
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for q in pool.map(_solved, [(ur5, targets)] * 2):
            assert np.array_equal(q, wanted)
