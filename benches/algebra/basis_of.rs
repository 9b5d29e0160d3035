//! groebot's program for the contest: computes the reduced basis of a file in msolve's format (see `program.rs`), and
//! over Q its proof.

mod program;

use std::time::Duration;

use groebot::groebner::{Basis, Options, basis_modulo_prime, modular, parametric};
use groebot::number::{BigRational, Field, Rationals, Ring, Style, Zp};
use groebot::poly::{Fractions, Order, Polynomial, PolynomialRing, parse};
use groebot::{ErrorKind, Watch};

use program::{Arguments, Result};

fn main() -> Result<()> {
    let arguments = Arguments::read()?;
    match (arguments.input.characteristic, arguments.input.parameters.is_empty()) {
        (0, true) => over_rationals(&arguments),
        (p, true) => modulo_prime(&arguments, p),
        (0, false) => with_parameters(&arguments),
        (_, false) => Err("no parameters in positive characteristic".into()),
    }
}

/// F4, then a change of order to lex (FGLM).
fn modulo_prime(arguments: &Arguments, p: u64) -> Result<()> {
    let (ring, generators) = read(arguments, Zp::new(p)?)?;
    let found = arguments.measure(|| Ok(basis_modulo_prime(&ring, &generators, &Watch::none())?))?;
    show(arguments, &found);
    Ok(())
}

/// The basis by many primes. The proof has a separate time limit.
fn over_rationals(arguments: &Arguments) -> Result<()> {
    let (ring, generators) = read(arguments, Rationals)?;
    let compute = || Ok(modular::basis(&ring, &generators, &Options::default(), &Watch::none())?);
    let found = arguments.measure(compute)?;
    if let Some(limit) = arguments.proof {
        prove(&found, &ring, &generators, limit)?;
    }
    show(arguments, &found.basis);
    Ok(())
}

fn prove(
    found: &modular::Modular,
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    limit: Duration,
) -> Result<()> {
    let before = program::processor_time()?;
    match modular::prove(found, ring, generators, &Watch::none().with_time(limit)) {
        Ok(_) => program::report("proof", program::seconds(program::processor_time()? - before)),
        Err(error) if error.kind() == ErrorKind::Budget => {
            program::report("proof", format_args!(">{}", limit.as_secs()));
        }
        Err(error) => return Err(error.into()),
    }
    Ok(())
}

/// The method that the engine selects, in the requested order.
fn with_parameters(arguments: &Arguments) -> Result<()> {
    let (ring, generators) = read(arguments, Fractions::new(Rationals, &arguments.input.parameters)?)?;
    let compute = || Ok(parametric::basis(&ring, &generators, &parametric::Options::default(), &Watch::none())?);
    let found = arguments.measure(compute)?;
    show(arguments, &found.basis);
    Ok(())
}

type Ideal<F> = (PolynomialRing<F>, Vec<Polynomial<<F as Ring>::Element>>);

fn read<F: Field>(arguments: &Arguments, field: F) -> Result<Ideal<F>> {
    let order = if arguments.lex { Order::Lex } else { Order::GrevLex };
    let ring = PolynomialRing::new(field, &arguments.input.variables, order)?;
    let read = |text: &String| parse(text).and_then(|tree| tree.evaluate(&ring));
    let generators = arguments.input.polynomials.iter().map(read).collect::<groebot::Result<_>>()?;
    Ok((ring, generators))
}

fn show<F: Field>(arguments: &Arguments, basis: &Basis<F>) {
    arguments.show(|| basis.polynomials.iter().map(|f| basis.ring.format(f, Style::Text)));
}
