"""The parts of a curve within the limits: end points, lengths, greatest margin."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from arm import Arm, wrap
from trace import Curve, tangents

TOUCH = 1e-8
"""Margins [rad] and distances along the curve below which joints are at their limits at the same point."""
REPEATED = 1e-6
"""A single point within the limits is not listed if the end of an arc is so near [rad]."""
FAR = 0.1
"""A piece of the curve is outside if a joint is farther beyond its limit at one end [rad]: pieces are shorter."""


@dataclass
class End:
    """An end of an arc: the joint vector, and the joints at limits there as (joint, is upper). Without any: the curve ends there, at a singular pose."""

    q: np.ndarray
    joints: list[tuple[int, bool]]


@dataclass
class Part:
    """An arc; a closed one has no ends. `margin` is its greatest least distance to a limit [rad],; `hits` counts random solutions on its curve."""

    ends: list[End]
    length: float
    margin: float
    best: np.ndarray
    is_closed: bool = False
    hits: int = 0
    sigma: float = field(default=0.0)


def without_repeats(parts: list[Part]) -> list[Part]:
    """Longest first, without points that are ends of other arcs: crossings of several joints at the same point, a little apart."""
    kept: list[Part] = []
    for part in sorted(parts, key=lambda part: -part.length):
        ends = [end.q for other in kept for end in other.ends]
        if part.length > 0 or not any(np.abs(wrap(q - part.best)).max() < REPEATED for q in ends):
            kept.append(part)
    return kept


@dataclass
class Event:
    """A joint passes a limit at the position `s` of the curve."""

    s: float
    q: np.ndarray


def piece_length(a: np.ndarray, b: np.ndarray, ta: np.ndarray, tb: np.ndarray) -> float:
    """Length of a short piece of a curve: its chord, corrected for the angle between the tangents."""
    return float(np.linalg.norm(b - a) * (1 + ((ta - tb) ** 2).sum() / 24))


class Cutter:
    """Cuts one curve of a target."""

    def __init__(self, arm: Arm, target: tuple[np.ndarray, np.ndarray], curve: Curve, onto: Callable | None = None):
        self.arm, self.target, self.curve = arm, (target[0][None], target[1][None]), curve
        self.onto = onto
        self.q, self.t = list(curve.q), list(curve.tangent)
        # A joint that is constant on the curve is only tested. Next to the ends of the curve the tangents are inaccurate.
        self.moving = [np.ptp(curve.q[:, i]) > 1e-7 for i in arm.limited]

    def cubic(self, a: int, share: np.ndarray) -> np.ndarray:
        """Points between samples a and a + 1 (n, 7) by a cubic: off the curve by about the fourth power of the step."""
        p, r, size = self.q[a], self.q[a + 1], np.linalg.norm(self.q[a + 1] - self.q[a])
        s = np.asarray(share)[:, None]
        return p + (r - p) * s**2 * (3 - 2 * s) + size * s * (1 - s) * ((1 - s) * self.t[a] - s * self.t[a + 1])

    def between(self, a: int, share: float) -> tuple[np.ndarray, np.ndarray]:
        """The point and tangent of the curve at a share of the piece from sample a to a + 1: the cubic, then Newton's method."""
        along = (1 - share) * self.t[a] + share * self.t[a + 1]
        along = along / np.linalg.norm(along)
        q = self.cubic(a, np.array([share]))
        for _ in range(2):
            left, jacobian = self.arm.residual(q, *self.target)
            q = q + self._least_change(jacobian[0], left[0], along)
        return q[0], self._tangent(jacobian[0], along)

    @staticmethod
    def _tangent(jacobian: np.ndarray, along: np.ndarray) -> np.ndarray:
        """The unit tangent; where it is not unique, the given direction."""
        if abs(np.linalg.det(np.vstack([jacobian, along]))) < 1e-10:
            return along
        tangent = tangents(jacobian[None], along[None])[0]
        return tangent if np.all(np.isfinite(tangent)) else along

    @staticmethod
    def _least_change(jacobian: np.ndarray, left: np.ndarray, along: np.ndarray) -> np.ndarray:
        """The correction at right angles to the curve, without directions that the Jacobian hardly has."""
        system = np.vstack([jacobian, along])
        step = np.linalg.solve(system, np.append(left, 0.0)) if abs(np.linalg.det(system)) > 1e-9 else np.full(7, np.inf)
        if np.linalg.norm(step) < 0.01:
            return step
        u, sizes, v = np.linalg.svd(jacobian, full_matrices=False)
        return v.T @ np.where(sizes > 1e-7, (u.T @ left) / np.maximum(sizes, 1e-7), 0.0)

    def refine(self) -> None:
        """Adds the points where a joint turns back next to a limit, so that no pair of crossings is between two samples."""
        extra = []
        rates = np.array(self.t)[:, self.arm.limited]
        margins = self.arm.margins(np.array(self.q))
        for a in self._near(margins):
            reach = 1.5 * np.linalg.norm(self.q[a + 1] - self.q[a])
            for m, joint in enumerate(self.arm.limited):
                if self.moving[m] and rates[a, m] * rates[a + 1, m] < 0 and np.abs(margins[a, m]).min() < reach:
                    extra.append((a, self._turning(a, joint)))
        for a, share in sorted(extra, reverse=True):
            q, t = self.between(a, share)
            if 1e-12 < np.linalg.norm(q - self.q[a]) and 1e-12 < np.linalg.norm(q - self.q[a + 1]):
                self.q.insert(a + 1, q)
                self.t.insert(a + 1, t)

    def _turning(self, a: int, joint: int) -> float:
        """The share at which the rate of the joint is zero, on the cubic."""
        shares = np.linspace(0, 1, 101)
        for _ in range(3):
            values = self.cubic(a, shares)[:, joint] * np.sign(self.t[a][joint])
            k = int(np.argmax(values))
            shares = np.linspace(shares[max(k - 1, 0)], shares[min(k + 1, 100)], 101)
        return float(shares[50])

    def parts(self) -> list[Part]:
        self.refine()
        q, t = np.array(self.q), np.array(self.t)
        lengths = [piece_length(*x) for x in zip(q, q[1:], t, t[1:])]
        self.s = np.concatenate([[0], np.cumsum(lengths)])
        self.margins = self.arm.margins(q)
        events = self._clusters(self._events())
        if not events:
            return self._whole()
        return self._arcs(events)

    @staticmethod
    def _near(margins: np.ndarray) -> np.ndarray:
        """The pieces that can be inside."""
        least = margins.min(axis=(1, 2), initial=np.inf)
        return np.flatnonzero(np.minimum(least[:-1], least[1:]) > -FAR)

    def _events(self) -> list[Event]:
        events, near = [], np.zeros(len(self.q) - 1, dtype=bool)
        near[self._near(self.margins)] = True
        for m, joint in enumerate(self.arm.limited):
            if not self.moving[m]:
                continue
            for side in range(2):
                f = self.margins[:, m, side]
                for a in np.flatnonzero(((f[:-1] >= 0) != (f[1:] >= 0)) & near):
                    events.append(self._crossing(a, m, side))
        return sorted(events, key=lambda event: event.s)

    def _crossing(self, a: int, m: int, side: int) -> Event:
        """Solves for the limit between two samples: regula falsi (Illinois), each point on the curve."""
        low, high = 0.0, 1.0
        f, g = self.margins[a, m, side], self.margins[a + 1, m, side]
        share, q, t = (0.0, self.q[a], self.t[a]) if abs(f) < abs(g) else (1.0, self.q[a + 1], self.t[a + 1])
        for _ in range(60):
            if abs(f) < 1e-14 or abs(g) < 1e-14 or high - low < 1e-13:
                break
            share = (low * g - high * f) / (g - f)
            q, t = self.between(a, share)
            value = float(self.arm.margins(q[None])[0, m, side])
            if abs(value) < 1e-13:
                break
            if (value >= 0) == (g >= 0):
                high, g, f = share, value, f / 2
            else:
                low, f, g = share, value, g / 2
        return Event(self.s[a] + piece_length(self.q[a], q, self.t[a], t), q)

    def _clusters(self, events: list[Event]) -> list[Event]:
        """Crossings at the same point are one event."""
        out: list[Event] = []
        for event in events:
            if not out or event.s - out[-1].s > TOUCH:
                out.append(event)
        if self.curve.is_closed and len(out) > 1 and out[0].s + self.s[-1] - out[-1].s < TOUCH:
            out.pop()
        return out

    def _at(self, s: float) -> tuple[np.ndarray, np.ndarray]:
        """The point and tangent at a position of the curve."""
        s = s % self.s[-1] if self.curve.is_closed else s
        a = int(np.clip(np.searchsorted(self.s, s) - 1, 0, len(self.q) - 2))
        size = self.s[a + 1] - self.s[a]
        return self.between(a, (s - self.s[a]) / size if size > 0 else 0.0)

    def _least(self, q: np.ndarray) -> float:
        """The least distance to a limit; infinite for an arm without limits."""
        return float(self.arm.margins(q[None]).min(initial=np.inf))

    def _whole(self) -> list[Part]:
        """A curve without crossings is inside or outside."""
        middle = self._at(self.s[-1] / 2)[0]
        if self._least(middle) < -TOUCH:
            return []
        best, margin = self._greatest(0, self.s[-1])
        ends = [] if self.curve.is_closed else [End(self.q[0], []), End(self.q[-1], [])]
        return [Part(ends, float(self.s[-1]), margin, best, self.curve.is_closed, self.curve.hits)]

    def _arcs(self, events: list[Event]) -> list[Part]:
        """The pieces between events that are inside; neighbours that are both inside are one arc."""
        marks = [(event.s, event.q) for event in events]
        if self.curve.is_closed:
            marks.append((marks[0][0] + self.s[-1], marks[0][1]))
        else:
            marks = [(0.0, self.q[0]), *marks, (self.s[-1], self.q[-1])]
        inside = [self._least(self._at((a[0] + b[0]) / 2)[0]) >= -1e-11 for a, b in zip(marks, marks[1:])]
        if all(inside) and self.curve.is_closed:
            return self._whole()
        first = inside.index(False) if self.curve.is_closed else 0
        order = range(first, first + len(inside))
        runs, run = [], None
        for i in order:
            k, turn = i % len(inside), i // len(inside) * self.s[-1]
            if inside[k]:
                start = marks[k][0] + turn
                run = (run[0] if run else start, marks[k + 1][0] + turn)
            if not inside[k] or i == order[-1]:
                if run:
                    runs.append(run)
                run = None
        return [self._part(*run) for run in runs] + self._points(marks, inside)

    def _points(self, marks: list, inside: list[bool]) -> list[Part]:
        """Points within the limits whose both sides are outside."""
        count, out = len(inside), []
        for k in range(count if self.curve.is_closed else count - 1):
            left, right, (_, q) = inside[k - 1 if self.curve.is_closed else k], inside[k if self.curve.is_closed else k + 1], \
                marks[k if self.curve.is_closed else k + 1]
            if not left and not right and self._least(q) > -TOUCH:
                end = self._end(q)
                out.append(Part([end, end], 0.0, 0.0, q, False, self.curve.hits))
        return out

    def _end(self, q: np.ndarray) -> End:
        margins = self.arm.margins(q[None])[0]
        near = [(self.arm.limited[m], side == 0) for m, side in zip(*np.nonzero(np.abs(margins) < 10 * TOUCH))]
        return End(q, near)

    def _part(self, start: float, end: float) -> Part:
        best, margin = self._greatest(start, end)
        ends = [self._end(self._at(s)[0]) for s in (start, end)]
        return Part(ends, end - start, margin, best, False, self.curve.hits)

    def _greatest(self, start: float, end: float) -> tuple[np.ndarray, float]:
        """The point with the greatest least margin: on the cubics at 30 points a piece, then finer ones at the best."""
        pieces, shares = self._inside(start, end, 30)
        for _ in range(4):
            values = np.concatenate([self.arm.margins(self.cubic(a, x)).min(axis=(1, 2), initial=np.inf) for a, x in zip(pieces, shares)])
            flat = [(a, x) for a, xs in zip(pieces, shares) for x in xs]
            k = int(np.argmax(values))
            near = {a: [x for b, x in flat[max(k - 1, 0) : k + 2] if b == a] for a, _ in flat[max(k - 1, 0) : k + 2]}
            best = flat[k]
            pieces, shares = list(near), [np.linspace(min(xs), max(xs), 40) for xs in near.values()]
        q = self.between(*best)[0]
        return q, self._least(q)

    def _inside(self, start: float, end: float, count: int) -> tuple[list[int], list[np.ndarray]]:
        """The pieces that a stretch of the curve contains, with `count` shares of each; only those whose samples have the greatest margins."""
        total, pieces, shares = self.s[-1], [], []
        least = self.margins.min(axis=(1, 2), initial=np.inf)
        for turn in (0.0, total) if self.curve.is_closed else (0.0,):
            low = np.clip((start - turn - self.s[:-1]) / np.diff(self.s), 0, 1)
            high = np.clip((end - turn - self.s[:-1]) / np.diff(self.s), 0, 1)
            for a in np.flatnonzero(high > low):
                pieces.append(int(a))
                shares.append(np.linspace(low[a], high[a], count))
        tops = np.array([max(least[a], least[a + 1]) for a in pieces])
        kept = np.flatnonzero(tops >= np.sort(tops)[-20 if len(tops) > 20 else 0])
        return [pieces[k] for k in kept], [shares[k] for k in kept]
