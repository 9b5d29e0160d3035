"""The closest joint values of targets out of reach."""

import numpy as np
import pytest
from witness import UR5_DH, dh_forward

import groebot
from groebot import BadValueError, Solver


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


def far(distance):
    target = np.eye(4)
    target[:3, 3] = distance
    return target


def test_the_error_is_that_of_the_joints(ur5):
    target = far(2.0)
    assert ur5.solve(target) == []
    found = ur5.closest(target)
    assert isinstance(found, groebot.Closest) and not found.reachable and found.is_minimum
    assert 0 < found.agreeing <= found.starts
    (reached,) = dh_forward(UR5_DH, found.q[None])
    assert np.abs(reached - found.reached).max() < 1e-12
    assert found.distance == pytest.approx(np.linalg.norm(reached[:3, 3] - target[:3, 3]))
    assert found.angle == pytest.approx(np.arccos((np.trace(reached[:3, :3]) - 1) / 2))
    assert np.array_equal(ur5.closest(target).q, found.q)


def test_no_random_joints_are_closer(ur5, random):
    target = far(1.5)
    found = ur5.closest(target, length=0.5)

    def error(pose):
        return ((pose[..., :3, 3] - target[:3, 3]) ** 2).sum(-1) + 0.125 * ((pose[..., :3, :3] - target[:3, :3]) ** 2).sum((-1, -2))

    others = error(dh_forward(UR5_DH, random.uniform(-np.pi, np.pi, (20000, 6))))
    assert error(found.reached) <= others.min()


def test_a_reachable_target_has_a_solution(ur5, random):
    for target in dh_forward(UR5_DH, random.uniform(-3, 3, (10, 6))):
        found = ur5.closest(target)
        assert found.reachable and found.distance < 1e-12 and found.angle < 1e-12
        assert any(np.array_equal(found.q, solution.q) for solution in ur5.solve(target))


def test_limits_are_respected_on_request(ur5):
    limits = np.tile([-0.5, 0.5], (6, 1))
    found = ur5.closest(far(2.0), limits=limits)
    assert (found.q >= -0.5).all() and (found.q <= 0.5).all() and not found.reachable


def test_the_error_of_a_placed_solver_is_that_of_the_tool(ur5):
    base, tool = far(1.0), far(0.2)
    placed = ur5.placed(base=base, tool=tool)
    found = placed.closest(far(4.0))
    assert np.abs(placed.forward(found.q) - found.reached).max() < 1e-12
    assert found.distance == pytest.approx(np.linalg.norm(found.reached[:3, 3] - 4.0))


def test_wrong_options_are_refused(ur5):
    for length in (0.0, -1.0, np.nan):
        with pytest.raises(BadValueError):
            ur5.closest(far(2.0), length=length)
    with pytest.raises(BadValueError):
        ur5.closest(far(np.nan))
