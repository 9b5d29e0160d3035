"""Writes an MJCF description as URDF: the compiled model of MuJoCo, body by body.

    GROEBOT_PYTHON mjcf.py robot.xml robot.urdf

Converted are the tree of bodies with their masses, centres of mass and inertia tensors, hinges and slides with their ranges, effort limits, damping, friction
and rotor inertias, and the boxes, spheres, capsules and cylinders that collide. Meshes, sites, equalities, tendons and actuators' gains are left out; MJCF has
no velocity limits. A capsule becomes a cylinder with two spheres. The free joint of the root is left out: a URDF's root is free.
"""

import math
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import mujoco
import numpy

DIGITS = 12
# MJCF has quaternions with six digits: angles so near to a multiple of 45 degrees are rounded to it [rad].
ROUNDING = 5e-6
EIGHTH = math.pi / 4


def text(numbers) -> str:
    return " ".join(repr(round(float(number), DIGITS) + 0.0) for number in numbers)


def matrix(quaternion) -> numpy.ndarray:
    entries = numpy.zeros(9)
    mujoco.mju_quat2Mat(entries, numpy.array(quaternion, dtype=float))
    return entries.reshape(3, 3)


def rpy(rotation: numpy.ndarray) -> list[float]:
    """Roll, pitch and yaw of a rotation, as in URDF."""
    pitch = math.atan2(-rotation[2, 0], math.hypot(rotation[0, 0], rotation[1, 0]))
    if math.hypot(rotation[0, 0], rotation[1, 0]) < 1e-9:
        return [0.0, pitch, math.atan2(-rotation[0, 1], rotation[1, 1])]
    return [math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])]


def origin(parent: ElementTree.Element, position, quaternion) -> None:
    ElementTree.SubElement(parent, "origin", xyz=text(position), rpy=text(map(rounded, rpy(matrix(quaternion)))))


def rounded(angle: float) -> float:
    nearest = EIGHTH * round(angle / EIGHTH)
    return nearest if abs(angle - nearest) < ROUNDING else angle


def inertial(link: ElementTree.Element, model: mujoco.MjModel, body: int) -> None:
    found = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(found, "origin", xyz=text(model.body_ipos[body]), rpy="0 0 0")
    ElementTree.SubElement(found, "mass", value=text([model.body_mass[body]]))
    axes = matrix(model.body_iquat[body])
    tensor = axes @ numpy.diag(model.body_inertia[body]) @ axes.T
    entries = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    ElementTree.SubElement(found, "inertia", {name: text([tensor[place]]) for name, place in entries.items()})


def collisions(link: ElementTree.Element, model: mujoco.MjModel, body: int) -> None:
    kinds = mujoco.mjtGeom
    for geom in range(model.ngeom):
        if model.geom_bodyid[geom] != body or not (model.geom_contype[geom] or model.geom_conaffinity[geom]):
            continue
        kind, (x, y, z) = model.geom_type[geom], model.geom_size[geom]
        place, turn = model.geom_pos[geom], model.geom_quat[geom]
        shapes = []
        if kind == kinds.mjGEOM_BOX:
            shapes = [("box", {"size": text([2 * x, 2 * y, 2 * z])}, 0.0)]
        elif kind == kinds.mjGEOM_SPHERE:
            shapes = [("sphere", {"radius": text([x])}, 0.0)]
        elif kind in (kinds.mjGEOM_CYLINDER, kinds.mjGEOM_CAPSULE):
            shapes = [("cylinder", {"radius": text([x]), "length": text([2 * y])}, 0.0)]
            if kind == kinds.mjGEOM_CAPSULE:
                shapes += [("sphere", {"radius": text([x])}, end) for end in (-y, y)]
        for name, sizes, along in shapes:
            collision = ElementTree.SubElement(link, "collision")
            origin(collision, place + matrix(turn) @ [0, 0, along], turn)
            ElementTree.SubElement(ElementTree.SubElement(collision, "geometry"), name, sizes)


def effort(model: mujoco.MjModel, joint: int) -> float | None:
    """The limit of the joint's torque or force: its own, else that of its actuator."""
    if model.jnt_actfrclimited[joint]:
        return float(numpy.abs(model.jnt_actfrcrange[joint]).max())
    for actuator in range(model.nu):
        if model.actuator_trntype[actuator] == mujoco.mjtTrn.mjTRN_JOINT and model.actuator_trnid[actuator, 0] == joint:
            gear = abs(float(model.actuator_gear[actuator, 0]))
            if model.actuator_forcelimited[actuator]:
                return gear * float(numpy.abs(model.actuator_forcerange[actuator]).max())
            is_torque = model.actuator_biastype[actuator] == mujoco.mjtBias.mjBIAS_NONE
            if is_torque and model.actuator_ctrllimited[actuator]:
                return gear * float(model.actuator_gainprm[actuator, 0] * numpy.abs(model.actuator_ctrlrange[actuator]).max())
    return None


def joined(robot: ElementTree.Element, model: mujoco.MjModel, body: int) -> None:
    """The joint between a body and its parent."""
    name = model.body(body).name
    own = [joint for joint in range(model.njnt) if model.jnt_bodyid[joint] == body]
    if len(own) > 1 or any(numpy.any(model.jnt_pos[joint] != 0.0) for joint in own):
        sys.exit(f"body {name} has several joints, or one that is not at its origin; such bodies are not converted")
    kinds = {int(mujoco.mjtJoint.mjJNT_HINGE): "revolute", int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic"}
    kind = kinds.get(int(model.jnt_type[own[0]])) if own else "fixed"
    if kind is None:
        sys.exit(f"body {name} has a ball or a free joint; such bodies are not converted")
    limits = {}
    if own:
        (joint,) = own
        if model.jnt_limited[joint]:
            limits["lower"], limits["upper"] = (text([end]) for end in model.jnt_range[joint])
        elif kind == "revolute":
            kind = "continuous"
        torque = effort(model, joint)
        limits |= {"effort": text([torque])} if torque else {}
    made = ElementTree.SubElement(robot, "joint", name=model.joint(own[0]).name if own else f"{name}_fixed", type=kind)
    origin(made, model.body_pos[body], model.body_quat[body])
    ElementTree.SubElement(made, "parent", link=model.body(model.body_parentid[body]).name)
    ElementTree.SubElement(made, "child", link=name)
    if own:
        dof = model.jnt_dofadr[own[0]]
        ElementTree.SubElement(made, "axis", xyz=text(model.jnt_axis[own[0]]))
        if limits:
            ElementTree.SubElement(made, "limit", limits)
        dynamics = {"damping": model.dof_damping[dof], "friction": model.dof_frictionloss[dof], "armature": model.dof_armature[dof]}
        ElementTree.SubElement(made, "dynamics", {key: text([numpy.ravel(value)[0]]) for key, value in dynamics.items()})


def main() -> int:
    source, target = sys.argv[1:]
    model = mujoco.MjModel.from_xml_path(source)
    robot = ElementTree.Element("robot", name=Path(source).stem)
    free = [model.jnt_bodyid[joint] for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE]
    root = free[0] if free else 1
    for body in range(1, model.nbody):
        if model.body_rootid[body] != root:
            continue
        link = ElementTree.SubElement(robot, "link", name=model.body(body).name)
        inertial(link, model, body)
        collisions(link, model, body)
        if body != root:
            joined(robot, model, body)
    ElementTree.indent(robot)
    ElementTree.ElementTree(robot).write(target, encoding="unicode")
    return 0


if __name__ == "__main__":
    sys.exit(main())
