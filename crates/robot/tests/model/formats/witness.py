"""MuJoCo's values of an MJCF, as JSON: python witness.py arm.xml > arm.json

Ten poses of all bodies at random joint values (a ball joint by three angles about x, y, z; followers by their law), limits, masses, inertias.
"""

import json
import sys

import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
draw = np.random.default_rng(7)
ball = int(mujoco.mjtJoint.mjJNT_BALL)


def name(kind, number):
    return getattr(model, kind)(number).name or f"{kind}{number}"


def pose():
    values = {}
    data.qpos[:] = model.qpos0
    for j in range(model.njnt):
        at = model.jnt_qposadr[j]
        if model.jnt_type[j] == ball:
            turned = np.array([1.0, 0, 0, 0])
            values[f"joint{j}"] = list(draw.uniform(-1, 1, 3))
            for axis, angle in zip(np.eye(3), values[f"joint{j}"]):
                product = np.zeros(4)
                mujoco.mju_mulQuat(product, turned, np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis]))
                turned = product
            data.qpos[at : at + 4] = turned
        else:
            low, high = model.jnt_range[j] if model.jnt_limited[j] else (-1, 1)
            data.qpos[at] = draw.uniform(low, high)
    for e in range(model.neq):
        if model.eq_type[e] == mujoco.mjtEq.mjEQ_JOINT and model.eq_active0[e]:
            one, other = (model.jnt_qposadr[joint] for joint in (model.eq_obj1id[e], model.eq_obj2id[e]))
            c = model.eq_data[e]
            data.qpos[one] = model.qpos0[one] + c[0] + c[1] * (data.qpos[other] - model.qpos0[other])
    for j in range(model.njnt):
        if model.jnt_type[j] != ball:
            values[name("joint", j)] = data.qpos[model.jnt_qposadr[j]]
    mujoco.mj_kinematics(model, data)
    bodies = {name("body", b): [*data.xpos[b], *data.xquat[b]] for b in range(1, model.nbody)}
    sites = {name("site", s): [*data.site_xpos[s]] for s in range(model.nsite)}
    return {"q": values, "bodies": bodies, "sites": sites}


def inertia(b):
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.body_iquat[b])
    turned = turned.reshape(3, 3)
    tensor = turned @ np.diag(model.body_inertia[b]) @ turned.T
    return {"mass": model.body_mass[b], "centre": list(model.body_ipos[b]), "tensor": tensor.tolist()}


limits = {name("joint", j): list(model.jnt_range[j]) for j in range(model.njnt) if model.jnt_limited[j]}
dynamics = {
    name("joint", j): [model.dof_damping[d], model.dof_frictionloss[d], model.dof_armature[d]]
    for j, d in enumerate(model.jnt_dofadr)
}
bodies = {name("body", b): inertia(b) for b in range(1, model.nbody)}
values = {"mujoco": mujoco.__version__, "limits": limits, "dynamics": dynamics, "inertias": bodies, "poses": [pose() for _ in range(10)]}
print(json.dumps(values))
