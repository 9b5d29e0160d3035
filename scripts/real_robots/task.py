"""A task as numbers: its targets, the residual of a solution, and the distance of a pose from singularity."""

import math

import numpy
import pinocchio

from groebot import Derivation
from robots import Chain
from witness import Witness


class Task:
    """The task of a derivation of a chain."""

    def __init__(self, chain: Chain, witness: Witness, derivation: Derivation):
        self.kind, self.witness, self.derivation = chain.task, witness, derivation
        aim = numpy.array([float(number) for number in (chain.direction or "0,0,1").split(",")])
        self.aim = aim / numpy.linalg.norm(aim)

    def target(self, pose: pinocchio.SE3, values: dict[str, float]) -> list[float]:
        """The numbers of a target in the order of the inputs: position, rotation by rows, direction, pitch and roll, given joints."""
        named = dict(zip(("px", "py", "pz"), pose.translation))
        named |= {f"r{i + 1}{j + 1}": pose.rotation[i, j] for i in range(3) for j in range(3)}
        named |= dict(zip(("dx", "dy", "dz"), pose.rotation @ self.aim))
        along, across, up = pose.rotation[2]
        named |= {"pitch": math.atan2(-along, math.hypot(across, up)), "roll": math.atan2(across, up)}
        return [float(values[name] if name in values else named[name]) for name in self.derivation.inputs]

    def residual(self, target: list[float], answer: dict[str, float]) -> float:
        """The largest difference of a coordinate [m or 1] between a target and the pose of a solution."""
        asked = dict(zip(self.derivation.inputs, target))
        given = {name: asked[name] for name in self.derivation.given}
        reached = self.target(self.witness.forward(answer), given)
        off = zip(self.derivation.inputs, numpy.subtract(target, reached))
        return max(abs(math.remainder(miss, math.tau) if name in ("pitch", "roll") else miss) for name, miss in off)

    def least_singular_value(self, values: dict[str, float], length: float) -> float:
        """The smallest singular value of the task's Jacobian for the joints that are not given. Lengths are in units of `length`."""
        twists = self.witness.jacobian(values)
        moves, turns = twists[:3] / length, twists[3:]
        aims = numpy.cross(turns, self.aim, axis=0)
        # A yaw is a rotation about the base's z axis.
        tilts = (self.witness.forward(values).rotation @ turns)[:2]
        rows = {"position_pitch_roll": [moves, tilts]}
        rows |= {"pose": [moves, turns], "position": [moves], "rotation": [turns], "ray": [moves, aims], "direction": [aims]}
        units = [length if joint.slides else 1.0 for joint in self.witness.joints]
        asked = [name not in self.derivation.given for name in self.witness.names]
        jacobian = (numpy.vstack(rows[self.kind]) * units)[:, asked]
        return float(numpy.linalg.svd(jacobian, compute_uv=False).min())

    def same(self, one: dict[str, float], other: dict[str, float], tolerance: float) -> bool:
        """Whether two sets of joint values are equal, modulo whole turns."""

        def apart(name: str) -> float:
            difference = one[name] - other[name]
            return abs(difference if name in self.witness.sliding else math.remainder(difference, math.tau))

        return all(apart(name) < tolerance for name in self.witness.names)
