#!/usr/bin/env python3
"""Writes the corpus of Groebner bases from `input/systems.toml` with Singular.

    regenerate.py            rewrites every file
    regenerate.py nao_leg    rewrites the files of one system (or more)
    regenerate.py --check    says which files differ from what Singular gives; writes nothing

Needs Python 3.11 and `Singular` on the path (Debian: singular-ui). README.md explains the format.
"""

import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import families  # noqa: E402
import singular  # noqa: E402

LIMIT = 200_000


def main(arguments):
    check = "--check" in arguments
    names = [word for word in arguments if not word.startswith("-")]
    with open(HERE / "input" / "systems.toml", "rb") as file:
        systems = tomllib.load(file)["system"]
    unknown = set(names) - {system["name"] for system in systems}
    if unknown:
        sys.exit(f"no system {sorted(unknown)} in input/systems.toml")
    wanted = list(cases(systems, names))
    changed = [path for case in wanted for path in [write(case, check)] if path]
    stray = {path.stem for path in HERE.glob("*.toml")} - {file_name(case) for case in wanted}
    if stray and not names:
        sys.exit(f"no entry of input/systems.toml gives {sorted(stray)}")
    print(f"{len(changed)} files differ" if check else f"{len(changed)} files changed")
    return 1 if check and changed else 0


def cases(systems, names):
    """One case for every basis of every system."""
    for system in systems:
        if names and system["name"] not in names:
            continue
        made = families.expand(system)
        for basis in made.pop("bases"):
            yield made | {"method": "std"} | basis


def write(case, check):
    """Writes one file; returns its path if the content is new."""
    path = HERE / f"{file_name(case)}.toml"
    content = document(case)
    if len(content) > LIMIT:
        raise RuntimeError(f"{path.name}: {len(content)} bytes, at most {LIMIT} are allowed")
    if path.exists() and path.read_text() == content:
        return None
    print(path.name, len(content))
    if not check:
        path.write_text(content)
    return path


def file_name(case):
    """`nao_leg-lex-q_px_pz`: the system, the order, the field."""
    field = case["field"].lower().replace(")(", "_").replace("gf(", "gf").replace("(", "_").replace(",", "_")
    return f"{case['name']}-{case['order']}-{field.replace(')', '')}"


def document(case):
    """The whole text of one file."""
    commands = script(case)
    found = singular.run(commands)
    confirm(case, found)
    parts = [singular.table(head(case, found, commands)), singular.table(facts(case, found), "[facts]")]
    parts += [singular.table(fact, "[[elimination]]") for fact in eliminations(case, found)]
    parts += [singular.table(fact, "[[membership]]") for fact in memberships(case, found)]
    return "\n".join(parts)


def script(case):
    """The commands that produce every fact of one file."""
    lines = [singular.PROCEDURES + "option(redSB);", setup(case)]
    lines += ["ideal G = std(I);" if case["method"] == "std" else FGLM.format(names=",".join(case["variables"]))]
    lines += [REPORT]
    for index, names in enumerate(case.get("eliminate", [])):
        lines += [f"ideal E{index} = std(eliminate(I, {'*'.join(names)}));", f'report("elimination{index}", E{index});']
    for index, polynomial in enumerate(case.get("membership", [])):
        lines += [f'show("membership{index}", ideal(reduce({polynomial}, G)));']
    return "\n".join(lines + ['"@end";', "exit;"]) + "\n"


def setup(case):
    """Ring and generators; by FGLM the ideal is first read in a ring with grevlex."""
    order = "grevlex" if case["method"] == "fglm" else case["order"]
    generators = ",\n  ".join(case["generators"])
    return f"{singular.ring(case['field'], order, case['variables'])}\nideal I =\n  {generators};"


FGLM = """\
ideal H = std(I);
ring s = char(r),({names}),lp; short = 0;
ideal I = imap(r, I);
ideal G = std(fglm(r, H));"""

REPORT = """\
proc report(string label, ideal B)
{
  ideal N = B;
  if (size(N) > 0) { N = N[sortvec(N)]; }
  for (int i = 1; i <= ncols(N); i++) { N[i] = normal(N[i]); }
  show(label, N);
}
show("generators", I);
report("basis", G);
"@dimension"; dim(G);
"@degree"; mult(G);
"@vdim"; vdim(G);
if (vdim(G) >= 0) { show("kbase", kbase(G)); }"""


def confirm(case, found):
    """Refuses a case that contradicts the literature, or whose text read back is another basis."""
    for key, value in case.get("known", {}).items():
        if key != "source" and int(found[key][0]) != value:
            raise RuntimeError(f"{case['name']}: {key} is {found[key][0]}, the literature says {value}")
    basis = nonzero(found["basis"])
    if not basis:
        return
    again = [singular.PROCEDURES, "option(redSB);", singular.ring(case["field"], case["order"], case["variables"])]
    again += [f"ideal B = {','.join(basis)};", f"ideal I = {','.join(found['generators'])};", CONFIRM]
    seen = singular.run("\n".join(again))
    if seen["same"] != ["1"]:
        raise RuntimeError(f"{case['name']}: the printed basis, read back, is not the reduced basis")


CONFIRM = """\
int same = 1;
ideal S = std(B);
S = S[sortvec(S)];
if (ncols(S) != ncols(B)) { same = 0; }
for (int i = 1; same and i <= ncols(B); i++) { same = (normal(S[i]) == normal(B[i])); }
for (int i = 2; same and i <= ncols(B); i++) { same = (lead(B[i-1]) < lead(B[i])); }
attrib(B, "isSB", 1);
if (size(reduce(I, B)) != 0) { same = 0; }
"@same"; same;
"@end";
exit;
"""


def head(case, found, commands):
    """The keys at the top of a file."""
    known = {"known": case["known"]} if "known" in case else {}
    return {
        "name": case["name"],
        "source": case["source"],
        "obtained": f"Singular {singular.version()}, by the script below",
        "field": case["field"],
        "order": case["order"],
        "variables": case["variables"],
        "parameters": singular.parameters(case["field"]),
        "generators": case["generators"],
        "basis": nonzero(found["basis"]),
    } | known | {"script": commands}


def facts(case, found):
    """Dimension, degree (that of the ideal only if the order goes by degree), standard monomials if there are finitely many."""
    made = {"dimension": int(found["dimension"][0])}
    if case["order"] == "grevlex":
        made["degree"] = int(found["degree"][0])
    if made["dimension"] > 0:
        return made
    monomials = nonzero(found["kbase"])
    if len(monomials) != int(found["vdim"][0]):
        raise RuntimeError(f"vdim is {found['vdim']}, kbase has {len(monomials)} monomials")
    return made | {"quotient_dimension": len(monomials), "standard_monomials": monomials}


def eliminations(case, found):
    """The elimination ideals."""
    for index, names in enumerate(case.get("eliminate", [])):
        yield {"eliminate": names, "basis": nonzero(found[f"elimination{index}"])}


def memberships(case, found):
    """The normal forms; a polynomial is in the ideal if its normal form is 0."""
    for index, polynomial in enumerate(case.get("membership", [])):
        [remainder] = found[f"membership{index}"]
        yield {"polynomial": polynomial, "member": remainder == "0", "normal_form": remainder}


def nonzero(polynomials):
    """Singular prints the zero ideal as one zero."""
    return [polynomial for polynomial in polynomials if polynomial != "0"]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
