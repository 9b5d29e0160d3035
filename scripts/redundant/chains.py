"""Writes each arm of arms.toml as a URDF that contains only its chain: the joints from base to tip, their origins, axes and limits as written in the source.

    python chains.py FOLDER [--only ID,...]

Links are empty. Joints with a fixed angle stay fixed joints.
"""

import argparse
import tomllib
from importlib import metadata
from pathlib import Path
from xml.dom import expatbuilder, minidom

HERE = Path(__file__).resolve().parent


def read(only: str = "") -> list[dict]:
    """The entries of arms.toml, or those with the identifiers in `only`."""
    arms = tomllib.loads((HERE / "arms.toml").read_text())["arm"]
    return [arm for arm in arms if not only or arm["id"] in only.split(",")]


def locate(package: str, ending: str) -> Path:
    """The only file of an installed package whose path ends with `ending`."""
    found = [file for file in metadata.files(package) or [] if f"/{file}".endswith(f"/{ending}")]
    if len(found) != 1:
        raise FileNotFoundError(f"{package} has {len(found)} files {ending}")
    return Path(found[0].locate())


def attributes(joint: minidom.Element, tag: str) -> dict[str, str]:
    """The attributes of a child element, as text; empty without it."""
    for child in joint.childNodes:
        if child.nodeName == tag:
            return dict(child.attributes.items())
    return {}


def of_urdf(text: str, base: str, tip: str) -> list[dict]:
    """The joints from base to tip of a URDF. The base is an ancestor of the tip."""
    document = expatbuilder.parseString(text, namespaces=False)
    by_child = {attributes(j, "child")["link"]: j for j in document.getElementsByTagName("joint") if attributes(j, "child")}
    joints, link = [], tip
    while link != base:
        joint = by_child[link]
        parent = attributes(joint, "parent")["link"]
        limit = {key: value for key, value in attributes(joint, "limit").items() if key in ("lower", "upper")}
        joints.append({
            "name": joint.getAttribute("name"), "type": joint.getAttribute("type"), "parent": parent, "child": link,
            "origin": attributes(joint, "origin"), "axis": attributes(joint, "axis"), "limit": limit,
        })
        link = parent
    return joints[::-1]


def of_module(path: Path, base: str, tip: str) -> list[dict]:
    """The joints of a prebuilt module of ssik: their frames have no rotation at zero, except the last one's right side, which is a fixed joint."""
    import numpy as np

    text = path.read_text()
    namespace = {"np": np}
    for name in ("_JOINT_NAMES", "_JOINT_AXES", "_JOINT_T_LEFTS", "_JOINT_T_RIGHTS", "_JOINT_LIMITS"):
        start = text.index(f"\n{name} = ")
        exec(text[start : text.index("\n]", start) + 2], namespace)
    rights = namespace["_JOINT_T_RIGHTS"]
    assert all(np.array_equal(left[:3, :3], np.eye(3)) for left in namespace["_JOINT_T_LEFTS"])
    assert all(np.array_equal(right, np.eye(4)) for right in rights[:-1])
    joints, names = [], namespace["_JOINT_NAMES"]
    words = lambda numbers: " ".join(repr(float(number)) for number in numbers)
    for i, name in enumerate(names):
        lower, upper = namespace["_JOINT_LIMITS"][i]
        joints.append({
            "name": name, "type": "revolute", "parent": base if i == 0 else f"link_{i}", "child": f"link_{i + 1}",
            "origin": {"xyz": words(namespace["_JOINT_T_LEFTS"][i][:3, 3])}, "axis": {"xyz": words(namespace["_JOINT_AXES"][i])},
            "limit": {"lower": repr(lower), "upper": repr(upper)},
        })
    right = rights[-1]
    if np.array_equal(right, np.eye(4)):
        joints[-1]["child"] = tip
    else:
        rpy = [np.arctan2(right[2, 1], right[2, 2]), np.arcsin(-np.clip(right[2, 0], -1, 1)), np.arctan2(right[1, 0], right[0, 0])]
        joints.append({
            "name": "tip", "type": "fixed", "parent": joints[-1]["child"], "child": tip,
            "origin": {"xyz": words(right[:3, 3]), "rpy": words(rpy)}, "axis": {}, "limit": {},
        })
    return joints


def to_urdf(name: str, comment: str, joints: list[dict]) -> str:
    """The chain as a URDF with empty links."""
    quoted = lambda pairs: "".join(f' {key}="{value}"' for key, value in pairs.items())
    lines = [f"<!-- {comment} -->", f'<robot name="{name}">', f'  <link name="{joints[0]["parent"]}"/>']
    for joint in joints:
        lines.append(f'  <link name="{joint["child"]}"/>')
        lines.append(f'  <joint name="{joint["name"]}" type="{joint["type"]}">')
        lines.append(f'    <parent link="{joint["parent"]}"/><child link="{joint["child"]}"/>')
        lines.extend(f"    <{tag}{quoted(joint[tag])}/>" for tag in ("origin", "axis") if joint[tag])
        if joint["limit"]:
            lines.append(f'    <limit{quoted(joint["limit"])} effort="1" velocity="1"/>')
        lines.append("  </joint>")
    return "\n".join([*lines, "</robot>", ""])


def chain(arm: dict) -> str:
    """The URDF of one entry of arms.toml."""
    package, base, tip = arm["package"], arm["base"], arm["tip"]
    if "module" in arm:
        source = f"ssik/prebuilt/{arm['module'].replace('.', '/')}.py"
        joints = of_module(locate(package, source), base, tip)
    else:
        source = arm["urdf"]
        joints = of_urdf(locate(package, source).read_text(), base, tip)
    version = metadata.version(package)
    return to_urdf(arm["id"], f"{arm['robot']}: joints {base} to {tip} of {source}, {package} {version}", joints)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", metavar="ID,...")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    for arm in read(args.only):
        (args.folder / f"{arm['id']}.urdf").write_text(chain(arm))


if __name__ == "__main__":
    main()
