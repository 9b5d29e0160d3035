"""Base and tool at run time: products of matrices are the witness."""

import numpy as np
import pytest
from witness import UR5_DH, dh_forward

import groebot
from groebot import BadValueError, GroebotError, Solver


def pose(random):
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * np.sign(np.linalg.det(rotation))
    matrix[:3, 3] = random.uniform(-1, 1, 3)
    return matrix


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


def test_solutions_reach_the_target_of_the_tool_in_the_world(ur5, random):
    base, tool = pose(random), pose(random)
    placed = ur5.placed(base=base, tool=tool)
    assert isinstance(placed, groebot.PlacedSolver)
    assert np.array_equal(placed.base, base) and np.array_equal(placed.tool, tool)
    q = random.uniform(-3, 3, (50, 6))
    targets = base @ dh_forward(UR5_DH, q) @ tool
    assert np.abs(placed.forward(q) - targets).max() < 1e-12
    batch = placed.solve_batch(targets)
    assert (np.diff(batch.starts) >= 1).all()
    for row, target in enumerate(targets):
        solutions = placed.solve(target)
        assert np.array_equal(np.stack([solution.q for solution in solutions]), batch[row])
        assert np.abs(base @ dh_forward(UR5_DH, batch[row]) @ tool - target).max() < 1e-11
        assert np.allclose(placed.nearest(target, q[row]).q, q[row], atol=1e-6)


def test_base_and_tool_are_optional(ur5, random):
    q = random.uniform(-3, 3, (5, 6))
    base, tool = pose(random), pose(random)
    assert np.abs(ur5.placed(base=base).forward(q) - base @ dh_forward(UR5_DH, q)).max() < 1e-12
    assert np.abs(ur5.placed(tool=tool).forward(q) - dh_forward(UR5_DH, q) @ tool).max() < 1e-12
    target = ur5.forward(q[0])
    wanted = [solution.q for solution in ur5.solve(target)]
    assert np.array_equal([solution.q for solution in ur5.placed().solve(target)], wanted)


def test_a_path_of_the_tool_is_followed(ur5):
    base, tool = np.eye(4), np.eye(4)
    base[:3, 3], tool[2, 3] = (1.0, 2.0, 0.5), 0.1
    placed = ur5.placed(base=base, tool=tool)
    q = np.linspace([0.1, -1.2, 1.4, -0.3, 0.8, 0.5], [0.3, -1.0, 1.2, -0.2, 0.9, 0.4], 30)
    path = placed.solve_path(placed.forward(q), q[0])
    assert np.abs(path.q - q).max() < 1e-6


@pytest.mark.parametrize(
    ("matrix", "words"),
    [
        (np.eye(3), "give a matrix (4, 4)"),
        (np.diag([2.0, 1.0, 1.0, 1.0]), "the rotation of `base` is off by"),
        (np.diag([-1.0, 1.0, 1.0, 1.0]), "right-handed"),
        (np.diag([1.0, 1.0, 1.0, 2.0]), "the last row of `base`"),
        (np.full((4, 4), np.nan), "finite"),
    ],
)
def test_what_is_no_pose_is_refused(ur5, matrix, words):
    with pytest.raises(BadValueError, match=r".*") as caught:
        ur5.placed(base=matrix)
    assert words in str(caught.value)


def test_a_tool_that_a_ray_does_not_determine_is_refused():
    tool = np.eye(4)
    tool[0, 3] = 0.1
    with pytest.raises(GroebotError) as caught:
        Solver.named("nao_left_arm").placed(tool=tool)
    assert caught.value.kind == "unsupported"
