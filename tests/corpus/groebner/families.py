"""The generators of the families of polynomial systems, written out from their definitions."""

import math
from fractions import Fraction


def expand(system):
    """Replaces `family` and `size` by `variables` and `generators`."""
    made = dict(system)
    if "family" in made:
        variables, generators = FAMILIES[made.pop("family")](made.pop("size"))
        made |= {"variables": variables, "generators": generators}
    return made


def cyclic(n):
    """The sums of all products of d cyclically consecutive unknowns, d = 1..n-1, and x0*...*x(n-1) - 1."""
    names = [f"x{i}" for i in range(n)]
    product = lambda start, length: "*".join(names[k] for k in sorted((start + j) % n for j in range(length)))
    sums = [" + ".join(product(start, length) for start in range(n)) for length in range(1, n)]
    return names, sums + [product(0, n) + " - 1"]


def katsura(n):
    """n+1 unknowns x0..xn with x(-l) = x(l), and x(l) = 0 for l > n:
    sum over l of x(l) x(m-l) = x(m) for m = 0..n-1, and sum over l of x(l) = 1."""
    names = [f"x{i}" for i in range(n + 1)]
    linear = " + ".join([names[0]] + [f"2*{name}" for name in names[1:]]) + " - 1"
    return names, [linear] + [convolution(names, m) for m in range(n)]


def convolution(names, m):
    """The equation of index m of Katsura's system."""
    n, count = len(names) - 1, {}
    for l in range(-n, n + 1):
        if abs(m - l) <= n:
            pair = tuple(sorted((abs(l), abs(m - l))))
            count[pair] = count.get(pair, 0) + 1
    terms = [(f"{k}*" if k > 1 else "") + monomial(names[a], names[b]) for (a, b), k in sorted(count.items())]
    return " + ".join(terms) + f" - {names[m]}"


def monomial(a, b):
    """The product of two unknowns."""
    return f"{a}^2" if a == b else f"{a}*{b}"


def eco(n):
    """The model of an economy: (x(k) + sum over i of x(i) x(i+k)) x(n) = k for k = 1..n-1, and x1 + ... + x(n-1) = -1."""
    names = [f"x{i}" for i in range(1, n + 1)]
    last = names[-1]
    products = [" + ".join(f"{term}*{last}" for term in autocorrelation(names[:-1], k)) + f" - {k}" for k in range(1, n)]
    return names, products + [" + ".join(names[:-1]) + " + 1"]


def redeco(n):
    """The same with u = 1/x(n), which leaves equations of degree 2."""
    names = [f"x{i}" for i in range(1, n)]
    sums = [" + ".join(autocorrelation(names, k)) + f" - {'' if k == 1 else f'{k}*'}u{n}" for k in range(1, n)]
    return [*names, f"u{n}"], sums + [" + ".join(names) + " + 1"]


def autocorrelation(names, k):
    """The terms x(k), x(1) x(1+k), x(2) x(2+k), ..."""
    return [names[k - 1]] + [f"{a}*{b}" for a, b in zip(names, names[k:])]


def noon(n):
    """A neural network: 10 x(i) (sum over j /= i of x(j)^2) - 11 x(i) + 10 = 0."""
    names = [f"x{i}" for i in range(1, n + 1)]
    equation = lambda x: " + ".join(f"10*{x}*{y}^2" for y in names if y != x) + f" - 11*{x} + 10"
    return names, [equation(x) for x in names]


def reimer(n):
    """The alternating power sums: 2 (x1^k - x2^k + ...) = 1 for k = 2..n+1."""
    names = [f"x{i}" for i in range(1, n + 1)]
    signed = lambda k: "".join(f"{' - ' if i % 2 else ' + ' if i else ''}2*{x}^{k}" for i, x in enumerate(names))
    return names, [f"{signed(k)} - 1" for k in range(2, n + 2)]


def chandra(n):
    """Chandrasekhar's H-equation at c = 51234/100000, without denominators:
    2n h(k) - c h(k) (1 + sum over i < n of k/(k+i) h(i)) = 2n."""
    names = [f"h{i}" for i in range(1, n + 1)]
    return names, [chandra_equation(names, k) for k in range(1, n + 1)]


def chandra_equation(names, k):
    """The equation of index k."""
    n, here, c = len(names), names[k - 1], Fraction(51234, 100000)
    products = [(c * k / (k + i), monomial(here, names[i - 1])) for i in range(1, n)]
    whole = math.lcm(c.denominator, *(value.denominator for value, _ in products))
    terms = "".join(f" - {value * whole}*{text}" for value, text in products)
    return f"{(2 * n - c) * whole}*{here}{terms} - {2 * n * whole}"


FAMILIES = {
    "cyclic": cyclic,
    "katsura": katsura,
    "eco": eco,
    "redeco": redeco,
    "noon": noon,
    "reimer": reimer,
    "chandra": chandra,
}
