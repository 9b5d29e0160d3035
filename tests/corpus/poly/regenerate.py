#!/usr/bin/env python3
"""Writes gcd.toml and factor.toml from `input/` with Singular.

    regenerate.py            rewrites both files
    regenerate.py --check    says which file differs from what Singular gives; writes nothing

Needs Python 3.11 and `Singular` on the path (Debian: singular-ui). README.md explains the format.
"""

import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import singular  # noqa: E402


def main(arguments):
    check = "--check" in arguments
    changed = [name for name, make in [("gcd", gcds), ("factor", factors)] if rewrite(name, make, check)]
    print(f"{changed or 'no file'} {'differ' if check else 'changed'}")
    return 1 if check and changed else 0


def rewrite(name, make, check):
    """Rewrites one file; says whether its content is new."""
    with open(HERE / "input" / f"{name}.toml", "rb") as file:
        content = make(tomllib.load(file)["case"])
    path = HERE / f"{name}.toml"
    if path.exists() and path.read_text() == content:
        return False
    if not check:
        path.write_text(content)
    return True


def gcds(cases):
    """The text of gcd.toml."""
    scripts = [GCD.format(ring=ring(case), **case) for case in cases]
    commands, found = run(scripts)
    return document(commands, [gcd(case, found) for case in cases])


GCD = """\
{ring}
poly f = ({common})*({a});
poly g = ({common})*({b});
poly h = normal(gcd(normal(f), normal(g)));
"@{name}"; string(f); string(g); string(h);
if (reduce(f, std(h)) != 0 or reduce(g, std(h)) != 0) {{ ERROR("no common divisor"); }}
if (normal(gcd(normal(f)/h, normal(g)/h)) != 1) {{ ERROR("not the greatest"); }}
kill r;
"""


def gcd(case, found):
    """One case of gcd.toml."""
    f, g, h = found[case["name"]]
    return {
        "name": case["name"],
        "field": case["field"],
        "variables": case["variables"],
        "parameters": singular.parameters(case["field"]),
        "f": f,
        "g": g,
        "gcd": h,
    }


def factors(cases):
    """The text of factor.toml."""
    cases = [{"field": "Q"} | case for case in cases]
    scripts = [FACTOR.format(ring=ring(case), **case) for case in cases]
    commands, found = run(scripts)
    return document(commands, [factorisation(case, found) for case in cases])


FACTOR = """\
{ring}
poly f = {polynomial};
list l = factorize(f);
poly rest = f;
"@{name}/polynomial"; string(f);
"@{name}/factors";
for (int i = 1; i <= ncols(l[1]); i++)
{{
  poly p = normal(l[1][i]);
  if (deg(p) > 0) {{ string(l[2][i]) + " " + string(p); rest = rest/(p^l[2][i]); }}
  kill p;
}}
"@{name}/unit"; string(rest);
"@{name}/square_free";
for (int m = 1; m <= deg(f); m++)
{{
  poly p = 1;
  for (i = 1; i <= ncols(l[1]); i++) {{ if (l[2][i] == m and deg(l[1][i]) > 0) {{ p = p*normal(l[1][i]); }} }}
  if (deg(p) > 0) {{ string(m) + " " + string(p); }}
  kill p;
}}
if (deg(rest) != 0) {{ ERROR("factors are missing"); }}
kill i; if (defined(m)) {{ kill m; }}
kill r;
"""


def factorisation(case, found):
    """One case of factor.toml."""
    of = lambda key: found[f"{case['name']}/{key}"]
    return {
        "name": case["name"],
        "field": case["field"],
        "variables": case["variables"],
        "polynomial": of("polynomial")[0],
        "unit": of("unit")[0],
        "factors": powers(of("factors")),
        "square_free": powers(of("square_free")),
    }


def powers(lines):
    """`2 x-1` is the factor x-1 with multiplicity 2; ordered by multiplicity, then by length and text."""
    pairs = [line.split(" ", 1) for line in lines]
    pairs.sort(key=lambda pair: (int(pair[0]), len(pair[1]), pair[1]))
    return [{"polynomial": polynomial, "multiplicity": int(count)} for count, polynomial in pairs]


def ring(case):
    """The ring of a case, with grevlex."""
    return singular.ring(case["field"], "grevlex", case["variables"])


def run(scripts):
    """All scripts in one run of Singular: the commands and what they print."""
    commands = "\n".join([singular.PROCEDURES, *scripts, '"@end";', "exit;"]) + "\n"
    return commands, singular.run(commands)


def document(commands, cases):
    """A whole file: the script, then the cases."""
    top = {"obtained": f"Singular {singular.version()}, by the script below", "script": commands}
    return "\n".join([singular.table(top)] + [singular.table(case, "[[case]]") for case in cases])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
