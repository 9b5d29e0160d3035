//! Program of `groebner` 0.6 (crates.io) for the contest: computes the reduced basis of a file in msolve's format (see
//! `program.rs`).

mod program;

use groebner::{
    F4Field, Frac, MonomialOrder, Polynomial, PolynomialRing, PrimeField, Zp, fglm, groebner_basis_f4,
    ring::ParseCoefficient,
};
use num_rational::BigRational;

use program::{Arguments, Result};

fn main() -> Result<()> {
    let arguments = Arguments::read()?;
    let (variables, parameters) = (&arguments.input.variables, &arguments.input.parameters);
    let order = MonomialOrder::GRevLex;
    if arguments.proof.is_some() {
        return Err("this contestant proves nothing".into());
    }
    match (arguments.input.characteristic, parameters.is_empty()) {
        (0, true) => run(&arguments, &PolynomialRing::<BigRational>::new(variables, order)?),
        (32003, true) => run(&arguments, &PolynomialRing::<PrimeField<32003>>::new(variables, order)?),
        (p, true) => run(&arguments, &PolynomialRing::<Zp>::with_modulus(variables, order, p)?),
        (0, false) => run(&arguments, &PolynomialRing::<Frac>::with_parameters(variables, order, parameters)?),
        (_, false) => Err("no parameters in positive characteristic".into()),
    }
}

fn run<F: F4Field + ParseCoefficient>(arguments: &Arguments, ring: &PolynomialRing<F>) -> Result<()> {
    let generators = ring.parse_many(&arguments.input.polynomials.join(";"))?;
    let target = if arguments.lex { ring.with_order(MonomialOrder::Lex) } else { ring.clone() };
    let basis = arguments.measure(|| theirs(&generators, arguments.lex))?;
    let lines = basis.iter().map(|f| target.format(f)).collect::<std::result::Result<Vec<_>, _>>()?;
    arguments.show(|| lines.into_iter());
    Ok(())
}

fn theirs<F: F4Field>(generators: &[Polynomial<F>], lex: bool) -> Result<Vec<Polynomial<F>>> {
    let graded = groebner_basis_f4(generators.to_vec(), true)?;
    Ok(if lex { fglm(&graded, &MonomialOrder::Lex)? } else { graded })
}
