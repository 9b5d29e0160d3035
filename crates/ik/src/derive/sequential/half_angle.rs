//! An angle from an equation of degree two in its cosine and sine, by the tangent of half the angle ([`HalfAngles`]).
//!
//! With `t = tan((q - f)/2)`, the rotated cosine and sine `c', s'` fulfil `t (1 + c') = s'` and `1 - c' = t s'`, unless `q` is opposite to `f`. A Groebner
//! basis that eliminates c and s gives a quartic in t.
//!
//! A polynomial of degree two has at most four zeros on the circle. So of five directions `f`, at least one is opposite to no solution. The quartic's leading
//! coefficient is the polynomial's value opposite to `f`. The direction with the greatest such value is used.

use serde::{Deserialize, Serialize};

use super::form_basis::{QUARTIC, QUARTIC_SYMBOLS};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::verify::{Claim, verify};
use groebot_algebra::groebner::{Options, Strategy, basis};
use groebot_algebra::number::{BigRational, Rationals, Ring, Style};
use groebot_algebra::poly::{Block, Order, Polynomial, PolynomialRing, parse};

/// The cosine and sine of each direction f, as numerators over a common denominator.
const DIRECTIONS: [(i32, i32, i32); 5] = [(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1), (3, 4, 5)];

type Poly = Polynomial<BigRational>;

/// One direction, with the basis that eliminates the angle's cosine and sine.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HalfAngle {
    /// Q[c, s, t, A, B, C, D, E].
    pub ring: PolynomialRing<Rationals>,
    /// The equation, the two relations of t, and the circle.
    pub generators: Vec<Poly>,
    /// The reduced Groebner basis.
    pub basis: Vec<Poly>,
    /// `basis[i] = sum over j of cofactors[i][j] * generators[j]`.
    pub cofactors: Vec<Vec<Poly>>,
}

/// All directions.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfAngles(pub Vec<HalfAngle>);

/// The stored proof of one direction.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stored {
    basis: Vec<String>,
    cofactors: Vec<Vec<String>>,
}

impl HalfAngles {
    /// Computes and proves the bases.
    ///
    /// # Errors
    /// The error of `watch` if it stops the computation.
    pub fn derive<'w>(watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let derive = |direction| {
            let (ring, generators) = setting(direction)?;
            let options = Options { strategy: Strategy::Sugar, cofactors: true };
            let found = basis(&ring, &generators, &options, watch)?;
            HalfAngle { ring, generators, basis: found.polynomials, cofactors: found.cofactors }.proved()
        };
        DIRECTIONS.into_iter().map(derive).collect::<Result<_>>().map(HalfAngles)
    }

    /// The stored form of the proofs.
    pub(super) fn stored(&self) -> Vec<Stored> {
        let text = |half: &HalfAngle, list: &[Poly]| -> Vec<String> {
            list.iter().map(|f| half.ring.format(f, Style::Text)).collect()
        };
        let stored = |half: &HalfAngle| Stored {
            basis: text(half, &half.basis),
            cofactors: half.cofactors.iter().map(|row| text(half, row)).collect(),
        };
        self.0.iter().map(stored).collect()
    }

    /// Proves stored bases again.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a false claim.
    pub(super) fn reprove(stored: &[Stored]) -> Result<Self> {
        if stored.len() != DIRECTIONS.len() {
            return Err(Error::new(ErrorKind::Certificate, "half angles: five directions are needed"));
        }
        let prove = |(direction, stored): (&(i32, i32, i32), &Stored)| {
            let (ring, generators) = setting(*direction)?;
            let read = |list: &[String]| -> Result<Vec<Poly>> {
                list.iter().map(|text| parse(text)?.evaluate(&ring)).collect()
            };
            let basis = read(&stored.basis)?;
            let cofactors = stored.cofactors.iter().map(|row| read(row)).collect::<Result<_>>()?;
            HalfAngle { ring: ring.clone(), generators, basis, cofactors }.proved()
        };
        DIRECTIONS.iter().zip(stored).map(prove).collect::<Result<_>>().map(HalfAngles)
    }
}

impl HalfAngle {
    fn proved(self) -> Result<Self> {
        let claim = Claim { generators: &self.generators, basis: &self.basis, cofactors: &self.cofactors };
        verify(&self.ring, &claim, &Watch::none())?;
        let degrees = [self.stair(2)?, self.stair(1)?, self.stair(0)?];
        let good = [4, 1, 1]
            .iter()
            .zip(degrees)
            .enumerate()
            .all(|(at, (degree, f))| self.ring.degree_in(f, 2 - at) == *degree);
        if good { Ok(self) } else { Err(Error::new(ErrorKind::Certificate, "a half angle's basis has no quartic")) }
    }

    /// The smallest polynomial of the basis whose greatest unknown is this one: 0, 1, 2 for c, s, t.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if there is none.
    pub(crate) fn stair(&self, unknown: usize) -> Result<&Poly> {
        let greatest = |f: &Poly| (0..3).find(|&v| self.ring.degree_in(f, v) > 0);
        let missing = || Error::new(ErrorKind::Certificate, "a half angle's basis does not determine every unknown");
        self.basis.iter().find(|f| greatest(f) == Some(unknown)).ok_or_else(missing)
    }
}

/// The ring and the equations of a direction.
fn setting((x, y, r): (i32, i32, i32)) -> Result<(PolynomialRing<Rationals>, Vec<Poly>)> {
    let names: Vec<&str> = ["c", "s", "t"].into_iter().chain(QUARTIC_SYMBOLS).collect();
    let blocks = [2, 1, QUARTIC_SYMBOLS.len()].map(|size| Block { size, graded: true });
    let ring = PolynomialRing::new(Rationals, &names, Order::Block(blocks.to_vec()))?;
    let (cosine, sine) = (format!("(({x})*c + ({y})*s)/{r}"), format!("(({x})*s - ({y})*c)/{r}"));
    let texts = [
        QUARTIC.to_owned(),
        format!("t*(1 + {cosine}) - {sine}"),
        format!("1 - {cosine} - t*{sine}"),
        "c^2 + s^2 - 1".to_owned(),
    ];
    let generators = texts.iter().map(|text| parse(text)?.evaluate(&ring)).collect::<Result<_>>()?;
    Ok((ring, generators))
}
