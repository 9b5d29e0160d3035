//! Reader of `tests/corpus/cover/systems.toml`. The README there explains the keys.

use groebot_algebra::number::Field;
use groebot_algebra::poly::{Fraction, Fractions, Order, Polynomial, PolynomialRing, parse};
use serde::Deserialize;

use super::{load, read_all};

#[derive(Deserialize)]
struct File {
    system: Vec<System>,
}

/// A parametric system with the number of segments that Singular's cover has.
#[derive(Clone, Debug, Deserialize)]
pub struct System {
    pub name: String,
    pub variables: Vec<String>,
    pub parameters: Vec<String>,
    pub segments: usize,
    #[serde(deserialize_with = "super::order")]
    pub order: Order,
    pub generators: Vec<String>,
}

type Unknowns<F> = PolynomialRing<Fractions<F>>;

/// Reads all systems.
pub fn all() -> Vec<System> {
    load::<File>("cover/systems.toml").system
}

/// The system with this name.
pub fn system(name: &str) -> System {
    all().into_iter().find(|system| system.name == name).unwrap_or_else(|| panic!("no system {name}"))
}

impl System {
    /// The unknowns over the rational functions of the parameters over `field`.
    pub fn ring<F: Field>(&self, field: F) -> Unknowns<F> {
        let fractions = Fractions::new(field, &self.parameters).expect("distinct parameters");
        PolynomialRing::new(fractions, &self.variables, self.order.clone()).expect("distinct unknowns")
    }

    /// The generators in `ring`.
    pub fn generators<F: Field>(&self, ring: &Unknowns<F>) -> Vec<Polynomial<Fraction<F::Element>>> {
        read_all(ring, &self.generators)
    }

    /// Whether the coefficients have images in `field`: no denominator vanishes there.
    pub fn exists_over<F: Field>(&self, field: &F) -> bool {
        let ring = self.ring(field.clone());
        self.generators.iter().all(|text| parse(text).expect("a polynomial").evaluate(&ring).is_ok())
    }
}
