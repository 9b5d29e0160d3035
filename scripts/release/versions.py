"""Cuts CHANGELOG.md into a version, sets the version of all packages, and lists the licences of the dependencies. Needs no package.

    versions.py cut VERSION DATE FOLDER       CHANGELOG.md, manifests, lock files, generated files, CITATION.cff
    versions.py order FOLDER                  the crates in the order of their dependencies
    versions.py notes VERSION FOLDER          the section of CHANGELOG.md
    versions.py licences FOLDER               licence texts of all crates in the program
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

UNRELEASED = "## [Unreleased]"
VERSION = re.compile(r"(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)")
DATE = re.compile(r"\d{4}-\d{2}-\d{2}")


class Refused(Exception):
    """An input that cannot be released."""


def numbers(version):
    """`1.2.3` as (1, 2, 3)."""
    if not VERSION.fullmatch(version):
        raise Refused(f"version `{version}`: give three numbers, such as 0.2.0")
    return tuple(map(int, version.split(".")))


def sections(text):
    """The head of a changelog, and its sections, each with its heading."""
    head, *rest = re.split(r"(?m)^(?=## \[)", text)
    return head, rest


def cut(text, version, date):
    """The changelog with the unreleased changes as those of `version`. A changelog that has the version and no unreleased changes is returned unchanged."""
    numbers(version)
    if not DATE.fullmatch(date):
        raise Refused(f"date `{date}`: give year-month-day")
    head, rest = sections(text)
    if not rest or not rest[0].startswith(UNRELEASED + "\n"):
        raise Refused(f"CHANGELOG.md: the first section is not `{UNRELEASED}`")
    changes = rest[0].removeprefix(UNRELEASED + "\n").strip("\n")
    is_cut = any(section.startswith(f"## [{version}] - ") for section in rest)
    if is_cut and changes:
        raise Refused(f"CHANGELOG.md has a section of {version} and unreleased changes; give the next version")
    if is_cut:
        return text
    if not changes:
        raise Refused(f"CHANGELOG.md: `{UNRELEASED}` is empty; there is nothing to release")
    released = f"## [{version}] - {date}\n\n{changes}\n" + ("\n" if rest[1:] else "")
    return head + f"{UNRELEASED}\n\n{released}" + "".join(rest[1:])


def notes(text, version):
    """The changes of `version`."""
    for section in sections(text)[1]:
        heading, _, changes = section.partition("\n")
        if heading.startswith(f"## [{version}] - "):
            return changes.strip("\n") + "\n"
    raise Refused(f"CHANGELOG.md has no section of {version}")


def replaced(path, pattern, by, text):
    """The text with the only match of `pattern` replaced."""
    text, count = re.subn(pattern, by, text)
    if count != 1:
        raise Refused(f"{path}: {count} places match `{pattern}`, not one")
    return text


def in_table(name, key):
    """A pattern of the value of `key` in a table of TOML."""
    return rf'(?ms)(^\[{re.escape(name)}\]\n(?:(?!^\[).)*?^{re.escape(key)} = ")[^"]*(")'


def workspace(folder):
    """The manifests of the crates in the workspace, by name."""
    root = tomllib.loads((folder / "Cargo.toml").read_text())
    paths = [folder] + [path for member in root["workspace"]["members"] for path in sorted(folder.glob(member))]
    manifests = [tomllib.loads((path / "Cargo.toml").read_text()) for path in paths if (path / "Cargo.toml").is_file()]
    return {manifest["package"]["name"]: manifest for manifest in manifests}


def order(folder):
    """The names of the crates, each after those that it needs, also for its tests."""
    crates = workspace(folder)
    needs = {
        name: {need for table in ("dependencies", "build-dependencies", "dev-dependencies") for need in crate.get(table, {})} & crates.keys() - {name}
        for name, crate in crates.items()
    }
    done = []
    while len(done) < len(needs):
        ready = sorted(name for name, own in needs.items() if name not in done and own <= set(done))
        if not ready:
            raise Refused("the crates depend on each other in a circle")
        done += ready
    return done


def current(folder):
    """The version of the workspace."""
    return tomllib.loads((folder / "Cargo.toml").read_text())["workspace"]["package"]["version"]


def set_manifests(folder, version):
    """Sets the version in the manifests of the workspace and of the wheel."""
    path = folder / "Cargo.toml"
    text = replaced(path, in_table("workspace.package", "version"), rf"\g<1>{version}\g<2>", path.read_text())
    for name in workspace(folder).keys() - {"groebot"}:
        text = replaced(path, rf'(?m)^({name} = {{ version = ")[^"]*(")', rf"\g<1>{version}\g<2>", text)
    path.write_text(text)
    for name, table in (("python/Cargo.toml", "package"), ("python/pyproject.toml", "project")):
        path = folder / name
        path.write_text(replaced(path, in_table(table, "version"), rf"\g<1>{version}\g<2>", path.read_text()))


def set_lock(text, names, old, version):
    """A lock file with the version of the packages `names` that come from a folder."""
    entries = text.split("[[package]]\n")
    for place, entry in enumerate(entries):
        found = re.match(r'name = "([^"]*)"\nversion = "([^"]*)"\n(?!source)', entry)
        if found and found[1] in names and found[2] == old:
            entries[place] = entry.replace(f'version = "{old}"', f'version = "{version}"', 1)
    return "[[package]]\n".join(entries)


def tracked(folder):
    """The files of the repository."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=folder, check=True, capture_output=True, text=True).stdout
    return [folder / name for name in listed.split("\0") if name]


def set_generated(path, old, version):
    """Sets the version in the mark of a generated file."""
    text = path.read_bytes()
    marks = [(f"generated by groebot {one}").encode() for one in (old, version)]
    if marks[0] in text[:4096]:
        path.write_bytes(text.replace(*marks))


def set_citation(path, version, date):
    """Sets version and date of CITATION.cff, which has no date before the first release."""
    text = re.sub(r"(?m)^date-released: .*\n", "", path.read_text())
    path.write_text(replaced(path, r"(?m)^version: .*$", f"version: {version}\ndate-released: {date}", text))


def prepare(folder, version, date):
    """Cuts the changelog and sets all versions; returns the folders whose hashes of outputs `groebot derive` must compute again."""
    old = current(folder)
    if numbers(version) < numbers(old):
        raise Refused(f"version {version} is before {old}, the version of Cargo.toml")
    changelog = folder / "CHANGELOG.md"
    before = changelog.read_text()
    text = cut(before, version, date)
    if text != before:
        changelog.write_text(text)
        set_citation(folder / "CITATION.cff", version, date)
    if version == old:
        return []
    names = {*workspace(folder), "groebot-python"}
    set_manifests(folder, version)
    files = [path for path in tracked(folder) if path.is_file() and not path.is_symlink()]
    for path in files:
        if path.name == "Cargo.lock":
            path.write_text(set_lock(path.read_text(), names, old, version))
        elif path.suffix in (".rs", ".c", ".h", ".cpp"):
            set_generated(path, old, version)
    return sorted({path.parent.relative_to(folder).as_posix() for path in files if path.name == "outputs.sha256"})


def licences(folder):
    """The name, the licence and the licence texts of each crate in the program. A text that several crates share is printed once."""
    def cargo(*arguments):
        return subprocess.run(["cargo", *arguments, "--locked"], cwd=folder, check=True, capture_output=True, text=True).stdout

    listed = cargo("tree", "--package", "groebot", "--edges", "normal", "--prefix", "none", "--format", "{p}")
    used = {tuple(line.split()[:2]) for line in listed.splitlines() if line}
    printed = {}
    packages = json.loads(cargo("metadata", "--format-version", "1"))["packages"]
    for package in sorted(packages, key=lambda package: (package["name"], package["version"])):
        if package["source"] is None or (package["name"], "v" + package["version"]) not in used:
            continue
        files = sorted(path for path in Path(package["manifest_path"]).parent.iterdir() if re.match(r"(?i)(licen[sc]e|copying|copyright|notice|unlicense)", path.name) and path.is_file())
        own = f"{package['name']} {package['version']}"
        texts = {path.name: path.read_text(errors="replace").strip() for path in files}
        first = {name: printed.setdefault(text, own) for name, text in texts.items()}
        shown = [f"{name}:\n{text}" if first[name] == own else f"{name}: as of {first[name]}" for name, text in texts.items()]
        yield f"{own}: {package['license']}\n" + "".join(f"\n{text}\n" for text in shown)


def main(command, *arguments):
    if command == "cut":
        version, date, folder = arguments
        for thin in prepare(Path(folder), version, date):
            print(thin)
    elif command == "order":
        print("\n".join(order(Path(arguments[0]))))
    elif command == "notes":
        print(notes((Path(arguments[1]) / "CHANGELOG.md").read_text(), arguments[0]), end="")
    elif command == "licences":
        print(("\n" + "-" * 80 + "\n\n").join(licences(Path(arguments[0]))), end="")
    else:
        raise Refused(f"`{command}`: give cut, order, notes or licences")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except Refused as refused:
        sys.exit(f"error: {refused}")
