"""The polynomial systems of mechanisms, written out from their geometry: each function gives the unknowns and the equations.

A joint i has the unknowns c_i, s_i with c_i^2 + s_i^2 = 1, or t_i, the tangent of its half angle. A link has the standard
Denavit-Hartenberg numbers (d, a, tangent of half of alpha), all rational, so that a pose of rational tangents is reachable exactly.
"""

import math
from fractions import Fraction

from sums import Sum, unknowns

# d, a, tan(alpha/2) of a chain of six revolute joints without any special position of its axes.
GENERAL = [(1, 2, "1/2"), (2, 1, "1/3"), (1, 3, "-1/2"), (3, 1, "2"), (1, 2, "1/3"), (2, 1, "1/2")]
GENERAL_POSE = ["1/2", "1/3", "2", "-1/2", "3", "-1/3"]
# The wrist centre of the PUMA 560 by Paul and Zhang (1986), metres: a2 = 0.4318, a3 = 0.0203, d3 = 0.15005, d4 = 0.4318.
PUMA = [(0, 0, "-1"), ("0.15005", "0.4318", "0"), (0, "-0.0203", "1")]


def circle_point(t):
    """Cosine and sine of the angle whose half has the tangent `t`."""
    t = Fraction(t)
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def link(cosine, sine, numbers):
    """The frame of a link: Rz(theta) Tz(d) Tx(a) Rx(alpha)."""
    (d, a), (k, m) = map(exact, numbers[:2]), circle_point(numbers[2])
    return [
        [cosine, -sine * k, sine * m, cosine * a],
        [sine, cosine * k, -cosine * m, sine * a],
        [0, m, k, d],
        [0, 0, 0, 1],
    ]


def exact(value):
    """A number or text as a fraction; a polynomial as it is."""
    return value if isinstance(value, Sum) else Fraction(value)


def product(a, b):
    """The product of two matrices."""
    return [[sum((x * y for x, y in zip(row, column)), 0) for column in zip(*b)] for row in a]


def inverse(frame):
    """The inverse of a rigid motion."""
    turned = [[frame[j][i] for j in range(3)] for i in range(3)]
    shift = [-sum((turned[i][j] * frame[j][3] for j in range(3)), 0) for i in range(3)]
    return [row + [end] for row, end in zip(turned, shift)] + [[0, 0, 0, 1]]


def chain(numbers, joints):
    """The product of the links; `joints` are pairs (cosine, sine)."""
    frame = link(*joints[0], numbers[0])
    for joint, row in zip(joints[1:], numbers[1:]):
        frame = product(frame, link(*joint, row))
    return frame


def angle_unknowns(first, last):
    """The unknowns c_i, s_i as names, as pairs of sums, and their circles."""
    names = [name for i in range(first, last + 1) for name in (f"c{i}", f"s{i}")]
    values = unknowns(names)
    pairs = list(zip(values[::2], values[1::2]))
    return names, pairs, [c * c + s * s - 1 for c, s in pairs]


def system(names, equations):
    """Unknowns and equations with coprime integer coefficients, without zeros."""
    return names, [equation.primitive().text(names) for equation in map(Sum.of, equations) if equation.terms]


def planar(lengths, tangents, orientation):
    """A planar chain at the pose of `tangents`: the tip, and the direction of its last link if requested."""
    names, pairs, circles = angle_unknowns(1, len(lengths))
    wanted = planar_tip(lengths, [circle_point(t) for t in tangents])
    equations = [found - value for found, value in zip(planar_tip(lengths, pairs), wanted)]
    return system(names, equations[: 4 if orientation else 2] + circles)


def contradicted():
    """The arm of two joints whose last link points to the left of where it can."""
    names, pairs, circles = angle_unknowns(1, 2)
    lengths = ["2", "3/2"]
    x, y, cosine, sine = planar_tip(lengths, [circle_point("1/2"), circle_point("1/3")])
    found = planar_tip(lengths, pairs)
    return system(names, [a - b for a, b in zip(found, (x, y, -sine, cosine))] + circles)


def planar_tip(lengths, pairs):
    """x, y of the tip, cosine and sine of the sum of the angles."""
    x = y = 0
    cosine, sine = 1, 0
    for length, (c, s) in zip(lengths, pairs):
        cosine, sine = cosine * c - sine * s, sine * c + cosine * s
        x, y = x + cosine * Fraction(length), y + sine * Fraction(length)
    return x, y, cosine, sine


def position(numbers, tool, tangents):
    """The point `tool` of the last frame of a spatial chain, at the pose of `tangents`."""
    names, pairs, circles = angle_unknowns(1, len(numbers))
    point = [[Fraction(value)] for value in (*tool, 1)]
    found = product(chain(numbers, pairs), point)
    wanted = product(chain(numbers, [circle_point(t) for t in tangents]), point)
    return system(names, [a[0] - b[0] for a, b in zip(found[:3], wanted)] + circles)


def general_3r():
    return position(GENERAL[:3], (1, 2, 1), ["1/2", "-1/3", "2"])


def puma_position():
    return position(PUMA, (0, 0, "0.4318"), ["1/2", "-1/3", "1/5"])


def six_pose():
    """The pose of the general chain of six joints."""
    return chain(GENERAL, [circle_point(t) for t in GENERAL_POSE])


def six_split():
    """T1 T2 T3 = G T6^-1 T5^-1 T4^-1: twelve entries and six circles."""
    names, pairs, circles = angle_unknowns(1, 6)
    left = chain(GENERAL[:3], pairs[:3])
    right = product(six_pose(), inverse(chain(GENERAL[3:], pairs[3:])))
    return system(names, [left[i][j] - right[i][j] for i in range(3) for j in range(4)] + circles)


def raghavan_roth():
    """The fourteen equations of M. Raghavan and B. Roth (J. Mechanical Design 115 (1993) 502-508) without joint 6: p, l, p.p, p.l,
    p x l and (p.p) l - 2 (p.l) p of the axis l and the origin p on both sides of T3 T4 T5 = T2^-1 T1^-1 G T6^-1."""
    names, pairs, circles = angle_unknowns(1, 5)
    left = invariants(chain(GENERAL[2:5], pairs[2:]))
    right = invariants(product(inverse(chain(GENERAL[:2], pairs[:2])), without_last_joint()))
    return system(names, [(a - b).on_circles(5) for a, b in zip(left, right)] + circles)


def without_last_joint():
    """G T6^-1, whose axis and origin do not depend on joint 6: that joint is put to 0."""
    return product(six_pose(), inverse(link(1, 0, GENERAL[5])))


def invariants(frame):
    """The fourteen functions of the axis l and the origin p of a frame."""
    l, p = [frame[i][2] for i in range(3)], [frame[i][3] for i in range(3)]
    dot = lambda a, b: Sum.of(sum((x * y for x, y in zip(a, b)), 0)).on_circles(5)
    cross = [p[(i + 1) % 3] * l[(i + 2) % 3] - p[(i + 2) % 3] * l[(i + 1) % 3] for i in range(3)]
    square, along = dot(p, p), dot(p, l)
    return [*p, *l, square, along, *cross, *(square * l[i] - along * p[i] * 2 for i in range(3))]


def six_tangents():
    """The same p and l in tangents of half angles without denominators; w keeps the factors 1 + t^2 from zero."""
    names = [f"t{i}" for i in range(1, 6)] + ["w"]
    *tangents, w = unknowns(names)
    _, pairs, _ = angle_unknowns(1, 5)
    left, right = chain(GENERAL[2:5], pairs[2:]), product(inverse(chain(GENERAL[:2], pairs[:2])), without_last_joint())
    equations = [Sum.of(left[i][j] - right[i][j]).in_tangents(tangents) for j in (2, 3) for i in range(3)]
    factors = [t * t + 1 for t in tangents]
    return system(names, equations + [w * math.prod(factors) - 1])


def quaternion_product(a, b):
    """The product of two quaternions (scalar first)."""
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]


def dual_product(a, b):
    """The product of two dual quaternions (real part first)."""
    mixed = zip(quaternion_product(a[:4], b[4:]), quaternion_product(a[4:], b[:4]))
    return quaternion_product(a[:4], b[:4]) + [x + y for x, y in mixed]


def dual_link(t, numbers):
    """The dual quaternion of a link, up to a factor: (1 + t k)(1 + eps d/2 k)(1 + eps a/2 i)(1 + tan(alpha/2) i)."""
    d, a, m = map(Fraction, numbers)
    made = dual_product([1, 0, 0, t, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0, 0, d / 2])
    made = dual_product(made, [1, 0, 0, 0, 0, a / 2, 0, 0])
    return dual_product(made, [1, m, 0, 0, 0, 0, 0, 0])


def dual_inverse(q):
    """The inverse of a dual quaternion on Study's quadric, up to a factor."""
    return [q[0], -q[1], -q[2], -q[3], q[4], -q[5], -q[6], -q[7]]


def six_dual_quaternions():
    """T1 T2 T3 = w G (T4 T5 T6)^-1 on Study's quadric; v keeps the norms from zero."""
    names = [f"t{i}" for i in range(1, 7)] + ["w", "v"]
    *tangents, w, v = unknowns(names)
    links = [dual_link(t, numbers) for t, numbers in zip(tangents, GENERAL)]
    pose = dual_chain([dual_link(Fraction(t), numbers) for t, numbers in zip(GENERAL_POSE, GENERAL)])
    right = dual_product(pose, dual_inverse(dual_chain(links[3:])))
    equations = [a - w * b for a, b in zip(dual_chain(links[:3]), right)]
    return system(names, equations + [v * math.prod(t * t + 1 for t in tangents[:3]) - 1])


def dual_chain(links):
    """The product of dual quaternions."""
    made = links[0]
    for factor in links[1:]:
        made = dual_product(made, factor)
    return made


# Anchors of six legs on the base and on the platform, and the pose (a dual quaternion) that gives their lengths.
BASE = [(0, 0, 0), (4, 0, 1), (6, 3, 0), (4, 6, -1), (0, 5, 1), (-2, 2, 0)]
PLATFORM = [(0, 0, 0), (2, 1, 0), (3, 2, 1), (2, 3, -1), (1, 3, 0), (-1, 1, 1)]
PLATFORM_POSE = ([1, "1/2", "-1/3", "1/4"], [1, 2, 5])


def stewart():
    """The platform of D. Stewart and V. E. Gough on Study's quadric, x0 = 1: sum of x(i) y(i) = 0, and the length of each leg as
    M. L. Husty writes it (Mechanism and Machine Theory 31 (1996) 365-380). 40 solutions."""
    names = ["x1", "x2", "x3", "y0", "y1", "y2", "y3"]
    values = unknowns(names)
    x, y = [Sum.of(1), *values[:3]], values[3:]
    turn, shift = ([Fraction(v) for v in part] for part in PLATFORM_POSE)
    pose = dual_product([1, 0, 0, 0, 0, *(value / 2 for value in shift)], [*turn, 0, 0, 0, 0])
    equations = [leg(x, y, a, b) - leg_square(pose, a, b) * squares(x) for a, b in zip(PLATFORM, BASE)]
    return system(names, equations + [scalar_product(x, y)])


def leg(x, y, a, b):
    """The squared length of a leg from b to a, times x.x; the translation is 2 y x* / x.x."""
    point, base = [0, *a], [0, *b]
    turned = quaternion_product(quaternion_product(x, point), conjugate(x))
    moved = [2 * value for value in quaternion_product(y, conjugate(x))]
    mixed = scalar_product(quaternion_product(x, point), y) * 4 - scalar_product(turned, base) * 2
    return squares(x) * (squares(a) + squares(b)) + squares(y) * 4 + mixed - scalar_product(moved, base) * 2


def leg_square(pose, a, b):
    """The squared length of a leg at a pose."""
    return Fraction(leg(pose[:4], pose[4:], a, b)) / squares(pose[:4])


def conjugate(q):
    return [q[0], -q[1], -q[2], -q[3]]


def scalar_product(a, b):
    return sum((x * y for x, y in zip(a, b)), 0)


def squares(a):
    return scalar_product(a, a)


def octahedron():
    """The 3-3 platform: each corner of the platform turns about an edge of the base; the sides of the platform have given lengths
    (P. Nanua, K. J. Waldron and V. Murthy, IEEE Trans. Robotics and Automation 6 (1990) 438-444). 16 solutions."""
    names, pairs, circles = angle_unknowns(1, 3)
    corners = [corner(i, pairs[i]) for i in range(3)]
    known = [corner(i, circle_point(t)) for i, t in enumerate(["1/2", "2/3", "3/4"])]
    gap = lambda points, i: squares([a - b for a, b in zip(points[i], points[(i + 1) % 3])])
    return system(names, [Sum.of(gap(corners, i) - gap(known, i)).on_circles(3) for i in range(3)] + circles)


# Of each edge of the base: the foot of the corner above it, the outward direction across it (rational, of length 1), the distance.
EDGES = [((2, 0), (0, 1), 3), ((5, 3), ("-4/5", "-3/5"), 4), ((0, 4), ("12/13", "-5/13"), 5)]


def corner(i, joint):
    """The corner of the platform over edge i."""
    (c, s), (foot, across, distance) = joint, EDGES[i]
    return [c * (Fraction(a) * distance) + f for f, a in zip(foot, across)] + [s * distance]


def three_rpr():
    """The planar platform on three legs of given lengths, its direction (c, s) and its point (x, y): 6 solutions."""
    names = ["c", "s", "x", "y"]
    unknown, known = unknowns(names), [*circle_point("1/3"), Fraction(2), Fraction(3)]
    legs = [((0, 0), (0, 0)), ((7, 1), (3, 0)), ((3, 8), (1, 2))]
    equations = [planar_leg(unknown, *ends) - planar_leg(known, *ends) for ends in legs]
    return system(names, [*equations, unknown[0] ** 2 + unknown[1] ** 2 - 1])


def planar_leg(pose, base, point):
    """The squared length of a leg of the planar platform."""
    c, s, x, y = pose
    return squares([c * point[0] - s * point[1] + x - base[0], s * point[0] + c * point[1] + y - base[1]])


MECHANISMS = {
    "planar_2r": lambda: planar(["2", "3/2"], ["1/2", "1/3"], False),
    "planar_2r_stretched": lambda: planar(["2", "3/2"], ["1/2", "0"], False),
    "planar_2r_contradicted": contradicted,
    "planar_3r": lambda: planar(["2", "3/2", "1"], ["1/2", "1/3", "-2/3"], True),
    "planar_4r": lambda: planar(["2", "3/2", "1", "1/2"], ["1/2", "1/3", "-2/3", "1/4"], True),
    "general_3r": general_3r,
    "puma_position": puma_position,
    "six_split": six_split,
    "six_raghavan_roth": raghavan_roth,
    "six_tangents": six_tangents,
    "six_dual_quaternions": six_dual_quaternions,
    "stewart": stewart,
    "stewart_octahedron": octahedron,
    "planar_3rpr": three_rpr,
}
