//! Real points of a stratum: a proof that there are some, a proof that there are none, or no result.

use super::ideals::{Ideal, Ideals};
use super::region::Region;
use super::sample::sample;
use super::signs::{changes_sign, forced_zeros};
use super::{Cover, RealPoints, Stratum};
use crate::number::{BigInt, BigRational, Rationals, Ring, Style};
use crate::poly::univariate::Univariate;
use crate::poly::{Polynomial, PolynomialRing, rational_root};
use crate::{Result, Watch};

type Poly = Polynomial<BigRational>;

impl Cover<Rationals> {
    /// Adds to the cover what is known about the real points of each stratum.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Overflow`]; the error with which `watch` stops the work.
    pub fn with_real_points(mut self, watch: &Watch) -> Result<Self> {
        let ideals = Ideals::new(self.ring.field().ring(), watch)?;
        for stratum in &mut self.strata {
            stratum.real = real_points(&ideals, stratum)?;
        }
        Ok(self)
    }
}

fn real_points(ideals: &Ideals<'_, Rationals>, stratum: &Stratum<Rationals>) -> Result<RealPoints> {
    let region = &stratum.region;
    if let Some(reason) = no_real_point(ideals, region)? {
        return Ok(RealPoints::None(reason));
    }
    if let Some(point) = sample(&ideals.ring, region, &mut rational_candidates, ideals.watch)? {
        return Ok(RealPoints::At(point));
    }
    let Some(f) = hypersurface(&ideals.ring, &region.equations) else { return Ok(RealPoints::Unknown) };
    let square_free = ideals.product(&ideals.factors(&f)?);
    let proved = ideals.ring.degree(&square_free) == ideals.ring.degree(&f) && changes_sign(&ideals.ring, &f);
    let reason = format!("{} changes its sign", ideals.ring.format(&f, Style::Decimal));
    Ok(if proved { RealPoints::Some(reason) } else { RealPoints::Unknown })
}

/// A reason why `region` has no real point, if one is found. On each of its parts, some equation is a sum of squares
/// that cannot vanish, or that vanishes on an exclusion only.
fn no_real_point(ideals: &Ideals<'_, Rationals>, region: &Region<BigRational>) -> Result<Option<String>> {
    let mut open = vec![region.equations.clone()];
    let mut reasons: Vec<String> = Vec::new();
    while let Some(equations) = open.pop() {
        ideals.watch.check()?;
        if let Some((f, zeros)) = consequence(ideals, &equations)? {
            let reason = ideals.ring.format(&f, Style::Decimal);
            if !reasons.contains(&reason) {
                reasons.push(reason);
            }
            open.extend(narrowed(ideals, region, &equations, &zeros)?);
            continue;
        }
        let Some(parts) = ideals.reducible(&equations)? else { return Ok(None) };
        for part in parts {
            open.extend(narrowed(ideals, region, &equations, &[part])?);
        }
    }
    Ok(Some(format!("{} is zero at no real point here", reasons.join(" or "))))
}

/// An equation whose real zeros are zeros of further polynomials, which the equations do not yet imply, and these
/// polynomials.
fn consequence(ideals: &Ideals<'_, Rationals>, equations: &Ideal<BigRational>) -> Result<Option<(Poly, Vec<Poly>)>> {
    let none_positive = vec![false; ideals.ring.variables().len()];
    for f in equations {
        if let Some(zeros) = forced_zeros(&ideals.ring, f, &none_positive)
            && !ideals.contains_all(equations, &zeros)?
        {
            return Ok(Some((f.clone(), zeros)));
        }
    }
    Ok(None)
}

/// The closure of the part of `region` where `equations` and `more` hold.
fn narrowed(
    ideals: &Ideals<'_, Rationals>,
    region: &Region<BigRational>,
    equations: &[Poly],
    more: &[Poly],
) -> Result<Option<Ideal<BigRational>>> {
    let part = Region { equations: equations.to_vec(), exclusions: region.exclusions.clone() };
    ideals.closure_of(&part, more)
}

/// Candidate values: small numbers for a free parameter, rational roots of low degree for one with a condition.
fn rational_candidates(condition: Option<&Univariate<BigRational>>) -> Vec<BigRational> {
    match condition {
        None => [1, 2, 3, 0, -1, 4, 5, 100].iter().map(|&n| BigRational::from_integer(BigInt::from(n))).collect(),
        Some(f) => rational_roots(f),
    }
}

/// The rational roots of a polynomial of degree one or two. For other degrees only the root zero is found.
pub fn rational_roots(f: &Univariate<BigRational>) -> Vec<BigRational> {
    let zero = Rationals.zero();
    match f.coefficients.as_slice() {
        [b, a] => vec![-b / a],
        [c, b, a] => {
            let four = BigRational::from_integer(BigInt::from(4));
            let root = rational_root(&(b * b - &four * a * c));
            root.map_or_else(Vec::new, |root| vec![(-b + &root) / (a + a), (-b - &root) / (a + a)])
        }
        [c, ..] if *c == zero => vec![zero],
        _ => Vec::new(),
    }
}

/// The only equation that remains after solving for parameters that occur linearly.
///
/// Where it has no repeated factors and changes its sign, real points are dense in the zeros of one of its factors
/// (Bochnak, Coste and Roy, Real Algebraic Geometry, 4.5.1). No component of a stratum's closure is contained in an
/// exclusion, so some real points are on the stratum.
fn hypersurface(ring: &PolynomialRing<Rationals>, equations: &[Poly]) -> Option<Poly> {
    let count = ring.variables().len();
    let mut rest: Vec<Poly> = equations.to_vec();
    while rest.len() > 1 {
        let linear = |f: &Poly, v: usize| {
            ring.degree_in(f, v) == 1 && ring.as_constant(&ring.coefficients_in(f, v)[1]).is_some()
        };
        let mut places = (0..rest.len()).flat_map(|i| (0..count).map(move |v| (i, v)));
        let (index, v) = places.find(|&(i, v)| linear(&rest[i], v))?;
        let solved = rest.swap_remove(index);
        let parts = ring.coefficients_in(&solved, v);
        let mut values: Vec<Poly> = (0..count).map(|w| ring.variable(w)).collect();
        values[v] = ring.exact_div(&ring.neg(&parts[0]), &parts[1])?;
        rest = rest.iter().map(|f| ring.substitute(f, ring, &values, |c| ring.constant(c.clone()))).collect();
        rest.retain(|f| !f.is_zero());
    }
    rest.pop()
}
