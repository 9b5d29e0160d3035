"""Forward kinematics and Jacobian of a chain of seven revolute joints, for many joint vectors at once. Only numpy; nothing is shared with groebot."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

TURN = 2 * np.pi


def wrap(angles: np.ndarray) -> np.ndarray:
    """Angles in [-pi, pi)."""
    return (angles + np.pi) % TURN - np.pi


def skew(vector: np.ndarray) -> np.ndarray:
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross products of the last axes."""
    return a[..., [1, 2, 0]] * b[..., [2, 0, 1]] - a[..., [2, 0, 1]] * b[..., [1, 2, 0]]


def rotation(axis: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Rotations about a unit axis: (..., 3, 3) for angles (...)."""
    k = skew(axis)
    s, c = np.sin(angles)[..., None, None], np.cos(angles)[..., None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def _numbers(element, tag: str, key: str, default: str) -> np.ndarray:
    child = element.find(tag)
    return np.array([float(x) for x in (child.get(key, default) if child is not None else default).split()])


class Arm:
    """A chain from a URDF that contains nothing else.

    `low` and `high` [rad] are infinite for a continuous joint. `limited` are the joints whose range is below one turn: angles are compared modulo 2 pi,
    so that others have no limit. `length` is the sum of the offsets [m], which weighs positions against angles.
    """

    def __init__(self, path: Path):
        self.name = path.stem
        joints = ElementTree.parse(path).getroot().findall("joint")
        self.fixed, self.axes, self.names, bounds = [], [], [], []
        turn, shift = np.eye(3), np.zeros(3)
        for joint in joints:
            roll, pitch, yaw = _numbers(joint, "origin", "rpy", "0 0 0")
            shift = shift + turn @ _numbers(joint, "origin", "xyz", "0 0 0")
            x, y, z = np.eye(3)
            turn = turn @ rotation(z, yaw) @ rotation(y, pitch) @ rotation(x, roll)
            if joint.get("type") == "fixed":
                continue
            axis = _numbers(joint, "axis", "xyz", "1 0 0")
            limit = joint.find("limit")
            endless = joint.get("type") == "continuous" or limit is None
            bounds.append([-np.inf, np.inf] if endless else [float(limit.get("lower", 0)), float(limit.get("upper", 0))])
            self.fixed.append((turn, shift))
            self.axes.append(axis / np.linalg.norm(axis))
            self.names.append(joint.get("name"))
            turn, shift = np.eye(3), np.zeros(3)
        self.tip = (turn, shift)
        self.low, self.high = np.array(bounds).T
        self.count = len(self.axes)
        self.limited = [i for i in range(self.count) if self.high[i] - self.low[i] < TURN]
        finite = np.isfinite(self.low) & np.isfinite(self.high)
        low, high = np.where(finite, self.low, 0.0), np.where(finite, self.high, 0.0)
        self.middle, self.half = (low + high) / 2, (high - low) / 2
        self._prepare()
        self.length = sum(np.linalg.norm(shift) for _, shift in [*self.fixed, self.tip])

    def _prepare(self) -> None:
        """Each joint's rotation, with the fixed one before it, is constant + sine * (...) + cosine * (...)."""
        squares = [(fixed, skew(axis)) for (fixed, _), axis in zip(self.fixed, self.axes)]
        self.constant = np.array([fixed @ (np.eye(3) + k @ k) for fixed, k in squares])
        self.of_sine = np.array([fixed @ k for fixed, k in squares])
        self.of_cosine = np.array([-fixed @ k @ k for fixed, k in squares])
        self.shifts = np.array([shift for _, shift in self.fixed] + [self.tip[1]])
        self.turned_axes = np.array(self.axes)

    def frames(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """For q (n, 7): rotation (n, 3, 3) and position (n, 3) of the tip in the base, axes (n, 7, 3) and points on them (n, 7, 3)."""
        each = self.constant + np.sin(q)[:, :, None, None] * self.of_sine + np.cos(q)[:, :, None, None] * self.of_cosine
        turns = np.empty((len(q), self.count + 1, 3, 3))
        turns[:, 0] = np.eye(3)
        for i in range(self.count):
            np.matmul(turns[:, i], each[:, i], out=turns[:, i + 1])
        points = np.cumsum((turns @ self.shifts[:, :, None])[..., 0], axis=1)
        axes = (turns[:, 1:] @ self.turned_axes[:, :, None])[..., 0]
        return turns[:, -1] @ self.tip[0], points[:, -1], axes, points[:, :-1]

    def pose(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rotation (3, 3) and position (3) of the tip for one joint vector."""
        turn, place, _, _ = self.frames(np.asarray(q, dtype=float)[None])
        return turn[0], place[0]

    def residual(self, q: np.ndarray, turns: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The remaining motion to the targets (n, 6), lengths over `length`, and the Jacobian (n, 6, 7) in the same units."""
        turn, place, axes, points = self.frames(q)
        left, jacobian = np.empty((len(q), 6)), np.empty((len(q), 6, self.count))
        left[:, :3] = (places - place) / self.length
        m = turns @ turn.transpose(0, 2, 1)
        left[:, 3:] = 0.5 * (m[:, [2, 0, 1], [1, 2, 0]] - m[:, [1, 2, 0], [2, 0, 1]])
        jacobian[:, :3] = cross(axes, (place[:, None] - points) / self.length).transpose(0, 2, 1)
        jacobian[:, 3:] = axes.transpose(0, 2, 1)
        return left, jacobian

    def margins(self, q: np.ndarray) -> np.ndarray:
        """Distances to the upper and lower limits of the limited joints (n, m, 2) [rad], negative beyond them, on the turn nearest to the range."""
        off = wrap(q[:, self.limited] - self.middle[self.limited])
        half = self.half[self.limited]
        return np.stack([half - off, half + off], axis=2)

    def lifted(self, q: np.ndarray) -> np.ndarray:
        """Limited joints on the turn of their range, others in [-pi, pi)."""
        out = wrap(q)
        out[..., self.limited] = self.middle[self.limited] + wrap(q[..., self.limited] - self.middle[self.limited])
        return out
