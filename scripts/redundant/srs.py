"""The curves of arms with a spherical shoulder and a spherical wrist, by the circle on which the elbow turns: no tracing.

    python srs.py ARMS_FOLDER RESULTS_FOLDER [--only ID,...] [--values 7200]

The distance from shoulder to wrist determines joint 4 (two values). The upper arm turns about the line from shoulder to wrist by the angle psi; joints 1-3 and
5-7 are Euler angles of the rotations that remain (two values each). Eight curves over psi, whose arcs are compared with those of witness.py.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from arm import TURN, Arm, cross, rotation, wrap
from cut import Cutter, Part, without_repeats
from trace import Curve


def unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def meeting(points: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """The point nearest to several lines; it must be on each of them within 1e-9."""
    across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
    point = np.linalg.solve(across.sum(axis=0), (across @ points[:, :, None]).sum(axis=0))[:, 0]
    off = np.linalg.norm((across @ (point - points)[:, :, None])[:, :, 0], axis=1).max()
    if off > 1e-9:
        raise ValueError(f"the axes pass each other at {off}")
    return point


def angle_between(axis: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The angles about `axis` from a to b (..., 3)."""
    a, b = a - (a @ axis)[..., None] * axis, b - (b @ axis)[..., None] * axis
    return np.arctan2(cross(a, b) @ axis, (a * b).sum(axis=-1))


def cosine_equation(a: float, b: float, values: np.ndarray) -> np.ndarray:
    """The two solutions of a cos x + b sin x = value (2, n); NaN where there is none. A value is clipped if it exceeds the amplitude by 1e-12."""
    ratio = values / np.hypot(a, b)
    ratio = np.where(np.abs(ratio) > 1 + 1e-12, np.nan, np.clip(ratio, -1, 1))
    return np.arctan2(b, a) + np.array([np.arccos(ratio), -np.arccos(ratio)])


def euler(turns: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Angles of rotations (n, 3, 3) about three fixed axes, as rotation(a, x) rotation(b, y) rotation(c, z): (2, n, 3)."""
    a, b, c = axes
    image = turns @ c
    along, side = c - (b @ c) * b, np.cross(b, c)
    middle = cosine_equation(a @ along, a @ side, image @ a - (a @ b) * (b @ c))
    out = []
    for y in middle:
        first = angle_between(a, rotation(b, y) @ c, image)
        rest = (rotation(a, first) @ rotation(b, y)).transpose(0, 2, 1) @ turns
        perpendicular = unit(np.cross(c, np.eye(3)[np.argmin(np.abs(c))]))
        out.append(np.stack([first, y, angle_between(c, np.broadcast_to(perpendicular, image.shape), rest @ perpendicular)], axis=1))
    return np.array(out)


class Circle:
    """The circle of an arm: points and axes at zero."""

    def __init__(self, arm: Arm):
        self.arm = arm
        turn, place, axes, points = arm.frames(np.zeros((1, 7)))
        self.axes, self.tip = axes[0], (turn[0], place[0])
        self.shoulder, self.wrist = meeting(points[0, :3], axes[0, :3]), meeting(points[0, 4:], axes[0, 4:])
        self.elbow = points[0, 3]

    def elbows(self, distance: float) -> np.ndarray:
        """The two values of joint 4: |elbow + rotation (wrist - elbow) - shoulder| is the distance."""
        axis, upper, fore = self.axes[3], self.elbow - self.shoulder, self.wrist - self.elbow
        along = (axis @ fore) * axis
        a, b = 2 * upper @ (fore - along), 2 * upper @ np.cross(axis, fore)
        rest = distance**2 - upper @ upper - fore @ fore - 2 * upper @ along
        return cosine_equation(a, b, np.array([rest]))[:, 0]

    def curves(self, target: tuple[np.ndarray, np.ndarray], values: int) -> list[Curve]:
        """The eight curves, at `values` angles psi. At an exactly straight elbow, four."""
        turn, place = target
        wrist = place - turn @ self.tip[0].T @ (self.tip[1] - self.wrist)
        line = wrist - self.shoulder
        elbows = self.elbows(np.linalg.norm(line))
        elbows = elbows[:1] if abs(wrap(elbows[0] - elbows[1])) < 1e-9 else elbows
        out = []
        for angle in elbows:
            if np.isfinite(angle):
                out += self._branch(turn, line, float(angle), values)
        return out

    def _branch(self, turn: np.ndarray, line: np.ndarray, angle: float, values: int) -> list[Curve]:
        elbow_turn = rotation(self.axes[3], np.array(angle))
        straight = self.elbow + elbow_turn @ (self.wrist - self.elbow) - self.shoulder
        psi = np.linspace(0, TURN, values, endpoint=False)
        upper = rotation(unit(line), psi) @ aligning(unit(straight), unit(line))
        lower = (upper @ elbow_turn).transpose(0, 2, 1) @ (turn @ self.tip[0].T)
        out = []
        for shoulder in euler(upper, self.axes[:3]):
            for wrist in euler(lower, self.axes[4:]):
                q = np.concatenate([shoulder, np.full((values, 1), angle), wrist], axis=1)
                if np.all(np.isfinite(q)):
                    out.append(closed(q))
        return out


def aligning(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """A rotation of the unit vector a to b."""
    axis = np.cross(a, b)
    if np.linalg.norm(axis) < 1e-12:
        axis = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
    return rotation(unit(axis), np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def closed(q: np.ndarray) -> Curve:
    """A closed curve through the points, with tangents by differences."""
    steps = wrap(np.diff(np.concatenate([q, q[:1]]), axis=0))
    path = np.concatenate([q[:1], q[0] + np.cumsum(steps, axis=0)])
    tangent = unit(steps + np.roll(steps, 1, axis=0))
    return Curve(path, np.concatenate([tangent, tangent[:1]]), True)


def arcs(circle: Circle, target: tuple[np.ndarray, np.ndarray], values: int) -> tuple[list[Part], float]:
    """The arcs of a pose, longest first, and the greatest step between two values of psi [rad]: large next to singular poses."""
    curves = circle.curves(target, values)
    parts = without_repeats([part for curve in curves for part in Cutter(circle.arm, target, curve).parts()])
    step = max([np.linalg.norm(np.diff(curve.q, axis=0), axis=1).max() for curve in curves], default=0.0)
    return parts, float(step)


def compared(arm: Arm, pose: dict, values: int) -> str:
    """The number of arcs and the greatest differences of lengths and margins, as text."""
    circle = Circle(arm)
    parts, step = arcs(circle, arm.pose(np.array(pose["q"]) if "q" in pose else np.radians(pose["degrees"])), values)
    theirs = [{"length": arc[0], "margin": arc[1]} for arc in pose.get("arcs", [])]
    same = len(parts) == len(theirs)
    lengths = max([abs(a.length - b["length"]) for a, b in zip(parts, theirs)], default=0.0) if same else float("nan")
    margins = max([abs(a - b) for a, b in zip(sorted(p.margin for p in parts), sorted(b["margin"] for b in theirs))], default=0.0) if same else float("nan")
    return f"{arm.name},{pose['kind']},{len(parts)},{len(theirs)},{lengths:.1e},{margins:.1e},{step:.3f},{pose.get('sigma')}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("arms", type=Path)
    parser.add_argument("results", type=Path)
    parser.add_argument("--only", default="iiwa14,openarm")
    parser.add_argument("--values", type=int, default=7200)
    args = parser.parse_args()
    print("arm,kind,arcs_of_circle,arcs_of_witness,length_difference,margin_difference,greatest_step,least_sigma")
    for name in args.only.split(","):
        arm = Arm(args.arms / f"{name}.urdf")
        for pose in json.loads((args.results / f"{name}.json").read_text())["poses"]:
            print(compared(arm, pose, args.values), flush=True)


if __name__ == "__main__":
    main()
