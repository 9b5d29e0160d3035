"""Invalid arguments cause an exception with the allowed values, or a status. They never cause an abort, a panic or a hang."""

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from witness import DERIVATIONS, KUKA_URDF

import groebot
from groebot import BadValueError, GroebotError, Robot, Solver

UR5 = Solver.named("ur5")


@pytest.mark.parametrize(
    "target",
    [
        np.zeros((3, 4)),
        np.zeros(5),
        np.zeros((2, 4, 4)),
        np.zeros((1, 2, 4, 4)),
        np.zeros(()),
        np.eye(4, dtype=complex),
        np.eye(4, dtype=bool),
        np.array([["a"] * 4] * 4),
        np.eye(4, dtype=object),
        None,
        "T",
        [[1, 2], [3]],
        {},
        np.full((4, 4), np.nan),
        2 * np.eye(4),
        np.diag([1.0, 1.0, -1.0, 1.0]),
        [0, 0, 0, 0, 0, 0, 0.5],
    ],
)
def test_what_is_no_target_is_refused(target):
    with pytest.raises((ValueError, TypeError)):
        UR5.solve(target)


@pytest.mark.parametrize("shape", [(4, 4), (3, 4, 5), (3, 3, 3), (3, 8), (12,), (7,), (2, 2, 4, 4), (0,), (0, 3)])
def test_wrong_shapes_report_the_right_ones(shape):
    with pytest.raises(BadValueError, match=r"\(4, 4\)|one target"):
        UR5.solve_batch(np.zeros(shape))


@pytest.mark.parametrize(
    "options",
    [
        {"layout": "square"},
        {"dtype": int},
        {"limits": np.zeros((5, 2))},
        {"limits": np.tile([1.0, -1.0], (6, 1))},
        {"limits": np.full((6, 2), np.nan)},
        {"near": np.zeros(5)},
        {"near": np.zeros((3, 6))},
        {"near": np.full(6, np.inf)},
        {"given": [1.0]},
        {"out": np.zeros((3, 5))},
        {"out": [[0.0] * 6]},
        {"threads": -2},
        {"threads": "two"},
    ],
)
def test_wrong_options_are_refused(options):
    with pytest.raises((ValueError, TypeError, OverflowError)):
        UR5.solve_batch(np.tile(np.eye(4), (2, 1, 1)), **options)


def test_joint_values_are_looked_at():
    for q in (np.zeros(5), np.full(6, np.nan), np.zeros((2, 7)), np.zeros((1, 1, 6))):
        with pytest.raises(BadValueError):
            UR5.forward(q)
        with pytest.raises(BadValueError):
            UR5.jacobian(q)
    with pytest.raises(BadValueError, match="frame"):
        UR5.jacobian(np.zeros(6), "world")
    with pytest.raises(BadValueError, match="row 1"):
        UR5.forward([[0.0] * 6, [0.0] * 5 + [np.inf]])


def test_solvers_of_another_version_are_refused():
    program = json.loads((DERIVATIONS / "ur5/5_program.json").read_text())
    with pytest.raises(GroebotError) as raised:
        Solver.from_json(json.dumps({**program, "format": 1}))
    assert raised.value.kind == "unsupported"
    stored = json.loads(UR5.to_json())
    with pytest.raises(GroebotError, match="format 9") as raised:
        Solver.from_json(json.dumps({**stored, "groebot": 9}))
    assert raised.value.kind == "unsupported"


@pytest.mark.parametrize("files", [{"../x": "a"}, {"0_chain.toml": "x"}, {}, [], 3, {"": ""}, {"0_chain.toml": 3}])
def test_stored_descriptions_are_looked_at(files):
    stored = json.loads(UR5.to_json())
    with pytest.raises(GroebotError):
        Solver.from_json(json.dumps({**stored, "files": files}))


@pytest.mark.parametrize("text", ["", "{", "[]", "3", "null", "{}", '{"groebot": 1}', '{"groebot": 1, "program": {}}'])
def test_text_that_is_no_solver_is_refused(text):
    with pytest.raises(GroebotError):
        Solver.from_json(text)


def test_files_that_are_not_there_are_reported(tmp_path):
    for read in (Solver.load, Robot.from_urdf, groebot.derive):
        with pytest.raises(GroebotError) as raised:
            read(tmp_path / "nothing")
        assert raised.value.kind == "io" and "nothing" in str(raised.value)
    with pytest.raises(GroebotError, match="5_program.json"):
        Solver.load(tmp_path)


def test_mistakes_in_a_urdf_have_their_line():
    with pytest.raises(BadValueError) as raised:
        Robot.from_urdf("<robot name='r'>\n<link name='a'/>\n<joint name='j' type='revolute'/>\n</robot>")
    assert raised.value.line == 3


def test_a_fault_beside_the_chain_is_a_note(tmp_path):
    joint = "<joint name='{0}' type='{1}'><parent link='{2}'/><child link='{3}'/><origin xyz='0.3 0 0'/><axis xyz='0 0 1'/>{4}</joint>"
    joints = [("j1", "continuous", "a", "b", ""), ("j2", "continuous", "b", "c", ""), ("jt", "fixed", "c", "e", ""), ("pan", "revolute", "a", "d", "")]
    text = "<?xml version='1.0' encoding='ISO-8859-1'?>\n<robot name='r'><!-- J\u00f6rg -->\n"
    text += "".join(f"<link name='{name}'/>" for name in "abcde") + "\n" + "\n".join(joint.format(*one) for one in joints) + "</robot>"
    file = tmp_path / "r.urdf"
    file.write_bytes(text.encode("latin-1"))
    for robot in (Robot.from_urdf(file, tip="e"), Robot.from_urdf(text, tip="e")):
        assert len(robot.notes) == 1 and "joint `pan`: a revolute joint needs limits" in robot.notes[0]
        solver = groebot.derive(robot, task="planar_position", plane="xy")
        assert len(solver.solve([0.6, 0.3])) == 2
        with pytest.raises(BadValueError, match="pan"):
            robot.mass_matrix(np.zeros(3))
    assert Robot.named("nao").notes == []


@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(arrays.arrays(np.float64, (5, 4, 4), elements=st.floats(width=64)))
def test_any_matrices_are_answered(targets):
    batch = UR5.solve_batch(targets)
    assert len(batch) == 5 and batch.starts[-1] == len(batch.q)


@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(arrays.arrays(st.sampled_from([np.float64, np.float32, np.int32, np.uint8, np.bool_, np.complex64]), arrays.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=5)))
def test_any_array_is_answered_or_refused(target):
    for call in (UR5.solve, UR5.solve_batch, UR5.forward, UR5.jacobian):
        try:
            call(target)
        except (BadValueError, TypeError):
            pass


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_any_change_of_a_stored_solver_is_read_or_refused(data):
    text = (DERIVATIONS / "planar_2r/5_program.json").read_text()
    at = data.draw(st.integers(0, len(text) - 1))
    changed = text[:at] + data.draw(st.sampled_from(["", "9", "-", "null", "1e999", "}", '"', "true"])) + text[at + data.draw(st.integers(0, 3)) :]
    try:
        solver = Solver.from_json(changed)
        solver.solve_batch(np.random.default_rng(0).normal(size=(5, len(solver.inputs))))
    except GroebotError:
        pass


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_any_change_of_a_urdf_is_read_or_refused(data):
    text = KUKA_URDF.read_text()
    at = data.draw(st.integers(0, len(text) - 1))
    changed = text[:at] + data.draw(st.sampled_from(["", "9", "-", "nan", "1e999", "<", ">", '"', "&", "\0"])) + text[at + data.draw(st.integers(0, 3)) :]
    try:
        robot = Robot.from_urdf(changed)
        robot.mass_matrix(np.zeros(len(robot.joints)))
    except (GroebotError, TypeError):
        pass
