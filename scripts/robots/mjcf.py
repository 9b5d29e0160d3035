"""Bodies, joints, sites and inertias of an MJCF as the elements of a URDF, for import.py.

Positions are the decimals of the file. Rotations, which MJCF has as quaternions or Euler angles, become roll, pitch and yaw, to 15 digits. Only what
the listed files use is read: default classes, `childclass`, `euler`, `quat`, `axisangle`, `range`, `actuatorfrcrange`, `inertial`. A joint that is
not at its body's origin is marked `moved`.
"""

import math
from pathlib import Path
from xml.etree import ElementTree

import numpy
import pinocchio
from pinocchio.rpy import matrixToRpy, rpyToMatrix


class Reader:
    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()
        self._include(self.root, Path(path).parent)
        compiler = {}
        for element in self.root.findall("compiler"):
            compiler.update(element.attrib)
        self.degrees = compiler.get("angle", "degree") == "degree"
        if compiler.get("eulerseq", "xyz") != "xyz":
            raise ValueError("eulerseq")
        self.defaults = {"": {}}
        for element in self.root.findall("default"):
            self._default(element, {})
        self.robot = ElementTree.Element("robot", name=self.root.get("model", "robot"))

    def _include(self, element, folder):
        """Puts the content of included files in the place of their elements."""
        for index, child in reversed(list(enumerate(element))):
            if child.tag == "include":
                part = ElementTree.parse(folder / child.get("file")).getroot()
                element.remove(child)
                for offset, inner in enumerate(part):
                    element.insert(index + offset, inner)
        for child in element:
            self._include(child, folder)

    def _default(self, element, above):
        own = {kind: {**above.get(kind, {}), **(element.find(kind).attrib if element.find(kind) is not None else {})} for kind in ("joint",)}
        name = element.get("class") or "main"
        self.defaults[name] = own
        if name == "main":
            self.defaults[""] = own
        for child in element.findall("default"):
            self._default(child, own)

    def urdf(self):
        """The root of the URDF."""
        world = ElementTree.SubElement(self.robot, "link", name="world")
        for body in self.root.findall("worldbody/body"):
            self._body(body, "world", "")
        return self.robot

    def _rotation(self, element):
        if element.get("quat"):
            w, x, y, z = map(float, element.get("quat").split())
            return pinocchio.Quaternion(w, x, y, z).normalized().toRotationMatrix()
        if element.get("euler"):
            scale = math.pi / 180 if self.degrees else 1.0
            a, b, c = (scale * float(word) for word in element.get("euler").split())
            return rpyToMatrix(a, 0, 0) @ rpyToMatrix(0, b, 0) @ rpyToMatrix(0, 0, c)
        if element.get("axisangle"):
            *axis, angle = map(float, element.get("axisangle").split())
            scale = math.pi / 180 if self.degrees else 1.0
            return pinocchio.exp3(scale * angle * numpy.array(axis) / numpy.linalg.norm(axis))
        if element.get("xyaxes") or element.get("zaxis"):
            raise ValueError(f"{element.get('name')}: orientation")
        return numpy.eye(3)

    def _origin(self, element):
        rpy = [0.0 if abs(angle) < 1e-15 else angle for angle in matrixToRpy(self._rotation(element))]
        return ElementTree.Element("origin", xyz=element.get("pos") or "0 0 0", rpy=" ".join(f"{angle:.15g}" for angle in rpy))

    def _body(self, body, parent, childclass):
        name, childclass = body.get("name"), body.get("childclass") or childclass
        link = ElementTree.SubElement(self.robot, "link", name=name)
        self._inertial(body, link)
        moving = [joint for joint in body.findall("joint") if joint.get("type", "hinge") in ("hinge", "slide")]
        # Joints of one body follow each other, with a link between two of them.
        ends = [f"{name}_{i}" for i in range(1, len(moving))] + [name]
        for end in ends[:-1]:
            ElementTree.SubElement(self.robot, "link", name=end)
        for i, end in enumerate(ends):
            joint = ElementTree.SubElement(self.robot, "joint", name=moving[i].get("name") if moving else f"{name}_fixed", type="fixed")
            ElementTree.SubElement(joint, "parent", link=ends[i - 1] if i else parent)
            ElementTree.SubElement(joint, "child", link=end)
            if i == 0:
                joint.append(self._origin(body))
            if moving:
                self._moving(joint, moving[i], childclass)
        for site in body.findall("site"):
            if site.get("name"):
                ElementTree.SubElement(self.robot, "link", name=site.get("name"))
                fixed = ElementTree.SubElement(self.robot, "joint", name=f"{site.get('name')}_fixed", type="fixed")
                ElementTree.SubElement(fixed, "parent", link=name)
                ElementTree.SubElement(fixed, "child", link=site.get("name"))
                fixed.append(self._origin(site))
        for child in body.findall("body"):
            self._body(child, name, childclass)

    def _moving(self, out, joint, childclass):
        own = {**self.defaults[joint.get("class") or childclass].get("joint", {}), **joint.attrib}
        if any(float(word) for word in own.get("pos", "0 0 0").split()):
            out.set("moved", own["pos"])
        slides = own.get("type") == "slide"
        out.set("type", "prismatic" if slides else "revolute")
        ElementTree.SubElement(out, "axis", xyz=own.get("axis", "0 0 1"))
        limit = ElementTree.SubElement(out, "limit")
        if own.get("range") and own.get("limited") != "false":
            words = own["range"].split()
            if self.degrees and not slides:
                words = [repr(math.radians(float(word))) for word in words]
            limit.set("lower", words[0])
            limit.set("upper", words[1])
        force = own.get("actuatorfrcrange")
        if force:
            limit.set("effort", force.split()[1])

    def _inertial(self, body, link):
        inertial = body.find("inertial")
        if inertial is None:
            return
        out = ElementTree.SubElement(link, "inertial")
        ElementTree.SubElement(out, "mass", value=inertial.get("mass"))
        out.append(self._origin(inertial))
        words = (inertial.get("fullinertia") or f"{inertial.get('diaginertia')} 0 0 0").split()
        ElementTree.SubElement(out, "inertia", dict(zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), words)))
