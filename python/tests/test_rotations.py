"""`tolerance=`: one rule for matrices and quaternions. scipy's projection is the witness."""

import numpy as np
import pytest
from witness import UR5_DH, dh_forward

from groebot import BadValueError, Solver, Status

Rotation = pytest.importorskip("scipy.spatial.transform").Rotation
Q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.fixture(scope="module")
def pose():
    return dh_forward(UR5_DH, Q[None])[0]


def nearest(pose):
    """The pose with the nearest rotation, by a singular value decomposition."""
    u, _, v = np.linalg.svd(pose[:3, :3])
    whole = pose.copy()
    whole[:3, :3] = u @ v
    return whole


def spoiled(pose, size):
    off = pose.copy()
    off[:3, :3] += size * np.array([[1.0, -0.4, 0.2], [0.3, -0.8, 0.5], [-0.6, 0.1, 0.7]])
    return off


def as_row(pose, length=1.0):
    return np.concatenate([pose[:3, 3], length * Rotation.from_matrix(pose[:3, :3]).as_quat()])


def test_single_precision_is_accepted_as_such_and_as_doubles(ur5, pose):
    rounded = pose.astype(np.float32)
    for form in (rounded, rounded.astype(float), as_row(pose).astype(np.float32), as_row(pose).astype(np.float32).astype(float)):
        found = ur5.solve(form, as_array=True)
        assert found.shape == (8, 6) and np.abs(found - Q).max(1).min() < 1e-5
    half = ur5.solve(pose.astype(np.float16), as_array=True)
    assert np.abs(half - Q).max(1).min() < 0.02
    with pytest.raises(BadValueError, match="tolerance"):
        ur5.solve(pose.astype(np.float16).astype(float))


@pytest.mark.parametrize("size", [1e-9, 1e-7, 3e-6, 1e-4, 1e-2, 3e-2])
def test_a_rotation_within_the_tolerance_is_the_nearest_one(ur5, pose, size):
    off = spoiled(pose, size)
    found = ur5.solve(off, tolerance=0.1, as_array=True)
    assert np.abs(dh_forward(UR5_DH, found) - nearest(off)).max() < 1e-9
    assert np.array_equal(ur5.solve_batch(off[None], tolerance=0.1).q, found)
    near = ur5.nearest(off, Q, tolerance=0.1).q
    assert np.allclose(near, found[np.linalg.norm(found - Q, axis=1).argmin()], atol=1e-9)
    assert np.allclose(ur5.solve_path(off[None], Q, tolerance=0.1).q[0], near)
    assert ur5.closest(off, tolerance=0.1).reachable
    assert np.allclose(ur5.placed(base=off, tolerance=0.1).base, nearest(off), atol=1e-12)


def test_exact_rotations_are_not_changed(ur5, pose):
    wanted = ur5.solve(pose, as_array=True)
    assert np.array_equal(ur5.solve(pose, tolerance=0.0, as_array=True), wanted)
    assert np.array_equal(ur5.solve(pose, tolerance=0.1, as_array=True), wanted)


@pytest.mark.parametrize("form", ["matrix", "quaternion"])
def test_one_rule_for_matrices_and_quaternions(ur5, pose, form):
    make = {"matrix": lambda size: spoiled(pose, size), "quaternion": lambda size: as_row(pose, 1 + 1.6 * size)}[form]
    assert len(ur5.solve(make(4e-6))) == 8
    with pytest.raises(BadValueError, match=r"off by 1.6e-4, more than the tolerance 1e-5; `tolerance=1.\de-4` replaces it by the nearest") as raised:
        ur5.solve(make(1e-4))
    value = float(str(raised.value).split("`tolerance=")[1].split("`")[0])
    assert len(ur5.solve(make(1e-4), tolerance=value)) == 8
    batch = ur5.solve_batch(np.stack([make(0.0), make(1e-4)]))
    assert batch.status.tolist() == [Status.SOLVED, Status.NOT_ROTATION]
    with pytest.raises(BadValueError, match=r"row 1 .*`tolerance=1.\de-4`"):
        ur5.solve_batch(np.stack([make(0.0), make(1e-4)]), strict=True)
    with pytest.raises(BadValueError, match="at most 0.1"):
        ur5.solve(make(0.5), tolerance=0.1)
    with pytest.raises(BadValueError, match="tolerance 1e-7"):
        ur5.solve(make(4e-6), tolerance=1e-7)


@pytest.mark.parametrize("tolerance", [-1e-9, 0.2, np.nan, np.inf])
def test_other_tolerances_are_refused(ur5, pose, tolerance):
    for call in (ur5.solve, lambda target, **option: ur5.solve_batch(target[None], **option), lambda target, **option: ur5.placed(base=target, **option)):
        with pytest.raises(BadValueError, match="give 0 to 0.1"):
            call(pose, tolerance=tolerance)


def test_a_base_that_is_off_names_the_tolerance(ur5, pose):
    with pytest.raises(BadValueError, match=r"`base` has a rotation that is off by .*`tolerance="):
        ur5.placed(base=spoiled(pose, 1e-3))
    assert np.abs(ur5.placed(base=as_row(pose)).base - pose).max() < 1e-12


def test_redundant_arms_take_it_too(panda):
    q = np.array([0, -0.785398, 0, -2.356194, 0, 1.570796, 0.785398])
    off = spoiled(panda.forward(q), 1e-4)
    with pytest.raises(BadValueError, match="tolerance"):
        panda.any_within(off)
    whole = nearest(off)
    for found in (panda.any_within(off, tolerance=1e-3).q, panda.best(off, tolerance=1e-3).q, panda.nearest(off, q, tolerance=1e-3).q):
        assert np.abs(panda.forward(found) - whole).max() < 1e-8
    assert len(panda.arcs(off, tolerance=1e-3)) == len(panda.arcs(whole))
    assert (panda.any_within_batch(off[None], tolerance=1e-3).status == Status.SOLVED).all()
    assert (panda.best_batch(off[None], tolerance=1e-3).status == Status.SOLVED).all()
    assert (panda.any_within_batch(off[None]).status == Status.NOT_ROTATION).all()


@pytest.mark.parametrize("many", [False, True])
def test_pairs_of_a_position_and_a_rotation(ur5, pose, random, many):
    poses = dh_forward(UR5_DH, random.uniform(-3, 3, (5, 6))) if many else pose
    place, turn = poses[..., :3, 3], poses[..., :3, :3]
    solve = (lambda target: ur5.solve_batch(target).q) if many else (lambda target: ur5.solve(target, as_array=True))
    wanted = solve(poses)
    quaternion = Rotation.from_matrix(turn).as_quat()
    for pair in ((place, turn), (place.tolist(), turn.tolist()), (place, quaternion), (place, Rotation.from_matrix(turn))):
        assert np.allclose(solve(pair), wanted, atol=1e-9)
    assert np.allclose(solve((place.astype(np.float32), turn.astype(np.float32))), wanted, atol=1e-4)
    base = ur5.placed(base=(pose[:3, 3], pose[:3, :3])).base
    assert np.array_equal(base, pose)


def test_pairs_that_do_not_fit_are_refused(ur5, pose):
    with pytest.raises(BadValueError, match=r"positions \(2, 3\) do not fit to rotations \(3, 3, 3\)"):
        ur5.solve_batch((np.zeros((2, 3)), np.tile(np.eye(3), (3, 1, 1))))
    with pytest.raises(BadValueError, match="off by"):
        ur5.solve((pose[:3, 3], 1.01 * pose[:3, :3]))
