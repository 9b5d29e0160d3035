//! Printed polynomials are read back as equal polynomials, in text and in LaTeX.

use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Style, Zp};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing, parse, parse_latex};
use proptest::prelude::*;

use super::sparse::{Sparse, build, quotient, sparse, with_roots};

const NAMES: [&str; 4] = ["x", "c4", "theta", "long_name2"];

fn ring<F: Field>(field: F) -> PolynomialRing<F> {
    PolynomialRing::new(field, &NAMES, Order::GrevLex).expect("distinct names")
}

fn reads_back<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) {
    let (text, latex) = (ring.format(f, Style::Text), ring.format(f, Style::Latex));
    let from_text = parse(&text).and_then(|tree| tree.evaluate(ring)).unwrap_or_else(|e| panic!("{text}: {e}"));
    let from_latex =
        parse_latex(&latex).and_then(|tree| tree.evaluate(ring)).unwrap_or_else(|e| panic!("{latex}: {e}"));
    assert_eq!(&from_text, f, "{text}");
    assert_eq!(&from_latex, f, "{latex}");
}

/// `sum of (top / bottom) f`.
fn combination<F: Field>(
    field: &Fractions<F>,
    parts: &[(Sparse, Sparse, Sparse)],
) -> Polynomial<<Fractions<F> as Ring>::Element> {
    let ring = ring(field.clone());
    parts.iter().fold(ring.zero(), |sum, (top, bottom, f)| {
        ring.add(&sum, &ring.scale(&build(&ring, f), &quotient(field, top, bottom)))
    })
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn over_the_rationals_and_prime_fields(f in sparse(4, 6, 12), denominators in prop::collection::vec(1i64..99, 6)) {
        let rationals = ring(Rationals);
        let mut divided = rationals.zero();
        for (term, d) in build(&rationals, &f).terms().iter().zip(denominators) {
            let coefficient = &term.coefficient / BigRational::from_integer(BigInt::from(d));
            divided = rationals.add(&divided, &rationals.term(coefficient, term.monomial.clone()));
        }
        reads_back(&rationals, &divided);
        for p in [2, 32003] {
            let ring = ring(Zp::new(p).unwrap());
            reads_back(&ring, &build(&ring, &f));
        }
    }

    #[test]
    fn over_rational_functions(parts in prop::collection::vec((sparse(3, 3, 2), sparse(3, 2, 2), sparse(4, 2, 3)), 1..4)) {
        let field = Fractions::new(Rationals, &["px", "L1", "z"]).unwrap();
        reads_back(&ring(field.clone()), &combination(&field, &parts));
        let modular = Fractions::new(Zp::new(7).unwrap(), &["px", "L1", "z"]).unwrap();
        reads_back(&ring(modular.clone()), &combination(&modular, &parts));
        let roots = with_roots(Rationals);
        reads_back(&ring(roots.clone()), &combination(&roots, &parts));
    }
}

#[test]
fn polynomials_are_written_as_people_write_them() {
    let ring = ring(Fractions::new(Rationals, &["px", "pz"]).unwrap());
    for (input, text, latex) in [
        ("0", "0", "0"),
        ("-1", "-1", "-1"),
        ("x - x", "0", "0"),
        ("1 - 3*x^2/2", "-3/2*x^2 + 1", "-\\frac{3}{2} x^{2} + 1"),
        ("-x*c4^10 + theta", "-x*c4^10 + theta", "-x c_{4}^{10} + \\mathit{theta}"),
        ("(px + 1)*x - px", "(px + 1)*x - px", "\\left(\\mathit{px} + 1\\right) x - \\mathit{px}"),
        ("x - px - 1", "x + (-px - 1)", "x + \\left(-\\mathit{px} - 1\\right)"),
        ("x*px/pz", "(px)/(pz)*x", "\\frac{\\mathit{px}}{\\mathit{pz}} x"),
    ] {
        let f = parse(input).unwrap().evaluate(&ring).unwrap();
        assert_eq!(ring.format(&f, Style::Text), text);
        assert_eq!(ring.format(&f, Style::Latex), latex);
    }
}
