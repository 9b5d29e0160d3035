"""Descriptions of robots in public packages: their text, and Pinocchio models of their chains.

A description is named `package:file`. `file` is the end of a path in the package. Packages of Python and of Rust (`crate/NAME`) are known.
The forms: URDF, xacro, MJCF, a Denavit-Hartenberg table in Python code, constants of ssik, OPW parameters in YAML.
"""

import ast
import math
import os
import re
import tempfile
import types
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from xml.etree import ElementTree

import numpy
import pinocchio

CRATES = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo")) / "registry" / "src"


@dataclass(frozen=True)
class Chain:
    """A chain of a Pinocchio model: frames of base and tip, and the joints between them from base to tip."""

    model: pinocchio.Model
    base: int
    tip: int
    joints: list

    def forward(self, q):
        """base_from_tip of the joint values `q`, in the order of the joints."""
        data = self.model.createData()
        configuration = pinocchio.neutral(self.model)
        for index, value in zip(self.joints, q):
            joint = self.model.joints[index]
            values = (math.cos(value), math.sin(value)) if joint.nq == 2 else value
            configuration[joint.idx_q : joint.idx_q + joint.nq] = values
        pinocchio.framesForwardKinematics(self.model, data, configuration)
        return (data.oMf[self.base].inverse() * data.oMf[self.tip]).homogeneous


def locate(name):
    """The path of the description `package:file`."""
    package, file = name.split(":")
    if package.startswith("crate/"):
        folder = next(iter(sorted(CRATES.glob(f"*/{package[6:]}-*"))), None)
        found = [path for path in folder.rglob("*") if f"/{path}".endswith(f"/{file}")] if folder else []
    else:
        files = metadata.files(package) or []
        found = [Path(path.locate()).resolve() for path in files if f"/{path}".endswith(f"/{file}")]
    if len(found) != 1:
        raise FileNotFoundError(f"{name}: {len(found)} files")
    return found[0]


def is_installed(name):
    """Whether the Python package of a description is installed."""
    try:
        return bool(metadata.version(name.split(":")[0]))
    except metadata.PackageNotFoundError:
        return False


def version(name):
    """The package and its version, such as `ssik 8.2.0`."""
    package = name.split(":")[0]
    if package.startswith("crate/"):
        folder = next(iter(sorted(CRATES.glob(f"*/{package[6:]}-*"))))
        return "crate " + " ".join(folder.name.rsplit("-", 1))
    return f"{package} {metadata.version(package)}"


@cache
def urdf(name):
    """The URDF of a description; xacro is expanded."""
    path = locate(name)
    if path.suffix == ".xml":
        from mjcf import Reader

        return ElementTree.tostring(Reader(path).urdf(), encoding="unicode")
    text = path.read_text(encoding="utf-8", errors="replace")
    text = re.sub(r"</?(gazebo|ros2_control)\b.*?</(gazebo|ros2_control)>", "", text, flags=re.S)
    return _expanded(path) if "<xacro:" in text else text


def _expanded(path):
    os.chdir(path.parent)
    from xacrodoc import XacroDoc, packages

    text = path.read_text(encoding="utf-8")
    macro = re.search(r'<xacro:macro\s+name="(\w+)"\s+params="([^"]*)"', text)
    if macro is None or "<xacro:" in text.replace(macro.group(0), "").split("</xacro:macro>")[1]:
        packages.look_in([str(folder) for folder in path.parents[1:4]])
        return XacroDoc.from_file(str(path), resolve_packages=False).to_urdf_string()
    # A file that only defines a macro: it is called here, without its materials.
    text = re.sub(r"<xacro:include[^>]*/>|<xacro:(material|gazebo)\w*\s*/>", "", text)
    given = " ".join(f'{name}=""' for name in macro.group(2).split() if "=" not in name)
    text = text.replace("</robot>", f"<xacro:{macro.group(1)} {given}/></robot>").replace("<robot ", '<robot name="r" ', 1)
    text = re.sub(r'name="r"([^>]*) name="[^"]*"', r'name="r"\1', text)
    for constant in ("DEG2RAD", "M_PI"):
        value = math.pi / 180 if constant == "DEG2RAD" else math.pi
        text = text.replace("<xacro:macro", f'<xacro:property name="{constant}" value="{value}"/><xacro:macro', 1)
    with tempfile.NamedTemporaryFile("w", suffix=".xacro") as file:
        file.write(text)
        file.flush()
        return XacroDoc.from_file(file.name, resolve_packages=False).to_urdf_string()


def chain(name, base, tip):
    """The chain of a description from `base` to `tip`, in Pinocchio."""
    package, file = name.split(":")
    if package == "ssik":
        return _ssik(file)
    if package == "robotkinematicscatalogue":
        return serial(*_modified(locate(name).read_text()))
    if file.endswith(".py"):
        return serial(*_table(locate(name), base))
    if file.endswith(".yaml"):
        return serial(*_opw(locate(name).read_text()))
    model = _model(name)
    frames = [_frame(model, base), _frame(model, tip)]
    path = _between(model, *(model.frames[frame].parentJoint for frame in frames))
    return Chain(model, *frames, path)


@cache
def _model(name):
    if name.endswith(".xml"):
        return pinocchio.buildModelFromMJCF(str(locate(name)))
    root = ElementTree.fromstring(urdf(name).encode())
    for element in root.iter("joint"):
        if element.find("limit") is None and element.get("type") == "revolute":
            element.set("type", "continuous")
        for limit in element.findall("limit"):
            limit.attrib = {"effort": "0", "velocity": "0"} | limit.attrib
        for tag in ("mimic", "safety_controller", "calibration"):
            for child in element.findall(tag):
                element.remove(child)
    for link in root.iter("link"):
        for child in list(link):
            link.remove(child)
    named = {link.get("name") for link in root.findall("link")}
    for end in [*root.iterfind("joint/parent"), *root.iterfind("joint/child")]:
        if end.get("link") not in named:
            named.add(end.get("link"))
            ElementTree.SubElement(root, "link", name=end.get("link"))
    return pinocchio.buildModelFromXML(ElementTree.tostring(root, encoding="unicode"))


def _frame(model, name):
    found = [i for i, frame in enumerate(model.frames) if frame.name == name and frame.type == pinocchio.FrameType.BODY]
    if not found:
        found = [i for i, frame in enumerate(model.frames) if frame.name == name]
    if not found:
        raise KeyError(f"no frame {name} among {[frame.name for frame in model.frames][:80]}")
    return found[0]


def _between(model, base, tip):
    """The joints between the joints `base` and `tip`, where base is an ancestor."""
    path = []
    while tip != base:
        if tip == 0:
            raise ValueError("the base is no ancestor of the tip")
        path.append(tip)
        tip = model.parents[tip]
    return [joint for joint in reversed(path) if model.joints[joint].nv == 1]


def serial(placements, axes, kinds, tool):
    """The chain of joints with placements in the frame of the joint before, axes, kinds (R or P) and the tool."""
    model, parent = pinocchio.Model(), 0
    joints = []
    for i, (placement, axis, kind) in enumerate(zip(placements, axes, kinds)):
        make = pinocchio.JointModelPrismaticUnaligned if kind == "P" else pinocchio.JointModelRevoluteUnaligned
        axis = numpy.array(axis, dtype=float)
        parent = model.addJoint(parent, make(axis / numpy.linalg.norm(axis)), pinocchio.SE3(numpy.array(placement)), f"j{i}")
        joints.append(parent)
    tip = model.addFrame(pinocchio.Frame("tip", parent, pinocchio.SE3(numpy.array(tool)), pinocchio.FrameType.OP_FRAME))
    return Chain(model, 0, tip, joints)


def _ssik(arm):
    """The constants of an arm in ssik, read from its module's text."""
    found = [Path(path.locate()) for path in metadata.files("ssik") if str(path).endswith(f"/{arm}_ik.py")]
    values = {}
    array = types.SimpleNamespace(array=lambda rows, dtype=None: numpy.array(rows, dtype=float), float64=float)
    for statement in ast.parse(found[0].read_text()).body:
        if isinstance(statement, ast.Assign) and getattr(statement.targets[0], "id", "").startswith("_JOINT_"):
            code = compile(ast.Expression(statement.value), "ssik", "eval")
            values[statement.targets[0].id] = eval(code, {"np": array, "math": math, "__builtins__": {}}, {"inf": math.inf})
    left, right = values["_JOINT_T_LEFTS"], values["_JOINT_T_RIGHTS"]
    before = [numpy.eye(4)] + right[:-1]
    kinds = ["P" if kind == "prismatic" else "R" for kind in values["_JOINT_TYPES"]]
    return serial([b @ a for b, a in zip(before, left)], values["_JOINT_AXES"], kinds, right[-1])


class _Recorder:
    """Stands for the classes of robot toolboxes while a class with a table is made: it records the links."""

    def __init__(self, *args, **kwargs):
        for value in [*args, *kwargs.values()]:
            if isinstance(value, list) and value and isinstance(value[0], Link):
                _Recorder.links = value

    def __getattr__(self, name):
        return lambda *args, **kwargs: numpy.deg2rad(args) if name == "_qlim" else None


class Link:
    """A row of a Denavit-Hartenberg table."""

    def __init__(self, kind, modified, d=0.0, a=0.0, alpha=0.0, offset=0.0, theta=0.0, **_):
        self.kind, self.modified = kind, modified
        self.d, self.a, self.alpha, self.theta = d, a, alpha, theta
        if kind == "R":
            self.theta += offset
        else:
            self.d += offset


def _table(path, name):
    """Placements, axes, kinds and tool of the table in the class `name` of a Python file."""
    tree = ast.parse(path.read_text())
    tree.body = [s for s in tree.body if isinstance(s, ast.ClassDef | ast.Assign) and "__all__" not in ast.dump(s)]
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            node.body = [s for s in node.body if not isinstance(s, ast.Import | ast.ImportFrom)] or [ast.Pass()]
            node.returns = None
            for argument in node.args.args:
                argument.annotation = None
    make = lambda kind, modified: lambda *a, **k: Link(kind, modified, **dict(zip(("d", "a", "alpha", "offset"), a)), **k)
    identity = lambda *a, **k: numpy.eye(4)
    toolbox = types.SimpleNamespace(
        RevoluteDH=make("R", False), PrismaticDH=make("P", False), RevoluteMDH=make("R", True), PrismaticMDH=make("P", True),
        DHLink=make("R", False), DHRobot=_Recorder, Robot=_Recorder,
    )
    scope = {
        **vars(toolbox), "rtb": toolbox, "np": numpy, "numpy": numpy, "pi": math.pi, "math": math, "os": os, "UTSMeshRobot": _Recorder,
        "DHRobot3D": _Recorder, "spb": _Recorder(), "transl": identity, "trotx": identity, "SE3": identity, "cos": math.cos,
        "sin": math.sin, "radians": math.radians,
        "__file__": str(path), "__name__": "table", "zeros": numpy.zeros, "sqrt": math.sqrt, "MeshDHRobot": _Recorder,
    }
    _Recorder.links = None
    exec(compile(ast.fix_missing_locations(tree), str(path), "exec"), scope)
    try:
        scope[name]()
    except Exception as error:
        if _Recorder.links is None:
            raise ValueError(f"{path}: {error!r}") from error
    return frames(_Recorder.links)


def _modified(text):
    """The chain of a modified table in millimetres, an array `DHM` of rows (alpha, a, d, theta); senses are left to the alignment."""
    rows = eval(re.search(r"DHM = np\.array\((\[.*?\]\s*)\)", text, re.S).group(1), {"np": numpy, "__builtins__": {}})
    make = lambda alpha, a, d, theta: Link("R", True, d=d / 1000, a=a / 1000, alpha=alpha, theta=theta)
    return frames([make(*row) for row in rows])


def frames(rows):
    """Placements, axes, kinds and tool of the rows of a table."""
    placements, before = [], numpy.eye(4)
    for row in rows:
        turn, slide = _about(2, row.theta, row.d), _about(0, row.alpha, row.a)
        if row.modified:
            placements.append(before @ slide @ turn)
            before = numpy.eye(4)
        else:
            placements.append(before)
            before = turn @ slide
    return placements, [(0, 0, 1)] * len(rows), [row.kind for row in rows], before


def _about(axis, angle, shift):
    """A turn about an axis (0: x, 2: z) and a shift along it."""
    pose = numpy.eye(4)
    pose[:3, :3] = pinocchio.exp3(angle * numpy.eye(3)[axis])
    pose[axis, 3] = shift
    return pose


def _opw(text):
    """The chain of OPW parameters (Brandstoetter, Angerer, Hofbaur 2014), with offsets and signs left to the alignment."""
    p = {key: float(value) for key, value in re.findall(r"^\s+(a1|a2|b|c1|c2|c3|c4):\s*([-\d.e]+)", text, re.M)}
    points = [(0, 0, 0), (p["a1"], 0, p["c1"]), (p["a1"], p["b"], p["c1"] + p["c2"])]
    wrist = numpy.array(points[2]) + (p["a2"], 0, p["c3"])
    points += [wrist, wrist, wrist]
    placements = []
    for before, point in zip([(0, 0, 0), *points], points):
        pose = numpy.eye(4)
        pose[:3, 3] = numpy.subtract(point, before)
        placements.append(pose)
    tool = numpy.eye(4)
    tool[2, 3] = p["c4"]
    return placements, [(0, 0, 1), (0, 1, 0), (0, 1, 0), (0, 0, 1), (0, 1, 0), (0, 0, 1)], ["R"] * 6, tool
