"""Writes the robots of crates/robot/src/robots/named from the descriptions that manifest.toml lists.

    import.py [NAME ...]     all robots, or those named

A chain from base to tip becomes a robot in TOML: its joints with origins, axes, limits, speeds and efforts, its links with masses where
the description has them. Numbers are the decimals of the description, without zeros at their ends; masses, centres
and moments have at most seven digits, and limits that a xacro computed nine decimals, rounded towards zero. Where the frame of inertia is turned,
moments and products of inertia are those of the description turned into the link's frame, to seven digits.
"""

import copy
import math
import re
import sys
import tomllib
from decimal import ROUND_DOWN, Decimal
from pathlib import Path
from xml.etree import ElementTree

import numpy

import descriptions

HERE = Path(__file__).resolve().parent
DATA = HERE.parents[1] / "crates" / "robot" / "src" / "robots" / "named"
HUGE = 1e4
"""Limits of more than this [rad] mean that there are none."""


def manifest():
    """The entries of manifest.toml."""
    return tomllib.loads((HERE / "manifest.toml").read_text())["robot"]


def number(text):
    """A decimal in TOML: that of the description without zeros at its ends."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    if value == 0.0:
        return "0"
    match = re.fullmatch(r"([+-]?)(\d*)\.?(\d*)(?:[eE]([+-]?\d+))?", text.strip())
    sign, whole, part, exponent = match.groups()
    whole, part = whole.lstrip("0") or "0", part.rstrip("0")
    out = ("-" if sign == "-" else "") + whole + (f".{part}" if part else "")
    return out + (f"e{int(exponent)}" if exponent and int(exponent) else "")


def short(text):
    """A limit or a speed: what a xacro computed with twelve decimals or more is rounded towards zero at nine."""
    out = number(text)
    return number(str(Decimal(out).quantize(Decimal("1e-9"), ROUND_DOWN))) if len(out.partition(".")[2]) >= 12 and "e" not in out else out


def seven(text):
    """A decimal of a mass, a centre or a moment: at most seven digits."""
    short = f"{float(text):.7g}"
    return number(short if len(number(short)) < len(number(text)) else text)


def numbers(text):
    return [number(word) for word in text.split()]


def vector(words):
    return "[" + ", ".join(words) + "]"


def origin(element):
    """The table of an origin, or nothing for the identity."""
    place = element.find("origin")
    if place is None:
        return ""
    xyz, rpy = (numbers(place.get(key) or "0 0 0") for key in ("xyz", "rpy"))
    parts = [f"{key} = {vector(words)}" for key, words in (("xyz", xyz), ("rpy", rpy)) if any(word != "0" for word in words)]
    return f", origin = {{{', '.join(parts)}}}" if parts else ""


def limits(joint):
    """Limits, speed and effort: only those that say something."""
    limit = joint.find("limit")
    if limit is None:
        return ""
    out = ""
    low, high = limit.get("lower") or "0", limit.get("upper") or "0"
    if joint.get("type") != "continuous" and float(low) < float(high) < HUGE:
        out += f", limits = [{short(low)}, {short(high)}]"
    for key, name in (("velocity", "speed"), ("effort", "effort")):
        text = limit.get(key)
        if text and 0 < float(text) < HUGE:
            out += f", {name} = {short(text)}"
    return out


def joint_line(joint, name):
    kind = joint.get("type")
    if kind == "revolute" and "limits =" not in limits(joint):
        kind = "continuous"
    axis = joint.find("axis")
    words = numbers(axis.get("xyz")) if axis is not None else ["1", "0", "0"]
    axis = "" if kind == "fixed" else f", axis = {vector(words)}"
    ends = f'parent = "{joint.find("parent").get("link")}", child = "{joint.find("child").get("link")}"'
    limit = "" if kind == "fixed" else limits(joint)
    return f' {{name = "{name}", type = "{kind}", {ends}{origin(joint)}{axis}{limit}}},'


def link_line(link):
    """A link with its mass, if the mass and the moments are those of a body."""
    inertial = link.find("inertial")
    mass = inertia = None
    if inertial is not None and inertial.find("mass") is not None and inertial.find("inertia") is not None:
        mass = inertial.find("mass").get("value")
        inertia = [inertial.find("inertia").get(key) or "0" for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    if mass is None or float(mass) <= 0:
        return f' {{name = "{link.get("name")}"}},'
    place = inertial.find("origin")
    xyz, rpy = ("0 0 0", "0 0 0") if place is None else (place.get(key) or "0 0 0" for key in ("xyz", "rpy"))
    words = [seven(word) for word in inertia]
    if any(word != "0" for word in numbers(rpy)):
        words = turned([float(word) for word in inertia], [float(word) for word in rpy.split()])
    if not is_body([float(word) for word in words]):
        return f' {{name = "{link.get("name")}"}},'
    place = [seven(word) for word in xyz.split()]
    centre = "" if all(word == "0" for word in place) else f", centre = {vector(place)}"
    return f' {{name = "{link.get("name")}", mass = {seven(mass)}{centre}, inertia = {vector(words)}}},'


def matrix(values):
    xx, yy, zz, xy, xz, yz = values
    return numpy.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def turned(values, rpy):
    from pinocchio.rpy import rpyToMatrix

    turn = rpyToMatrix(*rpy)
    out = turn @ matrix(values) @ turn.T
    floor = 1e-12 * max(abs(value) for value in values)
    entries = [out[0, 0], out[1, 1], out[2, 2], out[0, 1], out[0, 2], out[1, 2]]
    return [number(f"{0 if abs(value) <= floor else value:.9g}") for value in entries]


def is_body(values):
    """Whether the principal moments are positive, and none exceeds the sum of the others."""
    moments = numpy.linalg.eigvalsh(matrix(values))
    return moments[0] > 0 and moments[0] + moments[1] >= moments[2] * (1 - 1e-6)


def path(root, base, tip):
    """The joints from base to tip."""
    above = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
    found = []
    while tip != base:
        joint = above[tip]
        found.append(joint)
        tip = joint.find("parent").get("link")
    return found[::-1]


def merged(joints, links):
    """The joints, where a fixed joint without rotation and the next fixed one are one if the link between them is light."""
    out = []
    for joint in joints:
        last = out[-1] if out else None
        if last is not None and joint.get("type") == last.get("type") == "fixed" and is_light(links[last.find("child").get("link")]):
            sums = added(last, joint)
            if sums is not None:
                joint = copy.deepcopy(joint)
                joint.find("parent").set("link", last.find("parent").get("link"))
                for place in joint.findall("origin"):
                    joint.remove(place)
                joint.append(sums)
                out[-1] = joint
                continue
        out.append(joint)
    return out


def is_light(link):
    """Whether the link has no mass, or one gram as descriptions give to frames."""
    mass = link.find("inertial/mass")
    return mass is None or float(mass.get("value")) <= 0.001


def added(first, second):
    """The origin of two fixed joints, if the first does not turn."""
    (xyz, turn), (other, rpy) = (
        [numbers((joint.find("origin").get(key) if joint.find("origin") is not None else None) or "0 0 0") for key in ("xyz", "rpy")]
        for joint in (first, second)
    )
    if any(word != "0" for word in turn):
        return None
    sums = [format(Decimal(a) + Decimal(b), "f") for a, b in zip(xyz, other)]
    return ElementTree.Element("origin", xyz=" ".join(sums), rpy=" ".join(rpy))


def text(entry):
    """The robot in TOML."""
    root = ElementTree.fromstring(descriptions.urdf(entry["from"]).encode())
    joints = path(root, entry["base"], entry["tip"])
    if any(joint.get("moved") for joint in joints):
        raise ValueError("a joint is not at the origin of its body")
    names = [entry["base"]] + [joint.find("child").get("link") for joint in joints]
    links = {link.get("name"): link for link in root.findall("link")}
    links = {name: links.get(name, ElementTree.Element("link", name=name)) for name in names}
    version = descriptions.version(entry["from"])
    source = f"{version}, {entry['from'].split(':')[1]}" + (f"; {entry['of']}" if "of" in entry else "")
    head = f'name = "{entry["name"]}"\nsource = "{source}"\n'
    joints = merged(joints, links)
    names = [entry["base"]] + [joint.find("child").get("link") for joint in joints]
    for child in list(links[entry["base"]]):
        links[entry["base"]].remove(child)
    lines = [joint_line(joint, joint.get("name")) for joint in joints]
    bodies = [link_line(links[name]) for name in names]
    text = head + "link = [\n" + "\n".join(bodies) + "\n]\njoint = [\n" + "\n".join(lines) + "\n]\n"
    prefix = entry.get("prefix")
    return text.replace(f' = "{prefix}', ' = "') if prefix else text


def main(wanted):
    for entry in manifest():
        if "from" in entry and (not wanted or entry["name"] in wanted):
            try:
                (DATA / f"{entry['name']}.toml").write_text(text(entry))
            except Exception as error:
                print(f"{entry['name']}: {error!r}"[:300], file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1:])
