"""The generators of the families cyclic-n and katsura-n, written out from their definitions."""


def expand(system):
    """Replaces `family` and `size` by `variables` and `generators`."""
    made = dict(system)
    if "family" in made:
        variables, generators = {"cyclic": cyclic, "katsura": katsura}[made.pop("family")](made.pop("size"))
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
