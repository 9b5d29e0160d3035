"""Plays a walk of `groebot walk` open loop on a rigid-body model of NAO V5 in MuJoCo, and measures what the robot does.

    python playback.py walk.csv [--frames FOLDER] [--nominal]

Position servos with kp 150 Nm/rad, damping 1.084, armature 0.045, friction 0.8, steps of 2 ms, commands at 100 Hz. Then twelve
disturbances. The exit status is 0 when every run meets the demands.
"""

import argparse
import csv
import math
import sys

import mujoco
import numpy

from model import xml

STEP, COMMAND = 0.002, 0.01
FEET = {"left": "nao_left_leg", "right": "nao_right_leg"}
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
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


class Robot:
    """The model at the first row of a walk."""

    def __init__(self, walk, latency=0.0, **figures):
        self.walk, self.latency = walk, latency
        self.model = mujoco.MjModel.from_xml_string(xml(**figures))
        self.data = mujoco.MjData(self.model)
        names = [self.model.actuator(i).name for i in range(self.model.nu)]
        self.commands = numpy.column_stack([walk[name] for name in names])
        pose = [walk[f"torso_{key}"][0] for key in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        self.data.qpos[:7] = pose
        self.data.qpos[7:] = self.commands[0]
        mujoco.mj_forward(self.model, self.data)
        self.floor = self.model.geom("floor").id
        self.soles = {side: self.model.geom(name).id for side, name in FEET.items()}

    def step(self, time):
        row = int(round((time - self.latency) / STEP)) // int(round(COMMAND / STEP))
        self.data.ctrl[:] = self.commands[min(max(row, 0), len(self.commands) - 1)]
        mujoco.mj_step(self.model, self.data)

    def tilt(self):
        return math.acos(min(1.0, self.data.body("Torso").xmat[8]))

    def foot(self, side):
        """Position of the sole's frame, heading, height of the lowest corner."""
        site = self.data.site(FEET[side])
        heading = math.atan2(site.xmat[3], site.xmat[0])
        geom = self.soles[side]
        centre, turn = self.data.geom_xpos[geom], self.data.geom_xmat[geom].reshape(3, 3)
        size = self.model.geom_size[geom]
        lowest = centre[2] - numpy.abs(turn[2]) @ size
        return site.xpos.copy(), heading, lowest

    def pressed(self):
        """The force on each foot from the floor [N]."""
        forces = dict.fromkeys(FEET, 0.0)
        wrench = numpy.zeros(6)
        for index in range(self.data.ncon):
            contact = self.data.contact[index]
            for side, geom in self.soles.items():
                if geom in (contact.geom1, contact.geom2):
                    mujoco.mj_contactForce(self.model, self.data, index, wrench)
                    forces[side] += wrench[0]
        return forces


def middle(robot):
    (left, left_yaw, _), (right, right_yaw, _) = robot.foot("left"), robot.foot("right")
    at = (left + right) / 2
    return at, left_yaw + wrapped(right_yaw - left_yaw) / 2


def play(walk, film=None, **figures):
    robot = Robot(walk, **figures)
    start, start_yaw = middle(robot)
    steps = int(round((walk["time"][-1] + 0.5) / STEP))
    tilt, fell = 0.0, False
    aloft = dict.fromkeys(FEET, False)
    landings = dict.fromkeys(FEET, 0)
    highest = dict.fromkeys(FEET, 0.0)
    lifts = []
    for index in range(steps):
        robot.step(index * STEP)
        tilt = max(tilt, robot.tilt())
        fell = fell or robot.data.qpos[2] < 0.2
        for side in FEET:
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
        left, right = ([walk[f"{side}_{key}"][index] for key in ("x", "y", "yaw")] for side in FEET)
        yaw = left[2] + wrapped(right[2] - left[2]) / 2
        return (left[0] + right[0]) / 2, (left[1] + right[1]) / 2, yaw

    (x0, y0, yaw0), (x1, y1, yaw1) = row(0), row(-1)
    swings = sum(
        int(numpy.sum(numpy.diff(walk[f"{side}_stands"]) > 0)) for side in FEET
    )
    return {"x": x1 - x0, "y": y1 - y0, "turn": wrapped(yaw1 - yaw0), "landings": swings}


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
        renderer = renderers.setdefault(id(robot.model), mujoco.Renderer(robot.model, 540, 960))
        renderer.update_scene(robot.data, camera="side")
        Image.fromarray(renderer.render()).save(f"{folder}/{index * STEP:06.2f}.png")

    return film


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walk", help="CSV of `groebot walk`")
    parser.add_argument("--frames", help="folder for pictures of the nominal run, ten a second")
    parser.add_argument("--nominal", action="store_true", help="no disturbances")
    arguments = parser.parse_args()
    walk = load(arguments.walk)
    plan = planned(walk)
    print(f"planned: {plan['x']:.3f} {plan['y']:.3f} m, {math.degrees(plan['turn']):.1f} deg, {plan['landings']} landings")
    failed = 0
    for name, figures in CASES.items():
        if arguments.nominal and figures:
            break
        film = filming(arguments.frames) if arguments.frames and not figures else None
        result = play(walk, film=film, **figures)
        wrong = faults(result, plan)
        failed += bool(wrong)
        print(
            f"{name:30} {result['x']:7.3f} {result['y']:7.3f} m {math.degrees(result['turn']):6.1f} deg  "
            f"tilt {math.degrees(result['tilt']):4.1f} deg  {result['landings']} landings  "
            f"lift {1e3 * result['lift']:4.1f} mm  {'; '.join(wrong) or 'ok'}"
        )
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
