"""Curves of solutions of a target, without limits: found from random starts by Newton's method, and traced around by small steps."""

from dataclasses import dataclass

import numpy as np

from arm import Arm, wrap

REACHED = 1e-11
"""Greatest residual of a solution (lengths over the arm's length, angles in rad)."""
STEP, TURN = 0.03, 0.06
"""Longest step [rad in joint space], and greatest angle between the tangents of a step."""
MOST_CURVES = 40
"""Rounds of tracing. A target with so many curves has a surface of solutions."""
LEAST, STEPS = 1e-7, 6000
"""The shortest step before a curve counts as singular, and the most steps of a curve."""


@dataclass
class Curve:
    """Points of a curve in order (n, 7), not wrapped, with unit tangents (n, 7). If it is closed, the last point is the first one plus whole turns."""

    q: np.ndarray
    tangent: np.ndarray
    is_closed: bool
    hits: int = 0


def solutions(arm: Arm, turns: np.ndarray, places: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Newton's method, damped, from each start (n, 7) for the target of the same row; rows that do not converge are NaN."""
    q, damping = starts.copy(), np.full(len(starts), 1e-2)
    left, jacobian = arm.residual(q, turns, places)
    error = np.linalg.norm(left, axis=1)
    active = np.arange(len(q))
    for _ in range(120):
        j, r = jacobian[active], left[active]
        square = j @ j.transpose(0, 2, 1) + (damping[active] * np.minimum(error[active], 1))[:, None, None] * np.eye(6) + 1e-15 * np.eye(6)
        step = (j.transpose(0, 2, 1) @ np.linalg.solve(square, r[:, :, None]))[:, :, 0]
        step *= np.minimum(1, 1.0 / np.maximum(np.linalg.norm(step, axis=1), 1e-9))[:, None]
        tried = q[active] + step
        new_left, new_jacobian = arm.residual(tried, turns[active], places[active])
        new_error = np.linalg.norm(new_left, axis=1)
        better = (new_error < error[active]) | (new_error < REACHED)
        rows = active[better]
        q[rows], left[rows], jacobian[rows], error[rows] = tried[better], new_left[better], new_jacobian[better], new_error[better]
        damping[active] = np.clip(np.where(better, damping[active] / 3, damping[active] * 4), 1e-9, 1e3)
        active = active[error[active] > 1e-13]
        if len(active) == 0:
            break
    # A rotation by pi has a zero residual: it must be compared itself.
    turn, place, _, _ = arm.frames(q)
    off = np.abs(turn - turns).max(axis=(1, 2)) + np.abs(place - places).max(axis=1)
    q[(error > REACHED) | (off > 1e-9)] = np.nan
    return wrap(q)


def tangents(jacobian: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Unit null vectors of (n, 6, 7), in the direction of `along` (n, 7). Where it is not unique: NaN or inaccurate."""
    system = np.concatenate([jacobian, along[:, None]], axis=1)
    right = np.zeros((len(system), 7, 1))
    right[:, 6] = 1
    with np.errstate(all="ignore"):
        found = _solve(system, right)[:, :, 0]
        return found / np.linalg.norm(found, axis=1)[:, None]


def _solve(system: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Solves each system; NaN for all if one is exactly singular and the others must be solved singly."""
    try:
        return np.linalg.solve(system, right)
    except np.linalg.LinAlgError:
        out = np.full_like(right, np.nan)
        for i in range(len(system)):
            try:
                out[i] = np.linalg.solve(system[i], right[i])
            except np.linalg.LinAlgError:
                pass
        return out


def null_vectors(jacobian: np.ndarray) -> np.ndarray:
    """Null vectors by singular values (n, 7), of either sign."""
    return np.linalg.svd(jacobian)[2][:, 6]


class Tracer:
    """Traces several curves at the same time, one row each, from `starts` in the direction of `along`."""

    def __init__(self, arm: Arm, targets: tuple[np.ndarray, np.ndarray], starts: np.ndarray, along: np.ndarray):
        self.arm, self.targets = arm, targets
        self.starts, self.along = starts, along
        count = len(starts)
        self.q, self.t, self.h = starts.copy(), along.copy(), np.full(count, STEP / 4)
        self.taken = np.zeros(count, dtype=int)
        self.points = [[row] for row in starts]
        self.directions = [[row] for row in along]
        self.is_closed = np.zeros(count, dtype=bool)

    def run(self) -> list[Curve]:
        active = np.arange(len(self.q))
        while len(active):
            active = self._step(active)
        return [Curve(np.array(p), np.array(d), bool(c)) for p, d, c in zip(self.points, self.directions, self.is_closed)]

    def _step(self, rows: np.ndarray) -> np.ndarray:
        """One step of the curves `rows`: those that go on."""
        turns, places = self.targets[0][rows], self.targets[1][rows]
        q, t, h = self.q[rows], self.t[rows], self.h[rows]
        new, tangent, good = self._corrected(q + h[:, None] * t, t, h, (turns, places))
        self.h[rows] = np.where(good, np.minimum(h * 1.4, STEP), h / 2)
        ended = ~good & (h < LEAST)
        for row, point, direction in zip(rows[good], new[good], tangent[good]):
            if self._closes(row, point):
                self.is_closed[row] = True
                self.points[row].append(self.q[row] + wrap(self.starts[row] - self.q[row]))
                self.directions[row].append(self.along[row])
            else:
                self.points[row].append(point)
                self.directions[row].append(direction)
                self.q[row], self.t[row] = point, direction
                self.taken[row] += 1
        return rows[~ended & ~self.is_closed[rows] & (self.taken[rows] < STEPS)]

    def _corrected(self, q: np.ndarray, t: np.ndarray, h: np.ndarray, target: tuple) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Newton's method at right angles to `t`: points, tangents, and where the step is acceptable."""
        good = np.ones(len(q), dtype=bool)
        with np.errstate(all="ignore"):
            for i in range(4):
                left, jacobian = self.arm.residual(q, *target)
                right = np.concatenate([left, np.zeros((len(q), 1))], axis=1)[:, :, None]
                step = _solve(np.concatenate([jacobian, t[:, None]], axis=1), right)[:, :, 0]
                if i == 0:
                    good &= np.linalg.norm(step, axis=1) < 0.1 * h
                q = q + step
            left, jacobian = self.arm.residual(q, *target)
            tangent = tangents(jacobian, t)
            good &= np.linalg.norm(left, axis=1) < REACHED
            good &= np.linalg.norm(tangent - t, axis=1) < TURN
        return q, tangent, good

    def _closes(self, row: int, point: np.ndarray) -> bool:
        """Whether the start is between the last point and the new one."""
        if self.taken[row] < 3:
            return False
        off, step = wrap(self.starts[row] - self.q[row]), point - self.q[row]
        size = np.linalg.norm(step)
        along = off @ step / size
        return bool(0 < along <= size and np.linalg.norm(off - along * step / size) < 0.03 * size and self.along[row] @ self.t[row] > 0.9)


def traced(arm: Arm, targets: tuple[np.ndarray, np.ndarray], starts: np.ndarray) -> list[Curve]:
    """The whole curves through `starts`; a curve that is not closed is traced to both ends."""
    along = null_vectors(arm.residual(starts, *targets)[1])
    curves = Tracer(arm, targets, starts, along).run()
    opened = [i for i, curve in enumerate(curves) if not curve.is_closed]
    if opened:
        back = Tracer(arm, (targets[0][opened], targets[1][opened]), starts[opened], -along[opened]).run()
        for i, other in zip(opened, back):
            q = np.concatenate([other.q[:0:-1], curves[i].q])
            tangent = np.concatenate([-other.tangent[:0:-1], curves[i].tangent])
            curves[i] = Curve(q, tangent, False)
    return curves


def on_curve(curve: Curve, points: np.ndarray) -> np.ndarray:
    """Which of the points (n, 7) are on the curve: no farther from its nearest point along the tangent than a step, and next to the tangent."""
    out = np.zeros(len(points), dtype=bool)
    for i, point in enumerate(points):
        off = wrap(point - curve.q)
        nearest = np.argmin((off**2).sum(axis=1))
        off, tangent = off[nearest], curve.tangent[nearest]
        along = off @ tangent
        out[i] = abs(along) < STEP and np.linalg.norm(off - along * tangent) < 0.1 * STEP * STEP + 0.06 * abs(along)
    return out


def all_curves(arm: Arm, targets: tuple[np.ndarray, np.ndarray], found: list[np.ndarray]) -> list[list[Curve]]:
    """All curves of each target, from the solutions `found` of each: rounds of one curve a target until every solution is on a curve."""
    curves: list[list[Curve]] = [[] for _ in found]
    left = [np.arange(len(points)) for points in found]
    for _ in range(MOST_CURVES):
        rows = [i for i, open_points in enumerate(left) if len(open_points)]
        if not rows:
            break
        starts = np.array([found[i][left[i][0]] for i in rows])
        for i, curve in zip(rows, traced(arm, (targets[0][rows], targets[1][rows]), starts)):
            hit = on_curve(curve, found[i][left[i]])
            hit[0] = True
            curve.hits = int(hit.sum())
            curves[i].append(curve)
            left[i] = left[i][~hit]
    return curves

