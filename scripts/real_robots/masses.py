"""Mass and centre of mass of whole robots, by groebot and by Pinocchio: python masses.py [--groebot PATH] [URDF ...]

Each robot is tested at zero and at two random configurations. Both results must agree to 1e-12, relative to the mass and to the height. The exit status is 0 if
all agree.
"""

import argparse
import json
import subprocess
import sys

import numpy
import pinocchio

import robots

# Whole humanoids: package and URDF.
ROBOTS = [
    ("example-robot-data", "talos_data/robots/talos_full_v2.urdf"),
    ("example-robot-data", "talos_data/robots/talos_reduced.urdf"),
    ("example-robot-data", "icub_description/robots/icub.urdf"),
    ("example-robot-data", "romeo_description/urdf/romeo.urdf"),
    ("example-robot-data", "g1_description/urdf/g1_29dof_rev_1_0.urdf"),
    ("example-robot-data", "bolt_description/robots/bolt.urdf"),
    ("jvrc-description", "jvrc1.urdf"),
]
TOLERANCE = 1e-12


def groebot(program, urdf, q=None):
    command = [program, "info", str(urdf), "--json"]
    if q is not None:
        command.append("--q=" + ",".join(repr(float(value)) for value in q))
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def pinocchio_centre(model, names, values):
    q = pinocchio.neutral(model)
    for name, value in zip(names, values):
        joint = model.joints[model.getJointId(name)]
        if joint.nq == 2:
            q[joint.idx_q : joint.idx_q + 2] = numpy.cos(value), numpy.sin(value)
        else:
            q[joint.idx_q] = value
    return pinocchio.centerOfMass(model, model.createData(), q)


def compare(program, path):
    """The largest relative differences of the mass and of the centre, and the values themselves."""
    model = pinocchio.buildModelFromUrdf(str(path), pinocchio.JointModelFreeFlyer())
    told = groebot(program, path)
    names = [joint["name"] for joint in told["joints"]]
    random = numpy.random.default_rng(1)
    mass = pinocchio.computeTotalMass(model)
    off = abs(told["mass"] - mass) / mass
    apart = 0.0
    for values in [numpy.zeros(len(names)), *(random.uniform(-1, 1, len(names)) for _ in range(2))]:
        ours = numpy.array(groebot(program, path, values)["centre_of_mass"])
        apart = max(apart, numpy.linalg.norm(ours - pinocchio_centre(model, names, values)))
    return off, apart, mass, len(told["links"]), len(names)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--groebot", default="target/release/groebot")
    parser.add_argument("--ci", action="store_true", help="only robots of the packages that --ci installs")
    parser.add_argument("urdf", nargs="*", help="URDF files instead of the list")
    arguments = parser.parse_args()
    worst = 0.0
    print("robot,links,moving joints,mass [kg],mass off [1],centre off [m]")
    listed = [(package, urdf) for package, urdf in ROBOTS if package == "example-robot-data" or not arguments.ci]
    paths = arguments.urdf or [robots.locate(package, urdf) for package, urdf in listed]
    for path in paths:
        off, apart, mass, links, moving = compare(arguments.groebot, path)
        worst = max(worst, off, apart)
        print(f"{str(path).rsplit('/', 1)[-1]},{links},{moving},{mass:.6f},{off:.1e},{apart:.1e}", flush=True)
    sys.exit(0 if worst <= TOLERANCE else 1)


if __name__ == "__main__":
    main()
