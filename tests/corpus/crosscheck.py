#!/usr/bin/env python3
"""Computes the corpus again with SymPy, a system that shares no code with Singular.

    crosscheck.py            all files
    crosscheck.py nao_leg    the files whose name begins so

Needs SymPy (`pip install sympy`). A computation gets 60 seconds; those that need more are listed, not failed.
Prints one line a file, and exits with 1 if any answer differs.
"""

import itertools
import math
import pathlib
import re
import signal
import sys
import tomllib

from sympy import FF, QQ
from sympy.polys.fglmtools import matrix_fglm
from sympy.polys.groebnertools import groebner, spoly
from sympy.polys.orderings import grevlex, lex
from sympy.polys.rings import ring

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 60
ORDERS = {"lex": lex, "grevlex": grevlex}


class TooSlow(Exception):
    """A computation did not end in time."""


def main(prefixes):
    seen, failed, slow = 0, [], []
    for name, check in checks():
        if prefixes and not name.startswith(tuple(prefixes)):
            continue
        seen += 1
        answer = within(SECONDS, check)
        slow += [name] if answer == "slow" else []
        failed += [name] if answer == "differs" else []
        print(f"{answer:8} {name}", flush=True)
    print(f"{seen} checks, {len(slow)} too slow {slow}, {len(failed)} differ {failed}")
    return 1 if failed or not seen else 0


def checks():
    """A name and a function for every check of every file."""
    for path in sorted((HERE / "groebner").glob("*.toml")):
        case = tomllib.loads(path.read_text())
        parts = [counted] if "vdim" in case.get("known", {}) else []
        parts += [reduced] if case["field"].startswith("GF") and case["name"] != "unlucky_prime" else []
        for part in [basis, *parts, normal_forms, eliminations, standard_monomials]:
            yield f"{path.stem} {part.__name__}", lambda part=part, case=case: part(case)
    for part in [gcd, factors]:
        path = HERE / "poly" / {gcd: "gcd.toml", factors: "factor.toml"}[part]
        for case in tomllib.loads(path.read_text())["case"]:
            if part == factors and case["field"] != "Q" and len(case["variables"]) > 1:
                continue  # SymPy does not factor these
            yield f"{path.stem} {case['name']}", lambda part=part, case=case: part(case)


def within(seconds, check):
    """`same`, `differs` or `slow`."""
    def stop(*_):
        raise TooSlow

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        return "same" if check() else "differs"
    except TooSlow:
        return "slow"
    finally:
        signal.alarm(0)


class Reader:
    """Reads polynomials of a field and order, in the given variables, greatest first."""

    def __init__(self, field, order, variables):
        self.field = domain(field)
        self.ring, *generators = ring(variables, self.field, ORDERS[order])
        self.names = dict(zip(variables, generators))
        self.names |= dict(zip(parameters(field), getattr(self.field, "gens", ())))
        self.names["number"] = self.field.convert

    def read(self, text):
        """A polynomial from its text; whole numbers become elements of the field before any division."""
        expression = re.sub(r"(?<![\w^])(\d+)", r"number(\1)", text).replace("^", "**")
        return self.ring(eval(expression, {"__builtins__": {}}, self.names))

    def all(self, texts):
        """The non-zero polynomials of a list."""
        return [f for f in map(self.read, texts) if f]


def parameters(field):
    """`["px", "pz"]` for `Q(px,pz)`."""
    found = re.fullmatch(r"(?:Q|GF\(\d+\))(?:\(([^)]*)\))?", field).group(1)
    return found.split(",") if found else []


def domain(field):
    """SymPy's field."""
    prime = re.match(r"GF\((\d+)\)", field)
    ground = FF(int(prime.group(1))) if prime else QQ
    names = parameters(field)
    return ground.frac_field(*names) if names else ground


def reader(case, order=None):
    """The reader of one case."""
    return Reader(case["field"], order or case.get("order", "grevlex"), case["variables"])


def monic(polynomials):
    """As a set, each divided by its leading coefficient."""
    return {f.monic() for f in polynomials}


def basis(case):
    """The reduced basis; in lex by FGLM if the quotient is small."""
    read = reader(case)
    expected = monic(read.all(case["basis"]))
    converts = case["order"] == "lex" and 0 < case["facts"].get("quotient_dimension", 0) <= 100
    start = reader(case, "grevlex" if converts else case["order"])
    generators = start.all(case["generators"])
    found = groebner(generators, start.ring) if generators else []
    return expected == monic(matrix_fglm(found, start.ring, lex) if converts else found)


def counted(case):
    """A proof by the number of solutions, without computing a basis: the S-polynomials of the basis and the generators
    reduce to zero by it, and it leaves as many standard monomials as the literature counts solutions."""
    read = reader(case)
    given = [f.monic() for f in read.all(case["basis"])]
    count = len(staircase([f.LM for f in given], len(case["variables"])))
    candidates = itertools.chain(read.all(case["generators"]), spolys(given, read.ring))
    return count == case["known"]["vdim"] and not any(f.rem(given) for f in candidates)


def reduced(case):
    """The basis modulo p is the basis over Q modulo p: true but for finitely many primes."""
    rational = "q" + "".join(f"_{name}" for name in parameters(case["field"]))
    path = HERE / "groebner" / f"{case['name']}-{case['order']}-{rational}.toml"
    read = reader(case)
    over_q = read.all(tomllib.loads(path.read_text())["basis"])
    given = read.all(case["basis"])
    return len(over_q) == len(given) and not any(f.monic() - g.monic() for f, g in zip(over_q, given))


def spolys(given, ground):
    """The S-polynomials of monic polynomials that Buchberger's product and chain criteria leave."""
    done = set()
    lcm = ground.monomial_lcm
    degree = lambda pair: sum(lcm(given[pair[0]].LM, given[pair[1]].LM))
    for i, j in sorted(itertools.combinations(range(len(given)), 2), key=degree):
        both = lcm(given[i].LM, given[j].LM)
        known = lambda k: {(min(i, k), max(i, k)), (min(j, k), max(j, k))} <= done
        chain = any(ground.monomial_div(both, f.LM) and known(k) for k, f in enumerate(given) if k not in (i, j))
        done.add((i, j))
        if not chain and both != ground.monomial_mul(given[i].LM, given[j].LM):
            yield spoly(given[i], given[j], ground)


def normal_forms(case):
    """The remainders by the basis, which are unique."""
    read = reader(case)
    divisors = read.all(case["basis"])
    for fact in case.get("membership", []):
        f = read.read(fact["polynomial"])
        remainder = f.rem(divisors) if divisors else f
        if remainder - read.read(fact["normal_form"]) or fact["member"] != (not remainder):
            return False
    return True


def eliminations(case):
    """The elimination ideals: a lex basis with the eliminated variables first, then a basis of what has none of them."""
    for fact in case.get("elimination", []):
        kept = [name for name in case["variables"] if name not in fact["eliminate"]]
        first = Reader(case["field"], "lex", fact["eliminate"] + kept)
        read, count = Reader(case["field"], case["order"], kept), len(fact["eliminate"])
        inside = [f for f in groebner(first.all(case["generators"]), first.ring) if not any(map(any, (m[:count] for m in f)))]
        moved = [read.ring.from_dict({m[count:]: c for m, c in f.items()}) for f in inside]
        if monic(read.all(fact["basis"])) != (monic(groebner(moved, read.ring)) if moved else set()):
            return False
    return True


def standard_monomials(case):
    """The dimension from the leading monomials, and the monomials that none of them divides."""
    read, facts = reader(case), case["facts"]
    leading = [f.LM for f in read.all(case["basis"])]
    if dimension(leading, len(case["variables"])) != facts["dimension"]:
        return False
    if facts["dimension"] > 0:
        return True
    listed = {read.read(text).LM for text in facts["standard_monomials"]}
    return listed == staircase(leading, len(case["variables"])) and len(listed) == facts["quotient_dimension"]


def dimension(leading, count):
    """The largest number of variables without a leading monomial in them alone; -1 for the unit ideal."""
    sizes = [-1]
    for chosen in itertools.product([0, 1], repeat=count):
        if not any(all(c or not e for c, e in zip(chosen, m)) for m in leading):
            sizes.append(sum(chosen))
    return max(sizes)


def staircase(leading, count):
    """The monomials under the staircase, grown from 1."""
    standard = lambda m: not any(all(a <= b for a, b in zip(l, m)) for l in leading)
    found, new = set(), {(0,) * count}
    while new:
        new = {m for m in new if standard(m)}
        found |= new
        new = {tuple(e + (i == j) for j, e in enumerate(m)) for m in new for i in range(count)} - found
    return found


def gcd(case):
    """The gcd up to a unit, and how it is scaled."""
    read = reader(case)
    f, g, h = map(read.read, [case["f"], case["g"], case["gcd"]])
    return f.gcd(g).monic() == h.monic() and scaled(h, case["field"])


def scaled(h, field):
    """Over Q primitive with a positive leading coefficient; over GF(p) monic."""
    if field == "Q":
        return h.LC > 0 and all(c.denominator == 1 for c in h.coeffs()) and math.gcd(*map(int, h.coeffs())) == 1
    return h.LC == 1 or field.startswith("Q(")


def factors(case):
    """The irreducible factors, and that both products give the polynomial back."""
    read = reader(case)
    f, unit = read.read(case["polynomial"]), read.read(case["unit"])
    listed = {(read.read(p["polynomial"]).monic(), p["multiplicity"]) for p in case["factors"]}
    if listed != {(p.monic(), k) for p, k in f.factor_list()[1]}:
        return False
    products = [product(read, case[key]) * unit for key in ["factors", "square_free"]]
    return all(p == f for p in products)


def product(read, powers):
    """The product of a list of powers."""
    return math.prod((read.read(p["polynomial"]) ** p["multiplicity"] for p in powers), start=read.ring(1))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
