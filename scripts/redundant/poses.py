"""Joint vectors whose poses are tested: random ones, round ones, ones with joints at limits, and the published cases."""

import numpy as np

from arm import Arm

NAMED = {
    "panda": [(0, -0.785398, 0, -2.356194, 0, 1.570796, 0.785398), (2.6214, 1.7513, 0.5511, -1.3872, -2.5629, 1.4541, 0.1179)],
    "openarm": [
        (-0.5182, 0.1229, 0.5255, 1.7812, 0.7964, 0.5382, 0.7426),
        (1.2088, -1.5517, 1.0634, 1.8112, -0.9063, 0.0903, 0.0853),
        (-1, -1, 0.5, 0, 0.3, 0.4, 0.2),
    ],
    "pr2": [(-0.6018, -0.3148, -2.94, -2.1056, -3.0855, -0.7956, 1.2759)],
    "talos": [(-1.11315, 0.580867, -0.045073, -0.132867, -0.446795, 0.82341, -0.447731)],
}
"""Cases of which counts and lengths were measured by a prototype in C++ (they are compared by `witness.py --named`)."""


def ranges(arm: Arm) -> tuple[np.ndarray, np.ndarray]:
    """Bounds of random values: the limits, or one turn."""
    endless = arm.high - arm.low >= 2 * np.pi
    return np.where(endless, -np.pi, arm.low), np.where(endless, np.pi, arm.high)


def random_vectors(arm: Arm, count: int, seed: int) -> np.ndarray:
    """Joint vectors (count, 7), uniform within the limits, with four decimals."""
    low, high = ranges(arm)
    return np.clip(np.round(np.random.default_rng([seed, *arm.name.encode()]).uniform(low, high, (count, len(low))), 4), low, high)


def vectors(arm: Arm, count: int, seed: int) -> list[tuple[str, list[float]]]:
    """Kind and joint vector: `count` of each kind, and the named ones."""
    random = np.random.default_rng([seed, *arm.name.encode()])
    low, high = ranges(arm)
    out = [("named", [float(x) for x in q]) for q in NAMED.get(arm.name, [])]
    for _ in range(count):
        q = np.clip(np.round(random.uniform(low, high), 4), low, high)
        out.append(("random", q.tolist()))
    for _ in range(count):
        steps = [int(random.integers(np.ceil(a / STEP - 1e-9), np.floor(b / STEP + 1e-9) + 1)) for a, b in zip(low, high)]
        out.append(("round", [float(np.radians(15 * k)) for k in steps]))
    for i in range(count):
        q = np.clip(np.round(random.uniform(low, high), 4), low, high)
        for joint in random.permutation(arm.limited)[: 1 + i % 3]:
            q[joint] = (arm.low if random.integers(2) else arm.high)[joint]
        out.append(("limits", q.tolist()))
    return out


STEP = np.pi / 12
