//! A Groebner basis of three quadrics, and their real points of intersection.
//!
//!     cargo run --release -p groebot-algebra --example groebner_basis

use groebot_algebra::groebner::{Options, basis};
use groebot_algebra::number::{Rationals, Ring, Style};
use groebot_algebra::poly::{Order, PolynomialRing, parse};
use groebot_algebra::{Result, Watch, real};

fn main() -> Result<()> {
    let ring = PolynomialRing::new(Rationals, &["x", "y", "z"], Order::Lex)?;
    let equations = ["x^2 + y^2 + z^2 - 4", "x^2 + 2*y^2 - 5", "x*z - 1"];
    let generators = equations.iter().map(|text| parse(text)?.evaluate(&ring)).collect::<Result<Vec<_>>>()?;

    let found = basis(&ring, &generators, &Options::default(), &Watch::none())?;
    for polynomial in &found.polynomials {
        println!("{}", ring.format(polynomial, Style::Text));
    }
    println!("complex solutions, with multiplicity: {:?}", found.quotient_dimension());
    for solution in real::solve(&ring, &generators, &real::Options::default(), &Watch::none())? {
        println!("[x, y, z] = {:?}", solution.approximate());
    }
    Ok(())
}
