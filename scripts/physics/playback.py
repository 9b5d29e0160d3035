"""Plays a walk of `groebot walk` open loop on a rigid-body model of its robot in MuJoCo, and measures what the robot does.

    python playback.py robot.xml walk.csv [--feet LEFT,RIGHT] [--nominal] [--frames FOLDER]

robot.xml is what `groebot export ROBOT --format mjcf` writes. Position servos, steps of 2 ms, commands as often as the walk has rows. Then twelve
disturbances. The exit status is 0 when every run meets the demands.
"""

import argparse
import csv
import math
import sys

import mujoco
import numpy

STEP = 0.002
FRICTION = 0.8
# Servos by the size of the robot, m its mass and l 0.63 of the height of its torso: kp in m g l, damping in m g^0.5 l^1.5, armature in m l^2.
# NAO (m g l = 10.4 Nm) has 150 Nm/rad, 1.084 Nms/rad and 0.045 kg m^2.
STIFFNESS, DAMPING, ARMATURE = 14.4, 0.73, 0.21
CASES = {
    "nominal": {},
    "friction 0.5": {"friction": 0.5},
    "friction 1.2": {"friction": 1.2},
    "torso 10 % lighter": {"torso_mass": 0.9},
    "torso 10 % heavier": {"torso_mass": 1.1},
    "gains 20 % lower": {"gain": 0.8},
    "gains 20 % higher": {"gain": 1.2},
    "floor rises 1 deg ahead": {"slope": (0.0, math.radians(1))},
    "floor falls 1 deg ahead": {"slope": (0.0, -math.radians(1))},
    "floor rises 1 deg to the left": {"slope": (math.radians(1), 0.0)},
    "floor falls 1 deg to the left": {"slope": (-math.radians(1), 0.0)},
    "latency 20 ms": {"latency": 0.02},
    "latency 40 ms": {"latency": 0.04},
}
MOST_TILT = math.radians(8)
DISTANCE_SHARE, TURN_ERROR = 0.10, math.radians(2)
LIFTED = 0.005


def load(path):
    """The columns of a trajectory by their names: `q:KNEE [rad]` is `KNEE`, `base_x [m]` is `base_x`."""
    with open(path, newline="") as file:
        if file.readline().strip() != "# groebot trajectory 1":
            sys.exit(f"{path}: this is no trajectory of version 1")
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    walk = {
        name.rsplit(" ", 1)[0].removeprefix("q:"): numpy.array([float(row[name]) for row in rows]) for name in rows[0]
    }
    for side in ("left", "right"):
        x, y, z, w = (walk[f"{side}_q{axis}"] for axis in "xyzw")
        walk[f"{side}_yaw"] = numpy.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return walk


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


class Robot:
    """The model at the first row of a walk."""

    def __init__(self, path, feet, walk, servo, latency=0.0, friction=FRICTION, torso_mass=1.0, gain=1.0, slope=(0.0, 0.0)):
        self.walk, self.latency = walk, latency
        self.tick = walk["time"][1] - walk["time"][0]
        model = mujoco.MjModel.from_xml_path(path)
        model.opt.timestep = STEP
        roll, pitch = slope
        gravity = 9.80665
        # Turning gravity instead of the floor keeps the floor at z = 0.
        model.opt.gravity[:] = [
            -gravity * math.sin(pitch), gravity * math.sin(roll), -gravity * math.cos(pitch) * math.cos(roll)
        ]
        model.geom_friction[:, 0] = friction
        torso = 1
        heaviest = max(range(1, model.nbody), key=lambda body: model.body_mass[body])
        model.body_mass[heaviest] *= torso_mass
        model.body_inertia[heaviest] *= torso_mass
        self.torso = torso
        mass, height = model.body_subtreemass[torso], walk["base_z"][0]
        length = 0.63 * height
        size = mass * gravity * length
        stiffness = servo[0] * size * gain
        damping = servo[1] * mass * math.sqrt(gravity) * length**1.5
        for actuator in range(model.nu):
            dof = model.jnt_dofadr[model.actuator_trnid[actuator, 0]]
            model.actuator_gainprm[actuator, 0] = stiffness
            model.actuator_biasprm[actuator, 1:3] = -stiffness, -damping
            model.dof_armature[dof] = max(model.dof_armature[dof], servo[2] * mass * length**2)
        self.model, self.data = model, mujoco.MjData(model)
        # What MuJoCo makes of masses and armatures for its contacts.
        mujoco.mj_setConst(model, self.data)
        self.data = mujoco.MjData(model)
        names = [model.actuator(i).name for i in range(model.nu)]
        angles = numpy.column_stack([walk[name] for name in names])
        # A servo damps what its joint turns faster than it should.
        self.commands = angles + damping / stiffness * numpy.gradient(angles, self.tick, axis=0)
        self.data.qpos[:7] = [walk[f"base_{key}"][0] for key in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        for joint in range(1, model.njnt):
            self.data.qpos[model.jnt_qposadr[joint]] = walk[model.joint(joint).name][0]
        mujoco.mj_forward(model, self.data)
        self.start_height = height
        self.floor = model.geom("floor").id
        self.feet = {side: model.body(name).id for side, name in zip(("left", "right"), feet)}
        # A sole is welded to the foot that carries its shapes.
        self.bodies = {
            side: {other for other in range(model.nbody) if model.body_weldid[other] == model.body_weldid[body]}
            for side, body in self.feet.items()
        }

    def step(self, time):
        row = int(round((time - self.latency) / STEP)) // int(round(self.tick / STEP))
        self.data.ctrl[:] = self.commands[min(max(row, 0), len(self.commands) - 1)]
        mujoco.mj_step(self.model, self.data)

    def tilt(self):
        return math.acos(min(1.0, self.data.xmat[self.torso][8]))

    def foot(self, side):
        """Position of the sole's frame, heading, height of the lowest point."""
        body = self.feet[side]
        matrix = self.data.xmat[body]
        lowest = min(self.lowest(geom) for geom in range(self.model.ngeom) if self.collides(geom, side))
        return self.data.xpos[body].copy(), math.atan2(matrix[3], matrix[0]), lowest

    def collides(self, geom, side):
        return self.model.geom_bodyid[geom] in self.bodies[side] and self.model.geom_contype[geom]

    def lowest(self, geom):
        centre, turn = self.data.geom_xpos[geom], self.data.geom_xmat[geom].reshape(3, 3)
        kind, size = self.model.geom_type[geom], self.model.geom_size[geom]
        if kind == mujoco.mjtGeom.mjGEOM_BOX:
            return centre[2] - numpy.abs(turn[2]) @ size
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = self.model.geom_dataid[geom]
            start, count = self.model.mesh_vertadr[mesh], self.model.mesh_vertnum[mesh]
            return centre[2] + (self.model.mesh_vert[start : start + count] @ turn[2]).min()
        return centre[2] - size[0] - abs(turn[2, 2]) * size[1]

    def pressed(self):
        """The force on each foot from the floor [N]."""
        forces = dict.fromkeys(self.feet, 0.0)
        wrench = numpy.zeros(6)
        for index in range(self.data.ncon):
            contact = self.data.contact[index]
            touching = {self.model.geom_bodyid[contact.geom1], self.model.geom_bodyid[contact.geom2]}
            for side, bodies in self.bodies.items():
                if touching & bodies:
                    mujoco.mj_contactForce(self.model, self.data, index, wrench)
                    forces[side] += wrench[0]
        return forces


def middle(robot):
    (left, left_yaw, _), (right, right_yaw, _) = robot.foot("left"), robot.foot("right")
    at = (left + right) / 2
    return at, left_yaw + wrapped(right_yaw - left_yaw) / 2


def play(path, feet, walk, servo, film=None, **figures):
    robot = Robot(path, feet, walk, servo, **figures)
    start, start_yaw = middle(robot)
    steps = int(round((walk["time"][-1] + 0.5) / STEP))
    tilt, fell = 0.0, False
    aloft = dict.fromkeys(robot.feet, False)
    landings = dict.fromkeys(robot.feet, 0)
    highest = dict.fromkeys(robot.feet, 0.0)
    lifts = []
    for index in range(steps):
        robot.step(index * STEP)
        tilt = max(tilt, robot.tilt())
        fell = fell or robot.data.qpos[2] < 0.6 * robot.start_height
        if index % 5 == 0:
            for side in robot.feet:
                height = robot.foot(side)[2]
                highest[side] = max(highest[side], height)
                # A foot is up when it is clear of the floor, and has landed when it carries weight again.
                if height > LIFTED:
                    aloft[side] = True
                elif aloft[side] and robot.pressed()[side] > 5.0:
                    aloft[side] = False
                    landings[side] += 1
                    lifts.append(highest[side])
                    highest[side] = 0.0
        if film and index % 50 == 0:
            film(robot, index)
    end, end_yaw = middle(robot)
    cosine, sine = math.cos(start_yaw), math.sin(start_yaw)
    dx, dy = (end - start)[:2]
    return {
        "x": cosine * dx + sine * dy,
        "y": cosine * dy - sine * dx,
        "turn": wrapped(end_yaw - start_yaw),
        "tilt": tilt,
        "landings": sum(landings.values()),
        "lift": min(lifts, default=0.0),
        "fell": fell,
    }


def planned(walk):
    def row(index):
        left, right = ([walk[f"{side}_{key}"][index] for key in ("x", "y", "yaw")] for side in ("left", "right"))
        yaw = left[2] + wrapped(right[2] - left[2]) / 2
        return (left[0] + right[0]) / 2, (left[1] + right[1]) / 2, yaw

    (x0, y0, yaw0), (x1, y1, yaw1) = row(0), row(-1)
    swings = sum(int(numpy.sum(numpy.diff(walk[f"{side}_stands"]) > 0)) for side in ("left", "right"))
    cosine, sine = math.cos(yaw0), math.sin(yaw0)
    dx, dy = x1 - x0, y1 - y0
    return {
        "x": cosine * dx + sine * dy, "y": cosine * dy - sine * dx, "turn": wrapped(yaw1 - yaw0), "landings": swings
    }


def faults(result, plan):
    distance = math.hypot(plan["x"], plan["y"])
    error = math.hypot(result["x"] - plan["x"], result["y"] - plan["y"])
    wrong = []
    if result["fell"]:
        wrong.append("it fell")
    if error > DISTANCE_SHARE * distance + (0.02 if distance < 0.05 else 0.0):
        wrong.append(f"its place is off by {1e3 * error:.0f} mm")
    if abs(wrapped(result["turn"] - plan["turn"])) > TURN_ERROR:
        wrong.append("its turn is off")
    if result["tilt"] > MOST_TILT:
        wrong.append("it tilts too far")
    if result["landings"] != plan["landings"]:
        wrong.append(f"{result['landings']} landings, {plan['landings']} planned")
    return wrong


def filming(folder):
    from pathlib import Path

    from PIL import Image

    Path(folder).mkdir(parents=True, exist_ok=True)
    renderers = {}

    def film(robot, index):
        renderer = renderers.setdefault(id(robot.model), mujoco.Renderer(robot.model, 480, 640))
        camera = mujoco.MjvCamera()
        camera.lookat[:] = robot.data.xpos[robot.torso]
        camera.distance, camera.azimuth, camera.elevation = 3.2 * robot.start_height, 120.0, -12.0
        renderer.update_scene(robot.data, camera=camera)
        Image.fromarray(renderer.render()).save(f"{folder}/{index * STEP:06.2f}.png")

    return film


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robot", help="MJCF of `groebot export`")
    parser.add_argument("walk", help="CSV of `groebot walk`")
    parser.add_argument("--feet", default="l_sole,r_sole", help="the links of the soles, left and right")
    parser.add_argument(
        "--servo", default=f"{STIFFNESS},{DAMPING},{ARMATURE}", help="stiffness, damping, armature by the size of the robot"
    )
    parser.add_argument("--frames", help="folder for pictures of the nominal run, ten a second")
    parser.add_argument("--nominal", action="store_true", help="no disturbances")
    arguments = parser.parse_args()
    walk, feet = load(arguments.walk), arguments.feet.split(",")
    servo = [float(figure) for figure in arguments.servo.split(",")]
    plan = planned(walk)
    print(f"planned: {plan['x']:.3f} {plan['y']:.3f} m, {math.degrees(plan['turn']):.1f} deg, {plan['landings']} landings")
    failed = 0
    for name, figures in CASES.items():
        if arguments.nominal and figures:
            break
        film = filming(arguments.frames) if arguments.frames and not figures else None
        result = play(arguments.robot, feet, walk, servo, film=film, **figures)
        wrong = faults(result, plan)
        failed += bool(wrong)
        print(
            f"{name:30} {result['x']:7.3f} {result['y']:7.3f} m {math.degrees(result['turn']):6.1f} deg  "
            f"tilt {math.degrees(result['tilt']):4.1f} deg  {result['landings']} landings  "
            f"lift {1e3 * result['lift']:4.1f} mm  {'; '.join(wrong) or 'ok'}",
            flush=True,
        )
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
