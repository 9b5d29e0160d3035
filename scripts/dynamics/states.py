"""Inverse dynamics, matrices, derivatives, energy and momentum of robots by Pinocchio: tests/corpus/dynamics.

    python3 states.py strip        the descriptions of example-robot-data without shapes
    python3 states.py witness      the tables of all descriptions

States are those of a generator that the test in crates/robot/tests/dynamics/pinocchio.rs also has, so only results are stored. Matrices are stored as products
with two vectors w and x of the same generator.
"""

import csv
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

import numpy as np

CORPUS = Path(__file__).resolve().parents[2] / "tests/corpus/dynamics"
STATES = 1000
# Name of the table, description, whether the base is floating.
TABLES = [
    ("ur5", "ur5", False),
    ("panda", "panda", False),
    ("stanford", "stanford", False),
    ("rrp", "rrp", False),
    ("humanoid", "humanoid", False),
    ("humanoid_floating", "humanoid", True),
]
# Stripped descriptions: name, file in example-robot-data.
SOURCES = [
    ("ur5", "ur_description/urdf/ur5_robot.urdf"),
    ("panda", "panda_description/urdf/panda.urdf"),
    ("humanoid", "simple_humanoid_description/urdf/simple_humanoid.urdf"),
]
WHOLE = (1 << 64) - 1


class Random:
    """SplitMix64 (Steele, Lea and Flood 2014): numbers between -1 and 1."""

    def __init__(self, state):
        self.state = state

    def numbers(self, count, most=1.0):
        return np.array([most * self.number() for _ in range(count)])

    def number(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & WHOLE
        z = ((self.state ^ (self.state >> 30)) * 0xBF58476D1CE4E5B9) & WHOLE
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & WHOLE
        return ((z ^ (z >> 31)) >> 11) / (1 << 52) - 1.0


def strip():
    import cmeel

    robots = Path(cmeel.__file__).parents[1] / "cmeel.prefix/share/example-robot-data/robots"
    for name, file in SOURCES:
        root = tree.parse(robots / file).getroot()
        kept = tree.Element("robot", name=name)
        for child in root:
            if child.tag == "link":
                link = tree.SubElement(kept, "link", name=child.get("name"))
                link.extend(child.findall("inertial"))
            elif child.tag == "joint":
                # Pinocchio ignores friction, and its joints are independent.
                for part in [part for tag in ("dynamics", "safety_controller", "mimic") for part in child.findall(tag)]:
                    child.remove(part)
                kept.append(child)
        tree.indent(kept)
        text = "\n".join(line.rstrip() for line in tree.tostring(kept, encoding="unicode").splitlines())
        (CORPUS / f"{name}.urdf").write_text(text + "\n")


def witness():
    import pinocchio as pin

    for number, (name, description, floats) in enumerate(TABLES):
        file = CORPUS / f"{description}.urdf"
        model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer()) if floats else pin.buildModelFromUrdf(str(file))
        data = model.createData()
        joints = [joint for joint in tree.parse(file).getroot().findall("joint")]
        names = [joint.get("name") for joint in joints if joint.get("type") in ("revolute", "continuous", "prismatic")]
        ids = [model.getJointId(joint) for joint in names]
        first = 6 if floats else 0
        # The indices in Pinocchio of the joints in the order of the file.
        places = list(range(first)) + [model.joints[i].idx_v for i in ids]
        random = Random(number)
        rows = []
        for _ in range(STATES):
            base = np.zeros(0)
            if floats:
                base = random.numbers(7, 2.0)
                base[3:] /= np.sqrt(sum(x * x for x in base[3:]))
            angles = random.numbers(len(names), 3.0)
            v, a, w, x = (random.numbers(first + len(names), most) for most in (2.0, 5.0, 1.0, 1.0))

            def ours(theirs):
                return theirs[places]

            def theirs(own):
                out = np.zeros(model.nv)
                out[places] = own
                return out

            q = pin.neutral(model)
            if floats:
                q[:7] = base
            for i, angle in zip(ids, angles):
                joint = model.joints[i]
                q[joint.idx_q : joint.idx_q + joint.nq] = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            v_, a_ = theirs(v), theirs(a)
            tau = ours(pin.rnea(model, data, q, v_, a_).copy())
            gravity = ours(pin.computeGeneralizedGravity(model, data, q).copy())
            mass = pin.crba(model, data, q)
            mass = np.triu(mass) + np.triu(mass, 1).T
            coriolis = pin.computeCoriolisMatrix(model, data, q, v_).copy()
            by_q, by_v, _ = (m.copy() for m in pin.computeRNEADerivatives(model, data, q, v_, a_))
            kinetic = pin.computeKineticEnergy(model, data, q, v_)
            potential = pin.computePotentialEnergy(model, data, q)
            momentum = pin.computeCentroidalMomentum(model, data, q, v_).copy()
            w_, x_ = theirs(w), theirs(x)
            row = [w @ tau, w @ gravity, w_ @ mass @ x_, w_ @ coriolis @ x_, w_ @ by_q @ x_, w_ @ by_v @ x_, kinetic, potential]
            about_origin = momentum.angular + np.cross(data.com[0], momentum.linear)
            rows.append(row + list(momentum.linear) + list(about_origin))
        head = ["tau", "g", "M", "C", "dtau_dq", "dtau_dv", "kinetic", "potential"] + [f"h{i}" for i in range(6)]
        with open(CORPUS / f"{name}.csv", "w", newline="") as out:
            table = csv.writer(out, lineterminator="\n")
            table.writerow(head)
            table.writerows([[f"{number:.13g}" for number in row] for row in rows])
        print(name, model.nv)


if __name__ == "__main__":
    {"strip": strip, "witness": witness}[sys.argv[1]]()
