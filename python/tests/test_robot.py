"""Dynamics and navigation, compared with results of numpy, and of Pinocchio if it is installed."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from witness import REPOSITORY, _origin, urdf_forward

import groebot
from groebot import Robot

UR5 = REPOSITORY / "tests/corpus/dynamics/ur5.urdf"


@pytest.fixture(scope="module")
def robot():
    return Robot.from_urdf(UR5)


def bodies():
    """For each link with a mass: its name, mass, centre of mass, and the inertia about it along the link's axes."""
    for link in ElementTree.parse(UR5).getroot().findall("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        frame, reported = _origin(inertial.find("origin")), inertial.find("inertia")
        xx, xy, xz, yy, yz, zz = (float(reported.get(key)) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn = frame[:3, :3]
        yield link.get("name"), float(inertial.find("mass").get("value")), frame[:3, 3], turn @ inertia @ turn.T


def motion(q, name, centre, step=1e-5):
    """The linear and angular velocity of a link's centre per joint velocity, in the root frame."""
    place = lambda q: urdf_forward(UR5, q, name)
    own, columns = place(q), []
    for joint in np.eye(6) * step:
        rate = (place(q + joint) - place(q - joint)) / (2 * step)
        turning = rate[:3, :3] @ own[:3, :3].T
        columns.append([*(rate[:3, :3] @ centre + rate[:3, 3]), turning[2, 1], turning[0, 2], turning[1, 0]])
    return own, np.array(columns).T


def mass_matrix(q):
    matrix = np.zeros((6, 6))
    for name, mass, centre, inertia in bodies():
        own, rates = motion(q, name, centre)
        turned = own[:3, :3] @ inertia @ own[:3, :3].T
        matrix += mass * rates[:3].T @ rates[:3] + rates[3:].T @ turned @ rates[3:]
    return matrix


def gravity(q):
    return sum(9.81 * mass * motion(q, name, centre)[1][2] for name, mass, centre, _ in bodies())


def test_the_mass_matrix_and_gravity_are_those_of_the_bodies(robot, random):
    for q in random.uniform(-3, 3, (5, 6)):
        assert np.allclose(robot.mass_matrix(q), mass_matrix(q), atol=1e-6)
        assert np.allclose(robot.gravity_torques(q), gravity(q), atol=1e-6)


def test_inverse_and_forward_dynamics_are_one_another(robot, random):
    q, v, a = random.uniform(-2, 2, (3, 30, 6))
    torques = robot.inverse_dynamics(q, v, a)
    assert torques.shape == (30, 6)
    assert np.allclose(robot.forward_dynamics(q, v, torques), a, atol=1e-8)
    whole = np.einsum("nij,nj->ni", robot.mass_matrix(q), a) + robot.gravity_torques(q)
    still = robot.inverse_dynamics(q, np.zeros(6), a)
    assert np.allclose(still, whole, atol=1e-9)
    coriolis = np.einsum("nij,nj->ni", robot.coriolis_matrix(q, v), v)
    assert np.allclose(torques, whole + coriolis, atol=1e-9)


def test_links_are_at_the_poses_of_the_tree(robot, random):
    q = random.uniform(-3, 3, 6)
    for link in robot.links:
        assert np.allclose(robot.link_pose(q, link), urdf_forward(UR5, q, link), atol=1e-12)
        _, rates = motion(q, link, np.zeros(3))
        assert np.allclose(robot.link_jacobian(q, link), rates, atol=1e-8)
    centre = sum(mass * (urdf_forward(UR5, q, name) @ [*centre, 1])[:3] for name, mass, centre, _ in bodies())
    assert np.allclose(robot.center_of_mass(q), centre / robot.mass, atol=1e-12)


def test_pinocchio_agrees(robot, random):
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(UR5))
    data = model.createData()
    for q, v, a in random.uniform(-2, 2, (20, 3, 6)):
        assert np.allclose(robot.inverse_dynamics(q, v, a), pinocchio.rnea(model, data, q, v, a), atol=1e-9)


def test_a_floating_base_and_another_gravity(random):
    robot = Robot.from_urdf(UR5, floating=True, gravity=[0, 0, -1.62])
    q = np.concatenate([[0.1, 0.2, 0.3, 0, 0, 0, 1], random.uniform(-1, 1, 6)])
    held = robot.gravity_torques(q)
    assert held.shape == (12,) and np.allclose(held[:3], [0, 0, 1.62 * robot.mass])
    with pytest.raises(groebot.BadValueError, match="quaternion"):
        robot.gravity_torques(np.zeros(13))


def test_states_are_looked_at(robot):
    with pytest.raises(groebot.BadValueError, match="`v`"):
        robot.coriolis_matrix(np.zeros(6), np.zeros(5))
    with pytest.raises(groebot.BadValueError, match="row 1"):
        robot.mass_matrix([[0.0] * 6, [np.nan] * 6])
    with pytest.raises(groebot.BadValueError, match="as many rows"):
        robot.inverse_dynamics(np.zeros((2, 6)), np.zeros((3, 6)), np.zeros(6))
    with pytest.raises(groebot.BadValueError) as raised:
        robot.link_pose(np.zeros(6), "elbow")
    assert raised.value.kind == "unknown_name"


def test_robots_travel(robot):
    import pickle

    again = pickle.loads(pickle.dumps(robot))
    assert again.to_urdf() == robot.to_urdf()
    named = Robot.named("nao", tip="l_sole")
    assert "l_sole" in named.links and named.mass > 4
    assert groebot.derive(named).solutions == 8


def test_a_humanoid_finds_its_path():
    walk = groebot.navigate("rh0", REPOSITORY / "examples/living_room.toml", (7.2, 3.4), (1, 2.6))
    assert walk.q.shape == (len(walk.times), len(walk.joints)) and (walk.margin > 0).all()
    assert np.allclose(walk.path[0], [1, 2.6], atol=0.1) and np.allclose(walk.path[-1], [7.2, 3.4], atol=0.1)
    assert np.hypot(*(walk.footsteps[-1, :2] - [7.2, 3.4])) < 0.3 and set(walk.feet) == {"left", "right"}
    assert walk.csv.startswith("#") or "time" in walk.csv.splitlines()[0]


def test_a_humanoid_walks_as_by_the_command(tmp_path):
    """The defaults are those of the command: no rests between steps. A gait by one step goal rests, and is slower."""
    room = REPOSITORY / "examples/living_room.toml"
    arguments = ["--start", "1.4,1.5,0", "--goal", "3.2,1.6", "--furniture", "chair=2.6,4", "--quiet"]
    walks = {}
    for gait in (None, "rh0-real"):
        out = tmp_path / f"{gait}.csv"
        command = ["groebot", "navigate", "rh0", "--map", str(room), "-o", str(out), *arguments]
        assert groebot._groebot._run(command + (["--gait", gait] if gait else [])) == 0
        walks[gait] = groebot.navigate("rh0", room, (3.2, 1.6), (1.4, 1.5, 0), gait=gait, furniture={"chair": (2.6, 4)})
        assert walks[gait].csv == out.read_text() and walks[gait].notes == []
    assert walks[None].times[-1] < 0.6 * walks["rh0-real"].times[-1]
    crouched = groebot.navigate("rh0", room, (3.2, 1.6), (1.4, 1.5, 0), crouched=True, furniture={"chair": None, "sofa": (3, 5, 0.1)})
    assert crouched.times[-1] < walks[None].times[-1]
    empty = np.zeros((60, 60), bool)
    for wrong in ({"gait": "gallop"}, {"body": (0.3,)}, {"furniture": {"chair": (1,)}}, {"furniture": {"throne": None}}):
        with pytest.raises(groebot.GroebotError):
            groebot.navigate("rh0", room, (3.2, 1.6), (1.4, 1.5, 0), **wrong)
    with pytest.raises(groebot.BadValueError, match="needs a room"):
        groebot.navigate("rh0", empty, (1.5, 1.5), (1.0, 1.5), furniture={"chair": None})


def test_a_map_as_an_array_and_no_path_through_it():
    room = np.zeros((60, 60), bool)
    assert len(groebot.navigate("nao", room, (2.0, 1.5), (1.0, 1.5)).times) > 100
    room[:, 30] = True
    with pytest.raises(groebot.NoPathError) as raised:
        groebot.navigate("nao", room, (2.5, 1.5), (0.6, 1.5))
    assert raised.value.kind == "no_path" and raised.value.enclosure.shape[1] == 2
    assert (raised.value.enclosure[:, 0] < 1.5).all()
    with pytest.raises(groebot.BadValueError):
        groebot.navigate("nao", room, (2.5,), (0.6, 1.5))


def test_a_stabiliser_keeps_a_standing_robot_where_it_is(tmp_path):
    walk = groebot.navigate("nao", np.zeros((60, 60), bool), (1.5, 1.5), (1.0, 1.5))
    stabilizer = groebot.Stabilizer("nao", walk.csv)
    assert stabilizer.joints == walk.joints
    upright, still, weight = [0, 0, 0, 1], np.zeros(3), 5.30575 * 9.80665
    soles = np.zeros((2, 6))
    soles[:, 2] = weight / 2
    for time in np.arange(0.0, 0.5, 0.005) * walk.times[1]:
        positions, velocities = stabilizer.step(time, walk.q[0], upright, still, soles)
        assert np.abs(positions - walk.q[0]).max() < 1e-2 and np.isfinite(velocities).all()
    # A torso that leans ahead is corrected, on both sides alike.
    lean = [0, np.sin(0.02), 0, np.cos(0.02)]
    for time in np.arange(0.0, 0.5, 0.005):
        leaning, _ = stabilizer.step(walk.times[1] + time, walk.q[0], lean, still, soles)
    moved = dict(zip(stabilizer.joints, leaning - positions))
    assert abs(moved["LAnklePitch"]) > 1e-3 and abs(moved["LAnklePitch"] - moved["RAnklePitch"]) < 1e-3


def test_a_stabiliser_of_a_description_needs_its_walk(tmp_path):
    """NAO's own URDF: the legs are derived, and standing is the same as by name."""
    urdf = tmp_path / "nao.urdf"
    assert groebot._groebot._run(["groebot", "export", "nao", "--to", "urdf", "-o", str(urdf)]) == 0
    walk = groebot.navigate("nao", np.zeros((60, 60), bool), (1.5, 1.5), (1.0, 1.5))
    soles = np.zeros((2, 6))
    soles[:, 2] = 5.30575 * 9.80665 / 2
    state = {"time": 0.0, "orientation": [0, 0, 0, 1], "angular_velocity": [0, 0, 0], "soles": soles}
    named = groebot.Stabilizer("nao", walk.csv, heading=0)
    described = groebot.Stabilizer(str(urdf), walk.csv)
    by_name = dict(zip(walk.joints, walk.q[0]))
    for stabilizer in (named, described):
        q = np.array([by_name[joint] for joint in stabilizer.joints])
        positions, _ = stabilizer.step(q=q, **state)
        assert np.abs(positions - q).max() < 1e-2


def test_states_that_are_none_are_refused():
    walk = groebot.navigate("nao", np.zeros((60, 60), bool), (1.5, 1.5), (1.0, 1.5))
    with pytest.raises(groebot.GroebotError, match="nao, rh0 or teo"):
        groebot.Stabilizer("asimo", walk.csv)
    with pytest.raises(groebot.BadValueError, match="stiffness"):
        groebot.Stabilizer("nao", walk.csv, stiffness=-1)
    with pytest.raises(groebot.BadValueError, match="heading"):
        groebot.Stabilizer("nao", walk.csv, heading=2)
    stabilizer = groebot.Stabilizer("nao", walk.csv)
    good = {"time": 0.0, "q": walk.q[0], "orientation": [0, 0, 0, 1], "angular_velocity": [0, 0, 0], "soles": np.zeros((2, 6))}
    for name, value in {"q": [1.0], "orientation": [1, 1, 1, 1], "angular_velocity": [np.nan, 0, 0], "soles": np.zeros(6), "time": np.inf}.items():
        with pytest.raises(groebot.BadValueError):
            stabilizer.step(**(good | {name: value}))


def test_a_xacro_has_packages_and_arguments(tmp_path):
    (tmp_path / "part.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="part" params="z"><link name="tool"/><joint name="j" type="continuous">'
        '<parent link="base"/><child link="tool"/><origin xyz="0 0 ${z}"/></joint></xacro:macro></robot>'
    )
    arm = tmp_path / "desc" / "arm.urdf.xacro"
    arm.parent.mkdir()
    arm.write_text(
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="z" default="1"/><xacro:include filename="$(find parts)/part.xacro"/>'
        '<link name="base"/><xacro:part z="$(arg z)"/></robot>'
    )
    with pytest.raises(groebot.GroebotError, match="the package `parts` is not found"):
        Robot.load(arm)
    read = Robot.load(arm, packages={"parts": tmp_path}, arguments={"z": "0.25"})
    assert read.joints == ["j"]
    assert 'xyz="0 0 0.25"' in read.to_urdf()
    assert 'xyz="0 0 1"' in Robot.load(arm, packages={"parts": str(tmp_path)}).to_urdf()


def test_a_dh_table_is_derived_but_is_no_robot(tmp_path):
    table = tmp_path / "table.csv"
    table.write_text("# convention: standard\nname,theta,d,a,alpha\nj1,q1,0,1,0\nj2,q2,0,1,0\n")
    with pytest.raises(groebot.GroebotError, match="`dh`: this describes a chain"):
        Robot.load(table)
    assert groebot.derive(table, "planar_position", plane="xy").joints == ["j1", "j2"]


def test_a_cache_that_cannot_be_written_is_not_used(tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.write_text("mine")
    monkeypatch.setenv("GROEBOT_CACHE", str(file))
    assert groebot.Solver.named("abb_irb140").name == "abb_irb140"
    assert file.read_text() == "mine"
