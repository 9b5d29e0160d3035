"""From a description to a solver: derivation, interruption, other tasks."""

import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
from witness import DERIVATIONS, KUKA_URDF, UR5_URDF, same_angles, urdf_forward

import groebot
from groebot import GroebotError, Robot, Solver, Status


def test_a_urdf_is_derived_and_solves(derived, random):
    assert not derived.compiled and len(derived.joints) == 6
    tip = Robot.from_urdf(UR5_URDF).tips[0]
    q = random.uniform(-3, 3, (200, 6))
    targets = derived.forward(q)
    for row in range(20):
        assert np.allclose(targets[row], urdf_forward(UR5_URDF, q[row], _last_link(UR5_URDF)), atol=1e-12), tip
    batch = derived.solve_batch(targets)
    assert (batch.status == Status.SOLVED).all()
    assert all(same_angles(batch[row], q[row]).min() < 1e-6 for row in range(200))


def _last_link(path):
    import xml.etree.ElementTree as ElementTree

    joints = ElementTree.parse(path).getroot().findall("joint")
    parents = {joint.find("parent").get("link") for joint in joints}
    (leaf,) = {joint.find("child").get("link") for joint in joints} - parents
    return leaf


def test_the_text_of_a_urdf_is_as_good_as_its_path(derived):
    again = groebot.derive(Robot.from_urdf(UR5_URDF.read_text()))
    assert again.to_json() == derived.to_json()


def test_a_derived_solver_travels_with_its_proof(derived):
    again = pickle.loads(pickle.dumps(derived))
    assert again.to_json() == derived.to_json()
    assert str(again.explain()) == str(derived.explain())


def test_a_proof_is_followed_again_where_it_has_travelled_to():
    planar = groebot.derive(DERIVATIONS / "planar_2r/0_chain.toml")
    checked = pickle.loads(pickle.dumps(planar)).check()
    assert checked.targets > 100 and checked.weak_spots == ()


def test_other_tasks(random):
    robot = Robot.from_urdf(KUKA_URDF)
    position = groebot.derive(robot, task="position", given=robot.joints[3:])
    q = random.uniform(-1, 1, (20, 6))
    target = position.forward(q)
    assert target.shape == (20, 3) and position.given == robot.joints[3:]
    batch = position.solve_batch(target, given=q[:, 3:])
    assert all(np.abs(batch[row] - q[row]).max(1).min() < 1e-6 for row in range(20))
    whole = position.solve_batch(np.concatenate([target, q[:, 3:]], 1))
    assert np.array_equal(whole.q, batch.q)
    with pytest.raises(groebot.BadValueError, match="given"):
        position.solve_batch(target)


def test_descriptions_other_than_urdf():
    planar = groebot.derive(DERIVATIONS / "planar_2r/0_chain.toml")
    assert len(planar.joints) == 2
    with pytest.raises(GroebotError) as raised:
        groebot.derive(UR5_URDF, task="teleport")
    assert raised.value.kind == "bad_value"
    with pytest.raises(GroebotError):
        groebot.derive(UR5_URDF, given="no_such_joint")


def test_progress_is_reported_and_can_stop():
    seen = []
    groebot.derive(UR5_URDF, progress=lambda stage, done, left: seen.append((stage, done, left)))
    assert all(isinstance(stage, str) for stage, _, _ in seen)

    def stop(stage, done, left):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        groebot.derive(DERIVATIONS / "nao_legs_poses", progress=stop)


def test_a_budget_of_time():
    with pytest.raises(GroebotError) as raised:
        groebot.derive(DERIVATIONS / "nao_legs_poses", time=0.001)
    assert raised.value.kind == "budget"


@pytest.fixture
def heard():
    """Enables interrupts. A script that runs these tests in the background has a shell that ignores them."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interrupt_from_the_keyboard(heard):
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            groebot.derive(DERIVATIONS / "nao_legs_poses")
    # A single batch also detects the interrupt.
    ur5 = Solver.named("ur5")
    targets = ur5.forward(np.random.default_rng(0).uniform(-3, 3, (1_000_000, 6)))
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            ur5.solve_batch(targets)


def test_a_forked_process_derives():
    script = """
        import os, groebot
        groebot.derive(PATH)
        child = os.fork()
        if child == 0:
            os._exit(0 if groebot.derive(PATH).solutions == 8 else 1)
        assert os.waitpid(child, 0)[1] == 0
    """
    text = textwrap.dedent(script).replace("PATH", repr(str(UR5_URDF)))
    subprocess.run([sys.executable, "-c", text], check=True, timeout=600)


def test_the_command():
    run = lambda *arguments: subprocess.run([sys.executable, "-m", "groebot", *arguments], capture_output=True, text=True)
    assert "groebot" in run("--version").stdout
    solved = run("solve", str(DERIVATIONS / "nao_leg_sagittal"), "--target", "60,150", "--json")
    assert solved.returncode == 0 and "solutions" in solved.stdout
    assert run("solve", "/nowhere").returncode == 1 and run("dance").returncode == 2


def test_a_path_is_continuous_or_reports_its_jumps():
    ur5 = Solver.named("ur5")
    q0 = np.array([0.2, -1.2, 1.5, -0.4, 1.0, 0.3])
    route = q0 + np.linspace(0, 1, 50)[:, None] * np.array([0.5, 0.3, -0.4, 0.2, 0.3, 4.0])
    path = ur5.solve_path(ur5.forward(route), q0)
    assert path.jumps == [] and np.abs(path.q - route).max() < 1e-9
    turned = ur5.solve_path(ur5.forward(route), q0 + [0, 0, 0, 0, 0, -2 * np.pi])
    assert np.abs(turned.q - route - [0, 0, 0, 0, 0, -2 * np.pi]).max() < 1e-9
    away = ur5.solve_path(ur5.forward(route), q0 + [2.0, 0, 0, 0, 0, 0])
    assert away.jumps[0].index == 0 and "does not begin" in away.jumps[0].why
    torn = np.concatenate([route[:25], route[25:] + [1.5, 0, 0, 0, 0, 0]])
    (jump,) = ur5.solve_path(ur5.forward(torn), q0).jumps
    assert jump.index == 25 and jump.joint == 0 and abs(jump.step - 1.5) < 0.1
    far = ur5.forward(route)
    far[7, :3, 3] = 9.0
    with pytest.raises(groebot.BadValueError, match="pose 8"):
        ur5.solve_path(far)
