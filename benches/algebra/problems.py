"""The lines of the contest: systems of the corpus, each in a field and an order."""

import pathlib
import re
import sys
import tomllib
from dataclasses import dataclass, field

CORPUS = pathlib.Path(__file__).resolve().parents[2] / "tests" / "corpus" / "groebner"
sys.path.insert(0, str(CORPUS))

import families  # noqa: E402
import polynomials  # noqa: E402

BLOCKS = pathlib.Path(__file__).resolve().parent / "blocks"
PRIMES = ["GF(32003)", "GF(2147483647)"]


@dataclass(frozen=True)
class Problem:
    """One system in one field and order, with the hash of its reduced basis if the corpus knows it."""

    system: str
    field: str
    order: str
    variables: list = field(hash=False)
    generators: list = field(hash=False)
    known_hash: str | None = None

    @property
    def characteristic(self):
        found = re.match(r"GF\((\d+)\)", self.field)
        return int(found.group(1)) if found else 0

    @property
    def parameters(self):
        found = re.fullmatch(r"(?:Q|GF\(\d+\))\(([a-z].*)\)", self.field)
        return found.group(1).split(",") if found else []

    @property
    def label(self):
        return f"{self.system} {self.field} {self.order}"

    def reduced(self, names=None):
        """The generators as texts without blanks, in these names; coefficients modulo the characteristic."""
        if self.parameters:
            return [text.replace(" ", "") for text in self.generators]
        read = [polynomials.read(text, self.variables, self.characteristic) for text in self.generators]
        return [polynomials.show(f, names or self.variables).replace(" ", "") for f in read]

    def msolve_text(self):
        """The system in msolve's format; parameters follow the characteristic (msolve itself has none)."""
        head = " ".join([str(self.characteristic), ",".join(self.parameters)]).strip()
        return f"{','.join(self.variables)}\n{head}\n" + ",\n".join(self.reduced()) + "\n"

    def hash_of(self, texts):
        """The hash of a basis, printed as expanded texts."""
        basis = [polynomials.read(text, self.variables, self.characteristic) for text in texts]
        return polynomials.basis_hash(basis, self.order, self.characteristic)


def lines():
    """All lines: numeric systems modulo primes and over Q in grevlex, and modulo primes in lex; then the blocks with parameters."""
    graded = family("katsura", 7, 10) + family("cyclic", 6, 8) + family("eco", 10, 12) + family("noon", 6, 8)
    rational = family("katsura", 7, 9) + family("cyclic", 6, 7) + family("noon", 6, 7) + ["eco_10"]
    change = ["katsura_7", "katsura_8", "cyclic_6", "eco_10", "noon_6"]
    yield from (problem(name, prime, "grevlex") for prime in PRIMES for name in graded)
    yield from (problem(name, "Q", "grevlex") for name in rational)
    yield from (problem(name, prime, "lex") for prime in PRIMES for name in change)
    yield from (block(path) for path in sorted(BLOCKS.glob("*.sing")))


def corpus_lines():
    """All results of the corpus."""
    for path in sorted((CORPUS / "systems").glob("*.toml")):
        for answer in tomllib.loads(path.read_text()).get("answer", []):
            yield problem(path.stem, answer["field"], answer["order"])


def family(name, first, last):
    return [f"{name}_{size}" for size in range(first, last + 1)]


def problem(name, field_name, order):
    """The system `name`, from the corpus or from its family."""
    file = CORPUS / "systems" / f"{name}.toml"
    if not file.exists():
        word, _, size = name.rpartition("_")
        return Problem(name, field_name, order, *families.FAMILIES[word](int(size)))
    system = tomllib.loads(file.read_text())
    asked = (field_name, order)
    known = [answer.get("hash") for answer in system.get("answer", []) if (answer["field"], answer["order"]) == asked]
    return Problem(name, *asked, system["variables"], system["generators"], next(iter(known), None))


def block(path):
    """A file of the folder `blocks`: a Singular ring with parameters, and an ideal."""
    text = path.read_text()
    parameters, variables, order = re.search(r"ring r = \(0,([^)]*)\),\(([^)]*)\),(\w+);", text).groups()
    generators = re.search(r"ideal I =([^;]*);", text).group(1).split(",")
    name, order = path.stem.rpartition("-")[0], {"dp": "grevlex", "lp": "lex"}[order]
    return Problem(name, f"Q({parameters})", order, variables.split(","), [g.strip() for g in generators])
