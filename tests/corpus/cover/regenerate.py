#!/usr/bin/env python3
"""Writes `segments` of each system: the size of the Groebner cover that Singular's grobcov.lib finds."""

import pathlib
import re
import subprocess
import sys
import tomllib

FILE = pathlib.Path(__file__).with_name("systems.toml")
ORDERS = {"lex": "lp", "grevlex": "dp"}


def segments(system):
    ring = f"ring R = (0,{','.join(system['parameters'])}),({','.join(system['variables'])}),{ORDERS[system['order']]};"
    ideal = f"ideal F = {', '.join(system['generators'])};"
    script = f'LIB "grobcov.lib"; {ring} {ideal} def G = grobcov(F); "@", size(G);'
    done = subprocess.run(["Singular", "-q", "--no-rc", "--no-tty"], input=script, capture_output=True, text=True, timeout=300)
    found = re.search(r"^@ (\d+)$", done.stdout, re.MULTILINE)
    if not found or "? " in done.stdout:
        raise RuntimeError(f"Singular failed on {system['name']}:\n{done.stdout}\n{done.stderr}")
    return int(found.group(1))


def main():
    text = FILE.read_text()
    head, *blocks = text.split("[[system]]\n")
    blocks = [re.sub(r"^segments = .*\n", "", block, flags=re.MULTILINE) for block in blocks]
    for index, block in enumerate(blocks):
        system = tomllib.loads(block)
        number = segments(system)
        print(system["name"], number, file=sys.stderr)
        blocks[index] = block.replace("order = ", f"segments = {number}\norder = ", 1)
    FILE.write_text("[[system]]\n".join([head, *blocks]))


main()
