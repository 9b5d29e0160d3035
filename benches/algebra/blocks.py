#!/usr/bin/env python3
"""Writes the folder `blocks`: kinematic blocks whose poses, and some whose lengths, are parameters, as Singular reads them."""

import pathlib

import problems  # noqa: F401 (the path to the corpus)
import kinematics
from kinematics import Fraction, angle_unknowns, chain, planar_tip, product, system
from sums import Sum, unknowns

FOLDER = pathlib.Path(__file__).resolve().parent / "blocks"


def nao_leg():
    """NAO (6.7.12)-(6.7.15), millimetres: knee 3 and ankle 4."""
    names = ["c4", "c3", "s4", "s3"]
    c4, c3, s4, s3, px, pz = unknowns([*names, "px", "pz"])
    upper, lower = 100, Fraction("102.9")
    tip = [(c3 * c4 - s3 * s4) * lower + c3 * upper - pz, (c3 * s4 + c4 * s3) * lower + s3 * upper - px]
    return names, ["px", "pz"], tip + [c3 * c3 + s3 * s3 - 1, c4 * c4 + s4 * s4 - 1]


def nao_arm():
    """NAO (6.7.1)-(6.7.4), millimetres."""
    names = ["c4", "c2", "s4", "s2"]
    c4, c2, s4, s2, py, pz = unknowns([*names, "py", "pz"])
    tip = [c2 * 105 + s4 * Fraction("113.7") - pz, s2 * 105 + c4 * Fraction("113.7") - py]
    return names, ["py", "pz"], tip + [c2 * c2 + s2 * s2 - 1, c4 * c4 + s4 * s4 - 1]


def planar_3r():
    """Position and orientation; t is the tangent of half the direction phi of the last link."""
    names, pairs, circles = angle_unknowns(1, 3)
    px, py, t = unknowns(["px", "py", "t"])
    x, y, cosine, sine = planar_tip(["2", "3/2", "1"], pairs)
    whole = t * t + 1
    turned = [cosine * whole - (1 - t * t), sine * whole - t * 2]
    return names, ["px", "py", "t"], [x - px, y - py, *turned, *circles]


def position(numbers, tool, lengths):
    """The position block of three joints for the target (px, py, pz) and the lengths with names."""
    names, pairs, circles = angle_unknowns(1, 3)
    targets = ["px", "py", "pz"]
    tip = product(chain(numbers, pairs), [[kinematics.exact(value)] for value in (*tool, 1)])
    return names, targets + lengths, [row[0] - target for row, target in zip(tip, unknowns(targets))] + circles


def puma():
    return position(kinematics.PUMA, (0, 0, "0.4318"), [])


def puma_symbolic():
    """Same as `position`, but with its four lengths as parameters."""
    a2, a3, d3, d4 = unknowns(["a2", "a3", "d3", "d4"])
    return position([(0, 0, "-1"), (d3, a2, "0"), (0, -a3, "1")], (0, 0, d4), ["a2", "a3", "d3", "d4"])


def general_3r():
    return position(kinematics.GENERAL[:3], (1, 2, 1), [])


def general_3r_symbolic():
    """Three axes with fixed angles between them, five lengths and three coordinates as parameters."""
    a1, a2, a3, d2, d3 = unknowns(["a1", "a2", "a3", "d2", "d3"])
    return position([(0, a1, "1/2"), (d2, a2, "1/3"), (d3, a3, "0")], (0, 0, 0), ["a1", "a2", "a3", "d2", "d3"])


# Each block in the orders and with the order of unknowns in which Singular is fastest (None: as above).
BLOCKS = [
    (nao_leg, "lp", None),
    (nao_arm, "lp", None),
    (planar_3r, "dp", None),
    (planar_3r, "lp", None),
    (puma, "dp", "s3 c3 s1 c1 s2 c2"),
    (puma, "lp", "c1 s1 c2 s2 c3 s3"),
    (puma_symbolic, "dp", "c3 s3 c2 s2 c1 s1"),
    (puma_symbolic, "lp", "c1 s1 c2 s2 c3 s3"),
    (general_3r, "dp", None),
    (general_3r, "lp", None),
    (general_3r_symbolic, "dp", None),
    (general_3r_symbolic, "lp", None),
]


def text(block, order, unknown_order):
    """The block as a Singular ring and ideal."""
    names, parameters, equations = block()
    names = unknown_order.split() if unknown_order else names
    _, generators = system(names + parameters, equations)
    ring = f"ring r = (0,{','.join(parameters)}),({','.join(names)}),{order};"
    return f"{ring}\nideal I =\n  " + ",\n  ".join(generators) + ";\n"


if __name__ == "__main__":
    for block, order, unknown_order in BLOCKS:
        (FOLDER / f"{block.__name__}-{order}.sing").write_text(text(block, order, unknown_order))
