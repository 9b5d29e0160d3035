"""Forward kinematics independent of groebot: a chain of a URDF in Pinocchio."""

import re
from collections.abc import Iterable
from functools import cached_property
from xml.parsers import expat

import numpy
import pinocchio

PI = numpy.pi
"""Without limits, or with equal ones, a prismatic joint is drawn between -1 m and 1 m, and a revolute joint between -pi and pi."""
SLIDE = 1.0


class Joint:
    """A joint whose value can be chosen, and its bounds for random values."""

    def __init__(self, model: pinocchio.Model, index: int):
        joint = model.joints[index]
        self.name = model.names[index]
        self.slides = joint.shortname().startswith("JointModelP")
        self.row, self.column, self.size = joint.idx_q, joint.idx_v, joint.nq
        self.low, self.high = self._bounds(model)

    def _bounds(self, model: pinocchio.Model) -> tuple[float, float]:
        reach = SLIDE if self.slides else PI
        if self.size == 2:
            return -reach, reach
        low, high = model.lowerPositionLimit[self.row], model.upperPositionLimit[self.row]
        return (low, high) if 0 < high - low < 100 else (-reach, reach)

    def put(self, q: numpy.ndarray, value: float) -> None:
        """Writes the joint's value [rad or m] into a configuration: cosine and sine where the joint is continuous."""
        q[self.row : self.row + self.size] = (numpy.cos(value), numpy.sin(value)) if self.size == 2 else value


class Witness:
    """The chain from `base` to `tip` of a URDF, given as text.

    `joints` are those whose values can be chosen. For joints coupled by `mimic` that are all in the chain, it is the leader. If the leader is outside the
    chain, a single mimic joint is independent, as in groebot.
    """

    def __init__(self, urdf: str, base: str, tip: str):
        self.model = _model(urdf, base, tip)
        self.data = self.model.createData()
        self.base, self.tip = _frame(self.model, base), _frame(self.model, tip)
        path = _path(self.model, self.base, self.tip)
        self.followers = {self.model.names[i]: _follower(self.model, i) for i in path if i in list(self.model.mimicking_joints)}
        leaders = {self.model.getJointId(leader) for leader, _, _ in self.followers.values()}
        driven = [i for i in path if self.model.names[i] not in self.followers]
        self.joints = [Joint(self.model, i) for i in sorted(leaders - set(driven)) + driven]

    def draw(self, count: int, seed: int) -> list[dict[str, float]]:
        """Random joint values, uniform between the bounds."""
        random = numpy.random.default_rng(seed)
        low, high = ([getattr(joint, side) for joint in self.joints] for side in ("low", "high"))
        return [dict(zip(self.names, map(float, row))) for row in random.uniform(low, high, (count, len(low)))]

    @property
    def names(self) -> list[str]:
        return [joint.name for joint in self.joints]

    @cached_property
    def sliding(self) -> set[str]:
        """The prismatic joints."""
        return {joint.name for joint in self.joints if joint.slides}

    def chosen(self, values: dict[str, float]) -> dict[str, float]:
        """The values of `joints`, computed from those of other joints that determine them."""
        out = {name: values[name] for name in self.names if name in values}
        for name, (leader, factor, offset) in self.followers.items():
            if leader not in out and name in values:
                out[leader] = (values[name] - offset) / factor
        for name, value in values.items():
            leader, *others = re.split(r" ([+-]) ", name)
            if others:
                out[leader] = value / (1.0 + sum(self._share(*other) for other in zip(others[::2], others[1::2])))
        return out

    def _share(self, sign: str, name: str) -> float:
        """The contribution of a telescope's joint to its value, which is the sum in groebot, when its leader moves by one."""
        return float(sign + "1") * self.followers[name][1]

    def forward(self, values: dict[str, float]) -> pinocchio.SE3:
        """base_from_tip at joint values."""
        pinocchio.forwardKinematics(self.model, self.data, self._configuration(values))
        world_from_base = pinocchio.updateFramePlacement(self.model, self.data, self.base)
        world_from_tip = pinocchio.updateFramePlacement(self.model, self.data, self.tip)
        return world_from_base.actInv(world_from_tip)

    def jacobian(self, values: dict[str, float]) -> numpy.ndarray:
        """The twist (v, w) of the tip relative to the base, in the tip's frame, per velocity of `joints`: 6 rows."""
        q = self._configuration(values)
        tip_from_base = self.forward(values).inverse()
        # For a model with one joint, Pinocchio returns a vector.
        of_tip, of_base = (
            pinocchio.computeFrameJacobian(self.model, self.data, q, frame, pinocchio.LOCAL).reshape(6, -1)
            for frame in (self.tip, self.base)
        )
        twists = of_tip - tip_from_base.toActionMatrix() @ of_base
        return twists[:, [joint.column for joint in self.joints]]

    def _configuration(self, values: dict[str, float]) -> numpy.ndarray:
        q = pinocchio.neutral(self.model)
        for joint in self.joints:
            joint.put(q, values[joint.name])
        return q


def _model(urdf: str, base: str, tip: str) -> pinocchio.Model:
    """The model with `mimic` if two joints of the chain are coupled, otherwise without."""
    model = pinocchio.buildModelFromXML(urdf)
    path = [model.names[i] for i in _path(model, _frame(model, base), _frame(model, tip))]
    leaders = _leaders(urdf)
    led = [leaders.get(name, name) for name in path]
    return model if len(set(led)) == len(led) else pinocchio.buildModelFromXML(urdf, True)


def _frame(model: pinocchio.Model, link: str) -> int:
    """The frame of a link."""
    if not model.existFrame(link, pinocchio.FrameType.BODY):
        raise LookupError(f"no link {link}")
    return model.getFrameId(link, pinocchio.FrameType.BODY)


def _path(model: pinocchio.Model, base: int, tip: int) -> list[int]:
    """The moving joints between two frames."""
    to_base, to_tip = (set(model.supports[model.frames[frame].parentJoint]) for frame in (base, tip))
    return sorted(to_base ^ to_tip)


def _leaders(urdf: str) -> dict[str, str]:
    """The leader of each mimic joint of a URDF. Undeclared prefixes in the file are ignored."""
    leaders, names = {}, [""]

    def start(tag: str, attributes: dict[str, str]) -> None:
        if tag == "joint":
            names[0] = attributes.get("name", "")
        if tag == "mimic":
            leaders[names[0]] = attributes["joint"]

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    parser.Parse(urdf, True)
    return leaders


def _follower(model: pinocchio.Model, index: int) -> tuple[str, float, float]:
    """The leader, factor and offset of a mimic joint."""
    leaders: Iterable[int] = model.mimicked_joints
    leader = dict(zip(model.mimicking_joints, leaders))[index]
    mimic = model.joints[index].extract()
    return model.names[leader], mimic.scaling, mimic.offset
