//! The representation modulo one prime: Krylov sequences of a multiplication matrix, Berlekamp-Massey, numerators.
//!
//! Bostan, Salvy and Schost 2003, sections 3 and 4. For multiple points, let `mu` be the minimal polynomial of `t`, `f`
//! its square-free part and `l` a random linear form on the quotient ring. Then `l((mu/f)(t) x t^i)` has simple poles
//! only.

use super::residues::{Residues, trim};
use super::staircase::{Border, Coordinate, Place, Row, Staircase};
use crate::number::{BigInt, Field, Ring, Zp};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// A representation modulo `p`. Polynomials have their constant term first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Modular {
    /// The degree of the minimal polynomial of the separating form.
    pub(super) minimal: usize,
    /// `f`, monic and square-free.
    pub(super) polynomial: Vec<u32>,
    /// `g_v`, of degree below that of `f`, with `x_v = g_v / f'`.
    pub(super) numerators: Vec<Vec<u32>>,
    /// The factors of `f` by the multiplicity of their points; empty when all points are simple.
    pub(super) classes: Vec<(usize, Vec<u32>)>,
}

/// The quotient ring modulo one prime: multiplication by the variables of a border.
pub(super) struct QuotientModulo<'a> {
    pub(super) field: Residues,
    staircase: &'a Staircase,
    border: &'a Border,
    leads: Vec<Vec<u32>>,
    forms: Vec<Vec<u32>>,
}

/// A column of a multiplication matrix.
enum Column<'a> {
    Unit(usize),
    Dense(&'a [u32]),
    Sum(Vec<u32>),
}

impl<'a> QuotientModulo<'a> {
    /// Builds the quotient ring; `None` when a leading coefficient of the basis is zero modulo `prime`.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn new(staircase: &'a Staircase, border: &'a Border, prime: u32, watch: &Watch) -> Result<Option<Self>> {
        let field = Residues::new(prime);
        let reduce = Zp::new(u64::from(prime))?;
        let image = |n: &BigInt| reduce.from_integer(n) as u32;
        let lead = |row: &Row| -> Option<Vec<u32>> {
            let inverse = reduce.inverse(&reduce.from_integer(&row.lead))? as u32;
            let mut form = vec![0; staircase.dimension()];
            for (place, coefficient) in &row.tail {
                form[*place] = field.neg(field.mul(image(coefficient), inverse));
            }
            Some(form)
        };
        let Some(leads) = staircase.rows.iter().map(lead).collect::<Option<Vec<_>>>() else { return Ok(None) };
        let add_scaled = |target: &mut [u32], factor: &u32, row: &[u32]| field.add_scaled(target, *factor, row);
        let forms = border.normal_forms(&leads, [0, 1], add_scaled, watch)?;
        Ok(Some(QuotientModulo { field, staircase, border, leads, forms }))
    }

    fn dimension(&self) -> usize {
        self.staircase.dimension()
    }

    fn form_of(&self, place: Place) -> Column<'_> {
        match place {
            Place::Standard(i) => Column::Unit(i),
            Place::Border(i) => Column::Dense(&self.forms[i]),
        }
    }

    /// The columns of multiplication by the linear form `sum form[v] x_v`.
    fn columns(&self, form: &[i64]) -> Vec<Column<'_>> {
        let terms: Vec<(usize, i64)> = form.iter().copied().enumerate().filter(|&(_, c)| c != 0).collect();
        let column = |j: usize| match terms[..] {
            [(v, 1)] => self.form_of(self.border.action[v][j]),
            _ => {
                let mut sum = vec![0; self.dimension()];
                for &(v, c) in &terms {
                    self.form_of(self.border.action[v][j]).add_to(&mut sum, self.field.from_i64(c), &self.field);
                }
                Column::Sum(sum)
            }
        };
        (0..self.dimension()).map(column).collect()
    }

    /// The representation by the linear form `sum form[v] x_v`; `None` when some point of a root has no numerator.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn representation(&self, form: &[i64], watch: &Watch) -> Result<Option<Modular>> {
        let field = &self.field;
        let columns = self.columns(form);
        let sequences = self.sequences(&columns, watch)?;
        let (powers, coordinates) = sequences.split_first().expect("the powers of the form are first");
        let minimal = field.minimal_polynomial(powers);
        let repeated = field.gcd(&minimal, &field.derivative(&minimal));
        let polynomial = field.div_rem(&minimal, &repeated).0;
        let degree = polynomial.len() - 1;
        let residue = |sequence: &[u32]| {
            let shifted: Vec<u32> = (0..degree).map(|i| field.dot(&repeated, &sequence[i..])).collect();
            polar_numerator(field, &polynomial, &shifted)
        };
        let Some(weight) = field.inverse_modulo(&residue(powers), &polynomial) else { return Ok(None) };
        let weight = field.product_modulo(&weight, &field.derivative(&polynomial), &polynomial);
        let numerator = |sequence: &Vec<u32>| field.product_modulo(&residue(sequence), &weight, &polynomial);
        let numerators = coordinates.iter().map(numerator).collect();
        let classes = if degree < self.dimension() { self.classes(&columns, watch)? } else { Vec::new() };
        Ok(Some(Modular { minimal: minimal.len() - 1, polynomial, numerators, classes }))
    }

    /// `l(t^i)` for `i < 2 D`, then for each variable `l(x_v t^i)` for `i < D`, with a fixed random linear form `l`.
    fn sequences(&self, columns: &[Column<'_>], watch: &Watch) -> Result<Vec<Vec<u32>>> {
        let size = self.dimension();
        let coordinates = self.staircase.coordinates();
        let mut sequences = vec![Vec::new(); coordinates.len() + 1];
        let mut functional = random_vector(&self.field, size);
        for step in 0..2 * size {
            watch.check()?;
            sequences[0].push(functional[0]);
            if step < size {
                for (sequence, coordinate) in sequences[1..].iter_mut().zip(&coordinates) {
                    sequence.push(match *coordinate {
                        Coordinate::Standard(i) => functional[i],
                        Coordinate::Lead(row) => self.field.dot(&functional, &self.leads[row]),
                    });
                }
            }
            functional = columns.iter().map(|column| column.dot(&functional, &self.field)).collect();
        }
        Ok(sequences)
    }

    /// The number of distinct solutions modulo the prime, counted by a random linear form.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn count_points(&self, watch: &Watch) -> Result<Option<usize>> {
        let random = random_vector(&self.field, self.staircase.variables() + 1);
        let form: Vec<i64> = random[1..].iter().map(|&c| i64::from(c)).collect();
        Ok(self.representation(&form, watch)?.map(|modular| modular.polynomial.len() - 1))
    }

    /// Whether `x_v = g_v(t) / f'(t)` at all points, for a separating form. The test is that `(mu/f)(t)`, which is zero
    /// in no local ring, times `f'(t) x_v - g_v(t)` is zero.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn represents(&self, form: &[i64], modular: &Modular, watch: &Watch) -> Result<bool> {
        let columns = self.columns(form);
        let field = &self.field;
        let minimal = field.minimal_polynomial(&self.sequences(&columns, watch)?[0]);
        let repeated = field.div_rem(&minimal, &modular.polynomial).0;
        let element = self.evaluate(&repeated, &columns, &self.one());
        let slope = field.derivative(&modular.polynomial);
        let vanishes = |(v, g): (usize, &Vec<u32>)| is_zero(&self.excess(v, &columns, &slope, g, &element));
        Ok(modular.numerators.iter().enumerate().all(vanishes))
    }

    /// Whether the `power`-th powers of `f(t)` and of `f'(t) x_v - g_v(t)` are zero in the quotient ring.
    pub(super) fn are_nilpotent(
        &self,
        form: &[i64],
        f: &[u32],
        slope: &[u32],
        numerators: &[Vec<u32>],
        power: usize,
    ) -> bool {
        let columns = self.columns(form);
        let power_of = |apply: &dyn Fn(Vec<u32>) -> Vec<u32>| (0..power).fold(self.one(), |element, _| apply(element));
        is_zero(&power_of(&|element| self.evaluate(f, &columns, &element)))
            && numerators
                .iter()
                .enumerate()
                .all(|(v, g)| is_zero(&power_of(&|element| self.excess(v, &columns, slope, g, &element))))
    }

    fn one(&self) -> Vec<u32> {
        let mut one = vec![0; self.dimension()];
        one[0] = 1;
        one
    }

    /// `f'(t) x_v - g(t)` times an element.
    fn excess(&self, v: usize, columns: &[Column<'_>], slope: &[u32], g: &[u32], element: &[u32]) -> Vec<u32> {
        let mut form = vec![0; self.staircase.variables()];
        form[v] = 1;
        let product = self.apply(&self.columns(&form), element);
        let mut excess = self.evaluate(slope, columns, &product);
        self.field.add_scaled(&mut excess, self.field.neg(1), &self.evaluate(g, columns, element));
        excess
    }

    /// `f(t)` times an element, by Horner's rule.
    fn evaluate(&self, f: &[u32], columns: &[Column<'_>], element: &[u32]) -> Vec<u32> {
        let horner = |value: Vec<u32>, &c: &u32| {
            let mut next = self.apply(columns, &value);
            self.field.add_scaled(&mut next, c, element);
            next
        };
        f.iter().rev().fold(vec![0; element.len()], horner)
    }

    /// A matrix times a vector.
    fn apply(&self, columns: &[Column<'_>], vector: &[u32]) -> Vec<u32> {
        let mut result = vec![0; vector.len()];
        for (column, &factor) in columns.iter().zip(vector).filter(|(_, factor)| **factor != 0) {
            column.add_to(&mut result, factor, &self.field);
        }
        result
    }

    /// The factors by multiplicity of the characteristic polynomial of multiplication by the separating form.
    fn classes(&self, columns: &[Column<'_>], watch: &Watch) -> Result<Vec<(usize, Vec<u32>)>> {
        let dense = |column: &Column<'_>| {
            let mut sum = vec![0; self.dimension()];
            column.add_to(&mut sum, 1, &self.field);
            sum
        };
        let characteristic = self.field.characteristic_polynomial(columns.iter().map(dense).collect(), watch)?;
        Ok(self.field.square_free_parts(&characteristic))
    }
}

impl Column<'_> {
    fn dot(&self, functional: &[u32], field: &Residues) -> u32 {
        match self {
            Column::Unit(i) => functional[*i],
            Column::Dense(entries) => field.dot(functional, entries),
            Column::Sum(entries) => field.dot(functional, entries),
        }
    }

    fn add_to(&self, target: &mut [u32], factor: u32, field: &Residues) {
        match self {
            Column::Unit(i) => target[*i] = field.add(target[*i], factor),
            Column::Dense(entries) => field.add_scaled(target, factor, entries),
            Column::Sum(entries) => field.add_scaled(target, factor, entries),
        }
    }
}

fn is_zero(vector: &[u32]) -> bool {
    vector.iter().all(|&entry| entry == 0)
}

/// The polynomial part of `f sum s_i / T^(i+1)`, for the first `deg f` terms of a sequence.
fn polar_numerator(field: &Residues, f: &[u32], sequence: &[u32]) -> Vec<u32> {
    trim((0..sequence.len()).map(|k| field.dot(&f[k + 1..], sequence)).collect())
}

/// Entries of a fixed pseudorandom sequence that depends on the prime.
fn random_vector(field: &Residues, length: usize) -> Vec<u32> {
    let mut random = SplitMix64::new(u64::from(field.prime()));
    (0..length).map(|_| random.below(u64::from(field.prime())) as u32).collect()
}
