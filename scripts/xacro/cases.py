"""Writes the expansions of crates/robot/tests/model/xacro/cases.toml by the package xacro of ROS, as its version in requirements.txt prints them.

    ~/.cache/groebot/xacro/venv/bin/python scripts/xacro/cases.py

The form is that of `xacro::expand`: one element per line, attributes in the order of the file.
"""

import json
import multiprocessing
import os
import sys
import tempfile
import tomllib
from pathlib import Path
from xml.sax.saxutils import escape

START = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'
FOLDER = Path(__file__).resolve().parents[2] / "crates/robot/tests/model/xacro"


def text_of(element, depth=0):
    attributes = "".join(
        f' {name}="{escape(value, {chr(34): "&quot;", chr(39): "&apos;"})}"' for name, value in element.attributes.items()
    )
    start = "  " * depth + f"<{element.tagName}{attributes}"
    children = [node for node in element.childNodes if node.nodeType == node.ELEMENT_NODE]
    text = " ".join(node.data.strip() for node in element.childNodes if node.nodeType == node.TEXT_NODE and node.data.strip())
    if not children and not text:
        return start + "/>\n"
    inner = "".join(text_of(child, depth + 1) for child in children)
    inner = f"\n{inner}{'  ' * depth}" if inner else ""
    return f"{start}>{escape(text)}{inner}</{element.tagName}>\n"


def expand(case, answers):
    sys.stderr = sys.stdout = open(os.devnull, "w")
    import xacro
    import xacrodoc  # its finder of packages replaces that of ROS

    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, text in case.get("files", {}).items():
            Path(name).parent.mkdir(exist_ok=True)
            Path(name).write_text(text.replace("<robot>", START))
        Path("robot.xacro").write_text(START + case["body"] + "</robot>")
        try:
            document = xacro.process_file("robot.xacro", mappings=dict(case.get("arguments", {})))
            answers.put({"text": text_of(document.documentElement)})
        except BaseException as error:
            answers.put({"error": f"{type(error).__name__}: {error}".strip().replace(folder, "")})


def main():
    expected = {}
    for case in tomllib.loads((FOLDER / "cases.toml").read_text())["case"]:
        answers = multiprocessing.Queue()
        process = multiprocessing.Process(target=expand, args=(case, answers))
        process.start()
        expected[case["name"]] = answers.get(timeout=60)
        process.join()
    (FOLDER / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")


main()
