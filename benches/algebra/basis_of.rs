//! groebot's contestant: the reduced basis of a file in msolve's format (see `program.rs`).

mod program;

use groebot::Watch;
use groebot::groebner::{Basis, Options, Quotient, Strategy, basis};
use groebot::number::{Field, Rationals, Ring, Style, Zp};
use groebot::poly::{Fractions, Order, Polynomial, PolynomialRing, parse};

use program::{Arguments, Result};

fn main() -> Result<()> {
    let arguments = Arguments::read()?;
    let parameters = &arguments.input.parameters;
    match (arguments.input.characteristic, parameters.is_empty()) {
        (0, true) => run(&arguments, Rationals),
        (p, true) => run(&arguments, Zp::new(p)?),
        (0, false) => run(&arguments, Fractions::new(Rationals, parameters)?),
        (p, false) => run(&arguments, Fractions::new(Zp::new(p)?, parameters)?),
    }
}

fn run<F: Field>(arguments: &Arguments, field: F) -> Result<()> {
    let ring = PolynomialRing::new(field, &arguments.input.variables, Order::GrevLex)?;
    let texts = &arguments.input.polynomials;
    let read = |text: &String| parse(text).and_then(|tree| tree.evaluate(&ring));
    let generators = texts.iter().map(read).collect::<groebot::Result<Vec<_>>>()?;
    let show = |basis: &Basis<F>| Ok(basis.polynomials.iter().map(|f| basis.ring.format(f, Style::Text)).collect());
    arguments.measure(|| ours(&ring, &generators, arguments.lex), show)
}

/// The engine under test: the reduced basis in grevlex, or from there in lex.
fn ours<F: Field>(ring: &PolynomialRing<F>, generators: &[Polynomial<F::Element>], lex: bool) -> Result<Basis<F>> {
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    let graded = basis(ring, generators, &options, &Watch::none())?;
    if !lex {
        return Ok(graded);
    }
    let target = PolynomialRing::new(ring.field().clone(), ring.variables(), Order::Lex)?;
    Ok(Quotient::new(&graded)?.basis_in(&target, &Watch::none())?)
}
