//! Known results computed by an independent computer algebra system.

pub mod cover;
pub mod groebner;
pub mod poly;
pub mod systems;

use std::path::Path;

use groebot_algebra::number::{Field, Rationals, Zp};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing, parse};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};

/// A check over any field that a file names.
pub trait Check {
    fn run<F: Field>(&self, field: F);
}

/// Runs `check` over `field`: `Q`, `GF(32003)`, or rational functions of `parameters` over one of these.
pub fn over(field: &str, parameters: &[String], check: &impl Check) {
    let base = field.split_once(")(").map_or(field, |(base, _)| base);
    let prime = base.strip_prefix("GF(").map(|rest| rest.trim_end_matches(')').parse().expect("a modulus"));
    match prime {
        Some(p) => with_parameters(Zp::new(p).expect("a prime"), parameters, check),
        None if base.starts_with('Q') => with_parameters(Rationals, parameters, check),
        None => panic!("field {field}"),
    }
}

fn with_parameters<F: Field>(field: F, parameters: &[String], check: &impl Check) {
    if parameters.is_empty() {
        check.run(field);
    } else {
        check.run(Fractions::new(field, parameters).expect("distinct parameters"));
    }
}

/// Parses the polynomial in `text`.
pub fn read<F: Field>(ring: &PolynomialRing<F>, text: &str) -> Polynomial<F::Element> {
    let value = parse(text).and_then(|expression| expression.evaluate(ring));
    value.unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Parses the polynomials in `texts`.
pub fn read_all<F: Field>(ring: &PolynomialRing<F>, texts: &[String]) -> Vec<Polynomial<F::Element>> {
    texts.iter().map(|text| read(ring, text)).collect()
}

/// Parses the file at `path` of `tests/corpus`.
fn load<T: DeserializeOwned>(path: &str) -> T {
    let full = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/corpus")).join(path);
    let text = std::fs::read_to_string(&full).unwrap_or_else(|error| panic!("{path}: {error}"));
    toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A monomial order by its name.
fn order<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Order, D::Error> {
    match String::deserialize(deserializer)?.as_str() {
        "lex" => Ok(Order::Lex),
        "grevlex" => Ok(Order::GrevLex),
        other => Err(D::Error::custom(format!("order {other}"))),
    }
}
