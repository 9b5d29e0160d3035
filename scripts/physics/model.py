"""NAO V5 as a MuJoCo model, from this repository's own data (src/robots)."""

import math
import tomllib
from pathlib import Path

ROBOTS = Path(__file__).resolve().parents[2] / "src" / "robots"
SOLE_THICKNESS = 0.01


def read(name):
    with open(ROBOTS / f"{name}.toml", "rb") as file:
        return tomllib.load(file)


def numbers(values):
    return " ".join(f"{value:.10g}" for value in values)


def inertial(link, mass_factor=1.0):
    xx, yy, zz, xy, xz, yz = (mass_factor * moment for moment in link["inertia"])
    return (
        f'<inertial pos="{numbers(link["centre"])}" mass="{mass_factor * link["mass"]:.10g}" '
        f'fullinertia="{numbers([xx, yy, zz, xy, xz, yz])}"/>'
    )


def sole_box(sole, offset_z):
    (back, front), (right, left) = sole["x"], sole["y"]
    half = SOLE_THICKNESS / 2
    centre = [(back + front) / 2, (right + left) / 2, offset_z + half]
    size = [(front - back) / 2, (left - right) / 2, half]
    return (
        f'<geom name="{sole["limb"]}" class="sole" type="box" pos="{numbers(centre)}" size="{numbers(size)}"/>'
        f'<site name="{sole["limb"]}" pos="0 0 {offset_z:.10g}"/>'
    )


def capsule(start, end, radius):
    if math.dist(start, end) < 1e-6:
        return f'<geom class="look" type="sphere" size="{radius}" pos="{numbers(start)}"/>'
    return f'<geom class="look" type="capsule" size="{radius}" fromto="{numbers([*start, *end])}"/>'


def limb_body(limb, chain, soles, actuators, scale):
    """The nested bodies of a limb, and an actuator for each of its joints."""
    to_radians = math.radians if chain.get("angle_unit") == "deg" else float
    opened, text = 0, ""
    joints = chain["joint"]
    for place, (link, joint) in enumerate(zip(limb["link"], joints)):
        at = joint["origin"].get("xyz", [0, 0, 0])
        name = limb["prefix"] + joint["name"]
        low, high = (to_radians(limit) for limit in joint["limits"])
        text += f'<body name="{link["name"]}" pos="{numbers(at)}">{inertial(link)}'
        text += f'<joint name="{name}" axis="{numbers(joint["axis"])}" range="{low:.10g} {high:.10g}"/>'
        after = joints[place + 1]["origin"] if place + 1 < len(joints) else chain["tip"]["origin"]
        text += capsule([0, 0, 0], after.get("xyz", [0, 0, 0]), 0.02)
        actuators.append(f'<position name="{name}" joint="{name}" kp="{150 * scale:.10g}"/>')
        opened += 1
    for sole in soles:
        if sole["limb"] == limb["chain"]:
            text += sole_box(sole, chain["tip"]["origin"]["xyz"][2])
    if limb["chain"] == "nao_head":
        text += '<geom class="look" type="sphere" size="0.06" pos="0 0 0.06"/>'
    return text + "</body>" * opened


def xml(friction=0.8, torso_mass=1.0, gain=1.0, slope=(0.0, 0.0)):
    """The model as MJCF: slope is the tilt of the floor about x and about y [rad]."""
    robot = read("whole/nao_v5")
    actuators = []
    limbs = "".join(
        limb_body(limb, read(f"data/{limb['chain']}"), robot["sole"], actuators, gain) for limb in robot["limb"]
    )
    gravity = 9.80665
    roll, pitch = slope
    # Turning gravity instead of the floor keeps the floor at z = 0.
    down = [-gravity * math.sin(pitch), gravity * math.sin(roll), -gravity * math.cos(pitch) * math.cos(roll)]
    return f"""<mujoco model="nao_v5">
  <compiler angle="radian"/>
  <option timestep="0.002" gravity="{numbers(down)}" integrator="implicitfast"/>
  <visual><global offwidth="960" offheight="540"/></visual>
  <default>
    <joint damping="1.084" armature="0.045" limited="true"/>
    <geom friction="{friction} 0.005 0.0001"/>
    <default class="sole"><geom contype="1" conaffinity="2" rgba="0.2 0.4 0.8 1" mass="0"/></default>
    <default class="look"><geom contype="0" conaffinity="0" mass="0" rgba="0.85 0.85 0.85 1"/></default>
  </default>
  <worldbody>
    <light pos="0 -1 2" dir="0 0.5 -1"/>
    <camera name="side" pos="0.15 -1.1 0.35" xyaxes="1 0 0 0 0.17 1"/>
    <geom name="floor" type="plane" size="5 5 0.1" contype="2" conaffinity="1" rgba="0.6 0.65 0.6 1"/>
    <body name="Torso">
      <freejoint name="free"/>
      {inertial(robot["base"], torso_mass)}
      <geom class="look" type="box" size="0.04 0.06 0.09" pos="0 0 0.02"/>
      {limbs}
    </body>
  </worldbody>
  <actuator>{"".join(actuators)}</actuator>
</mujoco>"""
