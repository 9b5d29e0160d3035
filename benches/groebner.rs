//! Times of Groebner bases of known systems, of a parametric lexicographic basis as in a derivation, and of kinematic blocks with parameters.

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::groebner::{Basis, Options, Quotient, Strategy, basis, modular, parametric};
use groebot::number::{Field, Rationals, Zp};
use groebot::poly::system::PolynomialSystem;
use groebot::poly::{Fractions, Order, Polynomial, PolynomialRing, parse};

fn graded<F: Field>(field: F, variables: &[&str]) -> PolynomialRing<F> {
    PolynomialRing::new(field, variables, Order::GrevLex).expect("distinct variables")
}

fn read<F: Field>(ring: &PolynomialRing<F>, texts: &[&str]) -> Vec<Polynomial<F::Element>> {
    texts.iter().map(|text| parse(text).and_then(|tree| tree.evaluate(ring)).expect("well-formed text")).collect()
}

fn compute<F: Field>(ring: &PolynomialRing<F>, generators: &[Polynomial<F::Element>], strategy: Strategy) -> Basis<F> {
    let options = Options { strategy, cofactors: false };
    basis(ring, generators, &options, &Watch::none()).expect("a small system")
}

fn cyclic(criterion: &mut Criterion) {
    let field = Zp::new(32003).expect("a prime");
    let four = graded(field, &["a", "b", "c", "d"]);
    let equations = ["a+b+c+d", "a*b+b*c+c*d+d*a", "a*b*c+b*c*d+c*d*a+d*a*b", "a*b*c*d-1"];
    let generators = read(&four, &equations);
    criterion.bench_function("cyclic-4 grevlex GF(32003)", |b| b.iter(|| compute(&four, &generators, Strategy::Sugar)));
    let five = graded(field, &["a", "b", "c", "d", "e"]);
    let equations = [
        "a+b+c+d+e",
        "a*b+b*c+c*d+d*e+e*a",
        "a*b*c+b*c*d+c*d*e+d*e*a+e*a*b",
        "a*b*c*d+b*c*d*e+c*d*e*a+d*e*a*b+e*a*b*c",
        "a*b*c*d*e-1",
    ];
    let generators = read(&five, &equations);
    criterion.bench_function("cyclic-5 grevlex GF(32003)", |b| b.iter(|| compute(&five, &generators, Strategy::Sugar)));
}

fn katsura(criterion: &mut Criterion) {
    let ring = graded(Rationals, &["x0", "x1", "x2", "x3", "x4"]);
    let equations = [
        "x0+2*x1+2*x2+2*x3+2*x4-1",
        "x0^2+2*x1^2+2*x2^2+2*x3^2+2*x4^2-x0",
        "2*x0*x1+2*x1*x2+2*x2*x3+2*x3*x4-x1",
        "x1^2+2*x0*x2+2*x1*x3+2*x2*x4-x2",
        "2*x1*x2+2*x0*x3+2*x1*x4-x3",
    ];
    let generators = read(&ring, &equations);
    criterion.bench_function("katsura-4 grevlex Q", |b| b.iter(|| compute(&ring, &generators, Strategy::Sugar)));
}

/// NAO (6.7.12)-(6.7.15): grevlex over Q(px, pz), then lexicographic by a change of order.
fn leg(criterion: &mut Criterion) {
    let field = Fractions::new(Rationals, &["px", "pz"]).expect("distinct parameters");
    let variables = ["c4", "c3", "s4", "s3"];
    let ring = graded(field.clone(), &variables);
    let lex = PolynomialRing::new(field, &variables, Order::Lex).expect("distinct variables");
    let equations = [
        "1029/10*c3*c4 - 1029/10*s3*s4 + 100*c3 - pz",
        "1029/10*c3*s4 + 1029/10*c4*s3 + 100*s3 - px",
        "c3^2 + s3^2 - 1",
        "c4^2 + s4^2 - 1",
    ];
    let generators = read(&ring, &equations);
    criterion.bench_function("NAO leg Q(px,pz) grevlex, then lex", |b| {
        b.iter(|| {
            let quotient = Quotient::new(&compute(&ring, &generators, Strategy::Normal)).expect("two solutions");
            quotient.basis_in(&lex, &Watch::none()).expect("a small system")
        });
    });
}

fn cyclic_over_rationals(criterion: &mut Criterion) {
    let ring = graded(Rationals, &["a", "b", "c", "d", "e", "f"]);
    let sum_of_products = |length: usize| {
        let product =
            |first: usize| (0..length).map(|k| ["a", "b", "c", "d", "e", "f"][(first + k) % 6]).collect::<Vec<_>>();
        (0..6).map(|first| product(first).join("*")).collect::<Vec<_>>().join("+")
    };
    let mut equations: Vec<String> = (1..6).map(sum_of_products).collect();
    equations.push("a*b*c*d*e*f-1".to_owned());
    let generators = read(&ring, &equations.iter().map(String::as_str).collect::<Vec<_>>());
    criterion.bench_function("cyclic-6 grevlex Q, by primes", |b| {
        b.iter(|| modular::basis(&ring, &generators, &Options::default(), &Watch::none()).expect("a small system"));
    });
}

/// The blocks of the contest (`algebra/blocks`).
fn blocks(criterion: &mut Criterion) {
    for (name, text) in [
        ("NAO arm Q(py,pz) lex", include_str!("algebra/blocks/nao_arm-lp.sing")),
        ("planar 3R Q(px,py,t) grevlex", include_str!("algebra/blocks/planar_3r-dp.sing")),
        ("PUMA, symbolic, grevlex", include_str!("algebra/blocks/puma_symbolic-dp.sing")),
    ] {
        let system = PolynomialSystem::read(text, None).expect("a block of the contest");
        let field = Fractions::new(Rationals, &system.heading.parameters).expect("distinct parameters");
        let ring = PolynomialRing::new(field, &system.heading.variables, system.heading.order).expect("distinct names");
        let polynomials = system.polynomials.iter().map(|given| given.expression.evaluate(&ring));
        let generators = polynomials.collect::<groebot::Result<Vec<_>>>().expect("polynomials of the ring");
        criterion.bench_function(name, |b| {
            let options = parametric::Options::default();
            b.iter(|| parametric::basis(&ring, &generators, &options, &Watch::none()).expect("a small system"));
        });
    }
}

criterion_group! {
    name = bases;
    config = Criterion::default().sample_size(20);
    targets = cyclic, cyclic_over_rationals, katsura, leg, blocks
}
criterion_main!(bases);
