"""What MuJoCo makes of a model: python mujoco.py ROBOT.xml VALUES.json, where VALUES is a list of poses, each with the values of joints by name.

Degrees of freedom, servos, masses and centres of mass, and in each pose where the bodies are and by how much joints that are tied are off, as JSON.
"""

import json
import sys

# This file must not be found in the place of the package.
sys.path.pop(0)
try:
    import mujoco
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(7)

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
bodies = [model.body(number) for number in range(1, model.nbody)]


def posed(values):
    data.qpos[:] = model.qpos0
    for name, value in values.items():
        data.joint(name).qpos = value
    mujoco.mj_forward(model, data)
    places = {body.name: [*data.body(body.id).xpos, *data.body(body.id).xquat] for body in bodies}
    return {"bodies": places, "off": max(map(abs, data.efc_pos[: data.ne]), default=0.0)}


with open(sys.argv[2], encoding="utf-8") as file:
    poses = [posed(values) for values in json.load(file)]
reported = {
    "freedom": model.nv,
    "servos": model.nu,
    "ties": model.neq,
    "masses": {body.name: body.mass[0] for body in bodies},
    "centres": {body.name: list(body.ipos) for body in bodies},
    "poses": poses,
}
print(json.dumps(reported))
