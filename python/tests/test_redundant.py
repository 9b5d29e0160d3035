"""Redundant arms. Forward kinematics of the URDF and the arcs of tests/corpus/redundant, which were computed without groebot, are the witnesses."""

import json
import pickle
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from witness import DERIVATIONS, PANDA_URDF, REPOSITORY, same_angles, urdf_forward

import groebot
from groebot import BadValueError, GroebotError, Solver, Status

POSES = json.loads((REPOSITORY / "tests/corpus/redundant/panda.json").read_text())["poses"]
READY = np.array(POSES[0]["q"])
LIMITS = np.array([[float(limit.get(key)) for key in ("lower", "upper")] for limit in ElementTree.parse(PANDA_URDF).iter("limit")])[:7]
NAMES = [f"panda_joint{number}" for number in range(1, 8)]


def reach(q):
    return urdf_forward(PANDA_URDF, q, "panda_hand_tcp")


def vector(pose):
    return np.array(pose["q"]) if "q" in pose else np.radians(pose["degrees"])


def assert_solves(target, rows, limits=LIMITS):
    for q in np.atleast_2d(rows):
        assert np.abs(reach(q) - target).max() < 1e-8
        assert (q >= limits[:, 0] - 1e-9).all() and (q <= limits[:, 1] + 1e-9).all()


def margin(q):
    return np.minimum(q - LIMITS[:, 0], LIMITS[:, 1] - q).min(-1)


@pytest.fixture(scope="module")
def target():
    return reach(READY)


@pytest.fixture(scope="module")
def planar():
    """Three links of 0.5, 0.4 and 0.15 m in a plane."""
    return groebot.derive(DERIVATIONS / "planar_3r/0_chain.toml", task="planar_position", plane="xy")


def test_the_solver_of_a_seven_joint_arm_is_redundant(panda):
    assert panda.is_redundant and panda.joints == NAMES and len(panda.given) == 1
    assert np.allclose(panda.limits, LIMITS)
    assert not Solver.named("ur5").is_redundant and not Solver.named("iiwa14").is_redundant


@pytest.mark.parametrize("pose", [pose for pose in POSES if "sigma" in pose and pose["sigma"] > 1e-3][:6], ids=lambda pose: pose["kind"])
def test_arcs_are_those_of_the_witness(panda, pose):
    target = reach(vector(pose))
    arcs = panda.arcs(target)
    assert len(arcs) == len(pose["arcs"]) and arcs.reason is None
    assert not arcs.is_unsure and not arcs.is_surface and arcs.closed == sum(arc.is_closed for arc in arcs)
    found, wanted = sorted(arcs, key=lambda arc: -arc.length), sorted(pose["arcs"], key=lambda arc: -arc[0])
    assert np.allclose([arc.length for arc in found], [arc[0] for arc in wanted], atol=1e-4)
    ends = [(end.joint, end.limit, end.q) for arc in arcs if not arc.is_closed for end in (arc.start, arc.end)]
    for arc in wanted:
        for at, q in zip(arc[2::2], arc[3::2]) if arc[2] != "closed" else ():
            near = [(joint, limit) for joint, limit, own in ends if np.abs(own - q).max() < 1e-5]
            assert near == [(NAMES[int(at[0]) - 1], {"-": "lower", "+": "upper"}[at[1]])]
    for arc in arcs:
        assert_solves(target, arc.sample(30))


def test_points_of_an_arc(panda, target):
    arc = max(panda.arcs(target), key=lambda arc: arc.length)
    rows = arc.sample(200)
    assert rows.shape == (200, 7)
    assert np.allclose(rows[0], arc.start.q) and np.allclose(rows[-1], arc.end.q)
    steps = np.linalg.norm(np.diff(rows, axis=0), axis=1)
    # Chords are shorter than the curve between samples, here by their curvature: less than 1e-3 in all.
    assert -1e-3 < steps.sum() - arc.length < 1e-6
    some = arc.at([0.0, 0.5 * arc.length, 1e9])
    assert some.shape == (3, 7)
    assert_solves(target, some)
    assert np.array_equal(some[0], arc.start.q) and np.array_equal(some[2], arc.end.q)
    assert np.array_equal(arc.at(0.5 * arc.length), some[1])
    joint = NAMES.index(arc.start.joint)
    assert abs(arc.start.q[joint] - LIMITS[joint][["lower", "upper"].index(arc.start.limit)]) < 1e-9
    assert arc.start.joint in repr(arc) and "at its" in repr(arc)
    for call, wrong in [(arc.sample, wrong) for wrong in (0, 2_000_000, -1, "three")] + [(arc.at, wrong) for wrong in (np.nan, [[0.0]], "s")]:
        with pytest.raises((BadValueError, OverflowError, TypeError)):
            call(wrong)


def test_solve_returns_the_best_of_each_arc(panda, target):
    solutions = panda.solve(target)
    assert isinstance(solutions, groebot.Solutions) and solutions.reason is None and not solutions.is_unsure
    margins = [margin(solution.q) for solution in solutions]
    assert np.allclose(margins, sorted((arc[1] for arc in POSES[0]["arcs"]), reverse=True), atol=1e-4)
    assert margins == sorted(margins, reverse=True)
    for solution in solutions:
        assert_solves(target, solution.q)
        assert solution.residual < 1e-9 and solution.settled and solution.free == ()
    arcs = panda.arcs(target)
    for solution in solutions:
        assert np.linalg.norm(arcs[solution.branch].sample(2000) - solution.q, axis=1).min() < 0.01


def test_solve_needs_nothing_but_the_target_and_joint_values(panda, random):
    for _ in range(10):
        q = random.uniform(LIMITS[:, 0], LIMITS[:, 1])
        target = reach(q)
        solutions = panda.solve(target, q0=q)
        assert np.allclose(solutions[0].q, q, atol=1e-6)
        distances = [np.linalg.norm(solution.q - q) for solution in solutions]
        assert distances == sorted(distances)
        assert np.array_equal(panda.nearest(target, q).q, solutions[0].q)


def test_the_value_of_the_given_joint_is_accepted(panda, target):
    value = READY[NAMES.index(panda.given[0])]
    solutions = panda.solve(target, given=value)
    assert type(solutions) is list
    assert min(same_angles(solution.q, READY) for solution in solutions) < 1e-6
    numbers = np.concatenate([target[:3, 3], target[:3, :3].ravel(), [value]])
    assert np.array_equal([own.q for own in panda.solve(numbers)], [own.q for own in solutions])
    assert same_angles(panda.nearest(numbers, READY).q, READY) < 1e-6
    assert same_angles(panda.solve(numbers, q0=READY)[0].q, READY) < 1e-6


def test_other_solvers_sort_by_distance_too(random):
    ur5 = Solver.named("ur5")
    for q in random.uniform(-3, 3, (10, 6)):
        q0 = q + 2 * np.pi
        solutions = ur5.solve(ur5.forward(q), q0=q0)
        assert np.allclose(solutions[0].q, q0, atol=1e-6)
        assert all((np.abs(solution.q - q0) <= np.pi + 1e-9).all() for solution in solutions)
        distances = [np.linalg.norm(solution.q - q0) for solution in solutions]
        assert distances == sorted(distances)
        limits = {ur5.joints[0]: (q[0] - 0.1, q[0] + 0.1)}
        within = ur5.solve(ur5.forward(q), limits=limits)
        assert within and all(abs(solution.q[0] - q[0]) <= 0.1 + 1e-9 for solution in within)


def test_every_form_of_a_target_has_the_same_arcs(panda, target):
    numbers = np.concatenate([target[:3, 3], target[:3, :3].ravel()])
    wanted = [arc.length for arc in panda.arcs(target)]
    for form in (numbers, numbers.tolist(), np.asfortranarray(target)):
        assert [arc.length for arc in panda.arcs(form)] == wanted
    Rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    turn = Rotation.from_matrix(target[:3, :3])
    for form in (np.concatenate([target[:3, 3], turn.as_quat()]), (target[:3, 3], turn)):
        assert np.allclose(sorted(arc.length for arc in panda.arcs(form)), sorted(wanted), atol=1e-6)


def test_narrower_limits_are_kept(panda, target):
    narrow = LIMITS.copy()
    narrow[0] = -0.5, 0.5
    for limits in ({"panda_joint1": (-0.5, 0.5)}, narrow):
        arcs = panda.arcs(target, limits=limits)
        assert len(arcs) > 0
        for arc in arcs:
            assert_solves(target, arc.sample(30), narrow)
        assert_solves(target, panda.any_within(target, limits=limits).q, narrow)
        assert_solves(target, panda.best(target, "manipulability", limits=limits).q, narrow)
        assert all(abs(solution.q[0]) <= 0.5 + 1e-9 for solution in panda.solve(target, limits=limits))
    wide = panda.arcs(target, limits=np.tile([-np.inf, np.inf], (7, 1)))
    assert [arc.length for arc in wide] == [arc.length for arc in panda.arcs(target)]


def test_the_reason_for_no_solution_is_named(planar):
    # By the cosine rule, (0.95, 0) is reached only with joint angles of at most 0.464, 0.959 and 1.404 rad.
    limits = np.tile([1.5, 1.6], (3, 1))
    for x, status, joints in ((0.95, Status.BEYOND_LIMITS, tuple(planar.joints)), (1.2, Status.UNREACHABLE, ())):
        arcs, within = planar.arcs([x, 0.0], limits=limits), planar.any_within([x, 0.0], limits=limits)
        solutions = planar.solve([x, 0.0], limits=limits)
        assert len(arcs) == 0 and within.q is None and solutions == []
        for reason in (arcs.reason, within.reason, solutions.reason):
            assert reason == groebot.Reason(status, joints)
            assert str(reason).startswith("reachable, but beyond the limits of" if joints else "unreachable")
        assert planar.best([x, 0.0], limits=limits) is None and planar.nearest([x, 0.0], np.zeros(3), limits=limits) is None
        batch = planar.any_within_batch([[x, 0.0]], limits=limits)
        assert batch.status[0] == status and batch.reason(0) == arcs.reason and np.isnan(batch.q).all()


def test_the_best_solution_is_at_least_as_good_as_samples(panda, target):
    rows = np.concatenate([arc.sample(300) for arc in panda.arcs(target)])
    half = (LIMITS[:, 1] - LIMITS[:, 0]) / 2
    weights, q0 = np.array([1.0, 2.0, 0.5, 1.0, 0.0, 3.0, 1.0]), np.array([0.4, 0.2, -0.3, -1.9, 0.2, 1.8, 0.3])

    def manipulability(q):
        jacobian = panda.jacobian(q)
        return np.sqrt(np.linalg.det(jacobian @ np.swapaxes(jacobian, -1, -2)))

    cases = [
        ({}, margin, 1),
        ({"criterion": "relative_margin"}, lambda q: (np.minimum(q - LIMITS[:, 0], LIMITS[:, 1] - q) / half).min(-1), 1),
        ({"criterion": "nearest", "q0": q0}, lambda q: np.linalg.norm(q - q0, axis=-1), -1),
        ({"criterion": "nearest", "q0": q0, "weights": weights}, lambda q: np.sqrt((weights * (q - q0) ** 2).sum(-1)), -1),
        ({"criterion": "change", "joint": "panda_joint3", "value": 0.7}, lambda q: np.abs(q[..., 2] - 0.7), -1),
        ({"criterion": "manipulability"}, manipulability, 1),
    ]
    for options, measure, sign in cases:
        best, optima = panda.best(target, **options), panda.optima(target, **options)
        assert_solves(target, best.q)
        assert np.array_equal(best.q, optima[0].q)
        values = [sign * own.value for own in optima]
        assert values == sorted(values, reverse=True)
        assert sign * measure(best.q) >= (sign * measure(rows)).max() - 1e-6
        if options.get("criterion") != "manipulability":
            assert abs(measure(best.q) - best.value) < 1e-9
        arc = panda.arcs(target)[best.arc]
        assert np.allclose(arc.at(best.s), best.q, atol=1e-6)
    assert panda.best(target, "change", joint=2, value=0.7).value == panda.best(target, "change", joint="panda_joint3", value=0.7).value


def test_rows_of_batches_are_the_single_results(panda, random):
    q = random.uniform(LIMITS[:, 0], LIMITS[:, 1], (12, 7))
    targets = np.stack([reach(own) for own in q])
    targets[3, :3, 3] = 9.0
    within = panda.any_within_batch(targets)
    best, near = panda.best_batch(targets), panda.best_batch(targets, "nearest", q0=q)
    assert within.q.shape == best.q.shape == (12, 7) and len(within) == 12 and within.joints == tuple(NAMES)
    for row, target in enumerate(targets):
        one, own = panda.any_within(target), panda.best(target)
        assert (within.status[row], within.unsure[row]) == (Status.UNREACHABLE if row == 3 else Status.SOLVED, one.is_unsure)
        if row == 3:
            assert one.q is None and own is None and np.isnan(best.q[row]).all() and best.arc[row] == -1
            continue
        assert np.array_equal(within.q[row], one.q) and within.reason(row) is None
        assert np.array_equal(best.q[row], own.q)
        assert (best.value[row], best.arc[row], best.s[row]) == (own.value, own.arc, own.s)
        assert np.allclose(near.q[row], q[row], atol=1e-6) and near.value[row] < 1e-6
        assert_solves(target, [within.q[row], best.q[row], near.q[row]])
    for threads in (1, 3):
        assert np.array_equal(panda.best_batch(targets, threads=threads).q, best.q, equal_nan=True)
    one = panda.best_batch(targets, "nearest", q0=q[0])
    assert np.allclose(one.q[0], q[0], atol=1e-6)


def test_solve_batch_has_the_solutions_of_solve(panda, random):
    q = random.uniform(LIMITS[:, 0], LIMITS[:, 1], (6, 7))
    targets = np.stack([reach(own) for own in q])
    batch, near = panda.solve_batch(targets), panda.solve_batch(targets, near=q)
    for row, target in enumerate(targets):
        solutions = panda.solve(target)
        assert np.array_equal(batch[row], [solution.q for solution in solutions])
        assert batch.status[row] == (Status.SOLVED if all(own.settled for own in solutions) else Status.UNSETTLED)
    assert np.allclose(near.q, q, atol=1e-6) and (near.counts == 1).all()
    assert batch.residual.max() < 1e-9
    padded = panda.solve_batch(targets, layout="padded", limits={"panda_joint1": (-2.0, 2.0)})
    assert np.nanmax(np.abs(padded.q[..., 0])) <= 2.0 + 1e-9
    out = np.empty((200, 7))
    assert np.shares_memory(panda.solve_batch(targets, out=out).q, out) and np.array_equal(out[: len(batch.q)], batch.q)
    with pytest.raises(BadValueError, match="too few rows"):
        panda.solve_batch(targets, out=np.empty((1, 7)))


def test_rows_that_are_no_targets_are_reported(panda, target):
    targets = np.stack([target, 2 * target, target, np.full((4, 4), np.nan)])
    wanted = [Status.SOLVED, Status.NOT_ROTATION, Status.SOLVED, Status.NOT_FINITE]
    q0 = np.tile(READY, (4, 1))
    batches = [panda.any_within_batch(targets), panda.best_batch(targets), panda.solve_batch(targets)]
    for batch in [*batches, panda.best_batch(targets, "nearest", q0=q0)]:
        assert batch.status.tolist() == wanted
    for batch in (panda.any_within_batch, panda.best_batch, panda.solve_batch):
        with pytest.raises(BadValueError, match="row 1"):
            batch(targets, strict=True)
        assert len(batch(np.zeros((0, 4, 4)))) == 0


def test_a_path_follows_poses_without_a_jump(panda):
    route = READY + np.linspace(0, 0.4, 9)[:, None] * [0.4, 0.3, -0.4, 0.3, 0.3, 0.2, -0.5]
    poses = np.stack([reach(q) for q in route])
    for options in ({}, {"dt": 1.0, "speeds": np.full(7, 0.1)}, {"times": np.arange(9.0), "speeds": np.full(7, 0.1)}):
        path = panda.solve_path(poses, READY, **options)
        assert path.jumps == [] and not path.is_unsure and path.arcs.shape == (9,)
        for pose, q in zip(poses, path.q):
            assert_solves(pose, q)
        assert np.abs(np.diff(path.q, axis=0)).max() <= (0.1 if options else 0.5)
    narrow = panda.solve_path(poses, limits={"panda_joint1": (-0.2, 0.6)})
    assert (narrow.q[:, 0] >= -0.2 - 1e-9).all() and (narrow.q[:, 0] <= 0.6 + 1e-9).all()


def test_a_path_that_must_jump_names_the_joint(panda, target):
    other = reach(np.array([2.0, 0.8, 1.0, -1.0, -1.5, 2.5, -2.0]))
    path = panda.solve_path(np.stack([target, target, other]), READY)
    (jump,) = path.jumps
    assert jump.index == 2 and abs(jump.step) > 0.5 and "panda_joint" in jump.why
    far = np.eye(4)
    far[:3, 3] = 9.0
    with pytest.raises(BadValueError, match="target 2.*unreachable"):
        panda.solve_path(np.stack([target, far]))


def test_a_placed_arm_has_the_same_arcs(panda, target):
    base, tool = np.eye(4), np.eye(4)
    base[:3, 3], tool[2, 3] = (1.0, 2.0, 0.5), 0.1
    base[:2, :2] = [[0, -1], [1, 0]]
    placed, world = panda.placed(base=base, tool=tool), base @ target @ tool
    assert placed.is_redundant and placed.joints == NAMES
    lengths = sorted(arc.length for arc in panda.arcs(target))
    assert np.allclose(sorted(arc.length for arc in placed.arcs(world)), lengths, atol=1e-6)
    for q in (placed.any_within(world).q, placed.best(world).q, placed.solve(world, q0=READY)[0].q, placed.best_batch(world[None]).q[0]):
        assert_solves(target, q)
    assert np.allclose(placed.nearest(world, READY).q, READY, atol=1e-6)
    assert np.allclose(placed.solve_path(world[None], READY).q, READY, atol=0.1)


def test_a_redundant_solver_is_pickled(panda, target):
    again = pickle.loads(pickle.dumps(panda))
    assert again.is_redundant
    assert np.array_equal([own.q for own in again.solve(target)], [own.q for own in panda.solve(target)])
    for record in (panda.best(target), panda.any_within(target), panda.best_batch(target[None]), panda.solve_path(target[None])):
        assert np.array_equal(pickle.loads(pickle.dumps(record)).q, record.q)


def test_arcs_are_not_pickled(panda, target):
    arcs = panda.arcs(target)
    for own in (arcs, arcs[0]):
        with pytest.raises(TypeError, match="pickle the solver and the target"):
            pickle.dumps(own)


def test_the_closest_joint_values_need_no_given_joint(panda, planar, target):
    found = panda.closest(target)
    assert found.reachable and found.distance < 1e-9
    assert_solves(target, found.q)
    far = target.copy()
    far[:3, 3] += 0.9, 0.1, 0.2
    found = panda.closest(far, length=0.4)
    assert not found.reachable and found.is_minimum and (found.q >= LIMITS[:, 0]).all() and (found.q <= LIMITS[:, 1]).all()
    assert np.abs(reach(found.q) - found.reached).max() < 1e-9
    # Every value of the given joint has an error that is not smaller.
    low, high = LIMITS[NAMES.index(panda.given[0])]
    error = lambda own: own.distance**2 + (2 * 0.4 * np.sin(own.angle / 2)) ** 2
    for value in np.linspace(low, high, 9):
        assert error(found) <= error(panda.closest(far, length=0.4, given=value, limits=True)) + 1e-9
    # Three links of 1.05 m in all; with the elbow bent by at least 1 rad, by the law of cosines.
    assert abs(planar.closest([3.0, 4.0]).distance - 3.95) < 1e-9
    bent = planar.closest([0.0, 2.0], limits=[[-np.inf, np.inf], [1.0, 2.0], [0.0, 0.5]])
    assert abs(bent.distance - (2.0 - np.sqrt(0.5**2 + 0.55**2 + 2 * 0.5 * 0.55 * np.cos(1.0)))) < 1e-9
    for wrong in ({"length": 0.0}, {"limits": LIMITS[:6]}, {"limits": {"elbow": (0.0, 1.0)}}):
        with pytest.raises(BadValueError):
            panda.closest(far, **wrong)


@pytest.mark.parametrize(
    ("limits", "kind"),
    [
        *[({"panda_joint1": pair}, "bad_value") for pair in ((0.5, -0.5), (np.nan, 1.0), (5.0, 6.0), (0.0, 1.0, 2.0))],
        ({"elbow": (0.0, 1.0)}, "unknown_name"),
        ({3: (0.0, 1.0)}, "bad_value"),
        (LIMITS[:6], "bad_value"),
        (LIMITS[:, ::-1], "bad_value"),
        (np.full((7, 2), np.nan), "bad_value"),
    ],
)
def test_wrong_limits_are_refused(panda, target, limits, kind):
    calls = [panda.solve, panda.arcs, panda.any_within, panda.best, panda.optima]
    batches = [panda.solve_batch, panda.any_within_batch, panda.best_batch, panda.solve_path]
    for call, own in [(call, target) for call in calls] + [(call, target[None]) for call in batches]:
        with pytest.raises(BadValueError) as raised:
            call(own, limits=limits)
        assert raised.value.kind == kind


@pytest.mark.parametrize(
    "wrong",
    [np.zeros((3, 4)), np.zeros(5), 2 * np.eye(4), np.full((4, 4), np.nan), np.diag([1.0, 1.0, -1.0, 1.0]), np.eye(4, dtype=complex), None, "T", [[1, 2], [3]], np.zeros((2, 4, 4))],
)
def test_what_is_no_target_is_refused(panda, wrong):
    for call in (panda.solve, panda.arcs, panda.any_within, panda.best, lambda wrong: panda.nearest(wrong, READY)):
        with pytest.raises((ValueError, TypeError)):
            call(wrong)


@pytest.mark.parametrize(
    ("criterion", "options", "words"),
    [
        ("fast", {}, "margin, relative_margin, nearest"),
        ("nearest", {}, "needs `q0`"),
        ("nearest", {"q0": np.zeros(6)}, "(7,)"),
        ("nearest", {"q0": np.full(7, np.nan)}, "panda_joint1"),
        ("nearest", {"q0": READY, "weights": -np.ones(7)}, "weights"),
        ("nearest", {"q0": READY, "weights": np.ones(3)}, "(7,)"),
        ("margin", {"q0": READY}, "does not use `q0`"),
        ("change", {"joint": 0}, "needs `value`"),
        ("change", {"joint": "elbow", "value": 0.0}, "panda_joint7"),
        ("change", {"joint": 7, "value": 0.0}, "give 0 to 6"),
        ("change", {"joint": 0, "value": np.inf}, "finite"),
    ],
)
def test_wrong_criteria_are_refused(panda, target, criterion, options, words):
    for call, own in ((panda.best, target), (panda.optima, target), (panda.best_batch, target[None])):
        with pytest.raises(BadValueError) as raised:
            call(own, criterion, **options)
        assert words in str(raised.value)


def test_wrong_joint_values_and_times_are_refused(panda, target):
    for q0 in (np.zeros(6), np.full(7, np.nan), np.zeros((2, 7))):
        for call in (lambda q0: panda.solve(target, q0=q0), lambda q0: panda.nearest(target, q0), lambda q0: panda.solve_path(target[None], q0)):
            with pytest.raises(BadValueError):
                call(q0)
    with pytest.raises(BadValueError, match="2 rows"):
        panda.best_batch(np.stack([target] * 3), "nearest", q0=np.zeros((2, 7)))
    wrong = [{"dt": 0.0}, {"dt": np.nan}, {"times": [0.0]}, {"times": [1.0, 0.0]}, {"times": [0.0, np.nan]}, {"dt": 1.0, "times": [0.0, 1.0]}, {"dt": 1.0, "speeds": np.zeros(7)}]
    for options in wrong:
        with pytest.raises(BadValueError):
            panda.solve_path(np.stack([target] * 2), **options)
    with pytest.raises(BadValueError, match="row 1"):
        panda.solve_path(np.stack([target, 2 * target]))


def test_the_snippet_of_the_documentation_runs(panda, monkeypatch):
    page = (REPOSITORY / "docs/python.md").read_text()
    (code,) = re.findall(r"^## Redundant arms\n.*?```python\n(.*?)```", page, re.DOTALL | re.MULTILINE)
    monkeypatch.setattr(groebot, "derive", lambda path: {PANDA_URDF: panda}[REPOSITORY / path])
    exec(compile(code, "python.md", "exec"), {"groebot": groebot, "np": np})


def test_other_solvers_have_no_arcs():
    ur5 = Solver.named("ur5")
    pose = ur5.forward(np.zeros(6))
    for call, own in ((ur5.arcs, pose), (ur5.any_within, pose), (ur5.best, pose), (ur5.best_batch, pose[None]), (ur5.placed().arcs, pose)):
        with pytest.raises(GroebotError, match="not redundant") as raised:
            call(own)
        assert raised.value.kind == "unsupported"
    with pytest.raises(GroebotError, match="redundant"):
        ur5.solve_path(pose[None], limits=ur5.limits)
