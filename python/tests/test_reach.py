"""Maps of what solvers reach, against batches of poses that numpy makes."""

import json

import numpy as np
import pytest
from tools import need

import groebot
from groebot import BadValueError, ReachMap, Solver, reach_map

GRID = {"x": (-0.8, 0.8, 5), "y": np.linspace(0.1, 0.7, 4), "z": 0.3}


def spiral(count):
    """The super-Fibonacci spiral of its paper (M. Alexa, CVPR 2022), as matrices: (count, 3, 3)."""
    s = np.arange(count) + 0.5
    t, d = s / count, 2 * np.pi * s
    r, big, alpha, beta = np.sqrt(t), np.sqrt(1 - t), d / np.sqrt(2), d / 1.533751168755204288118041
    x, y, z, w = r * np.sin(alpha), r * np.cos(alpha), big * np.sin(beta), big * np.cos(beta)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def poses(made, orientations):
    """All poses of a map's grid: (x, y, z, orientations, 4, 4)."""
    x, y, z = np.meshgrid(made.x, made.y, made.z, indexing="ij")
    out = np.zeros((*x.shape, orientations, 4, 4))
    out[..., :3, :3] = spiral(orientations)
    out[..., :3, 3] = np.stack([x, y, z], -1)[..., None, :]
    out[..., 3, 3] = 1
    return out


def interpreted(solver):
    """The same solver under a name that is not compiled."""
    told = json.loads(solver.to_json())
    told["program"]["name"] = "another"
    return Solver.from_json(json.dumps(told))


@pytest.fixture(scope="module")
def ur5():
    return Solver.named("ur5")


@pytest.mark.parametrize("limits", [None, [[-2.0, 2.0], [-3, 0], [0, 2.5], [-6, 6], [-2, 2], [-6, 6]]])
def test_counts_are_those_of_batches(ur5, limits):
    made = reach_map(ur5, GRID, 60, limits=limits)
    assert made.reached.shape == (5, 4, 1) and made.reached.dtype == np.uint32 and made.limited == (limits is not None)
    batch = ur5.solve_batch(poses(made, 60).reshape(-1, 4, 4), limits=limits)
    counts = batch.counts.reshape(*made.reached.shape, 60)
    np.testing.assert_array_equal(made.answers, counts.sum(-1))
    np.testing.assert_array_equal(made.reached, (counts > 0).sum(-1))
    np.testing.assert_allclose(made.index, (counts > 0).mean(-1))
    assert 0 < made.index.mean() < 1
    other = reach_map(interpreted(ur5), GRID, 60, limits=limits)
    np.testing.assert_array_equal(other.answers, made.answers)


def test_manipulability_is_that_of_jacobians(ur5):
    made = reach_map(ur5, GRID, 25, "manipulability")
    batch = ur5.solve_batch(poses(made, 25).reshape(-1, 4, 4))
    own = np.abs(np.linalg.det(ur5.jacobian(batch.q)))
    best = np.array([own[start:stop].max(initial=0) for start, stop in zip(batch.starts, batch.starts[1:])])
    best = best.reshape(*made.reached.shape, 25)
    np.testing.assert_allclose(made.best, best.max(-1), rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(made.mean, best.sum(-1) / np.maximum(made.reached, 1), rtol=1e-5, atol=1e-9)


def test_described_limits_are_asked_for_by_either_name():
    arm = Solver.named("nao_left_arm")
    grid = [(0, 0.2, 5), (0, 0.25, 5), (0, 0.25, 5)]
    by_measure, by_limits, free = reach_map(arm, grid, 40, "limits"), reach_map(arm, grid, 40, limits=True), reach_map(arm, grid, 40)
    np.testing.assert_array_equal(by_measure.answers, by_limits.answers)
    assert by_measure.limited and 0 < by_measure.answers.sum() < free.answers.sum() and free.unit == "m"
    with pytest.raises(BadValueError, match="no limits are described"):
        reach_map(Solver.named("puma"), GRID, 5, limits=True)


def test_given_joints_and_threads_and_seeds():
    arm = Solver.named("iiwa14")
    grid = {"x": (0.2, 0.6, 3), "y": 0.1, "z": (0.3, 0.9, 3)}
    one, two = (reach_map(arm, grid, 50, given=[0.4], seed=3, threads=threads) for threads in (1, 2))
    np.testing.assert_array_equal(one.answers, two.answers)
    assert not np.array_equal(one.answers, reach_map(arm, grid, 50, given=0.4, seed=4).answers)
    told = []
    for count in (6, 12, 24, 48, 96):
        axis = (-1, 1, count)
        reach_map(arm, [axis] * 3, 50, given=[0.4], progress=lambda *line: told.append(line))
        if told:
            break
    assert told and all(stage == "reach: places" for stage, _, _ in told)
    with pytest.raises(BadValueError, match="A3"):
        reach_map(arm, grid, 50)


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ({"w": 1.0}, "none of them"),
        ([0.1, 0.2], "three axes"),
        ({"x": [0, 1, 3, 4.0]}, "not evenly spaced"),
        ({"x": (1.0, 0.0, 4)}, "lesser"),
        ({"x": (0.0, 1.0, 0)}, "no places|without places"),
        ({"x": np.zeros((2, 2))}, "shape"),
        ({"x": np.nan}, "finite"),
        ({"x": (0, 1, 10**5), "y": (0, 1, 10**5)}, "at most"),
        ({"x": (0, 1, 10**30)}, "whole number"),
        ({"x": (0, 1, -2)}, "whole number"),
    ],
)
def test_what_is_no_grid_is_refused(ur5, grid, message):
    with pytest.raises(BadValueError, match=message):
        reach_map(ur5, grid)


def test_wrong_questions_are_refused(ur5):
    with pytest.raises(groebot.GroebotError, match="no measure"):
        reach_map(ur5, GRID, 10, "weight")
    for orientations in (0, -1, 10**30, 2.5):
        with pytest.raises(BadValueError, match="orientations"):
            reach_map(ur5, GRID, orientations)
    for seed in (-1, 1 << 64, 0.5):
        with pytest.raises(BadValueError, match="seed"):
            reach_map(ur5, GRID, 5, seed=seed)
    with pytest.raises(BadValueError, match="lesser one|limits"):
        reach_map(ur5, GRID, 5, limits=[[1, 0]] * 6)
    with pytest.raises(groebot.GroebotError, match="none is known here"):
        reach_map(Solver.from_json(json.dumps(json.loads(ur5.to_json())["program"])), GRID, 5, "manipulability")
    with pytest.raises(groebot.GroebotError, match="positions of one tip"):
        reach_map(Solver.named("nao_head"), GRID)


@pytest.mark.parametrize("measure", ["count", "manipulability"])
def test_maps_are_stored_and_read(tmp_path, ur5, measure):
    made = reach_map(ur5, GRID, 10, measure, seed=np.int64(2))
    again = ReachMap.from_json(made.to_json())
    assert repr(again) == repr(made) and again.axes == made.axes and again.seed == 2
    for name in ("reached", "answers", "open", "best", "mean"):
        own = getattr(made, name)
        assert own is None or (np.array_equal(own, getattr(again, name)) and own.dtype == getattr(again, name).dtype)
    made.save(tmp_path / "map.json")
    assert (tmp_path / "map.json").read_text() == made.to_json() == again.to_json()
    made.save(tmp_path / "map.csv")
    rows = np.genfromtxt(tmp_path / "map.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(rows["answers"], made.answers.ravel())
    made.save(tmp_path / "map.npz")
    with np.load(tmp_path / "map.npz") as stored:
        np.testing.assert_array_equal(stored["reached"], made.reached)
        np.testing.assert_array_equal(stored["y"], made.y)
    made.save(tmp_path / "map.svg")
    assert (tmp_path / "map.svg").read_text() == made._repr_svg_() and made.slices("x").svg.count(">x = ") == 5
    with pytest.raises(BadValueError, match="npz"):
        made.save(tmp_path / "map.txt")
    with pytest.raises(BadValueError, match="across"):
        made.slices("w")
    with pytest.raises(groebot.GroebotError):
        ReachMap.from_json("{}")


def test_a_map_is_seen_in_a_page(tmp_path, ur5):
    made = reach_map(ur5, GRID, 10)
    page = made.view(ur5, tmp_path / "ur5.html", open=False)
    assert '"reach":{"base":0,"of":"ur5, pose"' in page.path.read_text()


def test_blocks_are_the_map(tmp_path, ur5):
    need("pyarrow")
    import pyarrow.parquet as parquet

    from groebot import blocks
    from groebot.reach import Reach, read

    made = reach_map(ur5, GRID, 30, "manipulability", seed=5)
    work = Reach.of(ur5, GRID, 30, "manipulability", seed=5)
    done = blocks.run(work, tmp_path / "out", 7)
    assert work.rows == 20 and (done.written, done.found) == (3, 0)
    again = read(tmp_path / "out", work)
    for name in ("reached", "answers", "open", "best", "mean"):
        np.testing.assert_array_equal(getattr(again, name), getattr(made, name))
    # Each block alone has the same content, in another folder and in another order.
    for block in reversed(blocks.planned(work, tmp_path / "other", 7)):
        assert block.write(work)
    for path in done.files:
        assert path.read_bytes() == (tmp_path / "other" / path.name).read_bytes()
    made.save(tmp_path / "map.parquet")
    whole = parquet.read_table(tmp_path / "map.parquet")
    np.testing.assert_array_equal(np.concatenate([parquet.read_table(path)["x"] for path in done.files]), whole["x"])
    other = Reach.of(ur5, GRID, 31)
    with pytest.raises(BadValueError, match="other work"):
        blocks.planned(other, tmp_path / "out", 7)
    with pytest.raises(BadValueError, match="the same work"):
        read(tmp_path / "out", other)
