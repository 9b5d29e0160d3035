"""Forward kinematics of Denavit-Hartenberg tables and URDFs in numpy, independent of groebot."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parents[2]
DERIVATIONS = REPOSITORY / "derivations"
UR5_URDF = REPOSITORY / "tests/corpus/urdf/ur5.urdf"
KUKA_URDF = REPOSITORY / "tests/corpus/urdf/kr6_r900.urdf"
PANDA_URDF = REPOSITORY / "tests/corpus/redundant/arms/panda.urdf"

# Universal Robots' DH table: a, alpha, d of each joint.
UR5_DH = [
    (0.0, np.pi / 2, 0.089159),
    (-0.425, 0.0, 0.0),
    (-0.39225, 0.0, 0.0),
    (0.0, np.pi / 2, 0.10915),
    (0.0, -np.pi / 2, 0.09465),
    (0.0, 0.0, 0.0823),
]


def dh_forward(table, q):
    """The poses (N, 4, 4) that joint values (N, joints) reach."""
    poses = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    for (a, alpha, d), theta in zip(table, np.asarray(q).T):
        c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        step = np.zeros((len(theta), 4, 4))
        step[:, 0] = np.stack([c, -s * ca, s * sa, a * c], 1)
        step[:, 1] = np.stack([s, c * ca, -c * sa, a * s], 1)
        step[:, 2, 1:] = sa, ca, d
        step[:, 3, 3] = 1.0
        poses = poses @ step
    return poses


def urdf_forward(path, q, tip):
    """The pose (4, 4) of the link `tip` in the root frame, by the tree of a URDF. Joint values are in the order of the file."""
    root = ElementTree.parse(path).getroot()
    joints = root.findall("joint")
    moving = [joint.get("name") for joint in joints if joint.get("type") in ("revolute", "continuous", "prismatic")]
    above = {joint.find("child").get("link"): joint for joint in joints}
    pose, link = np.eye(4), tip
    while link in above:
        joint = above[link]
        own = _origin(joint.find("origin"))
        if joint.get("name") in moving:
            axis = np.array([float(x) for x in joint.find("axis").get("xyz").split()])
            own = own @ _motion(joint.get("type"), axis, q[moving.index(joint.get("name"))])
        pose, link = own @ pose, joint.find("parent").get("link")
    return pose


def _origin(element):
    pose = np.eye(4)
    if element is None:
        return pose
    numbers = lambda key: [float(x) for x in element.get(key, "0 0 0").split()]
    for axis, angle in zip(np.eye(3), numbers("rpy")):
        pose = _motion("revolute", axis, angle) @ pose
    pose[:3, 3] = numbers("xyz")
    return pose


def _motion(kind, axis, value):
    pose = np.eye(4)
    axis = axis / np.linalg.norm(axis)
    if kind == "prismatic":
        pose[:3, 3] = axis * value
        return pose
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose[:3, :3] = np.eye(3) + np.sin(value) * cross + (1 - np.cos(value)) * cross @ cross
    return pose


def same_angles(a, b):
    """The difference of joint values, modulo whole turns."""
    return np.abs((np.asarray(a) - np.asarray(b) + np.pi) % (2 * np.pi) - np.pi).max(-1)
