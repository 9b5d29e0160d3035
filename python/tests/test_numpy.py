"""What users of numpy and of the standard library expect: pickles, arrays, errors, iteration, names."""

import errno
import gc
import os
import pickle
import subprocess
import sys
import tracemalloc

import numpy as np
import pytest
from witness import KUKA_URDF, REPOSITORY, UR5_DH, UR5_URDF, dh_forward

import groebot
from groebot import BadValueError, Robot, Solver

Q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.fixture(scope="module")
def pose():
    return dh_forward(UR5_DH, Q[None])[0]


def test_solutions_travel(ur5, pose, panda):
    # Joint 6 is free at the second target.
    for solutions in (ur5.solve(pose), ur5.solve(ur5.forward([0.3, -1.0, 1.2, 0.4, 0.0, 0.2])), panda.solve(panda.forward([0, -0.785, 0, -2.356, 0, 1.571, 0.785]))):
        for one, other in zip(solutions, pickle.loads(pickle.dumps(solutions)), strict=True):
            assert np.array_equal(one.q, other.q) and repr(one) == repr(other)
            assert (one.residual, one.branch, one.free, one.chosen, one.settled) == (other.residual, other.branch, other.free, other.chosen, other.settled)


def test_a_write_to_q_is_refused_and_not_lost(ur5, pose):
    solution = ur5.solve(pose)[0]
    with pytest.raises(ValueError, match="read-only"):
        solution.q[0] = 9
    own = solution.q.copy()
    own[0] = 9
    assert own[0] == 9 and solution.q[0] != 9


def test_solutions_are_arrays(ur5, pose):
    solutions = ur5.solve(pose)
    wanted = np.stack([solution.q for solution in solutions])
    assert np.array_equal(np.array(solutions), wanted) and np.array_equal(np.asarray(solutions[3]), wanted[3])
    assert np.array(solutions[0], dtype=np.float32).dtype == np.float32
    assert np.allclose(ur5.forward(solutions), pose, atol=1e-12)
    assert np.array_equal(ur5.solve(pose, as_array=True), wanted)
    away = pose.copy()
    away[:3, 3] = 9.0
    assert ur5.solve(away, as_array=True).shape == (0, 6)
    assert np.array_equal(ur5.solve(pose, q0=Q, as_array=True)[0], ur5.nearest(pose, Q).q)


def test_redundant_solutions_are_arrays(panda):
    q = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
    target = panda.forward(q)
    assert np.array_equal(panda.solve(target, as_array=True), np.array(panda.solve(target)))
    assert panda.solve(np.eye(4) + np.diag([0, 0, 0, 0.0]), as_array=True).shape[1] == 7


def test_batches_are_iterated_and_sliced(ur5, random):
    batch = ur5.solve_batch(dh_forward(UR5_DH, random.uniform(-3, 3, (20, 6))))
    rows = list(batch)
    assert len(rows) == 20 and all(np.array_equal(own, batch[row]) for row, own in enumerate(rows))
    for part in (slice(3, 9), slice(None, None, 2), slice(None, None, -1), slice(5, 5), slice(-3, None)):
        cut = batch[part]
        assert isinstance(cut, groebot.Batch) and len(cut) == len(rows[part]) == len(cut.status)
        assert all(np.array_equal(one, other) for one, other in zip(cut, rows[part], strict=True))
        assert cut.starts[-1] == len(cut.q) == len(cut.branch) == len(cut.residual) == len(cut.free)
    assert np.array_equal(batch[np.int64(4)], rows[4]) and np.array_equal(batch[-1], rows[-1])
    for wrong in (20, -21):
        with pytest.raises(IndexError):
            batch[wrong]


def test_minus_one_thread_is_all_processors(ur5, random):
    targets = dh_forward(UR5_DH, random.uniform(-3, 3, (2000, 6)))
    assert np.array_equal(ur5.solve_batch(targets, threads=-1).q, ur5.solve_batch(targets).q)
    with pytest.raises(BadValueError, match="-1 for all processors"):
        ur5.solve_batch(targets, threads=-2)


@pytest.mark.parametrize("read", [Solver.load, Robot.from_urdf, Robot.load, groebot.derive])
def test_a_missing_file_is_a_file_not_found_error(read, tmp_path):
    missing = tmp_path / "nothing.urdf"
    with pytest.raises(FileNotFoundError) as raised:
        read(missing)
    error = raised.value
    assert isinstance(error, groebot.GroebotError) and isinstance(error, groebot.MissingFileError)
    assert error.kind == "io" and error.filename == str(missing) and error.errno == errno.ENOENT
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and "nothing.urdf" in str(error) and again.filename == error.filename
    with pytest.raises(OSError, match=str(tmp_path)) as raised:
        Robot.from_urdf(tmp_path)
    assert isinstance(raised.value, groebot.FileError) and not isinstance(raised.value, FileNotFoundError)


def test_limits_that_are_not_described_are_an_error():
    puma = Solver.named("puma")  # The arm of a thesis: it has no maker.
    pose = puma.forward(Q)
    for call in (lambda: puma.solve(pose, limits=True), lambda: puma.nearest(pose, Q, limits=True), lambda: puma.solve_batch(pose[None], limits=True)):
        with pytest.raises(BadValueError, match=r"puma has no limits of joints; give an array \(6, 2\), or a dict"):
            call()
    described = groebot.derive(UR5_URDF)
    assert np.isfinite(described.limits).all() and len(described.solve(described.forward(Q), limits=True)) > 0


@pytest.mark.parametrize(
    ("name", "degrees"),
    [
        ("ur5", [(-360, 360)] * 6),
        # Axis 5 is zero with the tool down, 90 degrees from the maker's zero.
        ("irb120", [(-165, 165), (-110, 110), (-110, 70), (-160, 160), (-120 - 90, 120 - 90), (-400, 400)]),
    ],
)
def test_named_arms_have_the_limits_of_their_makers(name, degrees):
    arm = Solver.named(name)
    np.testing.assert_allclose(np.degrees(arm.limits), degrees, rtol=1e-14)
    q = np.random.default_rng(3).uniform(*arm.limits.T)
    within = arm.solve(arm.forward(q), limits=True, as_array=True)
    assert ((arm.limits[:, 0] <= within) & (within <= arm.limits[:, 1])).all()
    turns = (within - q) / (2 * np.pi)
    assert np.abs(turns - turns.round()).max(1).min() < 1e-9


def test_given_joints_by_name_and_by_default_from_q0():
    arm = Solver.named("iiwa14")
    q = np.full(7, 0.3)
    target = arm.forward(q)
    wanted = arm.solve(target, given=[0.3], as_array=True)
    assert arm.given == ["A3"] and np.abs(wanted - q).max(1).min() < 1e-6
    assert np.array_equal(arm.solve(target, given={"A3": 0.3}, as_array=True), wanted)
    assert np.allclose(arm.solve(target, q0=q)[0].q, q, atol=1e-6)
    assert np.allclose(arm.nearest(target, q, limits=True).q, q, atol=1e-6)
    assert abs(arm.nearest(target, q, given={"A3": 0.2}).q[2] - 0.2) < 1e-12
    with pytest.raises(BadValueError, match=r"needs the value of joint A3 .*given=\{\"A3\""):
        arm.solve(target)
    with pytest.raises(BadValueError, match="joint `A4` is not given in this solver; the given joints are A3"):
        arm.solve(target, given={"A4": 0.3})
    with pytest.raises(BadValueError, match="no value of joint `A3`"):
        arm.solve(target, given={})
    with pytest.raises(BadValueError, match="no given joints"):
        Solver.named("ur5").solve(np.eye(4), given=[1.0])


def test_given_joints_of_batches_and_paths(random):
    arm = Solver.named("iiwa14")
    q = random.uniform(-1.5, 1.5, (30, 7))
    targets = arm.forward(q)
    batch = arm.solve_batch(targets, near=q)
    assert np.allclose(batch.q, q, atol=1e-6)
    assert np.array_equal(arm.solve_batch(targets, given={"A3": q[:, 2]}).q, arm.solve_batch(targets, given=q[:, 2:3]).q)
    with pytest.raises(BadValueError, match="`given` has 3 values for 30 targets and the joints A3"):
        arm.solve_batch(targets, given={"A3": [0.1, 0.2, 0.3]})
    still = np.full(7, 0.3)
    route = still + np.linspace(0, 0.4, 12)[:, None] * np.array([1, -1, 0, 1, 1, -1, 0.5])
    for options in ({"q0": still}, {"q0": still, "given": {"A3": 0.3}}, {"given": [0.3]}):
        path = arm.solve_path(arm.forward(route), **options)
        assert np.abs(arm.forward(path.q) - arm.forward(route)).max() < 1e-9 and np.allclose(path.q[:, 2], 0.3)
        assert len(path.jumps) == 0
    assert np.allclose(arm.solve_path(arm.forward(route), still).q, route, atol=1e-6)
    with pytest.raises(BadValueError, match="joint A3"):
        arm.solve_path(arm.forward(route))


def test_one_rule_for_the_default_tip():
    """The first tip is the default one, and the solver is the same."""
    joint = '<joint name="to_{0}" type="fixed"><parent link="wrist_3_link"/><child link="{0}"/><origin xyz="0 {1} 0"/></joint><link name="{0}"/>'
    for ends, tips in [
        ([], ["wrist_3_link"]),
        ([("camera", 0.2), ("tool0", 0.1)], ["tool0", "camera"]),
        ([("camera", 0.2), ("flange", 0.1)], ["flange", "camera"]),
    ]:
        text = UR5_URDF.read_text().replace("</robot>", "".join(joint.format(*end) for end in ends) + "</robot>")
        robot = Robot.from_urdf(text)
        if ends:
            assert robot.tips == tips
        assert robot.tip == robot.tips[0] and robot.base == robot.links[0]
        one, other = groebot.derive(robot), groebot.derive(Robot.from_urdf(text, tip=robot.tips[0]))
        assert np.array_equal(one.forward(Q), other.forward(Q)) and one.joints == other.joints
    several = UR5_URDF.read_text().replace("</robot>", joint.format("left", 0.2) + joint.format("right", -0.2) + "</robot>")
    robot = Robot.from_urdf(several)
    assert robot.tip is None and robot.tips == ["left", "right"]
    with pytest.raises(BadValueError, match="left"):
        groebot.derive(robot)


def test_robots_of_all_formats_are_loaded(tmp_path):
    robot = Robot.load(UR5_URDF)
    assert robot.to_urdf() == UR5_URDF.read_text() and robot.joints == Robot.from_urdf(UR5_URDF).joints
    finger = Robot.load(REPOSITORY / "fuzz/seeds/robot_toml/finger.toml")
    again = pickle.loads(pickle.dumps(finger))
    assert again.joints == finger.joints and again.mass == finger.mass and len(finger.tips) > 0
    other = tmp_path / "arm.json"
    other.write_text("{}")
    with pytest.raises(groebot.GroebotError, match="arm.json"):
        Robot.load(other)


def test_a_robot_and_its_solver_name_joints_alike():
    robot = Robot.from_urdf(KUKA_URDF)
    solver = groebot.derive(robot)
    assert solver.joints == robot.joints[: len(solver.joints)]


def test_placed_solvers_travel_and_have_the_names(ur5, pose):
    base, tool = pose, np.linalg.inv(pose)
    placed = ur5.placed(base=base, tool=tool)
    again = pickle.loads(pickle.dumps(placed))
    assert np.array_equal(again.base, base) and np.array_equal(again.tool, tool)
    assert np.array_equal(again.solve(placed.forward(Q), as_array=True), placed.solve(placed.forward(Q), as_array=True))
    assert (placed.name, placed.task, placed.joints, placed.inputs, placed.given) == (ur5.name, ur5.task, ur5.joints, ur5.inputs, ur5.given)
    assert np.array_equal(placed.limits, ur5.limits)


def test_batches_do_not_leak(ur5, random):
    """Memory of many calls with more than 256 solutions, whose number is a new integer. A lost integer would be 28 bytes."""
    targets = dh_forward(UR5_DH, random.uniform(-3, 3, (40, 6)))
    assert len(ur5.solve_batch(targets, threads=1).q) > 256
    calls = 100_000 if os.environ.get("GROEBOT_RELEASE") == "1" else 1_000

    def used(calls):
        for _ in range(calls):
            ur5.solve_batch(targets, threads=1)
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        before = used(100)
        assert (used(calls) - before) / calls < 14
    finally:
        tracemalloc.stop()


def test_the_version_is_that_of_the_command():
    shown = subprocess.run([sys.executable, "-m", "groebot", "--version"], capture_output=True, text=True, check=True).stdout
    assert groebot.__version__ in shown
