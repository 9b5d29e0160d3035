"""Compares forward kinematics of groebot's named robots with Pinocchio's of other descriptions; writes index.toml.

    check.py [NAME ...]     all robots, or those named: prints the differences. --write: writes their lines of the index too
    check.py --ci           the checked robots that an installed package describes: each must be so again

A difference is the greatest of any entry of the pose (metres, entries of the rotation) at 100 joint vectors, uniform within the limits.
The frames and zero positions of the other description are unchanged. If the poses then differ, those are fitted (align.py).
"""

import json
import math
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy

import align
import descriptions
from chains import chain

HERE = Path(__file__).resolve().parent
ROBOTS = HERE.parents[1] / "crates" / "robot" / "src" / "robots"
GROEBOT = os.environ.get("GROEBOT", str(HERE.parents[1] / "target" / "release" / "groebot"))
COUNT = 100
TOLERANCE = 1e-3
"""Descriptions that round lengths to millimetres differ by less."""


class Ours:
    """A robot of the data folder, by the program's forward kinematics."""

    def __init__(self, entry):
        self.path = ROBOTS / entry.get("file", f"named/{entry['name']}.toml")
        prefix = entry.get("prefix", "")
        strip = lambda name: name.removeprefix(prefix)
        data = tomllib.loads(self.path.read_text())
        self.arguments = ["--base", strip(entry["base"]), "--tip", strip(entry["tip"])] if "link" in data else []
        ends = {key: strip(entry[key]) for key in ("base", "tip") if key in entry}
        joints = [joint for joint in chain(data, ends) if joint["type"] != "fixed"]
        limits = numpy.array([joint.get("limits", (-math.pi, math.pi)) for joint in joints], dtype=float)
        self.low, self.high = (numpy.deg2rad(limits) if data.get("angle_unit") == "deg" else limits).T
        self.count = len(joints)

    def poses(self, values):
        """base_from_tip at each row of `values`."""
        rows = "\n".join(",".join(repr(float(value)) for value in row) for row in values)
        command = [GROEBOT, "fk", str(self.path), *self.arguments, "--json"]
        done = subprocess.run(command, input=rows + "\n", capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip()[:300])
        decoder, text, out = json.JSONDecoder(), done.stdout, []
        while text.strip():
            value, end = decoder.raw_decode(text.lstrip())
            text = text.lstrip()[end:]
            out += value if isinstance(value, list) else [value]
        return [numpy.array(value["matrix"]) for value in out]

    def draw(self):
        return numpy.random.default_rng(7).uniform(self.low, self.high, (COUNT, self.count))


def difference(ours, name):
    """The greatest difference from the description, and whether frames were fitted."""
    specification = name.split()
    theirs = descriptions.chain(*(specification + ["", ""])[:3])
    if len(theirs.joints) != ours.count:
        raise ValueError(f"{len(theirs.joints)} joints instead of {ours.count}")
    values = ours.draw()
    poses = ours.poses(values)
    plain = max(abs(theirs.forward(q) - pose).max() for q, pose in zip(values, poses))
    if plain < TOLERANCE:
        return plain, ""
    probes = numpy.concatenate([numpy.zeros((1, ours.count)), 0.5 * numpy.eye(ours.count)])
    known = {tuple(q): pose for q, pose in zip(probes, ours.poses(probes))}

    fitted, offsets = align.fit(lambda q: known[tuple(q)], theirs.forward, ours.count)
    return max(abs(fitted(q) - pose).max() for q, pose in zip(values, poses)), "fitted"


def check(entry):
    """The differences from the other descriptions, until one agrees."""
    ours = Ours(entry)
    results = []
    for name in entry["check"]:
        try:
            results.append((*difference(ours, name), name))
            if results[-1][0] < TOLERANCE:
                break
        except Exception as error:
            print(f"  {entry['name']}: {name}: {error!r}"[:300], flush=True)
    if not any(result[0] < TOLERANCE for result in results) and "from" in entry:
        source = f"{entry['from']} {entry['base']} {entry['tip']}"
        results.append((*difference(ours, source), "source"))
    elif not results:
        ours.poses(ours.draw()[:1])
    return results


def installed(entries):
    """The robots that are checked in the index, with their descriptions in installed Python packages; those without any are left out."""
    index = tomllib.loads((ROBOTS / "index.toml").read_text())["robot"]
    checked = {robot["name"] for robot in index if "checked" in robot}
    few = [entry | {"check": list(filter(descriptions.is_installed, entry["check"]))} for entry in entries]
    return [entry for entry in few if entry["check"] and entry["name"] in checked]


def line(entry, results):
    """The entry of the index."""
    keep = {key: entry[key] for key in ("name", "vendor", "model", "kind", "file", "base", "tip") if key in entry}
    for end in ("base", "tip"):
        if end in keep:
            keep[end] = keep[end].removeprefix(entry.get("prefix", ""))
    keep["task"] = entry.get("task", "pose")
    out = ", ".join(f'{key} = "{value}"' for key, value in keep.items())
    own = [result for result in results if result[2] == "source"]
    passed = [result for result in results if result[0] < TOLERANCE and result not in own]
    if passed:
        greatest, how, name = passed[-1]
        out += f', checked = "{descriptions.version(name)}", difference = {greatest:.1e}'
        out += ", fitted = true" if how else ""
    elif own:
        out += f", converted = {own[0][0]:.1e}"
    return f" {{{out}}},"


def write(entries, lines):
    """Writes the index: the new lines, and those of other robots as they were."""
    index = ROBOTS / "index.toml"
    before = index.read_text().splitlines()[1:-1] if index.exists() else []
    known = {line.split('"')[1]: line for line in before} | {line.split('"')[1]: line for line in lines}
    kept = [known[entry["name"]] for entry in entries if entry["name"] in known]
    index.write_text("robot = [\n" + "\n".join(kept) + "\n]\n")


def main(arguments):
    wanted = [argument for argument in arguments if not argument.startswith("--")]
    entries = tomllib.loads((HERE / "manifest.toml").read_text())["robot"]
    few = "--ci" in arguments
    if few:
        entries = installed(entries)
    lines, counts = [], [0, 0, 0]
    for entry in entries:
        if wanted and entry["name"] not in wanted:
            continue
        try:
            results = check(entry)
        except Exception as error:
            counts[2] += 1
            print(f"{entry['name']}: FAILED {error!r}"[:400], flush=True)
            continue
        lines.append(line(entry, results))
        good = any(result[0] < TOLERANCE and result[2] != "source" for result in results)
        counts[0 if good else 1] += 1
        said = "; ".join(f"{value:.1e} {how} {name.split('/')[-1]}" for value, how, name in results)
        print(f"{entry['name']:24} {'checked' if good else 'UNCHECKED'} {said}", flush=True)
        if "--write" in arguments:
            write(entries, lines)
    print(f"{counts[0]} checked, {counts[1]} unchecked, {counts[2]} failed")
    return 1 if counts[2] or (few and (counts[1] or not counts[0])) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
