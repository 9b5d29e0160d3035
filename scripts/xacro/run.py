"""Expands each description in xacro of the packages of packages.txt by xacrodoc and by groebot, and compares them joint by joint.

Both read the same files, with the same folders of packages and the same arguments (settings.toml). The result is one row per file:

    equal      both expand it, and all links, joints and other elements are equal
    joints     links and joints are equal, and another element differs
    different  a link or a joint differs
    both       both refuse it
    xacrodoc   only xacrodoc refuses it
    groebot    only groebot refuses it

It ends with status 1 if a row is `joints`, `different` or `groebot`.
"""

import argparse
import csv
import json
import math
import multiprocessing
import os
import re
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Relative and absolute difference of two numbers that are equal: both print the shortest text of the same double.
EQUAL = 1e-12


def package_names(folder, renamed):
    """The folders of packages in an installed distribution, by name: those with a package.xml, and those that $(find NAME) and package://NAME name."""
    found = {}
    named = set()
    for file in sorted(folder.rglob("*")):
        if file.name == "package.xml":
            names = re.findall(r"<name>\s*([^<\s]+)\s*</name>", file.read_text(errors="replace"))
            if names:
                found.setdefault(names[0], file.parent)
        elif file.suffix == ".xacro":
            named |= set(re.findall(r"\$\(find\s+([^)\s]+)\)", file.read_text(errors="replace")))
    for name in sorted(named - set(found)):
        folders = sorted(path for path in folder.rglob(renamed.get(name, name)) if path.is_dir())
        if folders:
            found[name] = folders[0]
    return {name: str(path) for name, path in sorted(found.items())}


def by_xacrodoc(request, answers):
    """Expands one file in a process of its own, because xacro has global state."""
    sys.stderr = sys.stdout = open(os.devnull, "w")
    try:
        import xacrodoc

        os.chdir(Path(request["file"]).parent)
        xacrodoc.packages.update_package_cache(request["packages"])
        document = xacrodoc.XacroDoc.from_file(
            request["file"], subargs=dict(request["arguments"]), resolve_packages=False
        )
        # The text as expanded: `to_urdf_string` makes the paths of meshes absolute.
        answers.put({"text": document.dom.toxml()})
    except BaseException as error:  # xacro ends the process for some errors
        answers.put({"error": f"{type(error).__name__}: {error}".strip()})


def expanded_by_xacrodoc(request):
    answers = multiprocessing.Queue()
    process = multiprocessing.Process(target=by_xacrodoc, args=(request, answers))
    process.start()
    try:
        answer = answers.get(timeout=60)
    except Exception:
        answer = {"error": "no answer in 60 s"}
        process.kill()
    process.join()
    return answer


def expanded_by_groebot(program, requests):
    lines = "".join(json.dumps(request) + "\n" for request in requests)
    answers = subprocess.run([program], input=lines, capture_output=True, text=True, check=True).stdout
    return [json.loads(line) for line in answers.splitlines()]


def same_text(a, b):
    """Whether two attributes are equal, as texts or as lists of numbers."""
    a, b = a.split(), b.split()
    return len(a) == len(b) and all(x == y or same_number(x, y) for x, y in zip(a, b))


def same_number(x, y):
    try:
        x, y = float(x), float(y)
    except ValueError:
        return False
    return math.isclose(x, y, rel_tol=EQUAL, abs_tol=EQUAL) or (math.isnan(x) and math.isnan(y))


def difference(a, b, path):
    """The first difference of two elements, or None."""
    if a.tag != b.tag:
        return f"{path}: <{a.tag}> and <{b.tag}>"
    here = f"{path}/{a.tag}" + (f"[{a.get('name')}]" if a.get("name") else "")
    if set(a.attrib) != set(b.attrib):
        return f"{here}: attributes {sorted(set(a.attrib) ^ set(b.attrib))}"
    for name in a.attrib:
        if not same_text(a.get(name), b.get(name)):
            return f"{here}: {name} = {a.get(name)!r} and {b.get(name)!r}"
    if len(a) != len(b):
        return f"{here}: {len(a)} and {len(b)} children"
    if (a.text or "").split() != (b.text or "").split() and len(a) == 0:
        return f"{here}: texts {(a.text or '').strip()[:40]!r} and {(b.text or '').strip()[:40]!r}"
    for one, other in zip(a, b):
        found = difference(one, other, here)
        if found:
            return found
    return None


def parsed(text):
    # Prefixes of undeclared namespaces, such as those of sensors, become parts of names.
    text = re.sub(r"(</?|\s)([A-Za-z_][\w.-]*):(?=[A-Za-z_])", r"\1\2_", re.sub(r"\sxmlns(:\w+)?=\"[^\"]*\"", "", text))
    return ElementTree.fromstring(text)


def compared(ours, theirs):
    """The result, the number of joints, and the first difference."""
    ours, theirs = parsed(ours), parsed(theirs)
    joints = len(theirs.findall("joint"))
    for part in ("link", "joint"):
        a, b = ours.findall(part), theirs.findall(part)
        names = [[element.get("name") for element in elements] for elements in (a, b)]
        if names[0] != names[1]:
            return "different", joints, f"{part}s {sorted(map(str, set(names[0]) ^ set(names[1])))[:4]}"
        for one, other in zip(a, b):
            found = difference(one, other, "")
            if found:
                return "different", joints, found
    found = difference(ours, theirs, "")
    return ("joints", joints, found) if found else ("equal", joints, "")


def short(text):
    return " ".join(re.sub(r"\x1b\[[0-9;]*m", "", text).split())[:240]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--expand", required=True, help="the example `expand`")
    parser.add_argument("--packages", required=True, type=Path, help="the folder of the installed packages")
    parser.add_argument("--only", default="", help="only files with this text in their path")
    parser.add_argument("--csv", type=Path, help="write the table to this file")
    arguments = parser.parse_args()
    settings = tomllib.loads((HERE / "settings.toml").read_text())
    listed = [line for line in (HERE / "packages.txt").read_text().split("\n") if line and not line.startswith("#")]
    requests, names = [], []
    for package in listed:
        folder = arguments.packages / package.replace("==", "-")
        packages = package_names(folder, settings["folders"])
        for file in sorted(folder.rglob("*.xacro")):
            name = f"{folder.name}/{file.relative_to(folder)}"
            if arguments.only in name and file.is_file():
                names.append(name)
                values = settings["arguments"].get(file.name, {})
                requests.append({"file": str(file), "packages": packages, "arguments": values})
    answers = expanded_by_groebot(arguments.expand, requests)
    rows, counts, total = [], {}, 0
    for name, request, ours in zip(names, requests, answers):
        theirs = expanded_by_xacrodoc(request)
        if "error" in ours or "error" in theirs:
            result = "both" if "error" in ours and "error" in theirs else "groebot" if "error" in ours else "xacrodoc"
            texts = [f"{side}: {short(answer['error'])}" for side, answer in (("xacrodoc", theirs), ("groebot", ours)) if "error" in answer]
            joints, text = 0, "; ".join(texts).replace(str(arguments.packages) + "/", "")
        else:
            result, joints, text = compared(ours["text"], theirs["text"])
        total += joints if result == "equal" else 0
        counts[result] = counts.get(result, 0) + 1
        rows.append([name, result, joints, text])
        if result not in ("equal", "both", "xacrodoc"):
            print(f"{result}: {name}: {text}", flush=True)
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["file", "result", "joints", "difference"])
            writer.writerows(rows)
    print(f"{len(rows)} files: " + ", ".join(f"{count} {result}" for result, count in sorted(counts.items())) + f"; {total} equal joints")
    sys.exit(any(counts.get(result) for result in ("joints", "different", "groebot")))


if __name__ == "__main__":
    main()
