"""Compares groebot's reading of one MJCF with MuJoCo's compiled model: `compare(path, groebot, vectors)`."""

import csv
import io
import json
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np

MOST_CHAIN = 12  # joints of a chain of `groebot fk`
MOST_TIPS = 4  # chains for each robot
FREE, BALL, SLIDE, HINGE = (int(getattr(mujoco.mjtJoint, f"mjJNT_{kind}")) for kind in ("FREE", "BALL", "SLIDE", "HINGE"))


@dataclass
class Result:
    """The largest differences of one robot: [m], [rad], relative masses and inertias."""

    id: str
    bodies: int = 0
    joints: int = 0
    vectors: int = 0
    place: float = 0.0
    turn: float = 0.0
    tips: int = 0
    tip_place: float = 0.0
    limits: float = 0.0
    mass: float = 0.0
    inertia: float = 0.0
    dynamics: float = 0.0
    unweighed: int = 0
    faults: list = field(default_factory=list)

    def right(self) -> bool:
        """Whether all differences are those of rounding."""
        lengths = max(self.place, self.turn, self.tip_place, self.limits, self.dynamics)
        return not self.faults and lengths <= 1e-9 and self.mass <= 1e-9 and self.inertia <= 1e-6 and self.unweighed == 0


@dataclass
class Freedom:
    """A joint of MuJoCo with one number, and how it is named in groebot."""

    name: str
    address: int  # in qpos
    part: int  # 0, or the hinge of a ball joint
    joint: int
    kind: int


def quaternion(axis, angle):
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * np.asarray(axis)])


def freedoms(model):
    """The joints, with groebot's names of unnamed ones."""
    found, taken = [], {model.joint(j).name for j in range(model.njnt)}
    for j in range(model.njnt):
        body = model.body(model.jnt_bodyid[j])
        name = model.joint(j).name
        if not name:
            wanted = f"{body.name or f'body{body.id}'}_joint"
            name, number = wanted, 1
            while name in taken:
                number += 1
                name = f"{wanted}_{number}"
            taken.add(name)
        kind, address = int(model.jnt_type[j]), int(model.jnt_qposadr[j])
        if kind == BALL:
            found += [Freedom(f"{name}_{axis}", address, part, j, kind) for part, axis in enumerate("xyz")]
        elif kind != FREE:
            found.append(Freedom(name, address, 0, j, kind))
    return found


def laws(model):
    """Followers by joint index: the leader, and the law relative to the initial position."""
    found = {}
    for e in range(model.neq):
        if model.eq_type[e] != mujoco.mjtEq.mjEQ_JOINT or not model.eq_active0[e] or model.eq_obj2id[e] < 0:
            continue
        c = model.eq_data[e]
        if not np.any(c[2:5]) and int(model.eq_obj1id[e]) not in found:
            found[int(model.eq_obj1id[e])] = (int(model.eq_obj2id[e]), c[0], c[1])
    return found


def value_of(model, j, values, followers, depth=0):
    """The value of a joint, by its law if it follows another."""
    if j not in followers or depth > 50:
        return values[j]
    leader, summand, factor = followers[j]
    reference = model.qpos0[model.jnt_qposadr[leader]]
    own = model.qpos0[model.jnt_qposadr[j]]
    return own + summand + factor * (value_of(model, leader, values, followers, depth + 1) - reference)


def drawn(model, generator):
    """A random value of each joint with one number, by joint, and of the balls."""
    values = {}
    for j in range(model.njnt):
        low, high = (-np.pi, np.pi) if model.jnt_type[j] == HINGE else (-1.0, 1.0)
        if model.jnt_limited[j] and model.jnt_type[j] in (HINGE, SLIDE):
            low, high = model.jnt_range[j]
        values[j] = generator.uniform(low, high, 3) if model.jnt_type[j] == BALL else generator.uniform(low, high)
    return values


def posed(model, data, values, followers, is_root_free):
    """MuJoCo's forward kinematics; returns the values by joint, followers included."""
    data.qpos[:] = model.qpos0
    used = {}
    for j in range(model.njnt):
        address = model.jnt_qposadr[j]
        if model.jnt_type[j] == FREE:
            if is_root_free:
                data.qpos[address : address + 7] = [0, 0, 0, 1, 0, 0, 0]
        elif model.jnt_type[j] == BALL:
            turned = np.array([1.0, 0, 0, 0])
            for axis, angle in zip(np.eye(3), values[j]):
                product = np.zeros(4)
                mujoco.mju_mulQuat(product, turned, quaternion(axis, angle))
                turned = product
            data.qpos[address : address + 4] = turned
            used[j] = values[j]
        else:
            used[j] = value_of(model, j, values, followers)
            data.qpos[address] = used[j]
    mujoco.mj_kinematics(model, data)
    return used


class Urdf:
    """A URDF with its own forward kinematics in numpy, independent of groebot."""

    def __init__(self, text):
        root = ET.fromstring(text)
        self.links = {link.get("name"): link for link in root.iter("link")}
        self.joints = [joint for joint in root.findall("joint")]
        children = {joint.find("child").get("link") for joint in self.joints}
        (self.root,) = [name for name in self.links if name not in children]
        self.by_name = {joint.get("name"): joint for joint in self.joints}
        self.below = {}
        for joint in self.joints:
            self.below.setdefault(joint.find("parent").get("link"), []).append(joint)

    @staticmethod
    def origin(element):
        frame = np.eye(4)
        if element is not None:
            roll, pitch, yaw = map(float, element.get("rpy", "0 0 0").split())
            frame[:3, :3] = rotation([0, 0, 1], yaw) @ rotation([0, 1, 0], pitch) @ rotation([1, 0, 0], roll)
            frame[:3, 3] = list(map(float, element.get("xyz", "0 0 0").split()))
        return frame

    def value(self, joint, values):
        mimic = joint.find("mimic")
        if mimic is None:
            return values.get(joint.get("name"), 0.0)
        leader = self.value(self.by_name[mimic.get("joint")], values)
        return float(mimic.get("multiplier", 1)) * leader + float(mimic.get("offset", 0))

    def poses(self, values):
        found, stack = {self.root: np.eye(4)}, [self.root]
        while stack:
            parent = stack.pop()
            for joint in self.below.get(parent, []):
                frame = found[parent] @ self.origin(joint.find("origin"))
                kind = joint.get("type")
                if kind in ("revolute", "continuous", "prismatic"):
                    axis = np.array(list(map(float, joint.find("axis").get("xyz").split())))
                    axis /= np.linalg.norm(axis)
                    motion = np.eye(4)
                    if kind == "prismatic":
                        motion[:3, 3] = axis * self.value(joint, values)
                    else:
                        motion[:3, :3] = rotation(axis, self.value(joint, values))
                    frame = frame @ motion
                child = joint.find("child").get("link")
                found[child] = frame
                stack.append(child)
        return found

    def moving_above(self, link):
        """The joints with one degree of freedom from the root to a link."""
        above = {joint.find("child").get("link"): joint for joint in self.joints}
        found = []
        while link in above:
            if above[link].get("type") in ("revolute", "continuous", "prismatic"):
                found.append(above[link])
            if above[link].get("type") in ("floating", "planar"):
                return None
            link = above[link].find("parent").get("link")
        return found[::-1]

    def inertia(self, link):
        inertial = self.links[link].find("inertial")
        if inertial is None:
            return 0.0, np.zeros(3), np.zeros((3, 3))
        frame = self.origin(inertial.find("origin"))
        xx, xy, xz, yy, yz, zz = (float(inertial.find("inertia").get("i" + key)) for key in ("xx", "xy", "xz", "yy", "yz", "zz"))
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        return float(inertial.find("mass").get("value")), frame[:3, 3], frame[:3, :3] @ tensor @ frame[:3, :3].T


def rotation(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def angle_between(a, b):
    return float(np.linalg.norm(a - b) / np.sqrt(2))


def link_of(model, b):
    return model.body(b).name or f"body{b}"


def compare(identity, path: Path, groebot: Path, vectors: int) -> Result:
    """All differences between groebot's robot and MuJoCo's model of the file."""
    result = Result(identity, vectors=vectors)
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        result.faults.append(f"MuJoCo refuses it: {str(error).splitlines()[0]}")
        return result
    run = subprocess.run([groebot, "export", path, "--to", "urdf"], capture_output=True, text=True, check=False)
    if run.returncode:
        result.faults.append(run.stderr.strip().splitlines()[-1] if run.stderr.strip() else f"exit status {run.returncode}")
        return result
    urdf = Urdf(run.stdout)
    bodies = [b for b in range(1, model.nbody) if link_of(model, b) in urdf.links]
    moving = [b for b in range(1, model.nbody) if model.body_dofnum[b] and b not in bodies]
    if moving:
        result.faults.append(f"bodies without a link: {[link_of(model, b) for b in moving][:4]}")
    result.bodies, result.joints = len(bodies), model.njnt
    masses(model, urdf, bodies, result)
    joints(model, urdf, result)
    positions(model, urdf, bodies, path, groebot, result)
    return result


def positions(model, urdf, bodies, path, groebot, result):
    data, followers, generator = mujoco.MjData(model), laws(model), np.random.default_rng(1)
    is_root_free = urdf.root in [link_of(model, b) for b in bodies]
    singles, asked, reached = freedoms(model), [], []
    for _ in range(result.vectors):
        used = posed(model, data, drawn(model, generator), followers, is_root_free)
        values = {one.name: float(used[one.joint][one.part] if one.kind == BALL else used[one.joint]) for one in singles}
        found = urdf.poses(values)
        for b in bodies:
            pose = found[link_of(model, b)]
            result.place = max(result.place, float(np.abs(pose[:3, 3] - data.xpos[b]).max()))
            result.turn = max(result.turn, angle_between(pose[:3, :3], data.xmat[b].reshape(3, 3)))
        asked.append(values)
        reached.append((data.xpos.copy(), data.xmat.copy()))
    leaves = [b for b in bodies if b not in set(model.body_parentid)]
    for b in leaves:
        chain = urdf.moving_above(link_of(model, b))
        if chain and len(chain) <= MOST_CHAIN and result.tips < MOST_TIPS:
            tip(urdf, chain, link_of(model, b), asked, [(p[b], m[b]) for p, m in reached], path, groebot, result)


def tip(urdf, chain, link, asked, reached, path, groebot, result):
    """The poses of one tip link by `groebot fk`."""
    # A joint whose leader is not in the chain has its own value.
    own = {joint.get("name") for joint in chain}
    names = [joint.get("name") for joint in chain if joint.find("mimic") is None or joint.find("mimic").get("joint") not in own]
    table = io.StringIO()
    writer = csv.writer(table)
    writer.writerow(names)
    writer.writerows([[repr(values[name]) for name in names] for values in asked])
    command = [groebot, "fk", path, "--base", urdf.root, "--tip", link, "--json"]
    run = subprocess.run(command, input=table.getvalue(), capture_output=True, text=True, check=False)
    if run.returncode:
        result.faults.append(f"fk {link}: {run.stderr.strip().splitlines()[-1] if run.stderr.strip() else run.returncode}")
        return
    answers = [json.loads(line) for line in run.stdout.splitlines() if line.strip()]
    result.tips += 1
    for answer, (place, turned) in zip(answers, reached, strict=True):
        position, matrix = pose_of(answer)
        result.tip_place = max(result.tip_place, float(np.abs(position - place).max()), angle_between(matrix, turned.reshape(3, 3)))


def pose_of(answer):
    matrix = np.zeros(9)
    x, y, z, w = answer["quaternion_xyzw"]
    mujoco.mju_quat2Mat(matrix, np.array([w, x, y, z]))
    return np.array(answer["position"]), matrix.reshape(3, 3)


def masses(model, urdf, bodies, result):
    for b in bodies:
        mass, centre, tensor = urdf.inertia(link_of(model, b))
        own, scale = float(model.body_mass[b]), max(float(model.body_inertia[b].max()), 1e-12)
        if own > 0 and mass == 0:
            result.unweighed += 1
            continue
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, model.body_iquat[b])
        matrix = matrix.reshape(3, 3)
        expected = matrix @ np.diag(model.body_inertia[b]) @ matrix.T
        result.mass = max(result.mass, abs(mass - own) / max(own, 1e-12))
        if own > 0:
            result.inertia = max(result.inertia, float(np.abs(centre - model.body_ipos[b]).max()), float(np.abs(tensor - expected).max()) / scale)


def joints(model, urdf, result):
    for one in freedoms(model):
        joint = urdf.by_name.get(one.name)
        if joint is None:
            result.faults.append(f"no joint {one.name}")
            continue
        dof = model.jnt_dofadr[one.joint]
        dynamics = joint.find("dynamics")
        own = [float(dynamics.get(key, 0)) if dynamics is not None else 0.0 for key in ("damping", "friction", "armature")]
        expected = [model.dof_damping[dof], model.dof_frictionloss[dof], model.dof_armature[dof]]
        result.dynamics = max(result.dynamics, float(np.abs(np.subtract(own, expected)).max()))
        limit = joint.find("limit")
        limits = None if limit is None or limit.get("lower") is None else [float(limit.get("lower")), float(limit.get("upper"))]
        if model.jnt_limited[one.joint] and one.kind != BALL:
            if limits is None:
                result.faults.append(f"joint {one.name} has no limits")
            else:
                result.limits = max(result.limits, float(np.abs(np.subtract(limits, model.jnt_range[one.joint])).max()))
        elif limits is not None and one.kind != SLIDE:
            result.faults.append(f"joint {one.name} has limits")
