"""Drake's values of an SDF, as JSON: python witness_sdf.py arm.sdf > arm_sdf.json

Ten poses of all links and frames at random joint values, limits, masses and inertias. Followers have the value of their law, which Drake does not impose.
"""

import json
import os
import sys
import xml.etree.ElementTree as ET

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex, FrameIndex

plant = MultibodyPlant(0.0)
parser = Parser(plant)
parser.package_map().Add("hand", os.path.join(os.path.dirname(os.path.abspath(sys.argv[1])), "hand"))
parser.AddModels(os.path.abspath(sys.argv[1]))
plant.Finalize()
context = plant.CreateDefaultContext()
draw = np.random.default_rng(7)
outer = ET.parse(sys.argv[1]).getroot().find("model").get("name")
laws = {
    joint.get("name"): [joint.find("axis/mimic").get("joint"), *(float(joint.find(f"axis/mimic/{key}").text) for key in ("multiplier", "offset", "reference"))]
    for joint in ET.parse(sys.argv[1]).getroot().iter("joint")
    if joint.find("axis/mimic") is not None
}


# Drake gives a joint and a frame to the model of the link that they are fixed to.
model = ET.parse(sys.argv[1]).getroot().find("model")
own = {element.get("name") for element in model.findall("joint") + model.findall("frame")}


def full(element):
    """The name in the outermost model, `hand::finger`."""
    if element.name() in own:
        return element.name()
    scope = plant.GetModelInstanceName(element.model_instance())
    scope = scope.removeprefix(outer).removeprefix("::")
    return f"{scope}::{element.name()}" if scope else element.name()


every_joint = [plant.get_joint(j) for j in plant.GetJointIndices()]
joints = [joint for joint in every_joint if joint.num_positions() == 1]
bodies = [plant.get_body(BodyIndex(b)) for b in range(1, plant.num_bodies())]
frames = [plant.get_frame(FrameIndex(f)) for f in range(1, plant.num_frames()) if plant.GetModelInstanceName(plant.get_frame(FrameIndex(f)).model_instance()).startswith(outer)]
frames = [frame for frame in frames if not frame.name().startswith("__") and not any(frame.name().startswith(joint.name()) for joint in every_joint)]


def pose():
    values = {full(joint): draw.uniform(*np.clip([joint.position_lower_limits()[0], joint.position_upper_limits()[0]], -2, 2)) for joint in joints}
    for name, (leader, multiplier, offset, reference) in laws.items():
        values[name] = multiplier * (values[leader] - reference) + offset
    q = np.zeros(plant.num_positions())
    for joint in joints:
        q[joint.position_start()] = values[full(joint)]
    plant.SetPositions(context, q)
    found = {}
    for frame in frames:
        transform = frame.CalcPoseInWorld(context)
        found[full(frame)] = [*transform.translation(), *transform.rotation().matrix().flatten()]
    return {"q": values, "frames": found}


def inertia(body):
    spatial = body.default_spatial_inertia()
    centre = spatial.CalcComMoment() / spatial.get_mass()
    about = spatial.Shift(centre).CalcRotationalInertia().CopyToFullMatrix3()
    return {"mass": spatial.get_mass(), "centre": list(centre), "tensor": list(about.flatten())}


limits = {full(joint): [joint.position_lower_limits()[0], joint.position_upper_limits()[0]] for joint in joints if np.isfinite(joint.position_lower_limits()[0])}
values = {"limits": limits, "inertias": {full(body): inertia(body) for body in bodies}, "poses": [pose() for _ in range(10)]}
print(json.dumps(values))
