//! Greatest common divisors of multivariate polynomials over a field, by primitive remainder sequences (Knuth, The Art
//! of Computer Programming 2, 4.6.1) with an evaluation test that detects most coprime pairs.

use crate::number::{BigInt, Field, Ring};
use crate::poly::ring::{Polynomial, PolynomialRing, Term};

/// The monic greatest common divisor of `f` and `g`; zero only for two zeros.
pub(in crate::poly) fn gcd<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Polynomial<F::Element> {
    if f.is_zero() || g.is_zero() || f == g {
        return ring.monic(if f.is_zero() { g } else { f });
    }
    if ring.as_constant(f).is_some() || ring.as_constant(g).is_some() {
        return ring.one();
    }
    let (f_power, f) = split_monomial(ring, f);
    let (g_power, g) = split_monomial(ring, g);
    let shared = ring.layout().gcd(&leading(&f_power).monomial, &leading(&g_power).monomial);
    let rest = gcd_without_monomials(ring, &f, &g);
    ring.mul(&ring.term(ring.field().one(), shared), &rest)
}

fn leading<E>(f: &Polynomial<E>) -> &Term<E> {
    f.leading().expect("a nonzero polynomial has a leading term")
}

/// Splits `f` into the greatest monomial that divides it and the cofactor.
pub(in crate::poly) fn split_monomial<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
) -> (Polynomial<F::Element>, Polynomial<F::Element>) {
    let layout = ring.layout();
    let first = leading(f).monomial.clone();
    let shared = f.terms().iter().fold(first, |shared, term| layout.gcd(&shared, &term.monomial));
    let divide = |term: &Term<F::Element>| Term {
        coefficient: term.coefficient.clone(),
        monomial: layout.checked_div(&term.monomial, &shared).expect("it divides every term"),
    };
    let rest = Polynomial { terms: f.terms().iter().map(divide).collect() };
    (ring.term(ring.field().one(), shared), rest)
}

fn gcd_without_monomials<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Polynomial<F::Element> {
    if ring.as_constant(f).is_some() || ring.as_constant(g).is_some() {
        return ring.one();
    }
    let degrees = |v: usize| (ring.degree_in(f, v), ring.degree_in(g, v));
    let variables = 0..ring.variables().len();
    if let Some(v) = variables.clone().find(|&v| (degrees(v).0 == 0) != (degrees(v).1 == 0)) {
        let (with, without) = if degrees(v).0 > 0 { (f, g) } else { (g, f) };
        return gcd(ring, &content(ring, with, v), without);
    }
    if let Some(divisor) = divisor_of_the_other(ring, f, g) {
        return divisor;
    }
    let shared = variables.filter(|&v| degrees(v).0 > 0);
    let (absent, open): (Vec<usize>, Vec<usize>) = shared.partition(|&v| coprime_at_a_point(ring, f, g, v));
    if open.is_empty() {
        return ring.one();
    }
    if let Some(&v) = absent.first() {
        return gcd(ring, &content(ring, f, v), &content(ring, g, v));
    }
    let main = open.into_iter().min_by_key(|&v| degrees(v).0.max(degrees(v).1));
    let main = main.expect("two non-constants share a variable here");
    let (f_content, g_content) = (content(ring, f, main), content(ring, g, main));
    let shared = gcd(ring, &f_content, &g_content);
    let f = ring.exact_div(f, &f_content).expect("a content divides");
    let g = ring.exact_div(g, &g_content).expect("a content divides");
    ring.monic(&ring.mul(&shared, &primitive_remainders(ring, f, g, main)))
}

/// The shorter polynomial when it divides the other.
fn divisor_of_the_other<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Option<Polynomial<F::Element>> {
    let (short, long) = if f.terms().len() <= g.terms().len() { (f, g) } else { (g, f) };
    ring.exact_div(long, short).map(|_| ring.monic(short))
}

/// The gcd of the coefficients of `f` as a polynomial in `variable`.
fn content<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>, variable: usize) -> Polynomial<F::Element> {
    let mut coefficients = ring.coefficients_in(f, variable);
    coefficients.sort_by_key(|c| c.terms().len());
    let mut content = ring.zero();
    for coefficient in &coefficients {
        content = gcd(ring, &content, coefficient);
        if ring.is_one(&content) {
            break;
        }
    }
    content
}

fn primitive_part<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    variable: usize,
) -> Polynomial<F::Element> {
    let content = content(ring, f, variable);
    ring.monic(&ring.exact_div(f, &content).expect("a content divides"))
}

/// The primitive gcd of two polynomials that are primitive in `main`.
fn primitive_remainders<F: Field>(
    ring: &PolynomialRing<F>,
    f: Polynomial<F::Element>,
    g: Polynomial<F::Element>,
    main: usize,
) -> Polynomial<F::Element> {
    let (mut a, mut b) = if ring.degree_in(&f, main) >= ring.degree_in(&g, main) { (f, g) } else { (g, f) };
    loop {
        let remainder = pseudo_remainder(ring, &a, &b, main);
        if remainder.is_zero() {
            return primitive_part(ring, &b, main);
        }
        if ring.degree_in(&remainder, main) == 0 {
            return ring.one();
        }
        (a, b) = (b, primitive_part(ring, &remainder, main));
    }
}

/// The remainder of `lc(b)^k a` by `b` in the variable `main`.
fn pseudo_remainder<F: Field>(
    ring: &PolynomialRing<F>,
    a: &Polynomial<F::Element>,
    b: &Polynomial<F::Element>,
    main: usize,
) -> Polynomial<F::Element> {
    let divisor_degree = ring.degree_in(b, main);
    let lead = ring.coefficients_in(b, main).pop().expect("a degree has a coefficient");
    let mut rest = a.clone();
    while !rest.is_zero() && ring.degree_in(&rest, main) >= divisor_degree {
        let shift = ring.degree_in(&rest, main) - divisor_degree;
        let top = ring.coefficients_in(&rest, main).pop().expect("a degree has a coefficient");
        let power = ring.pow(&ring.variable(main), shift);
        let subtrahend = ring.mul(&ring.mul(&top, &power), b);
        rest = ring.sub(&ring.mul(&lead, &rest), &subtrahend);
    }
    rest
}

/// Proves that the gcd has degree 0 in `main` by evaluating the other variables. The degree of a gcd cannot drop where
/// a leading coefficient stays nonzero. `false` means that nothing was proved.
fn coprime_at_a_point<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
    main: usize,
) -> bool {
    (0..2).any(|attempt| {
        let f_line = restrict(ring, f, main, attempt);
        let g_line = restrict(ring, g, main, attempt);
        let kept = |line: &[F::Element], of| line.len() == ring.degree_in(of, main) as usize + 1;
        (kept(&f_line, f) || kept(&g_line, g))
            && !f_line.is_empty()
            && !g_line.is_empty()
            && dense_gcd_degree(ring.field(), f_line, g_line) == 0
    })
}

/// The coefficients in `main`, low degree first, with small numbers substituted for the other variables.
fn restrict<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    main: usize,
    attempt: usize,
) -> Vec<F::Element> {
    let field = ring.field();
    let number = |v: usize| field.from_integer(&BigInt::from(3 + 7 * attempt + (v * v + 5 * v) % 11));
    let values: Vec<_> = (0..ring.variables().len()).map(number).collect();
    let mut line = vec![field.zero(); ring.degree_in(f, main) as usize + 1];
    for term in f.terms() {
        let mut value = term.coefficient.clone();
        for (v, number) in values.iter().enumerate().filter(|(v, _)| *v != main) {
            value = field.mul(&value, &field.pow(number, ring.layout().exponent(&term.monomial, v)));
        }
        let power = ring.layout().exponent(&term.monomial, main) as usize;
        line[power] = field.add(&line[power], &value);
    }
    trim(field, &mut line);
    line
}

fn trim<F: Field>(field: &F, line: &mut Vec<F::Element>) {
    while line.last().is_some_and(|c| field.is_zero(c)) {
        line.pop();
    }
}

/// The degree of the gcd of two nonzero dense univariate polynomials, by the Euclidean algorithm.
fn dense_gcd_degree<F: Field>(field: &F, mut a: Vec<F::Element>, mut b: Vec<F::Element>) -> usize {
    while let Some(lead) = b.last() {
        let inverse = field.inverse(lead).expect("a leading coefficient is not zero");
        b.iter_mut().for_each(|c| *c = field.mul(c, &inverse));
        while a.len() >= b.len() {
            let top = a.last().cloned().expect("it is not empty");
            let shift = a.len() - b.len();
            for (k, c) in b.iter().enumerate() {
                a[shift + k] = field.sub(&a[shift + k], &field.mul(&top, c));
            }
            trim(field, &mut a);
        }
        (a, b) = (b, a);
    }
    a.len() - 1
}
