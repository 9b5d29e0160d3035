#!/usr/bin/env python3
"""Writes the folder `systems` from `input/answers.toml` with Singular: equations, and facts of their reduced bases.

    answers.py [NAME]              computes what is missing: answers of equations that have changed, answers never tried
    answers.py --again [NAME]      computes everything again
    answers.py --check [NAME]      the same without writing: fails if a file differs
    ... --field Q --order lex      only these answers
    ... --limit 30                 seconds of processor time for one answer

What goes over the limit of time or MEMORY bytes is listed in `input/absent.toml`, so that another machine gives the
same files: those answers are not tried again. README.md explains the format.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import families  # noqa: E402
import kinematics  # noqa: E402
import polynomials  # noqa: E402
import singular  # noqa: E402

sys.set_int_max_str_digits(0)

MEMORY = 4 << 30
FIELDS = ["GF(32003)", "GF(2147483647)", "Q"]
ORDERS = ["grevlex", "lex"]
ABSENT = HERE / "input" / "absent.toml"


class Unfinished(Exception):
    """Singular went over a limit; the text says which."""


def main():
    asked = arguments()
    wanted = [system for system in systems() if not asked.names or system["name"] in asked.names]
    differing = 0
    for system in wanted:
        path = HERE / "systems" / f"{system['name']}.toml"
        old = path.read_text() if path.exists() else ""
        text = document(system, {} if asked.again or asked.check else standing(old, system), asked)
        differing += old != text
        if old != text:
            print(path.name, flush=True)
        if not asked.check:
            path.write_text(text)
    print(f"{len(wanted)} systems, {differing} {'differ' if asked.check else 'changed'}")
    return 1 if asked.check and differing else 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--field", choices=FIELDS)
    parser.add_argument("--order", choices=ORDERS)
    parser.add_argument("--limit", type=int, default=120)
    return parser.parse_args()


def systems():
    """All systems, families written out."""
    with open(HERE / "input" / "answers.toml", "rb") as file:
        given = tomllib.load(file)
    yield from (member for entry in given["family"] for member in members(entry))
    for system in given["system"]:
        made = dict(system)
        if "generators" not in made:
            made["variables"], made["generators"] = kinematics.MECHANISMS[made["name"]]()
        yield made


def members(entry):
    """The systems of one family."""
    for index, size in enumerate(entry["sizes"]):
        made = families.expand({"family": entry["family"], "size": size})
        made |= {"name": f"{entry['family']}_{size}"} | {key: entry[key] for key in ("source", "method") if key in entry}
        if "degrees" in entry:
            dimension = entry["dimensions"][index] if "dimensions" in entry else 0
            made["known"] = {"dimension": dimension, "degree": entry["degrees"][index], "source": entry["fact"]}
        yield made


def standing(text, system):
    """The answers of a file by field and order, unless its equations have changed."""
    written = tomllib.loads(text)
    if any(written.get(key) != system[key] for key in ("variables", "generators")):
        return {}
    return {(found["field"], found["order"]): found for found in written.get("answer", [])}


def document(system, known, asked):
    """The whole text of one file."""
    head = {key: system[key] for key in ("name", "source")}
    head["obtained"] = f"Singular {singular.version()}, by answers.py"
    head |= {key: system[key] for key in ("variables", "generators", "known") if key in system}
    pairs = [(field, order) for field in FIELDS for order in ORDERS]
    return "\n".join([singular.table(head), *(entry(system, *pair, known.get(pair), asked) for pair in pairs)])


def entry(system, field, order, known, asked):
    """The table of one answer, or of its absence."""
    head = {"field": field, "order": order}
    reason = absences().get(system["name"], {}).get(f"{field} {order}")
    if known is None and reason is None:
        if asked.field in (None, field) and asked.order in (None, order):
            try:
                known = answer(system, field, order, asked.limit)
            except Unfinished as limits:
                reason = f"Singular needs {limits}"
                note_absence(system["name"], head, reason)
        else:
            reason = "not tried"
    return singular.table(head | known, "[[answer]]") if known else singular.table(head | {"reason": reason}, "[[absent]]")


def absences():
    return tomllib.loads(ABSENT.read_text()) if ABSENT.exists() else {}


def note_absence(name, asked, reason):
    """Adds one answer to the list of those that are not tried."""
    known = absences()
    known.setdefault(name, {})[f"{asked['field']} {asked['order']}"] = reason
    head = "# What Singular does not finish, by system, field and order: written by answers.py.\n"
    tables = [f"[{key}]\n" + "".join(f'"{k}" = {singular.literal(v)}\n' for k, v in known[key].items()) for key in sorted(known)]
    ABSENT.write_text("\n".join([head, *tables]))


def answer(system, field, order, limit):
    """The facts of one basis, after they have passed the literature's."""
    p = 0 if field == "Q" else int(field[3:-1])
    generators = [polynomials.read(text, system["variables"], p) for text in system["generators"]]
    texts = [polynomials.show(f, system["variables"]) for f in generators]
    method = system.get("method", "slimgb" if p else "std")
    printed = run(script(system["variables"], texts, p, order, method), limit)
    dimension, degree, how, *basis = printed
    found = {"dimension": int(dimension), "degree": int(degree) if dimension != "-1" else 0}
    confirm(system, field, found)
    basis = [polynomials.read(text, system["variables"], p) for text in basis]
    return {"method": how} | found | {"size": len(basis), "hash": polynomials.basis_hash(basis, order, p)}


def confirm(system, field, found):
    """Refuses what contradicts the literature."""
    for key, value in system.get("known", {}).items():
        if key != "source" and found[key] != value:
            raise RuntimeError(f"{system['name']} over {field}: {key} is {found[key]}, the literature says {value}")


def script(variables, generators, p, order, method):
    """Dimension and degree by the basis in grevlex; from there to lex, by FGLM if there are finitely many solutions."""
    return f"""option(redSB);
ring r = {p},({','.join(variables)}),dp; short = 0;
ideal I = {','.join(generators)};
ideal G = {method}(I);
int krull = dim(G); int count = mult(G);
string how = "{method}";
{LEX.format(p=p, names=','.join(variables)) if order == "lex" else ""}
write(":a " + target, string(krull), string(count), how);
for (int i = 1; i <= ncols(G); i++) {{ write(":a " + target, string(G[i])); }}
write(":a " + target, "end");
exit;
"""


LEX = """ring s = {p},({names}),lp; short = 0;
ideal G;
if (krull == 0) {{ how = how + ", fglm"; G = fglm(r, G); }}
else {{ how = "std"; G = std(imap(r, G)); }}"""


def run(commands, limit):
    """Within `limit` seconds: the lines that the script writes; an output without its last line was cut off and is refused."""
    with tempfile.NamedTemporaryFile("r", suffix=".txt") as file:
        text = f'string target = "{file.name}";\n{commands}'
        bounded = ["nice", "-n", "10", "prlimit", f"--cpu={limit}", f"--as={MEMORY}"]
        done = subprocess.run([*bounded, *singular.PROGRAM], input=text, capture_output=True, text=True)
        lines = file.read().splitlines()
    if done.returncode != 0 or "no more memory" in done.stdout + done.stderr:
        raise Unfinished(f"more than {limit} s or {MEMORY >> 30} GB")
    if "? " in done.stdout or not lines or lines.pop() != "end":
        raise RuntimeError(f"Singular failed: {done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return lines


if __name__ == "__main__":
    sys.exit(main())
