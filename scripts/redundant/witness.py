"""All arcs of solutions within limits, of poses of an arm, without groebot.

    python witness.py ARMS_FOLDER OUT_FOLDER [--only ID,...] [--count 7] [--starts 400] [--seed 1] [--bytes 16000]

Whole curves are found from random starts, traced, and cut at the limits (trace.py, cut.py). A pose has one entry of the file OUT_FOLDER/ID.json.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np

from arm import Arm
from cut import Cutter, End, Part, without_repeats
from poses import vectors
from srs import Circle
from srs import arcs as circle_arcs
from trace import MOST_CURVES, Curve, all_curves, solutions


def starts(arm: Arm, q: np.ndarray, count: int, random: np.random.Generator) -> np.ndarray:
    """Random joint vectors: half within the limits, half in a whole turn, and the vector itself first."""
    low, high = np.where(np.isfinite(arm.low), arm.low, -np.pi), np.where(np.isfinite(arm.high), arm.high, np.pi)
    half = count // 2
    return np.concatenate([q[None], random.uniform(low, high, (half, 7)), random.uniform(-np.pi, np.pi, (count - half, 7))])


def least_sigma(arm: Arm, q: np.ndarray) -> tuple[float, float]:
    """The least of the smallest singular values of the Jacobian along a curve, and the greatest of them."""
    zero = (np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3)))
    values = np.linalg.svd(arm.residual(q, *zero)[1], compute_uv=False)[:, 5]
    return float(values.min()), float(values.max())


def curves_of(arm: Arm, qs: np.ndarray, count: int, seed: int) -> tuple[tuple, list[list[Curve]]]:
    """The targets of joint vectors, and their curves."""
    random = np.random.default_rng(seed)
    turns, places, _, _ = arm.frames(qs)
    first = np.concatenate([starts(arm, q, count, random) for q in qs])
    rows = np.repeat(np.arange(len(qs)), count + 1)
    found = solutions(arm, turns[rows], places[rows], first)
    good = np.isfinite(found[:, 0])
    return (turns, places), all_curves(arm, (turns, places), [found[good & (rows == i)] for i in range(len(qs))])


def number(x: float, digits: int = 6) -> float:
    return round(float(x), digits) + 0.0


def rounded(q: np.ndarray) -> list[float]:
    return [number(x) for x in q]


def end_fields(arm: Arm, end: End) -> list:
    """The joints at limits, from 1, with + for upper and - for lower, and the joint vector."""
    return [" ".join(f"{joint + 1}{'+' if is_upper else '-'}" for joint, is_upper in end.joints), rounded(arm.lifted(end.q))]


def arc_fields(arm: Arm, part: Part) -> list:
    """Length, greatest margin, and both ends; a closed curve has one of its points instead."""
    head = [number(part.length), number(part.margin)]
    if part.is_closed:
        return [*head, "closed", rounded(arm.lifted(part.best))]
    return [*head, *(field for end in part.ends for field in end_fields(arm, end))]


def entry(arm: Arm, kind: str, q: list[float], target: tuple, curves: list[Curve]) -> dict:
    """One pose as data."""
    out = {"kind": kind, "degrees": [round(float(np.degrees(x))) for x in q]} if kind == "round" else {"kind": kind, "q": q}
    sigmas = [least_sigma(arm, curve.q) for curve in curves]
    if any(high < 1e-7 for _, high in sigmas) or len(curves) >= MOST_CURVES:
        return out | singular_entry(arm, target)
    parts = without_repeats([part for curve in curves for part in Cutter(arm, target, curve).parts()])
    out["sigma"] = float(f"{min(low for low, _ in sigmas):.2g}")
    out["curves"], out["hits"] = len(curves), min(curve.hits for curve in curves)
    out["open"] = sum(not curve.is_closed for curve in curves)
    return out | {"arcs": [arc_fields(arm, part) for part in parts]}


def singular_entry(arm: Arm, target: tuple) -> dict:
    """A pose whose solutions cannot be traced: the Jacobian has no full rank along a curve. The circle of the elbow gives them if the arm has one."""
    try:
        parts, _ = circle_arcs(Circle(arm), target, 7200)
    except ValueError:
        return {"singular": True}
    return {"singular": True, "arcs": [arc_fields(arm, part) for part in parts]}


def written(path: Path, head: dict, entries: list[dict], most: int) -> None:
    """One line a pose, the kinds in turn, as many as `most` bytes hold."""
    kinds = {kind: [entry for entry in entries if entry["kind"] == kind] for kind in ("random", "round", "limits")}
    order = [entry for entry in entries if entry["kind"] == "named"] + [entry for row in zip(*kinds.values()) for entry in row]
    lines, size = [], 0
    for item in order:
        line = json.dumps(item, separators=(",", ":"))
        size += len(line) + 2
        if size <= most or item["kind"] == "named":
            lines.append(line)
    path.write_text(json.dumps(head)[:-1] + ', "poses": [\n' + ",\n".join(lines) + "\n]}\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("arms", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--count", type=int, default=7)
    parser.add_argument("--starts", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bytes", type=int, default=16000, help="the greatest size of a file; poses beyond are left out")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    for path in sorted(args.arms.glob("*.urdf")):
        if args.only and path.stem not in args.only.split(","):
            continue
        start, arm = time.perf_counter(), Arm(path)
        chosen = vectors(arm, args.count, args.seed)
        targets, curves = curves_of(arm, np.array([q for _, q in chosen]), args.starts, args.seed)
        entries = [entry(arm, kind, q, (targets[0][i], targets[1][i]), curves[i]) for i, (kind, q) in enumerate(chosen)]
        head = {"arm": arm.name, "starts": args.starts, "seed": args.seed, "count": args.count}
        written(args.out / f"{arm.name}.json", head, entries, args.bytes)
        print(arm.name, len(entries), f"{time.perf_counter() - start:.1f} s", flush=True)


if __name__ == "__main__":
    main()
