#!/usr/bin/env python3
"""Compares the public items of the package `groebot` with the committed list; `run` starts it. One sorted line each: path, kind.

Input: the folder with rustdoc's JSON of the packages. With `--update` the list and its line in CHANGELOG.md are written.

One item is: a module, struct, enum, union, trait, type alias, macro, constant, static or free function, at each path where a user finds it; an inherent
method or associated constant; a trait's method. Fields, variants, methods of trait implementations and hidden items (`#[doc(hidden)]`) are not items.
A re-export from another package (`nalgebra`, `BigInt`) is one item. Members of a type that has several paths are listed at its first path.
"""
import difflib
import hashlib
import json
import re
import sys
from pathlib import Path

LISTED = {
    "struct": "struct", "enum": "enum", "union": "union", "trait": "trait", "type_alias": "type", "macro": "macro", "proc_macro": "macro",
    "constant": "const", "static": "static", "function": "fn",
}
MEMBERS = {"function": "fn", "assoc_const": "const"}


class Package:
    """The JSON of one package."""

    def __init__(self, name, document):
        self.name = name
        self.index = document["index"]
        self.root = str(document["root"])
        self.paths = document["paths"]
        self.by_path = {(tuple(p["path"]), p["kind"]): key for key, p in self.paths.items() if p["crate_id"] == 0}


class Lister:
    """Walks through the modules from the root of `groebot`."""

    def __init__(self, folder):
        self.packages = {}
        for file in folder.glob("groebot*.json"):
            self.packages[file.stem] = Package(file.stem, json.loads(file.read_text()))
        self.lines = set()
        # The paths at which each type is found.
        self.types = {}
        self.visiting = set()

    def resolve(self, package, key):
        """The package that defines an item and its key there; `None` if its package is not one of ours."""
        key = str(key)
        if key in package.index:
            return package, key
        summary = package.paths.get(key)
        if summary is None:
            return None
        owner = self.packages.get(summary["path"][0])
        found = owner and owner.by_path.get((tuple(summary["path"]), summary["kind"]))
        return (owner, found) if found else None

    def module(self, package, key, path):
        """Lists the items of a module at `path`."""
        if (package.name, key, path) in self.visiting:
            return
        self.visiting.add((package.name, key, path))
        for child in package.index[key]["inner"]["module"]["items"]:
            self.item(package, str(child), path, None)

    def item(self, package, key, path, name):
        """Lists an item of the module at `path`, under `name` if a re-export gives one."""
        item = package.index[key]
        if item["visibility"] != "public" or is_hidden(item):
            return
        (kind, inner), = item["inner"].items()
        if kind == "use":
            self.reexport(package, inner, path)
        elif kind == "module":
            here = f"{path}::{name or item['name']}"
            self.lines.add(f"{here} mod")
            self.module(package, key, here)
        elif kind in LISTED:
            here = f"{path}::{name or item['name']}"
            self.lines.add(f"{here} {LISTED[kind]}")
            self.types.setdefault((package.name, key), []).append(here)

    def reexport(self, package, use, path):
        """Lists what a `pub use` at `path` makes public."""
        found = self.resolve(package, use["id"]) if use["id"] is not None else None
        if found is None:
            if not use["is_glob"]:
                self.lines.add(f"{path}::{use['name']} use")
            return
        owner, key = found
        if not use["is_glob"]:
            self.item(owner, key, path, use["name"])
        elif "module" in owner.index[key]["inner"]:
            self.module(owner, key, path)

    def members(self):
        """Lists the members of all types that were found."""
        for (package, key), paths in self.types.items():
            package = self.packages[package]
            item = package.index[key]
            (kind, inner), = item["inner"].items()
            here = min(paths, key=lambda path: (path.count("::"), path))
            if kind == "trait":
                for child in inner["items"]:
                    self.member(package, child, here, inherent=False)
            for impl in inner.get("impls", []) if isinstance(inner, dict) else []:
                block = package.index[str(impl)]["inner"]["impl"]
                if block["trait"] is None:
                    for child in block["items"]:
                        self.member(package, child, here, inherent=True)

    def member(self, package, key, path, inherent):
        item = package.index.get(str(key))
        if item is None or (inherent and item["visibility"] != "public") or is_hidden(item):
            return
        (kind, _), = item["inner"].items()
        if kind in MEMBERS:
            self.lines.add(f"{path}::{item['name']} {MEMBERS[kind]}")

    def list(self):
        """All lines."""
        facade = self.packages["groebot"]
        self.module(facade, facade.root, "groebot")
        self.members()
        return sorted(self.lines)


def is_hidden(item):
    """Whether an item has `#[doc(hidden)]`."""
    return any("doc(hidden)" in str(attribute) for attribute in item["attrs"])


ROOT = Path(__file__).resolve().parents[2]
COMMITTED = ROOT / "tests/architecture/public_items.txt"
CHANGELOG = ROOT / "CHANGELOG.md"
LINE = re.compile(r"(?m)^- Public items: [0-9,]+, list [0-9a-f]{8}")


def main(folder, update):
    text = "\n".join(Lister(folder).list()) + "\n"
    count = text.count("\n")
    line = f"- Public items: {count:,}, list {hashlib.sha256(text.encode()).hexdigest()[:8]}"
    changelog = CHANGELOG.read_text()
    if update:
        COMMITTED.write_text(text)
        CHANGELOG.write_text(LINE.sub(line, changelog, count=1))
    committed = COMMITTED.read_text()
    difference = difflib.unified_diff(committed.splitlines(), text.splitlines(), "committed", "public", lineterm="", n=0)
    print(*difference, sep="\n", end="")
    if committed != text:
        sys.exit("error: the public items differ from the list; `scripts/public_items/run --update` writes it")
    unreleased = re.split(r"(?m)^## ", CHANGELOG.read_text())[1]
    if line not in unreleased:
        sys.exit(f"error: the unreleased section of CHANGELOG.md needs the line `{line}`, and says what has changed")
    print(f"{count:,} public items")


if __name__ == "__main__":
    main(Path(sys.argv[1]), "--update" in sys.argv[2:])
