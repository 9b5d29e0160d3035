"""Frames of base and tip, and zero positions, that make two chains with equal joint axes equal.

Two descriptions of a robot may have other frames of base and tip, other zero positions of the joints and other senses of them. `fit` finds
the frames, zero positions and senses from the lines of the joint axes. The geometry between the joints is compared, not fitted.
"""

import itertools
import math

import numpy
import pinocchio


def screws(forward, count):
    """The screws (w, v) of the joints in the base's frame where all joints are zero, and the tip there."""
    home = forward(numpy.zeros(count))
    out = []
    for unit in numpy.eye(count):
        moved = forward(0.5 * unit) @ numpy.linalg.inv(home)
        twist = pinocchio.log6(pinocchio.SE3(moved)).vector / 0.5
        out.append(numpy.concatenate([twist[3:], twist[:3]]))
    return numpy.array(out), home


def exponential(screw, value):
    return pinocchio.exp6(numpy.concatenate([screw[3:], screw[:3]]) * value).homogeneous


def moved(screw, pose):
    """The screw in another frame."""
    turn = pose[:3, :3]
    direction = turn @ screw[:3]
    return numpy.concatenate([direction, turn @ screw[3:] + numpy.cross(pose[:3, 3], direction)])


def form(screw):
    """Numbers that do not depend on the sense of the axis: direction times itself, and the point next to the origin."""
    w, v = screw[:3], screw[3:]
    if w @ w < 1e-6:
        return numpy.concatenate([numpy.outer(v, v).ravel(), numpy.zeros(3)])
    return numpy.concatenate([numpy.outer(w, w).ravel(), numpy.cross(w, v)])


class Problem:
    """Lines of two chains. The unknowns: the frame of the base (6), zero positions of all joints but the first and the last."""

    def __init__(self, ours, theirs):
        self.ours, self.theirs = ours, theirs
        self.wanted = numpy.concatenate([form(screw) for screw in ours])

    def offsets(self, x):
        return numpy.concatenate([[0.0], x[6:], [0.0]])[: len(self.ours)]

    def lines(self, x, start):
        pose = pinocchio.exp6(x[:6]).homogeneous @ start
        out = []
        for screw, offset in zip(self.theirs, self.offsets(x)):
            out.append(moved(screw, pose))
            pose = pose @ exponential(screw, offset)
        return out

    def residual(self, x, start):
        return numpy.concatenate([form(screw) for screw in self.lines(x, start)]) - self.wanted


def minimise(problem, x, start, steps=40):
    """Levenberg and Marquardt's method."""
    damping, value = 1e-2, problem.residual(x, start)
    for _ in range(steps):
        columns = [(problem.residual(x + 1e-6 * unit, start) - value) / 1e-6 for unit in numpy.eye(len(x))]
        jacobian = numpy.array(columns).T
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ value
        step = numpy.linalg.solve(normal + damping * numpy.eye(len(x)), -gradient)
        tried = problem.residual(x + step, start)
        if tried @ tried < value @ value:
            x, value, damping = x + step, tried, damping / 5
        else:
            damping *= 5
        if numpy.linalg.norm(step) < 1e-12 or damping > 1e8:
            break
    return x, math.sqrt(value @ value)


def starts(count):
    """Rotations by quarter turns, and zero positions in quarter turns: zero first, then at random."""
    turns = []
    for axes in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            turn = numpy.zeros((3, 3))
            turn[range(3), axes] = signs
            if numpy.linalg.det(turn) > 0:
                turns.append(turn)
    free = max(count - 2, 0)
    random = numpy.random.default_rng(1)
    for trial in range(48):
        pose = numpy.eye(4)
        pose[:3, :3] = turns[trial % 24]
        offsets = numpy.zeros(free) if trial < 24 else random.integers(-1, 3, free) * math.pi / 2
        yield pose, numpy.concatenate([numpy.zeros(6), offsets])


def invariants(lines):
    """For each two neighbouring lines: the cosine between them without its sign, and their distance."""
    out = []
    for a, b in itertools.pairwise(lines):
        if a[:3] @ a[:3] < 1e-6 or b[:3] @ b[:3] < 1e-6:
            continue
        first, second = numpy.cross(a[:3], a[3:]), numpy.cross(b[:3], b[3:])
        normal, between = numpy.cross(a[:3], b[:3]), second - first
        size = numpy.linalg.norm(normal)
        across = abs(normal @ between) / size if size > 1e-4 else numpy.linalg.norm(numpy.cross(a[:3], between))
        out += [abs(a[:3] @ b[:3]), across]
    return numpy.array(out)


def fit(ours, theirs, count, good=5e-3):
    """The forward kinematics of the chain `theirs` in the frames, zero positions and senses of `ours`, and the zero positions."""
    (lines, home), (others, other_home) = screws(ours, count), screws(theirs, count)
    apart = invariants(lines) - invariants(others)
    if abs(apart).max(initial=0.0) > 2e-3:
        raise ValueError(f"other distances or angles between the axes: {numpy.round(apart, 4).tolist()}")
    problem = Problem(lines, others)
    best = None
    for start, x in starts(count):
        x, error = minimise(problem, x, start)
        if best is None or error < 0.5 * best[0]:
            best = error, x, start
        if error < good:
            break
    error, x, start = best
    frame = pinocchio.exp6(x[:6]).homogeneous @ start
    offsets = problem.offsets(x)
    senses = [1.0 if (a[:3] @ b[:3] if a[:3] @ a[:3] > 0.5 else a[3:] @ b[3:]) > 0 else -1.0 for a, b in zip(lines, problem.lines(x, start))]
    tool = numpy.linalg.inv(frame @ theirs(offsets)) @ home
    return lambda q: frame @ theirs(senses * numpy.asarray(q) + offsets) @ tool, offsets
