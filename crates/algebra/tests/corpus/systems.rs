//! The files of `tests/corpus/groebner/systems`: equations, and facts of their reduced bases with a hash instead of the text.

use std::path::Path;

use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Zp};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};
use num_integer::Integer;
use num_traits::{One, Signed};
use serde::{Deserialize, Deserializer};

use super::{load, read_all};

/// One system of equations with the known properties of its reduced bases.
#[derive(Debug, Deserialize)]
pub struct System {
    pub name: String,
    pub variables: Vec<String>,
    pub generators: Vec<String>,
    #[serde(default, rename = "answer")]
    pub answers: Vec<Answer>,
}

/// The known properties of one reduced basis.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Answer {
    /// `Q` or `GF(p)`.
    pub field: String,
    #[serde(deserialize_with = "super::order")]
    pub order: Order,
    #[serde(flatten)]
    pub facts: Facts,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Facts {
    /// -1 for the unit ideal.
    pub dimension: i64,
    /// The degree of the projective closure: the number of solutions with multiplicity when there are finitely many.
    pub degree: usize,
    pub size: usize,
    /// [`basis_hash`].
    #[serde(deserialize_with = "hexadecimal")]
    pub hash: u64,
}

/// The system with this name, such as `katsura_8`.
pub fn system(name: &str) -> System {
    load(&format!("groebner/systems/{name}.toml"))
}

fn hexadecimal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
    u64::from_str_radix(&String::deserialize(deserializer)?, 16).map_err(serde::de::Error::custom)
}

/// All systems, sorted by name.
pub fn all() -> Vec<System> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("tests/corpus/groebner/systems");
    let entries = std::fs::read_dir(folder).expect("the corpus is there");
    let names = entries.map(|entry| entry.expect("a readable folder").file_name().into_string().expect("plain names"));
    let mut names: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    assert!(names.len() >= 60, "the corpus has shrunk to {} systems", names.len());
    names.iter().map(|name| system(name)).collect()
}

impl System {
    /// The ring of this system.
    pub fn ring<F: Field>(&self, field: F, order: &Order) -> PolynomialRing<F> {
        PolynomialRing::new(field, &self.variables, order.clone()).expect("distinct variables")
    }

    /// The generators in `ring`.
    pub fn generators<F: Field>(&self, ring: &PolynomialRing<F>) -> Vec<Polynomial<F::Element>> {
        read_all(ring, &self.generators)
    }

    /// The answer over `field` in `order`, if Singular found it.
    pub fn answer(&self, field: &str, order: &Order) -> Option<&Answer> {
        self.answers.iter().find(|answer| answer.field == field && answer.order == *order)
    }
}

/// A field whose elements have a canonical text, as `polynomials.py` defines it.
pub trait Canonical: Field {
    /// The coefficients of a polynomial of a reduced basis, greatest term first, scaled and in decimal.
    fn decimals(&self, coefficients: &[&Self::Element]) -> Vec<String>;
}

impl Canonical for Zp {
    fn decimals(&self, coefficients: &[&u64]) -> Vec<String> {
        assert_eq!(*coefficients[0], 1, "a reduced basis is monic");
        coefficients.iter().map(|c| c.to_string()).collect()
    }
}

impl Canonical for Rationals {
    fn decimals(&self, coefficients: &[&BigRational]) -> Vec<String> {
        assert!(coefficients[0].is_one(), "a reduced basis is monic");
        let denominator = coefficients.iter().fold(BigInt::one(), |found, c| found.lcm(c.denom()));
        let whole: Vec<BigInt> = coefficients.iter().map(|c| c.numer() * (&denominator / c.denom())).collect();
        assert!(whole[0].is_positive());
        whole.iter().map(BigInt::to_string).collect()
    }
}

/// FNV-1a (64 bits) of the canonical text of a reduced basis, sorted by leading monomial from the smallest.
pub fn basis_hash<F: Canonical>(ring: &PolynomialRing<F>, basis: &[Polynomial<F::Element>]) -> u64 {
    basis.iter().fold(0xcbf2_9ce4_8422_2325, |hash, f| fnv(hash, canonical_line(ring, f).as_bytes()))
}

fn fnv(start: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(start, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

/// `c:e1,e2,...,en` for each term.
fn canonical_line<F: Canonical>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> String {
    let coefficients: Vec<_> = f.terms().iter().map(|term| &term.coefficient).collect();
    let exponents = f.terms().iter().map(|term| ring.layout().exponents(&term.monomial));
    let exponents = exponents.map(|powers| powers.iter().map(u32::to_string).collect::<Vec<_>>().join(","));
    let terms = ring.field().decimals(&coefficients).into_iter().zip(exponents);
    terms.map(|(c, powers)| format!("{c}:{powers}")).collect::<Vec<_>>().join(" ") + "\n"
}
