"""Polynomials as dicts from exponent tuples to coefficients: expanded texts, and the hash of a reduced basis.

The canonical text of a reduced basis: one line for each element, smallest leading monomial first; in a line the terms, greatest
first, parted by spaces; a term is `c:e1,e2,...,en`, its coefficient and its exponents, all in decimal. Over GF(p) the element is
monic with coefficients in 0..p-1, over Q it has coprime integer coefficients, the first one positive. Every line ends with a
newline. The hash is FNV-1a with 64 bits of these bytes, written as 16 hexadecimal digits.
"""

import math
import re
from fractions import Fraction

TERM = re.compile(r"([+-]?)([^+-]+)")


def read(text, variables, p=0):
    """The polynomial of an expanded text such as `3/2*x^2*y-1`; coefficients modulo `p` unless it is 0."""
    index = {name: i for i, name in enumerate(variables)}
    found = {}
    for sign, term in TERM.findall(text.replace(" ", "")):
        value, exponents = factors(term, index)
        value = -value if sign == "-" else value
        found[exponents] = found.get(exponents, 0) + value
    return nonzero({exponents: residue(value, p) for exponents, value in found.items()})


def factors(term, index):
    """Coefficient and exponents of one term."""
    value, exponents = 1, [0] * len(index)
    for factor in term.split("*"):
        if factor[0].isdigit():
            value *= Fraction(factor) if "/" in factor else int(factor)
        else:
            name, _, power = factor.partition("^")
            exponents[index[name]] += int(power or 1)
    return value, tuple(exponents)


def residue(value, p):
    """The coefficient modulo `p`."""
    if p == 0:
        return value
    return value.numerator * pow(value.denominator, -1, p) % p


def nonzero(f):
    """Without its zero terms."""
    return {exponents: value for exponents, value in f.items() if value}


def show(f, variables):
    """The expanded text, in the order of insertion."""
    text = "".join(show_term(value, exponents, variables) for exponents, value in f.items())
    return "-" + text[3:] if text.startswith(" - ") else text[3:] or "0"


def show_term(value, exponents, variables):
    """A term with its sign in front."""
    names = [name if power == 1 else f"{name}^{power}" for name, power in zip(variables, exponents) if power]
    number = [] if abs(value) == 1 and names else [str(abs(value))]
    return (" - " if value < 0 else " + ") + "*".join(number + names)


def order_key(order):
    """The key by which exponent tuples ascend in `lex` or `grevlex`."""
    return {"lex": lambda e: e, "grevlex": lambda e: (sum(e), tuple(-power for power in reversed(e)))}[order]


def canonical_lines(basis, order, p):
    """The lines of the canonical text."""
    key = order_key(order)
    rows = sorted((sorted(f.items(), key=lambda term: key(term[0]), reverse=True) for f in basis), key=lambda row: key(row[0][0]))
    for row in rows:
        values = scaled([value for _, value in row], p)
        yield " ".join(f"{value}:{','.join(map(str, e))}" for value, (e, _) in zip(values, row)) + "\n"


def scaled(values, p):
    """Monic modulo `p`; coprime integers with a positive first one over Q."""
    if p:
        inverse = pow(values[0], -1, p)
        return [value * inverse % p for value in values]
    common = math.lcm(*(Fraction(value).denominator for value in values))
    whole = [int(value * common) for value in values]
    divisor = math.gcd(*whole) * (1 if whole[0] > 0 else -1)
    return [value // divisor for value in whole]


def basis_hash(basis, order, p):
    """The hash of a reduced basis."""
    value = 0xCBF29CE484222325
    for line in canonical_lines(basis, order, p):
        for byte in line.encode():
            value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"
