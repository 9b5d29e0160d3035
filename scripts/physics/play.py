"""Plays a walk on a rigid-body model of its robot in MuJoCo: one run of `groebot simulate`, which contains this script.

    python play.py robot.xml walk.csv answer.csv [--feet LEFT,RIGHT] [--servo STIFFNESS,DAMPING,ARMATURE] [--friction F] [--slope ROLL,PITCH]
                   [--mass FACTOR] [--gain FACTOR] [--latency SECONDS] [--push TIME,NEWTON,SECONDS,DEGREES] [--noise FACTOR]
                   [--feedback PERIOD --soles NUMBERS] [--frames FOLDER]

robot.xml is the output of `groebot export ROBOT --to mjcf`. walk.csv is a trajectory with a base and the contacts `left` and `right`. answer.csv is a
trajectory with the same times until the robot falls: joints, base, soles and their floor contact, the zero moment point from the contact forces of the last 20
ms, torques. The motor parameters and the time of the fall are written to standard output as JSON.

With --feedback, the names of the joints and the nominal stiffness of their motors are first written to standard output, as JSON. Then, each PERIOD, the state is one line of numbers there: time
[s], joint values, orientation of the base (quaternion xyzw, from the base to a world whose z axis is vertical), its angular velocity in its own frame
[rad/s], and for the left and the right sole force [N] and moment [N m] in the frame of the sole. A line of standard input is the answer: the targets of
the joints, then their velocities, or `lost` if the feedback finds no posture: the robot then falls.
"""

import argparse
import csv
import json
import math
import os
import sys

try:
    import mujoco
    import numpy
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(7)

STEP = 0.002
GRAVITY = 9.80665
# Servo parameters of joints without described gains, scaled by the robot's size. m is its mass, and l is 0.63 of the height of its torso: kp in m g l, damping
# in m g^0.5 l^1.5, armature in m l^2. For NAO (m g l = 10.3 Nm) they are 308 Nm/rad, 2.2 Nms/rad and 0.043 kg m^2.
SERVO = 30.0, 1.5, 0.21
LENGTH = 0.63
# The least error at which a servo may use its effort limit [rad or m]. A joint at 2 rad/s moves so far in 5 ms, the period of the feedback: a stiffer servo
# saturates between two commands.
LINEAR = 0.01
# The time in which a motor without load reaches its velocity limit with its effort limit [s]: its inertia is effort times this / velocity.
MOTOR_TIME = 0.015
# The moments of inertia of a body that is described as a point, as a fraction of its mass times l^2. The value is that
# of TEO's trunk.
POINT = 0.2
# Time for which the robot must stand after the last row [s].
AFTER = 1.0
# Time window of the contact forces [s].
WINDOW = 0.02
MOST_TILT = math.radians(45)
LEAST_HEIGHT = 0.6
# Fraction of the weight above which a foot is in contact.
PRESSED = 0.01
# Standard deviations of measurements with --noise 1: joint values [rad], orientation [rad], angular velocity [rad/s], forces and moments by their magnitude.
NOISE = 5e-4, 5e-3, 2e-2, 2e-2
POSE = ("x [m]", "y [m]", "z [m]", "qx [1]", "qy [1]", "qz [1]", "qw [1]")


def load(path):
    """The columns of a trajectory by their names: `q:KNEE [rad]` is `q:KNEE`, `base_x [m]` is `base_x`. Also returns its remarks."""
    with open(path, newline="") as file:
        lines = list(file)
    remarks = [line for line in lines if line.startswith("#")]
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name.rsplit(" ", 1)[0]: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}, remarks


class Robot:
    """The model at the first row of a walk."""

    def __init__(self, given, walk):
        model = mujoco.MjModel.from_xml_path(given.robot)
        self.model, self.walk, self.latency = model, walk, given.latency
        self.torso, self.height = 1, walk["base_z"][0]
        roll, pitch = (math.radians(angle) for angle in given.slope)
        # Rotation of gravity instead of the floor keeps the floor at z = 0.
        across, down = math.cos(pitch) * math.sin(roll), math.cos(pitch) * math.cos(roll)
        model.opt.gravity[:] = [GRAVITY * math.sin(pitch), -GRAVITY * across, -GRAVITY * down]
        self.level = turn_to_z(-model.opt.gravity / GRAVITY)
        model.geom_friction[:, 0] = given.friction
        self.mount(given.servo, given.gain)
        model.body_mass[:] *= given.mass
        model.body_inertia[:] *= given.mass
        # Recomputes the constants of MuJoCo's contacts that depend on masses and armatures.
        mujoco.mj_setConst(model, mujoco.MjData(model))
        self.data = mujoco.MjData(model)
        self.names = [model.actuator(i).name for i in range(model.nu)]
        zeros = numpy.zeros(len(walk["time"]))
        self.angles = numpy.column_stack([walk.get(f"q:{name}", zeros) for name in self.names])
        rates = numpy.gradient(self.angles, walk["time"], axis=0)
        # A servo damps the excess of its joint's velocity.
        self.commands = self.angles + self.damping / self.stiffness * rates
        self.data.qpos[:7] = [walk[f"base_{key}"][0] for key in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        for joint in range(1, model.njnt):
            self.data.qpos[model.jnt_qposadr[joint]] = walk.get(f"q:{model.joint(joint).name}", zeros)[0]
        self.data.ctrl[:] = self.angles[0]
        mujoco.mj_forward(model, self.data)
        self.floor = model.geom("floor").id
        self.feet = [model.body(name).id for name in given.feet]
        # A sole is welded to the foot that carries its shapes.
        self.bodies = [set(numpy.flatnonzero(model.body_weldid == model.body_weldid[body])) for body in self.feet]
        self.shapes = [
            [g for g in range(model.ngeom) if model.geom_bodyid[g] in bodies and model.geom_contype[g]]
            for bodies in self.bodies
        ]
        self.wrench, self.lost = numpy.zeros(6), False
        self.weight = model.body_subtreemass[0] * GRAVITY
        self.soles = numpy.reshape(given.soles, (2, 7)) if given.soles else numpy.tile([0.0, 0, 0, 0, 0, 0, 1], (2, 1))
        self.push, self.feedback = given.push, Feedback(self, given) if given.feedback else None

    def mount(self, servo, gain):
        """Adds the motor of each joint."""
        model = self.model
        self.points, mass, length = [], model.body_subtreemass[self.torso], LENGTH * self.height
        units = mass * GRAVITY * length, mass * math.sqrt(GRAVITY) * length**1.5, mass * length**2
        stiffness, damping, self.armature = (factor * unit for factor, unit in zip(servo or SERVO, units))
        self.stiffness, self.damping = numpy.full(model.nu, stiffness), numpy.full(model.nu, damping)
        self.described, self.unused = numpy.zeros(model.nu, dtype=bool), None
        if servo is None:
            weaken = numpy.where(model.actuator_forcelimited, model.actuator_forcerange[:, 1] / (LINEAR * stiffness), 1.0).clip(max=1.0)
            self.stiffness, self.damping = weaken * stiffness, weaken * damping
            if model.nuser_actuator > 1:
                self.described = model.actuator_user[:, 1] == 1.0
                greatest = model.actuator_gainprm[self.described, 0].max(initial=0.0)
                # No joint could hold the robot upright: gains of learned policies.
                if self.described.any() and greatest < units[0]:
                    self.described[:], self.unused = False, float(greatest)
        for body in range(1, model.nbody):
            if model.body_mass[body] > 0.01 * mass and max(model.body_inertia[body]) < 1e-6 * mass * length**2:
                model.body_inertia[body] = POINT * model.body_mass[body] * length**2
                self.points.append(model.body(body).name)
        for actuator in range(model.nu):
            dof = model.jnt_dofadr[model.actuator_trnid[actuator, 0]]
            if self.described[actuator]:
                self.take(actuator, dof)
            else:
                model.dof_armature[dof] = max(model.dof_armature[dof], self.inertia(actuator))
        self.nominal = self.stiffness.copy()
        self.stiffness *= gain
        model.actuator_gainprm[:, 0] = self.stiffness
        model.actuator_biasprm[:, 1], model.actuator_biasprm[:, 2] = -self.stiffness, -self.damping

    def take(self, actuator, dof):
        """Takes the gains of the description. A servo without any damping is critically damped; the inertia is at least that which MuJoCo integrates stably."""
        model, stiffness = self.model, self.model.actuator_gainprm[actuator, 0]
        model.dof_armature[dof] = max(model.dof_armature[dof], stiffness * STEP**2)
        damping = -model.actuator_biasprm[actuator, 2]
        if damping == 0.0 and model.dof_damping[dof] == 0.0:
            damping = 2 * math.sqrt(stiffness * model.dof_armature[dof])
        self.stiffness[actuator], self.damping[actuator] = stiffness, damping

    def inertia(self, actuator):
        """The inertia of a motor at its joint: by the limits of its effort and its velocity (`user`) where there are both, else by the robot's size."""
        model = self.model
        speed = model.actuator_user[actuator, 0] if model.nuser_actuator else 0.0
        # The servo's own frequency is at most 1 / (2 STEP): MuJoCo integrates this stably.
        least = self.stiffness[actuator] * (2 * STEP) ** 2
        if speed == 0.0 or not model.actuator_forcelimited[actuator]:
            return self.armature
        return min(max(MOTOR_TIME * model.actuator_forcerange[actuator, 1] / speed, least), self.armature)

    def motors(self):
        """The stiffness, damping and inertia of each motor."""
        joints = self.model.actuator_trnid[:, 0]
        inertias = self.model.dof_armature[self.model.jnt_dofadr[joints]]
        rows = zip(self.names, self.stiffness, self.damping, inertias, self.described)
        return [
            {"joint": name, "stiffness": float(k), "damping": float(d), "armature": float(inertia), "described": bool(described)}
            for name, k, d, inertia, described in rows
        ]

    def command(self, time):
        """Sets the commands of the servos: those of the feedback, or by linear interpolation between rows."""
        self.press(time)
        if self.feedback:
            self.feedback.command(time)
            return
        times, time = self.walk["time"], time - self.latency
        row = min(max(int(numpy.searchsorted(times, time, "right")) - 1, 0), len(times) - 1)
        after = min(row + 1, len(times) - 1)
        share = (time - times[row]) / (times[after] - times[row]) if after > row else 0.0
        self.data.ctrl[:] = self.commands[row] + max(share, 0.0) * (self.commands[after] - self.commands[row])

    def press(self, time):
        """Pushes the torso at its centre of mass."""
        if self.push:
            start, newton, duration, degrees = self.push
            share = newton if start <= time < start + duration else 0.0
            angle = math.radians(degrees) + self.heading()
            self.data.xfrc_applied[self.torso, :2] = share * math.cos(angle), share * math.sin(angle)

    def heading(self):
        return math.atan2(self.data.xmat[self.torso][3], self.data.xmat[self.torso][0])

    def fell(self):
        tilted = self.data.xmat[self.torso][8] < math.cos(MOST_TILT)
        return bool(self.lost or tilted or self.data.qpos[2] < LEAST_HEIGHT * self.height)

    def frame(self, side):
        """Origin and axes of a sole in the world."""
        body, (x, y, z, *turn) = self.feet[side], self.soles[side]
        axes = self.data.xmat[body].reshape(3, 3)
        own = numpy.zeros(9)
        mujoco.mju_quat2Mat(own, numpy.array([turn[3], *turn[:3]]))
        return self.data.xpos[body] + axes @ [x, y, z], axes @ own.reshape(3, 3)

    def clearance(self, side):
        """The height of a foot's lowest point."""
        return min(self.lowest(geom) for geom in self.shapes[side])

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

    def pressure(self):
        """The sum of the floor's forces along its normal, times 1, x and y, and the part of each foot [N, N m]."""
        sums, contacts = [0.0] * 5, self.data.contact
        for index, ((one, other), (x, y, _)) in enumerate(zip(contacts.geom.tolist(), contacts.pos.tolist())):
            if self.floor not in (one, other):
                continue
            mujoco.mj_contactForce(self.model, self.data, index, self.wrench)
            for place, part in enumerate((1.0, x, y)):
                sums[place] += float(self.wrench[0]) * part
            foot = other if one == self.floor else one
            for side in (0, 1):
                sums[3 + side] += float(self.wrench[0]) * (foot in self.shapes[side])
        return numpy.array(sums)


class Feedback:
    """Writes states to standard output, and reads the targets of the joints from standard input."""

    def __init__(self, robot, given):
        self.robot, self.period, self.latency = robot, given.feedback, given.latency
        self.next, self.late, self.random, self.noise = 0.0, [], numpy.random.default_rng(0), given.noise
        self.sums, self.count = numpy.zeros((2, 6)), 0
        self.sides = {geom: side for side in (0, 1) for geom in robot.shapes[side]}
        print(json.dumps({"joints": robot.names, "stiffness": robot.nominal.tolist()}), flush=True)

    def command(self, time):
        robot = self.robot
        self.sums += self.forces()
        self.count += 1
        if time >= self.next - 1e-9:
            self.next = max(self.next + self.period, time)
            numbers = self.ask(time - robot.walk["time"][0])
            targets, rates = numpy.split(numbers, 2)
            self.late.append((time + self.latency, targets + robot.damping / robot.stiffness * rates))
        while self.late and self.late[0][0] <= time + 1e-9:
            robot.data.ctrl[:] = self.late.pop(0)[1]

    def ask(self, time):
        robot, data = self.robot, self.robot.data
        joints = data.qpos[[robot.model.joint(name).qposadr[0] for name in robot.names]]
        base = numpy.zeros(4)
        mujoco.mju_mulQuat(base, robot.level, data.qpos[3:7])
        joints, base, rate, forces = self.disturbed(joints, base, data.qvel[3:6].copy(), self.sums / self.count)
        self.sums[:], self.count = 0.0, 0
        state = [time, *joints, *xyzw(base), *rate, *forces.ravel()]
        print(" ".join(map(repr, map(float, state))), flush=True)
        line = sys.stdin.readline()
        if not line:
            sys.exit("the feedback has ended")
        if line == "lost\n":
            robot.lost = True
            return numpy.concatenate([robot.data.ctrl, 0 * robot.data.ctrl])
        return numpy.array(line.split(), dtype=float)

    def disturbed(self, joints, base, rate, forces):
        if self.noise == 0.0:
            return joints, base, rate, forces
        angle, tilt, gyro, force = (self.noise * deviation for deviation in NOISE)
        normal = self.random.standard_normal
        turn = numpy.array([1.0, *(0.5 * tilt * normal(3))])
        turned = numpy.zeros(4)
        mujoco.mju_mulQuat(turned, base, turn / numpy.linalg.norm(turn))
        return joints + angle * normal(len(joints)), turned, rate + gyro * normal(3), forces * (1 + force * normal(forces.shape))

    def forces(self):
        """Force and moment on each sole, in its frame."""
        model, data = self.robot.model, self.robot.data
        forces, moments, wrench = numpy.zeros((2, 3)), numpy.zeros((2, 3)), numpy.zeros(6)
        contacts = data.contact
        for index, (one, other) in enumerate(contacts.geom.tolist()):
            # The force is that on the second shape; the rows of the frame are the axes of the contact.
            sign, side = (1.0, self.sides.get(other)) if other in self.sides else (-1.0, self.sides.get(one))
            if side is not None:
                mujoco.mj_contactForce(model, data, index, wrench)
                force = sign * (wrench[:3] @ contacts.frame[index].reshape(3, 3))
                (x, y, z), (u, v, w) = contacts.pos[index].tolist(), force.tolist()
                forces[side] += force
                moments[side] += y * w - z * v, z * u - x * w, x * v - y * u
        sums = []
        for side in (0, 1):
            origin, axes = self.robot.frame(side)
            sums.append([*(forces[side] @ axes), *((moments[side] - numpy.cross(origin, forces[side])) @ axes)])
        return numpy.array(sums)


class Table:
    """The motion of the robot, one row for each sample of the walk."""

    def __init__(self, robot):
        self.robot, self.rows = robot, []
        self.zmp = numpy.array([robot.data.subtree_com[0][0], robot.data.subtree_com[0][1]])

    def header(self):
        joints = [f"q:{name} [{self.unit(name, 'rad', 'm')}]" for name in self.robot.names]
        poses = [f"base_{end}" for end in POSE]
        for side in ("left", "right"):
            poses += [f"{side}_{end}" for end in POSE] + [f"{side}_stands [1]"]
        figures = ["zmp_x [m]", "zmp_y [m]", "zmp_z [m]", "pressed [N]", "left_clearance [m]", "right_clearance [m]"]
        torques = [f"tau:{name} [{self.unit(name, 'N m', 'N')}]" for name in self.robot.names]
        return ["time [s]"] + joints + poses + figures + torques

    def unit(self, name, turning, sliding):
        return sliding if self.robot.model.joint(name).type[0] == mujoco.mjtJoint.mjJNT_SLIDE else turning

    def add(self, time, pressure):
        robot, data = self.robot, self.robot.data
        if pressure[0] > PRESSED * robot.weight:
            self.zmp = pressure[1:3] / pressure[0]
        places = [robot.model.joint(name).qposadr[0] for name in robot.names]
        row = [time, *data.qpos[places], *data.qpos[:3], *xyzw(data.qpos[3:7])]
        for side in (0, 1):
            origin, axes = robot.frame(side)
            turn = numpy.zeros(4)
            mujoco.mju_mat2Quat(turn, axes.ravel())
            row += [*origin, *xyzw(turn), int(pressure[3 + side] > PRESSED * robot.weight)]
        row += [*self.zmp, 0.0, pressure[0], robot.clearance(0), robot.clearance(1), *data.actuator_force]
        self.rows.append(row)

    def write(self, path, remarks):
        with open(path, "w") as file:
            file.writelines([*remarks, ",".join(self.header()) + "\n"])
            file.writelines(",".join(f"{value:.9f}" for value in row) + "\n" for row in self.rows)


def turn_to_z(up):
    """The smallest rotation that turns a unit vector to z, as a quaternion wxyz."""
    turn = numpy.array([1.0 + up[2], up[1], -up[0], 0.0])
    return turn / numpy.linalg.norm(turn)


def xyzw(quaternion):
    return *quaternion[1:], quaternion[0]


def play(robot, film=None):
    """Plays the walk. Returns the table, and the time of the fall."""
    table, times = Table(robot), robot.walk["time"]
    pressures = [robot.pressure()]
    table.add(times[0], pressures[0])
    for row, (start, end) in enumerate(zip(times, [*times[1:], times[-1] + AFTER])):
        steps = math.ceil((end - start) / STEP - 1e-6)
        robot.model.opt.timestep = step = (end - start) / steps
        for index in range(steps):
            robot.command(start + index * step)
            mujoco.mj_step(robot.model, robot.data)
            left = (steps - 1 - index) * step
            if left < WINDOW:
                pressures.append(robot.pressure())
            if robot.fell():
                return table, start + (index + 1) * step
            if film:
                film(robot, start + (index + 1) * step)
        if robot.data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            sys.exit(f"the simulation is unstable at {end:.2f} s; give --servo less stiffness or more inertia")
        if row + 1 < len(times):
            mujoco.mj_kinematics(robot.model, robot.data)
            table.add(end, numpy.mean(pressures[-round(WINDOW / STEP) :], axis=0))
    return table, None


def filming(folder):
    from PIL import Image

    os.makedirs(folder, exist_ok=True)
    made = {"renderer": None, "next": 0.0}

    def film(robot, time):
        if time < made["next"]:
            return
        made["next"] += 0.1
        renderer = made["renderer"] = made["renderer"] or mujoco.Renderer(robot.model, 480, 640)
        camera = mujoco.MjvCamera()
        camera.lookat[:] = robot.data.xpos[robot.torso]
        camera.distance, camera.azimuth, camera.elevation = 3.2 * robot.height, 120.0, -12.0
        renderer.update_scene(robot.data, camera=camera)
        Image.fromarray(renderer.render()).save(f"{folder}/{time:06.2f}.png")

    return film


def arguments():
    numbers = lambda text: [float(number) for number in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robot", help="MJCF of `groebot export`")
    parser.add_argument("walk", help="CSV of `groebot walk`")
    parser.add_argument("answer", help="where the answer goes, CSV")
    parser.add_argument("--feet", type=lambda text: text.split(","), default="l_sole,r_sole", help="the links of the soles")
    parser.add_argument("--servo", type=numbers, help="stiffness, damping, armature by the size of the robot, instead of those described and those of LINEAR")
    parser.add_argument("--friction", type=float, default=0.8)
    parser.add_argument("--slope", type=numbers, default="0,0", help="how far the floor is turned about x and y [degrees]")
    parser.add_argument("--mass", type=float, default=1.0, help="all masses times this")
    parser.add_argument("--gain", type=float, default=1.0, help="stiffness times this")
    parser.add_argument("--latency", type=float, default=0.0, help="commands are so late [s]")
    parser.add_argument("--push", type=numbers, help="time [s], force [N], duration [s], direction [degrees from ahead to the left]")
    parser.add_argument("--feedback", type=float, help="the period of the feedback [s]")
    parser.add_argument("--soles", type=numbers, help="the frames of the soles in their links: x, y, z, qx, qy, qz, qw of the left, then of the right one")
    parser.add_argument("--noise", type=float, default=0.0, help="the measurements of the feedback are disturbed by this times the usual noise")
    parser.add_argument("--frames", help="folder for pictures, ten a second")
    return parser.parse_args()


def main():
    given = arguments()
    walk, remarks = load(given.walk)
    robot = Robot(given, walk)
    table, fell = play(robot, filming(given.frames) if given.frames else None)
    table.write(given.answer, remarks)
    told = {
        "mujoco": mujoco.__version__, "fell": fell, "motors": robot.motors(), "unused_stiffness": robot.unused, "mass": robot.weight / GRAVITY,
        "points": robot.points,
    }
    print(json.dumps(told))


if __name__ == "__main__":
    main()
