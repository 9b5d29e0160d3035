"""Polynomials with the usual operators, for writing equations down: what kinematics.py computes with."""

import math
from fractions import Fraction

from polynomials import nonzero, order_key, show


class Sum:
    """A polynomial as a dict from monomials, tuples of (name, power) sorted by name, to rational coefficients."""

    def __init__(self, terms):
        self.terms = nonzero(terms)

    @staticmethod
    def of(value):
        """A number as a polynomial; a polynomial as it is."""
        return value if isinstance(value, Sum) else Sum({(): Fraction(value)})

    def __add__(self, other):
        made = dict(self.terms)
        for monomial, value in Sum.of(other).terms.items():
            made[monomial] = made.get(monomial, 0) + value
        return Sum(made)

    def __mul__(self, other):
        made = {}
        for a, x in self.terms.items():
            for b, y in Sum.of(other).terms.items():
                monomial = times(a, b)
                made[monomial] = made.get(monomial, 0) + x * y
        return Sum(made)

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + Sum.of(other) * -1

    def __rsub__(self, other):
        return Sum.of(other) - self

    def __pow__(self, exponent):
        return math.prod([self] * exponent, start=Sum.of(1))

    __radd__, __rmul__ = __add__, __mul__

    def on_circles(self, count):
        """The same function where c_i^2 + s_i^2 = 1, i <= count: no power of s_i above 1."""
        found = self
        for i in range(1, count + 1):
            found = found.replaced(f"s{i}", lambda power, i=i: rest_on_circle(i, power))
        return found

    def in_tangents(self, tangents):
        """c_i = (1-t^2)/(1+t^2), s_i = 2t/(1+t^2), times (1+t^2) to the degree in joint i."""
        found = self
        for i, t in enumerate(tangents, 1):
            degree = max((power_of(m, f"c{i}") + power_of(m, f"s{i}") for m in found.terms), default=0)
            found = sum((term_in_tangents(m, value, i, t, degree) for m, value in found.terms.items()), Sum({}))
        return found

    def replaced(self, name, value):
        """With `value(power)` for each power of `name`."""
        made = Sum({})
        for monomial, coefficient in self.terms.items():
            rest = tuple(pair for pair in monomial if pair[0] != name)
            made += Sum({rest: coefficient}) * value(power_of(monomial, name))
        return made

    def primitive(self):
        """Divided by the content: coprime integers."""
        whole = math.lcm(*(value.denominator for value in self.terms.values()))
        divisor = math.gcd(*(int(value * whole) for value in self.terms.values()))
        return self * Fraction(whole, divisor)

    def text(self, names):
        """The expanded text, greatest term in grevlex first."""
        terms = {tuple(power_of(m, name) for name in names): value for m, value in self.terms.items()}
        return show(dict(sorted(terms.items(), key=lambda term: order_key("grevlex")(term[0]), reverse=True)), names)


def unknowns(names):
    """The names as polynomials."""
    return [Sum({((name, 1),): Fraction(1)}) for name in names]


def times(a, b):
    """The product of two monomials."""
    powers = dict(a)
    for name, power in b:
        powers[name] = powers.get(name, 0) + power
    return tuple(sorted(powers.items()))


def power_of(monomial, name):
    return dict(monomial).get(name, 0)


def rest_on_circle(i, power):
    """s_i to a power, with s_i^2 = 1 - c_i^2."""
    [c, s] = unknowns([f"c{i}", f"s{i}"])
    return (1 - c * c) ** (power // 2) * s ** (power % 2)


def term_in_tangents(monomial, value, i, t, degree):
    """One term with t for the joint i."""
    c, s = power_of(monomial, f"c{i}"), power_of(monomial, f"s{i}")
    rest = Sum({tuple(pair for pair in monomial if pair[0] not in (f"c{i}", f"s{i}")): value})
    return rest * (1 - t * t) ** c * (t * 2) ** s * (1 + t * t) ** (degree - c - s)
