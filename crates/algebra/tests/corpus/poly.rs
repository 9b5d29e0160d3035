//! The files of `tests/corpus/poly`; its README explains their keys.

use groebot_algebra::Result;
use groebot_robot::document::Table;

use super::{load, text, texts};

/// Two polynomials and their greatest common divisor.
#[derive(Debug)]
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
#[derive(Debug)]
pub struct Factored {
    pub name: String,
    pub field: String,
    pub variables: Vec<String>,
    pub polynomial: String,
    pub unit: String,
    pub factors: Vec<(String, usize)>,
}

/// All pairs of `gcd.toml`.
pub fn pairs() -> Vec<Pair> {
    load("poly/gcd.toml", |root| root.required("case")?.tables()?.into_iter().map(pair_of).collect())
}

fn pair_of(table: Table<'_>) -> Result<Pair> {
    Ok(Pair {
        name: text(table, "name")?,
        field: text(table, "field")?,
        variables: texts(table, "variables")?,
        parameters: texts(table, "parameters")?,
        f: text(table, "f")?,
        g: text(table, "g")?,
        gcd: text(table, "gcd")?,
    })
}

/// All factorisations of `factor.toml`.
pub fn factorisations() -> Vec<Factored> {
    load("poly/factor.toml", |root| root.required("case")?.tables()?.into_iter().map(factored_of).collect())
}

fn factored_of(table: Table<'_>) -> Result<Factored> {
    let factor = |table: Table<'_>| Ok((text(table, "polynomial")?, table.required("multiplicity")?.count()?));
    let factors = table.required("factors")?.tables()?;
    Ok(Factored {
        name: text(table, "name")?,
        field: text(table, "field")?,
        variables: texts(table, "variables")?,
        polynomial: text(table, "polynomial")?,
        unit: text(table, "unit")?,
        factors: factors.into_iter().map(factor).collect::<Result<_>>()?,
    })
}
