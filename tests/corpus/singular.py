"""Runs Singular and writes TOML: what both `regenerate.py` scripts share.

A script labels its output: a line `@label` opens a section, the lines after it are its items, and `@end` closes the run.
"""

import re
import subprocess

PROGRAM = ["Singular", "-q", "--no-rc", "--no-tty"]

PROCEDURES = """\
proc show(string label, ideal items)
{
  "@" + label;
  for (int i = 1; i <= ncols(items); i++) { string(items[i]); }
}
proc normal(poly f)
{
  if (char(basering) == 0) { return(cleardenom(f)); }
  return(simplify(f, 1));
}
"""


def version():
    """The version as Singular says it: 4.3.1."""
    text = subprocess.run(PROGRAM[:1] + ["--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"version ([\d.]+)", text).group(1)


def run(script, seconds=600):
    """The labelled sections of what `script` prints, as a dict from label to lines."""
    done = subprocess.run(PROGRAM, input=script, capture_output=True, text=True, timeout=seconds)
    if done.returncode != 0 or "? " in done.stdout or done.stderr.strip():
        raise RuntimeError(f"Singular failed:\n{script}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return sections(done.stdout)


def sections(text):
    """Splits labelled output; an output without its `@end` was cut off and is refused."""
    found, label = {}, None
    for line in text.splitlines():
        if line.startswith("@"):
            label = line[1:]
            found[label] = []
        elif label is not None and line.strip():
            found[label].append(line.strip())
    if found.pop("end", None) != []:
        raise RuntimeError("Singular's output ends too early")
    return found


def ring(field, order, variables):
    """The ring declaration for field `Q`, `GF(p)`, `Q(a,b)` or `GF(p)(a,b)` and order `lex` or `grevlex`."""
    prime = re.match(r"GF\((\d+)\)", field)
    names = parameters(field)
    characteristic = prime.group(1) if prime else "0"
    coefficients = "(" + ",".join([characteristic, *names]) + ")" if names else characteristic
    return f"ring r = {coefficients},({','.join(variables)}),{ {'lex': 'lp', 'grevlex': 'dp'}[order] }; short = 0;"


def parameters(field):
    """The parameters of a field: `["px", "pz"]` for `Q(px,pz)`."""
    found = re.fullmatch(r"(?:Q|GF\(\d+\))(?:\(([^)]*)\))?", field)
    if not found:
        raise ValueError(f"field `{field}`: write Q, GF(p), Q(a,b) or GF(p)(a,b)")
    return found.group(1).split(",") if found.group(1) else []


def literal(value):
    """A TOML value: booleans, integers, strings, lists (one item a line when long), inline tables."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return text(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {literal(item)}" for key, item in value.items()) + " }"
    line = "[" + ", ".join(literal(item) for item in value) + "]"
    return line if len(line) <= 100 else "[\n" + "".join(f"    {literal(item)},\n" for item in value) + "]"


def text(value):
    """A TOML string; several lines become a multi-line literal string."""
    if "\n" in value:
        return f"'''\n{value}'''"
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'


def table(entries, header=""):
    """A TOML table from a dict; `header` is a line such as `[facts]`."""
    lines = [header] if header else []
    return "\n".join(lines + [f"{key} = {literal(value)}" for key, value in entries.items()]) + "\n"
