"""Writes docs/named_robots.md: the robots of index.toml by vendor, with source and check."""

import tomllib
from collections import Counter
from itertools import groupby
from pathlib import Path

from chains import chain

ROOT = Path(__file__).resolve().parents[2]
ROBOTS = ROOT / "crates" / "robot" / "src" / "robots"
PAGE = ROOT / "docs" / "named_robots.md"

HEAD = """# Robots by name

A name of this page works wherever a file does:

    groebot robots kuka                                  # lists names
    groebot info franka_panda
    groebot solve ur10e --target 0.5,0.2,0.4,0,1,0,0     # position [m], quaternion x, y, z, w
    groebot derive ur10e                                 # the solver with its proof, C and Rust, in the folder ur10e

In Python `groebot.Solver.named("ur10e")`, in Rust `groebot::robots::by_name("ur10e")`. A file or folder of the same name comes first.

`solve`, `codegen`, `view`, `reach` and `explain` use a solver that is derived at its first use, in seconds, and stored in the user's cache folder:
`GROEBOT_CACHE`, else `groebot/solvers` in `XDG_CACHE_HOME` or `~/.cache` (`~/Library/Caches` on macOS, `LOCALAPPDATA` on Windows). The name of the stored
folder contains the version of groebot and a hash of the description. Each stored file has a hash; a damaged folder is derived again. `--no-cache` derives
without it. Where the cache cannot be written, the solver is derived at each call, with a note.

Base and tip are frames of the source. This page is written by `scripts/robots/run --table` from
[index.toml](../crates/robot/src/robots/index.toml). `groebot robots` also lists the humanoids of groebot's own walks, their limbs, and three arms of textbooks.

| column | meaning |
| --- | --- |
| joints | those between base and tip |
| source | where the numbers are from: a package with its version and file, or a repository with its commit and file |
| masses | the links that move have masses |
| checked by | the package whose other description of the robot has the same forward kinematics |
| difference | the greatest difference of any entry of the pose (metres, entries of the rotation) from Pinocchio's, at 100 joint vectors drawn uniformly within the limits |

*source only*: no other description was found; the comparison with the description that the numbers are from tests the conversion only.
*unchecked*: written by hand from the source, without another description. *fitted*: the other description has other frames of base and tip, other zero positions or other senses of joints. These are fitted before the
comparison; the geometry between the joints is compared. Two packages may have copied one description of the maker: the check then shows that the numbers
here are those, not that they are right.
"""


def row(entry):
    data = tomllib.loads((ROBOTS / entry.get("file", f"named/{entry['name']}.toml")).read_text())
    joints = [joint for joint in chain(data, entry) if joint["type"] != "fixed"]
    masses = {link["name"] for link in data.get("link", []) if "mass" in link}
    has_masses = bool(masses) and all(joint["child"] in masses for joint in joints)
    checked = entry.get("checked", "source only" if "converted" in entry else "unchecked")
    figure = entry.get("difference", entry.get("converted"))
    difference = "" if figure is None else f"{figure:.0e}" + (", fitted" if entry.get("fitted") else "")
    cells = [f"`{entry['name']}`", entry["model"], entry["kind"], str(len(joints)), "yes" if has_masses else "", data["source"], checked, difference]
    return "| " + " | ".join(cells) + " |"


def main():
    entries = tomllib.loads((ROBOTS / "index.toml").read_text())["robot"]
    entries.sort(key=lambda entry: (entry["vendor"].lower(), entry["name"]))
    kinds = Counter(entry["kind"] for entry in entries)
    checked = sum("checked" in entry for entry in entries)
    out = [HEAD]
    counts = ", ".join(f"{count} {kind}s" for kind, count in sorted(kinds.items()))
    out.append(f"{len(entries)} robots: {counts}. {checked} are checked, {len(entries) - checked} are not.\n")
    for vendor, robots in groupby(entries, key=lambda entry: entry["vendor"]):
        out.append(f"## {vendor}\n\n| name | model | kind | joints | masses | source | checked by | difference |\n| --- | --- | --- | --: | --- | --- | --- | --- |")
        out += [row(entry) for entry in robots]
        out.append("")
    PAGE.write_text("\n".join(out).rstrip() + "\n")


if __name__ == "__main__":
    main()
