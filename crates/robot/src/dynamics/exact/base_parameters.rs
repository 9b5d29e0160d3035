//! Base parameters: the combinations of inertial parameters on which the motion depends. Main type: [`BaseParameters`].
//!
//! M. Gautier and W. Khalil, Direct Calculation of Minimum Set of Inertial Parameters of Serial Robots, IEEE Trans.
//! Robotics and Automation 6 (1990), here by linear algebra over the rational numbers: every coefficient of M and N is
//! a linear form in the inertial parameters.

use std::collections::HashMap;

use num_traits::{One, Zero};

use super::model::{ExactModel, NUMBERS};
use super::number::Exact;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Field, Ring, Zp};

/// A prime below 2^31. Forms that are independent modulo it are independent.
const PRIME: u64 = 2_147_483_647;

/// The minimal set of parameters on which M, C and N depend: linear forms in the inertial parameters. Each has a pivot,
/// a parameter with factor one that no other form contains. Where there is a choice, the parameters of links near the
/// base are pivots.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameters {
    /// For each base parameter the index of its pivot among the ten parameters of each body.
    pub pivots: Vec<usize>,
    /// For each base parameter its coefficients.
    pub forms: Vec<Vec<BigRational>>,
}

impl BaseParameters {
    /// Computes the base parameters of entries of M and N with symbolic masses.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] where the directions of axes contain square roots.
    pub(super) fn of<'a>(model: &ExactModel, entries: impl IntoIterator<Item = &'a Exact>) -> Result<Self> {
        let count = NUMBERS.len() * model.joints.len();
        let forms = linear_forms(model, count, entries)?;
        let rows = independent(&forms, count)?;
        let (pivots, rows) = reduced(rows, count);
        let base = BaseParameters { pivots, forms: rows };
        base.covers(&forms)?;
        Ok(base)
    }

    /// Proves that the entries depend on exactly these base parameters and that the set is minimal.
    pub(super) fn prove<'a>(&self, model: &ExactModel, entries: impl IntoIterator<Item = &'a Exact>) -> Result<()> {
        let count = NUMBERS.len() * model.joints.len();
        let forms = linear_forms(model, count, entries)?;
        self.covers(&forms)?;
        let rank = independent(&forms, count)?.len();
        let text = || format!("{} base parameters are given; there are {rank}", self.forms.len());
        if rank == self.forms.len() { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }

    /// Checks that each form is the sum of these forms, each times the coefficient at its pivot.
    fn covers(&self, forms: &[Form]) -> Result<()> {
        for form in forms {
            let mut left: HashMap<usize, BigRational> = form.iter().cloned().collect();
            for (pivot, own) in self.pivots.iter().zip(&self.forms) {
                let Some(factor) = left.get(pivot).cloned() else { continue };
                for (at, coefficient) in own.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
                    *left.entry(at).or_default() -= &factor * coefficient;
                }
            }
            if left.values().any(|x| !x.is_zero()) {
                let text = "M and N depend on more than the given base parameters";
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }
}

/// A linear form: indices and coefficients.
type Form = Vec<(usize, BigRational)>;

/// The coefficients of entries with respect to the inertial parameters, in which they are linear: one form for each
/// entry and cofactor monomial.
fn linear_forms<'a>(
    model: &ExactModel,
    count: usize,
    entries: impl IntoIterator<Item = &'a Exact>,
) -> Result<Vec<Form>> {
    if model.setting.has_roots() {
        let text = "base parameters exist for chains whose axes have rational directions";
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let layout = model.setting.ring().layout();
    let mut forms = Vec::new();
    for entry in entries {
        let mut by_rest: HashMap<Vec<u32>, Form> = HashMap::new();
        for term in model.setting.polynomial(entry).terms() {
            let exponents = layout.exponents(&term.monomial);
            // The symbols are the first variables.
            let Some(place) = exponents[..count].iter().position(|exponent| *exponent > 0) else { continue };
            by_rest.entry(exponents[count..].to_vec()).or_default().push((place, term.coefficient.clone()));
        }
        let mut sorted: Vec<_> = by_rest.into_iter().collect();
        sorted.sort_by(|a, b| a.0.cmp(&b.0));
        forms.extend(sorted.into_iter().map(|(_, form)| form));
    }
    Ok(forms)
}

/// A maximal set of forms that are independent modulo a prime, and therefore over the rational numbers.
fn independent(forms: &[Form], count: usize) -> Result<Vec<Vec<BigRational>>> {
    let field = Zp::new(PRIME)?;
    let beyond = || Error::new(ErrorKind::Overflow, format!("a coefficient has a denominator that {PRIME} divides"));
    let mut chosen: Vec<Vec<BigRational>> = Vec::new();
    // Echelon rows with their pivots, which are one.
    let mut echelon: Vec<(usize, Vec<_>)> = Vec::new();
    for form in forms {
        let mut row = vec![field.zero(); count];
        for (place, coefficient) in form {
            row[*place] = field.from_rational(coefficient).ok_or_else(beyond)?;
        }
        for (pivot, other) in &echelon {
            let factor = row[*pivot];
            if !field.is_zero(&factor) {
                row.iter_mut().zip(other).for_each(|(x, y)| *x = field.sub(x, &field.mul(&factor, y)));
            }
        }
        let Some(pivot) = row.iter().position(|x| !field.is_zero(x)) else { continue };
        let inverse = field.inverse(&row[pivot]).ok_or_else(beyond)?;
        row.iter_mut().for_each(|x| *x = field.mul(x, &inverse));
        echelon.push((pivot, row));
        let mut exact = vec![BigRational::zero(); count];
        form.iter().for_each(|(place, coefficient)| exact[*place] = coefficient.clone());
        chosen.push(exact);
    }
    Ok(chosen)
}

/// The reduced echelon form of independent rows, and its pivots.
fn reduced(mut rows: Vec<Vec<BigRational>>, count: usize) -> (Vec<usize>, Vec<Vec<BigRational>>) {
    let (mut pivots, mut done) = (Vec::new(), 0);
    for column in 0..count {
        let Some(found) = (done..rows.len()).find(|row| !rows[*row][column].is_zero()) else { continue };
        rows.swap(done, found);
        let inverse = BigRational::one() / &rows[done][column];
        rows[done].iter_mut().for_each(|x| *x *= &inverse);
        let pivot = rows[done].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(at, _)| *at != done) {
            let factor = row[column].clone();
            if !factor.is_zero() {
                row.iter_mut().zip(&pivot).filter(|(_, y)| !y.is_zero()).for_each(|(x, y)| *x -= &factor * y);
            }
        }
        pivots.push(column);
        done += 1;
    }
    (pivots, rows)
}
