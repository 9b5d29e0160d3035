//! Reader of the files in `tests/corpus/poly`. The README there explains their keys.

use serde::Deserialize;

use super::load;

/// A file of cases.
#[derive(Deserialize)]
struct File<T> {
    case: Vec<T>,
}

/// Two polynomials and their greatest common divisor.
#[derive(Debug, Deserialize)]
pub struct Pair {
    pub name: String,
    pub field: String,
    pub variables: Vec<String>,
    pub parameters: Vec<String>,
    pub f: String,
    pub g: String,
    pub gcd: String,
}

/// A polynomial over Q or GF(p) and its irreducible factors, with their multiplicities.
#[derive(Debug, Deserialize)]
pub struct Factored {
    pub name: String,
    pub field: String,
    pub variables: Vec<String>,
    pub polynomial: String,
    pub unit: String,
    pub factors: Vec<Factor>,
}

/// A factor with its multiplicity.
#[derive(Debug, Deserialize)]
pub struct Factor {
    pub polynomial: String,
    pub multiplicity: usize,
}

/// All pairs of `gcd.toml`.
pub fn pairs() -> Vec<Pair> {
    load::<File<Pair>>("poly/gcd.toml").case
}

/// All factorisations of `factor.toml`.
pub fn factorisations() -> Vec<Factored> {
    load::<File<Factored>>("poly/factor.toml").case
}
