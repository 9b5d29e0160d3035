//! Reader of the files in `tests/corpus/groebner`. The README there explains their keys.

use std::path::Path;

use groebot_algebra::number::{Field, Ring};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};
use serde::Deserialize;

use super::{load, read_all};

/// One system in one field and order, with its reduced basis.
#[derive(Debug, Deserialize)]
pub struct Case {
    /// The file's name without `.toml`.
    #[serde(skip)]
    pub file: String,
    pub field: String,
    #[serde(deserialize_with = "super::order")]
    pub order: Order,
    pub variables: Vec<String>,
    pub parameters: Vec<String>,
    pub generators: Vec<String>,
    pub basis: Vec<String>,
    pub facts: Facts,
    #[serde(default, rename = "elimination")]
    pub eliminations: Vec<Elimination>,
    #[serde(default, rename = "membership")]
    pub memberships: Vec<Membership>,
}

#[derive(Debug, Deserialize)]
pub struct Facts {
    /// -1 for the unit ideal.
    pub dimension: i64,
    pub quotient_dimension: Option<usize>,
    pub standard_monomials: Option<Vec<String>>,
}

#[derive(Debug, Deserialize)]
pub struct Elimination {
    pub eliminate: Vec<String>,
    pub basis: Vec<String>,
}

#[derive(Debug, Deserialize)]
pub struct Membership {
    pub polynomial: String,
    pub member: bool,
    pub normal_form: String,
}

/// Reads the case of this file, named without `.toml`.
pub fn case(file: &str) -> Case {
    Case { file: file.to_owned(), ..load(&format!("groebner/{file}.toml")) }
}

/// Reads all cases, sorted by file name.
pub fn all() -> Vec<Case> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("tests/corpus/groebner");
    let entries = std::fs::read_dir(folder).expect("the corpus is there");
    let names = entries.map(|entry| entry.expect("a readable folder").file_name().into_string().expect("plain names"));
    let mut names: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    assert!(names.len() >= 80, "the corpus has shrunk to {} files", names.len());
    names.iter().map(|name| case(name)).collect()
}

impl Case {
    /// The ring of the file over `field`, which is the field that the file names.
    pub fn ring<F: Field>(&self, field: &F) -> PolynomialRing<F> {
        self.ring_in(field, self.order.clone())
    }

    /// Same as [`Case::ring`], but in another order.
    pub fn ring_in<F: Field>(&self, field: &F, order: Order) -> PolynomialRing<F> {
        PolynomialRing::new(field.clone(), &self.variables, order).expect("distinct variables")
    }

    /// The generators in `ring`.
    pub fn generators<F: Field>(&self, ring: &PolynomialRing<F>) -> Vec<Polynomial<F::Element>> {
        read_all(ring, &self.generators)
    }
}

/// A known basis in the form of the engine: monic, smallest leading monomial first.
pub fn read_basis<F: Field>(ring: &PolynomialRing<F>, texts: &[String]) -> Vec<Polynomial<F::Element>> {
    let basis: Vec<_> = read_all(ring, texts).iter().map(|f| ring.monic(f)).collect();
    assert!(basis.iter().all(|f| !ring.is_zero(f)), "a known basis has no zero");
    basis
}
