//! The quotient ring modulo a prime below 2^31, on machine words.
//!
//! J.-C. Faugere, C. Mou, "Sparse FGLM algorithms", J. Symbolic Computation 80 (2017): if the smallest variable
//! generates the quotient ring, its powers under a random functional give its minimal polynomial (Wiedemann 1986). One
//! Hankel system for each other variable gives the other polynomials. A. Bostan, B. Salvy, E. Schost, "Fast algorithms
//! for zero-dimensional polynomial systems using duality", AAECC 14 (2003), solve these systems by a product of series.

mod elimination;
mod kernel;
mod recurrence;
mod table;

use self::elimination::Elimination;
use self::kernel::Modulus;
use self::recurrence::Recurrence;
use self::table::{Matrix, Table};
use super::staircase::{Walk, variables};
use super::{Quotient, relation, require_member, sources};
use crate::groebner::Basis;
use crate::number::{Ring, Zp};
use crate::poly::univariate::Univariate;
use crate::poly::{Monomial, Polynomial, PolynomialRing};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result, Watch};

/// Number of terms that must agree with a recurrence before it is accepted. A wrong one passes with a probability of
/// about `p^-AGREED`.
const AGREED: usize = 12;

/// Computes the reduced basis of a zero-dimensional ideal in the order of `target`, a ring over the same field in the
/// same variables. If `target` has fewer variables, it is the basis of the elimination ideal. The result is exact.
/// Random choices affect the running time only.
///
/// # Errors
/// Those of [`Quotient::new`] and [`Quotient::basis_in`].
pub fn change_order<'w>(
    basis: &Basis<Zp>,
    target: &PolynomialRing<Zp>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<Zp>> {
    let watch = Watch::or_none(watch);
    match Modulus::new(basis.ring.field().modulus()) {
        None => Quotient::new(basis)?.basis_in(target, watch),
        Some(modulus) => Table::new(basis, modulus)?.basis_in(target, watch),
    }
}

/// The quotient ring of a zero-dimensional ideal modulo a prime below 2^31: [`Quotient`] on machine words.
#[derive(Clone, Debug)]
pub struct WordQuotient {
    table: Table,
}

impl WordQuotient {
    /// Computes the multiplication matrices of the quotient ring by `basis`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the prime is not below 2^31; those of [`Quotient::new`]; the error with which
    /// `watch` stops the work.
    pub fn new<'w>(basis: &Basis<Zp>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let p = basis.ring.field().modulus();
        let modulus = Modulus::new(p).ok_or_else(|| {
            Error::new(ErrorKind::BadValue, format!("the prime {p} is not below 2^31; use `Quotient` for larger ones"))
        })?;
        let mut table = Table::new(basis, modulus)?;
        (0..basis.ring.variables().len()).try_for_each(|variable| table.learn(variable, watch))?;
        Ok(WordQuotient { table })
    }

    /// The dimension of the quotient ring.
    pub fn dimension(&self) -> usize {
        self.table.dimension()
    }

    /// Same as [`Quotient::basis_in`], but on machine words.
    ///
    /// # Errors
    /// Those of [`Quotient::basis_in`].
    pub fn basis_in<'w>(&self, target: &PolynomialRing<Zp>, watch: impl Into<Option<&'w Watch>>) -> Result<Basis<Zp>> {
        let watch = Watch::or_none(watch);
        self.table.clone().basis_in(target, watch)
    }

    /// Same as [`Quotient::minimal_polynomial`], but on machine words. It is computed from a random projection of the
    /// powers and checked. If the check fails, it is computed by elimination.
    ///
    /// # Errors
    /// Those of [`Quotient::minimal_polynomial`].
    pub fn minimal_polynomial<'w>(
        &self,
        f: &Polynomial<u64>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Univariate<u64>> {
        let watch = Watch::or_none(watch);
        require_member(&self.table.ring, f)?;
        let matrix = self.table.multiplication(f, watch)?;
        let projected = project(&matrix, self.table.modulus, watch, |_, _| ())?;
        let polynomial = projected.polynomial();
        let found =
            projected.length() == self.dimension() || vanishes(&matrix, &polynomial, self.table.modulus, watch)?;
        let polynomial = if found { polynomial } else { eliminate_powers(&self.table, &matrix, watch)? };
        Ok(Univariate { coefficients: polynomial.into_iter().map(u64::from).collect() })
    }
}

impl Table {
    fn basis_in(mut self, target: &PolynomialRing<Zp>, watch: &Watch) -> Result<Basis<Zp>> {
        let sources = sources(&self.ring, target)?;
        let polynomials = match shape_basis(&mut self, target, &sources, watch)? {
            Some(polynomials) => polynomials,
            None => walk_basis(&mut self, target, &sources, watch)?,
        };
        Ok(Basis { ring: target.clone(), polynomials, cofactors: Vec::new() })
    }
}

/// The basis `x1 - g1(xn), x2 - g2(xn), ..., P(xn)` with P of full degree, if the ideal is in shape position; `None`
/// otherwise.
///
/// This is the case exactly when the minimal polynomial of xn has full degree. The projected sequence then has a
/// nonsingular Hankel matrix, or another projection is needed. So the result is exact.
fn shape_basis(
    table: &mut Table,
    target: &PolynomialRing<Zp>,
    sources: &[usize],
    watch: &Watch,
) -> Result<Option<Vec<Polynomial<u64>>>> {
    let dimension = table.dimension();
    let Some((&last, others)) = sources.split_last() else { return Ok(None) };
    let Some(powers) = powers_below_variables(target, dimension) else { return Ok(None) };
    table.learn(last, watch)?;
    for &variable in others {
        table.learn_product(variable, 0, watch)?;
    }
    let matrices: Vec<Matrix<'_>> = others.iter().map(|&variable| table.matrix(variable)).collect();
    let mut values = vec![Vec::with_capacity(dimension); others.len()];
    let sequence = project(&table.matrix(last), table.modulus, watch, |step, functional| {
        if step < dimension {
            values.iter_mut().zip(&matrices).for_each(|(list, matrix)| list.push(matrix.value_at_one(functional)));
        }
    })?;
    if sequence.length() < dimension {
        return Ok(None);
    }
    read_shape(target, &powers, &sequence, &values, watch).map(Some)
}

/// The basis in shape position from the projected powers of the last variable and from the projected multiples of the others.
fn read_shape(
    target: &PolynomialRing<Zp>,
    powers: &[Monomial],
    sequence: &Recurrence,
    values: &[Vec<u32>],
    watch: &Watch,
) -> Result<Vec<Polynomial<u64>>> {
    let field = target.field();
    let (hankel, dimension) = (sequence.hankel(), powers.len() - 1);
    let polynomial = sequence.polynomial().into_iter().map(u64::from).enumerate().take(dimension);
    let mut polynomials = vec![relation(target, powers, powers[dimension].clone(), polynomial)];
    for (lead, values) in variables(target).into_iter().zip(values) {
        watch.check()?;
        let tail = hankel.solve(values).into_iter().map(|c| field.neg(&u64::from(c))).enumerate();
        polynomials.push(relation(target, powers, lead, tail));
    }
    polynomials.sort_by(|f, g| target.layout().compare(&f.terms()[0].monomial, &g.terms()[0].monomial));
    Ok(polynomials)
}

/// The powers of the last variable up to degree `top`; `None` when they overflow or are not all below the other
/// variables.
fn powers_below_variables(target: &PolynomialRing<Zp>, top: usize) -> Option<Vec<Monomial>> {
    let count = target.variables().len();
    let power = |k: usize| {
        let mut exponents = vec![0; count];
        *exponents.last_mut()? = u32::try_from(k).ok()?;
        target.layout().pack(&exponents)
    };
    let powers: Vec<Monomial> = (0..=top).map(power).collect::<Option<_>>()?;
    let above = |variable: &Monomial| target.layout().compare(variable, &powers[top]).is_gt();
    variables(target)[..count - 1].iter().all(above).then_some(powers)
}

/// The recurrence of the values of a random functional at the powers of the multiplied element. `visit` receives the
/// functional composed with each power.
fn project(
    matrix: &Matrix<'_>,
    modulus: Modulus,
    watch: &Watch,
    mut visit: impl FnMut(usize, &[u32]),
) -> Result<Recurrence> {
    let dimension = matrix.dimension();
    let mut functional = random_row(modulus, dimension);
    let mut recurrence = Recurrence::new(modulus, 2 * dimension);
    for step in 0..2 * dimension {
        watch.check()?;
        watch.report("projected powers", step, 2 * dimension - step);
        visit(step, &functional);
        recurrence.push(functional[0]);
        if recurrence.length() < dimension && step >= 2 * recurrence.length() + AGREED {
            break;
        }
        functional = matrix.apply_left(&functional);
    }
    Ok(recurrence)
}

/// A deterministic row of pseudorandom residues.
fn random_row(modulus: Modulus, length: usize) -> Vec<u32> {
    let mut random = SplitMix64::new(0);
    let next = || modulus.residue(random.word());
    let mut row: Vec<u32> = std::iter::repeat_with(next).take(length).collect();
    row.resize(kernel::padded(length), 0);
    row
}

/// Whether `polynomial` vanishes at the element of the multiplication matrix, by Horner's rule.
fn vanishes(matrix: &Matrix<'_>, polynomial: &[u32], modulus: Modulus, watch: &Watch) -> Result<bool> {
    let mut value = vec![0; kernel::padded(matrix.dimension())];
    for &coefficient in polynomial.iter().rev() {
        watch.check()?;
        value = matrix.apply(&value);
        value[0] = modulus.add_mul(value[0], coefficient, 1);
    }
    Ok(value.iter().all(|&entry| entry == 0))
}

/// The first linear relation between the powers, found exactly.
fn eliminate_powers(table: &Table, matrix: &Matrix<'_>, watch: &Watch) -> Result<Vec<u32>> {
    let mut elimination = Elimination::new(table.modulus, table.dimension());
    let mut power = table.one();
    loop {
        watch.check()?;
        watch.report("minimal polynomial", elimination.rank(), table.dimension() - elimination.rank());
        if let Some(tail) = elimination.insert(&power) {
            return Ok([tail, vec![1]].concat());
        }
        power = matrix.apply(&power);
    }
}

/// The basis by enumeration of monomials: the dense FGLM algorithm of 1993.
fn walk_basis(
    table: &mut Table,
    target: &PolynomialRing<Zp>,
    sources: &[usize],
    watch: &Watch,
) -> Result<Vec<Polynomial<u64>>> {
    sources.iter().try_for_each(|&variable| table.learn(variable, watch))?;
    let matrices: Vec<Matrix<'_>> = sources.iter().map(|&variable| table.matrix(variable)).collect();
    let mut elimination = Elimination::new(table.modulus, table.dimension());
    let mut vectors = vec![table.one()];
    elimination.insert(&vectors[0]);
    let mut walk = Walk::new(target);
    let mut polynomials = Vec::new();
    while let Some(candidate) = walk.next()? {
        watch.check()?;
        watch.report("change of order", vectors.len(), table.dimension() - vectors.len());
        let vector = matrices[candidate.variable].apply(&vectors[candidate.factor]);
        match elimination.insert(&vector) {
            None => {
                walk.standard.push(candidate.monomial);
                vectors.push(vector);
            }
            Some(tail) => {
                let tail = tail.into_iter().map(u64::from).enumerate();
                polynomials.push(relation(target, &walk.standard, candidate.monomial, tail));
            }
        }
    }
    Ok(polynomials)
}
