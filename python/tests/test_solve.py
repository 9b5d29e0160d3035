"""One target: all solutions. An independent forward kinematics maps each solution to the target."""

import json
import pickle

import numpy as np
import pytest
from witness import DERIVATIONS, UR5_DH, dh_forward, same_angles

import groebot
from groebot import Solver


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


def test_all_eight_solutions_of_a_ur5_reach_the_target(ur5):
    q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
    (target,) = dh_forward(UR5_DH, q[None])
    solutions = ur5.solve(target)
    assert len(solutions) == 8
    found = np.stack([solution.q for solution in solutions])
    assert np.abs(dh_forward(UR5_DH, found) - target).max() < 1e-12
    assert same_angles(found, q).min() < 1e-9
    assert len({solution.branch for solution in solutions}) == 8
    assert all(solution.free == () and solution.residual < 1e-12 for solution in solutions)


def test_every_form_of_a_target_has_the_same_solutions(ur5, random):
    (target,) = dh_forward(UR5_DH, random.uniform(-3, 3, (1, 6)))
    numbers = np.concatenate([target[:3, 3], target[:3, :3].ravel()])
    wanted = [solution.q for solution in ur5.solve(target)]
    for form in (numbers, numbers.tolist(), target.tolist(), np.asfortranarray(target), target[None][0]):
        assert np.array_equal([solution.q for solution in ur5.solve(form)], wanted)
    Rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    turn = Rotation.from_matrix(target[:3, :3])
    quaternion = np.concatenate([target[:3, 3], turn.as_quat()])
    for form in (quaternion, (target[:3, 3], turn)):
        assert np.allclose([solution.q for solution in ur5.solve(form)], wanted, atol=1e-9)


def test_spatialmath_is_accepted(ur5, random):
    SE3 = pytest.importorskip("spatialmath").SE3
    poses = dh_forward(UR5_DH, random.uniform(-3, 3, (3, 6)))
    assert np.array_equal(ur5.solve_batch(SE3([SE3(pose) for pose in poses])).q, ur5.solve_batch(poses).q)
    assert len(ur5.solve(SE3(poses[0]))) == len(ur5.solve(poses[0]))


def test_out_of_reach_is_an_empty_list(ur5):
    target = np.eye(4)
    target[:3, 3] = 5.0
    assert ur5.solve(target) == []


def test_a_singular_target_has_a_free_joint(ur5):
    # With the wrist straight, joints 2, 3, 4 and 6 are parallel.
    (target,) = dh_forward(UR5_DH, np.array([[0.3, -1.0, 1.2, 0.4, 0.0, 0.2]]))
    solutions = ur5.solve(target)
    assert any(solution.free for solution in solutions)
    found = np.stack([solution.q for solution in solutions])
    assert np.abs(dh_forward(UR5_DH, found) - target).max() < 1e-9


def test_nearest_and_limits(ur5, random):
    q = random.uniform(-3, 3, (50, 6))
    for own, target in zip(q, dh_forward(UR5_DH, q)):
        near = own + 2 * np.pi
        solution = ur5.nearest(target, near)
        assert np.allclose(solution.q, near, atol=1e-6)
        limits = np.stack([own - 0.1, own + 0.1], 1)
        within = ur5.solve(target, limits=limits)
        assert within and all((s.q >= limits[:, 0] - 1e-9).all() and (s.q <= limits[:, 1] + 1e-9).all() for s in within)


def test_nearest_at_singular_poses_is_on_the_self_motion(ur5, random):
    q = random.uniform(-3, 3, (100, 6))
    q[:, 4] = 0.0
    poses = dh_forward(UR5_DH, q)
    for own, target in zip(q, poses):
        solution = ur5.nearest(target, own)
        assert np.allclose(solution.q, own, atol=1e-6) and np.abs(ur5.forward(solution.q) - target).max() < 1e-9
        window = np.stack([own - 0.01, own + 0.01], 1)
        assert np.allclose(ur5.nearest(target, own + 0.05, limits=window).q, own, atol=0.011)
    batch = ur5.solve_batch(poses, near=q)
    assert np.allclose(batch.q, q, atol=1e-6) and np.array_equal(batch.counts, np.ones(100))


def test_a_path_through_a_singular_wrist_has_no_jump(ur5, random):
    for start in random.uniform(-2, 2, (10, 6)):
        route = start + np.linspace(0, 0.3, 21)[:, None] * random.uniform(-1, 1, 6)
        route[:, 4] = np.linspace(-0.5, 0.5, 21)
        poses = ur5.forward(route)
        path = ur5.solve_path(poses, route[0])
        assert not path.jumps and np.abs(ur5.forward(path.q) - poses).max() < 1e-9
        assert np.abs(path.q - route).max() < 0.5


@pytest.mark.parametrize("name", Solver.names(compiled=True))
def test_named_solvers_find_what_made_the_target_and_travel(name, random):
    solver = Solver.named(name)
    assert solver.compiled
    again = pickle.loads(pickle.dumps(solver))
    for _ in range(20):
        q = random.uniform(-1.5, 1.5, len(solver.joints))
        target = solver.forward(q)
        given = q[[solver.joints.index(joint) for joint in solver.given]]
        solutions = solver.solve(target, given=given)
        found = np.stack([solution.q for solution in solutions])
        assert np.abs(found - q).max(1).min() < 1e-6
        assert np.array_equal(found, [solution.q for solution in again.solve(target, given=given)])


def test_a_compiled_solver_and_its_program_agree_to_the_last_bit(random):
    for name in Solver.names(compiled=True):
        compiled = Solver.named(name)
        interpreted = Solver.from_json((DERIVATIONS / name / "5_program.json").read_text().replace(f'"{name}"', '"other"', 1))
        assert not interpreted.compiled
        ordinary = random.uniform(-2, 2, (300, len(compiled.joints)))
        # One joint or several next to a right angle, where arms are singular, and all joints in steps of 15 degrees.
        right, off = random.integers(-1, 3, ordinary.shape) * np.pi / 2, 10 ** random.uniform(-12, -2, ordinary.shape)
        near = np.where(random.random(ordinary.shape) < 0.3, right + off, ordinary)
        for q in (ordinary, near, np.radians(15 * random.integers(-11, 13, ordinary.shape))):
            given = q[:, [compiled.joints.index(joint) for joint in compiled.given]]
            one, other = (s.solve_batch(compiled.forward(q), given=given) for s in (compiled, interpreted))
            for field in ("q", "starts", "branch", "residual", "free", "status"):
                assert np.array_equal(getattr(one, field), getattr(other, field)), (name, field)


def test_load_takes_folders_and_files(tmp_path):
    folder = Solver.load(DERIVATIONS / "scara")
    program = Solver.load(DERIVATIONS / "scara/5_program.json")
    file = tmp_path / "scara.json"
    file.write_text(folder.to_json())
    for solver in (folder, program, Solver.load(file)):
        assert solver.joints == folder.joints and solver.compiled
        assert solver.jacobian(np.zeros(4)).shape == (6, 4)


def test_load_proves_a_thin_folder_again():
    """A folder with hashes instead of outputs has the solver that is derived from its description."""
    folder = DERIVATIONS / "planar_4r"
    assert (folder / "outputs.sha256").exists() and not (folder / "5_program.json").exists()
    solver, derived = Solver.load(folder), groebot.derive(folder)
    assert json.loads(solver.to_json()) == json.loads(derived.to_json())
    assert solver.check().targets > 100


def test_sources(ur5):
    assert "ur5_solve" in ur5.c_source() and "float" in ur5.c_source(single=True)
    assert "impl" in ur5.rust_source(alone=False)
    assert len(ur5.rust_source()) > len(ur5.rust_source(alone=False))


def test_a_named_solver_follows_its_proof():
    checked = Solver.named("nao_head").check()
    assert checked.targets > 100 and checked.weak_spots == ()


def test_explain(ur5):
    reported = ur5.explain()
    assert "UR5" in str(reported).upper() and reported._repr_latex_().startswith("\\documentclass")


def test_the_jacobian_is_the_derivative_of_the_witness(ur5, random):
    q, step = random.uniform(-3, 3, 6), 1e-6
    jacobian = ur5.jacobian(q)
    (pose,) = dh_forward(UR5_DH, q[None])
    ahead = dh_forward(UR5_DH, q + step * np.eye(6))
    after = dh_forward(UR5_DH, q - step * np.eye(6))
    rate = (ahead - after) / (2 * step)
    turning = rate[:, :3, :3] @ pose[:3, :3].T
    angular = np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]])
    assert np.allclose(jacobian[:3], rate[:, :3, 3].T, atol=1e-8)
    assert np.allclose(jacobian[3:], angular, atol=1e-8)
    turn = np.kron(np.eye(2), pose[:3, :3].T)
    assert np.allclose(ur5.jacobian(q, "tip"), turn @ jacobian, atol=1e-12)
    assert ur5.jacobian(np.stack([q, q])).shape == (2, 6, 6)


def test_version_and_kinds():
    assert groebot.__version__
    with pytest.raises(groebot.GroebotError) as raised:
        Solver.named("ur6")
    assert raised.value.kind == "unknown_name" and "ur3" in str(raised.value)


def test_a_robot_by_name_is_derived_once_and_cached(tmp_path, monkeypatch):
    monkeypatch.setenv("GROEBOT_CACHE", str(tmp_path))
    polar = Solver.named("polar")
    assert len(list(tmp_path.iterdir())) == 1 and not polar.compiled
    q = [0.3, -0.4, 0.2]
    for solver in (polar, Solver.named("polar")):
        assert any(np.allclose(solution.q, q) for solution in solver.solve(solver.forward(q)))
    assert len(list(tmp_path.iterdir())) == 1
    assert {"polar", "ur5", "teo_leg"} <= set(Solver.names()) and "nao" not in Solver.names()
    assert "polar" not in Solver.names(compiled=True)
    with pytest.raises(groebot.GroebotError, match="did you mean `polar`"):
        Solver.named("polarr")
