"""Arms with scanned joints: a Panda on a rail. Forward kinematics of its URDF in numpy is the witness."""

import pickle

import numpy as np
import pytest
from witness import PANDA_URDF, urdf_forward

import groebot
from groebot import BadValueError, GroebotError, Status

RAIL = """<link name="floor"/><joint name="rail" type="prismatic"><parent link="floor"/><child link="panda_link0"/>
<origin xyz="0 0.1 0.5" rpy="0.3 0 0.5"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="0.5"/></joint></robot>"""
READY = np.array([0.4, 0.0, -0.8, 0.0, -2.3, 0.0, 1.55, 0.8])


@pytest.fixture(scope="module")
def rail(tmp_path_factory):
    """The URDF of the arm, its solver, and its forward kinematics."""
    path = tmp_path_factory.mktemp("rail") / "rail.urdf"
    path.write_text(PANDA_URDF.read_text().replace("</robot>", RAIL))
    solver = groebot.derive(groebot.Robot.from_urdf(path, tip="panda_hand_tcp"))
    fingers = PANDA_URDF.read_text().count('type="prismatic"')

    def reach(q):
        # The rail is the last joint of the file, after the fingers.
        return urdf_forward(path, np.concatenate([q[1:], np.zeros(fingers), q[:1]]), "panda_hand_tcp")

    return solver, reach


def assert_solves(rail, target, q):
    solver, reach = rail
    assert np.abs(reach(q) - target).max() < 1e-8
    assert (q >= solver.limits[:, 0] - 1e-9).all() and (q <= solver.limits[:, 1] + 1e-9).all()


def test_one_joint_is_scanned(rail, panda):
    solver, reach = rail
    assert solver.is_redundant and len(solver.scanned) == 1 and set(solver.scanned) < set(solver.joints) and len(solver.given) == 2
    assert panda.scanned == [] and groebot.Solver.named("ur5").scanned == []
    assert np.abs(solver.forward(READY) - reach(READY)).max() < 1e-9


def test_solutions_of_the_scan_reach_the_target(rail, random):
    solver, reach = rail
    for q in random.uniform(solver.limits[:, 0], solver.limits[:, 1], (1, 8)):
        target = reach(q)
        within, solutions, best = solver.any_within(target), solver.solve(target), solver.best(target)
        assert within.reason is None and not within.is_unsure and len(solutions) == 1 and solutions.is_unsure
        near = solver.solve(target, q0=q)
        for own in (within.q, solutions[0].q, best.q, near[0].q, solver.nearest(target, q).q):
            assert_solves(rail, target, own)
        assert solutions[0].residual < 1e-9 and (best.arc, np.isnan(best.s)) == (-1, True)
        # The values of the rail that a criterion prefers are samples, too.
        assert np.linalg.norm(near[0].q - q) < 1e-5 and np.linalg.norm(solver.nearest(target, q).q - q) < 1e-5
        assert np.allclose(solver.best(target, "nearest", q0=q).q, q, atol=1e-5)


def test_narrower_limits_and_reasons(rail):
    solver, reach = rail
    target = reach(READY)
    for limits in ({"rail": (0.1, 0.2)}, np.concatenate([[[0.1, 0.2]], solver.limits[1:]])):
        for q in (solver.any_within(target, limits=limits).q, solver.best(target, limits=limits).q, solver.solve(target, limits=limits)[0].q):
            assert_solves(rail, target, q)
            assert 0.1 - 1e-9 <= q[0] <= 0.2 + 1e-9
    far = target.copy()
    far[0, 3] += 4.0
    beyond = solver.any_within(target, limits={"rail": (0.4, 0.4), "panda_joint4": (-0.2, -0.1)})
    assert beyond.q is None and beyond.reason.status == Status.BEYOND_LIMITS and beyond.is_unsure
    within, solutions = solver.any_within(far), solver.solve(far)
    assert within.q is None and within.is_unsure and solutions == [] and solver.best(far) is None and solver.nearest(far, READY) is None
    for reason in (within.reason, solutions.reason):
        assert reason == groebot.Reason(Status.UNREACHABLE, ())
    for wrong in ({"rail": (0.5, -0.5)}, {"rail": (2.0, 3.0)}, {"slide": (0.0, 1.0)}, np.zeros((7, 2))):
        with pytest.raises(BadValueError):
            solver.any_within(target, limits=wrong)
    for wrong in (np.zeros(7), np.full(8, np.nan)):
        with pytest.raises(BadValueError):
            solver.solve(target, q0=wrong)


def test_a_path_moves_the_rail(rail):
    solver, reach = rail
    route = READY + np.linspace(0, 0.5, 4)[:, None] * [0.4, 0.2, 0.1, -0.2, 0.2, 0.1, 0.2, -0.2]
    poses = np.stack([reach(q) for q in route])
    path = solver.solve_path(poses, READY)
    assert path.jumps == [] and path.arcs is None and path.q.shape == (4, 8)
    for pose, q in zip(poses, path.q):
        assert_solves(rail, pose, q)
    assert np.abs(np.diff(path.q, axis=0)).max() <= 0.5 + 1e-9
    held = solver.solve_path(poses[:2], limits={"rail": (0.3, 0.5)})
    assert (held.q[:, 0] >= 0.3 - 1e-9).all() and (held.q[:, 0] <= 0.5 + 1e-9).all()
    poses[1, 0, 3] += 4.0
    with pytest.raises(BadValueError, match="target.*unreachable"):
        solver.solve_path(poses[:2])


def test_the_closest_joint_values_move_the_rail(rail):
    solver, reach = rail
    target = reach(READY)
    found = solver.closest(target)
    assert found.reachable
    assert_solves(rail, target, found.q)
    along = (reach(READY + np.eye(8)[0]) - target)[:3, 3]
    far = target.copy()
    far[:3, 3] += 4.0 * along
    found = solver.closest(far)
    assert not found.reachable and abs(found.q[0] - 1.0) < 1e-9 and found.is_minimum
    assert abs(np.linalg.norm(reach(found.q)[:3, 3] - far[:3, 3]) - found.distance) < 1e-9
    assert np.abs(reach(found.q) - found.reached).max() < 1e-9
    assert abs(solver.closest(far, limits={"rail": (-0.5, 0.25)}).q[0] - 0.25) < 1e-9


def test_a_map_counts_poses_within_limits(rail):
    solver, reach = rail
    made = groebot.reach_map(solver, {"x": (-0.2, 0.4, 2), "y": 0.3, "z": 0.9}, 2, "limits")
    assert made.limited and 0 < made.reached.sum() <= 4 and (made.open == 0).all()
    far = groebot.reach_map(solver, {"x": 4.0, "y": 4.0, "z": 0.9}, 1, "limits")
    assert far.reached.sum() == 0


def test_there_are_no_arcs_and_the_error_names_other_methods(rail):
    solver, reach = rail
    target = reach(READY)
    batches = [solver.any_within_batch, solver.best_batch, solver.solve_batch]
    for call, own in [(solver.arcs, target), (solver.optima, target), *((call, target[None]) for call in batches)]:
        with pytest.raises(GroebotError, match=f"{solver.scanned[0]} is scanned.*`any_within`, `best`, `nearest` or `solve_path`") as raised:
            call(own)
        assert raised.value.kind == "unsupported"


def test_placed_and_pickled_solvers_have_the_same_solutions(rail):
    solver, reach = rail
    target, base, tool = reach(READY), np.eye(4), np.eye(4)
    base[:3, 3], tool[2, 3] = (1.0, 2.0, 0.5), 0.1
    placed, world = solver.placed(base=base, tool=tool), base @ target @ tool
    for q in (placed.any_within(world).q, placed.best(world).q, placed.solve(world, q0=READY)[0].q, placed.nearest(world, READY).q):
        assert_solves(rail, target, q)
    far = world.copy()
    far[:3, 3] += 9.0
    found = placed.closest(far)
    assert np.abs(base @ reach(found.q) @ tool - found.reached).max() < 1e-9
    assert abs(np.linalg.norm(found.reached[:3, 3] - far[:3, 3]) - found.distance) < 1e-9
    again = pickle.loads(pickle.dumps(solver))
    assert np.array_equal(again.any_within(target).q, solver.any_within(target).q)


def test_with_all_given_values_it_solves_as_other_solvers(rail):
    solver, reach = rail
    values = [READY[solver.joints.index(name)] for name in solver.given]
    solutions = solver.solve(reach(READY), given=values)
    assert min(np.abs(solution.q - READY).max() for solution in solutions) < 1e-6
