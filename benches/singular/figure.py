"""Draws the time of a pose against the distance of a joint from a singular configuration: docs/singular_times.svg.

    python3 benches/singular/figure.py

from the rows `after` of benches/record/2026-11-28-singular-times.csv, and 2026-11-27-singular-peers.csv. Both axes are logarithmic.
"""

import csv
import math
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RECORD = ROOT / "benches/record/2026-11-28-singular-times.csv"
PEERS = ROOT / "benches/record/2026-11-27-singular-peers.csv"
FIGURE = ROOT / "docs/singular_times.svg"
ROBOTS = {
    "puma": ("PUMA, wrist", "WristPitch", "#1f5f9e"),
    "ur5": ("UR5, wrist", "Wrist2", "#c2352b"),
    "irb120": ("IRB 120, wrist", "Axis5", "#2e8540"),
    "nao_left_leg": ("NAO's leg, hip", "HipRoll", "#b05a00"),
    "teo_leg": ("TEO's leg, hip", "HipRoll", "#7a3b9e"),
}
OTHERS = {
    ("ur5", "ssik 8.2.0"): ("ssik, UR5", "#c2352b"),
    ("puma560", "ssik 8.2.0"): ("ssik, PUMA 560", "#1f5f9e"),
    ("ur5", "EAIK 1.2.2"): ("EAIK, UR5", "#888888"),
}
LEFT, TOP, WIDTH, HEIGHT = 76, 20, 520, 360
FARTHEST, NEAREST, LEAST, MOST = -3, -14, 0, 5


def x_of(exponent):
    return LEFT + WIDTH * (FARTHEST - exponent) / (FARTHEST - NEAREST)


def y_of(time):
    return TOP + HEIGHT * (MOST - math.log10(time)) / (MOST - LEAST)


def times(record, key, joint, column):
    """The exponents of distances and the times [us] of the rows that begin with `key`."""
    rows = [row for row in csv.reader(record.open()) if row[:2] == key and row[2].startswith(joint + " 1e")]
    return [(int(row[2].split("1e")[1]), float(row[column])) for row in rows]


def line(points, colour, dashes=""):
    path = " ".join(f"{x_of(exponent):.1f},{y_of(time):.1f}" for exponent, time in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.6" stroke-dasharray="{dashes}"/>'


def frame():
    for exponent in range(NEAREST, FARTHEST + 1):
        x = x_of(exponent)
        yield f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{TOP + HEIGHT}" stroke="#ddd"/>'
        yield f'<text x="{x:.1f}" y="{TOP + HEIGHT + 16}" text-anchor="middle">1e{exponent}</text>'
    for decade in range(LEAST, MOST + 1):
        y = y_of(10**decade)
        yield f'<line x1="{LEFT}" y1="{y:.1f}" x2="{LEFT + WIDTH}" y2="{y:.1f}" stroke="#ddd"/>'
        yield f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{10**decade} us</text>'
    yield f'<text x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 34}" text-anchor="middle">distance from the singular pose [rad]</text>'


def curves():
    for place, (robot, (label, joint, colour)) in enumerate(ROBOTS.items()):
        yield line(times(RECORD, ["after", robot], joint, 4), colour)
        yield line(times(RECORD, ["after", robot], joint, 6), colour, "2 3")
        yield f'<text x="{LEFT + 10}" y="{TOP + 18 + 16 * place}" fill="{colour}">{label}</text>'
    for place, ((robot, contestant), (label, colour)) in enumerate(OTHERS.items(), len(ROBOTS)):
        yield line(times(PEERS, [robot, contestant], "wrist", 4), colour, "8 4")
        yield f'<text x="{LEFT + 10}" y="{TOP + 18 + 16 * place}" fill="{colour}">{label} (dashed)</text>'
    y = TOP + 18 + 16 * (len(ROBOTS) + len(OTHERS))
    yield f'<text x="{LEFT + 10}" y="{y}">solid: mean, dotted: slowest of 200</text>'


def main():
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{LEFT + WIDTH + 20}" height="{TOP + HEIGHT + 45}">'
    parts = [head, "<style>text { font: 12px sans-serif }</style>", '<rect width="100%" height="100%" fill="white"/>']
    FIGURE.write_text("\n".join([*parts, *frame(), *curves(), "</svg>"]) + "\n")


if __name__ == "__main__":
    main()
