//! The F4 algorithm modulo word-size primes, and traces for replays modulo other primes.
//!
//! J.-C. Faugere, "A new efficient algorithm for computing Groebner bases (F4)", J. Pure Applied Algebra 139 (1999).
//! [`f4`] computes a reduced basis in any order; [`Trace::learn`] also stores a trace of the computation.
//! [`Trace::replay`] repeats its arithmetic for other primes or other coefficients.

mod eliminate;
mod guide;
mod lanes;
mod packing;
mod running;
mod sweep;
mod symbolic;
mod table;
mod trace;

pub(super) use guide::Guide;
pub use trace::Trace;

use super::Basis;
use crate::number::Zp;
use crate::poly::{Monomial, Order, Polynomial, PolynomialRing, Term};
use crate::watch::Matrix;
use crate::{Error, ErrorKind, Result, Watch};
use eliminate::{Elimination, eliminate, normal_forms};
use guide::{Leads, Whole};
use lanes::Instructions;
use packing::{Packing, words};
use running::{Running, overflow};
use sweep::Sparse;
use symbolic::{Builder, Columns, Shape};
use table::Table;

/// Exclusive upper bound of the modulus.
pub const MODULUS_LIMIT: u64 = 1 << 31;

/// Computes the reduced Groebner basis of the ideal of `generators` modulo a prime below 2^31, in the order of `ring`.
///
/// Random combinations of rows are reduced. The basis is incomplete with a probability below 2^-50 for each block of
/// rows. Every polynomial of it certainly belongs to the ideal. Modulo primes below 2^13, rows are reduced one by one.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a larger modulus; [`ErrorKind::Overflow`] when a degree overflows 15 bits or the
/// variables the widest keys; the error with which `watch` stops the work.
pub fn f4<'w>(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<Zp>> {
    let watch = Watch::or_none(watch);
    f4_with(ring, generators, Settings::default(), watch)
}

/// Settings of [`f4_with`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Whether to reduce random combinations of rows, as many as the rank. Otherwise rows are reduced one by one, and
    /// the result is certain.
    pub combinations: bool,
    /// Whether to use the processor's vector instructions. The results are equal.
    pub vectors: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { combinations: true, vectors: true }
    }
}

/// Same as [`f4`], but with settings.
///
/// # Errors
/// Those of [`f4`].
pub fn f4_with<'w>(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    settings: Settings,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<Zp>> {
    let watch = Watch::or_none(watch);
    let instructions = if settings.vectors { Instructions::detect() } else { Instructions::Portable };
    let elimination = Elimination { combinations: settings.combinations, instructions };
    Ok(in_some_width(ring, generators, elimination, &mut Whole, watch)?.0)
}

/// The leading monomials of the basis that [`f4`] computes, smallest first.
///
/// # Errors
/// Those of [`f4`].
pub(super) fn leading_monomials(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    watch: &Watch,
) -> Result<Vec<Monomial>> {
    let elimination = Elimination { combinations: true, instructions: Instructions::detect() };
    let (basis, _) = in_some_width(ring, generators, elimination, &mut Leads, watch)?;
    Ok(basis.polynomials.into_iter().map(|f| f.terms()[0].monomial.clone()).collect())
}

impl Trace {
    /// Computes the reduced basis without random combinations, and the trace of the computation.
    ///
    /// # Errors
    /// Those of [`f4`].
    pub fn learn<'w>(
        ring: &PolynomialRing<Zp>,
        generators: &[Polynomial<u64>],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<(Basis<Zp>, Trace)> {
        let watch = Watch::or_none(watch);
        Self::learn_guided(ring, generators, &mut Whole, watch)
    }

    /// Same as [`Trace::learn`], but only for the elements that `guide` selects, until it has enough. They are a basis
    /// when the guide's goal is the set of leading monomials of one.
    ///
    /// # Errors
    /// Those of [`f4`]; the error with which `guide` stops the work.
    pub(super) fn learn_guided(
        ring: &PolynomialRing<Zp>,
        generators: &[Polynomial<u64>],
        guide: &mut dyn Guide,
        watch: &Watch,
    ) -> Result<(Basis<Zp>, Trace)> {
        let elimination = Elimination { combinations: false, instructions: Instructions::detect() };
        in_some_width(ring, generators, elimination, guide, watch)
    }
}

/// Tries narrow lanes first, then wider ones.
fn in_some_width(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    elimination: Elimination,
    guide: &mut dyn Guide,
    watch: &Watch,
) -> Result<(Basis<Zp>, Trace)> {
    let p = ring.field().modulus();
    if p >= MODULUS_LIMIT {
        let text = format!("F4 works modulo primes below 2^31, not modulo {p}");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    match in_lanes(ring, generators, elimination, 8, guide, watch) {
        Err(error) if error.kind() == ErrorKind::Overflow => in_lanes(ring, generators, elimination, 16, guide, watch),
        outcome => outcome,
    }
}

/// Fixes the number of words of a monomial.
fn in_lanes(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    elimination: Elimination,
    bits: u32,
    guide: &mut dyn Guide,
    watch: &Watch,
) -> Result<(Basis<Zp>, Trace)> {
    let words = words(ring.layout().order(), ring.variables().len(), bits);
    match words {
        1 => Run::<1>::new(ring, bits, elimination).basis(generators, guide, watch),
        2 => Run::<2>::new(ring, bits, elimination).basis(generators, guide, watch),
        3 => Run::<3>::new(ring, bits, elimination).basis(generators, guide, watch),
        4 => Run::<4>::new(ring, bits, elimination).basis(generators, guide, watch),
        5..=6 => Run::<6>::new(ring, bits, elimination).basis(generators, guide, watch),
        7..=8 => Run::<8>::new(ring, bits, elimination).basis(generators, guide, watch),
        _ => {
            let text = format!("{} variables exceed the keys of F4", ring.variables().len());
            Err(Error::new(ErrorKind::Overflow, text))
        }
    }
}

/// A run of F4 with monomials of `W` words.
struct Run<'a, const W: usize> {
    ring: &'a PolynomialRing<Zp>,
    p: u32,
    elimination: Elimination,
    /// Whether the order compares degrees first. Pairs are then sorted by the degree of their least common multiple.
    graded: bool,
    running: Running<W>,
    coefficients: Vec<Vec<u32>>,
    table: Table<W>,
    trace: Trace,
    /// Number of reduced matrices.
    round: usize,
}

impl<'a, const W: usize> Run<'a, W> {
    fn new(ring: &'a PolynomialRing<Zp>, bits: u32, elimination: Elimination) -> Self {
        let graded = *ring.layout().order() == Order::GrevLex;
        let packing = Packing::new(ring.layout().order(), ring.variables().len(), bits);
        Run {
            ring,
            p: ring.field().modulus() as u32,
            elimination,
            graded,
            running: Running::new(packing, graded),
            coefficients: Vec::new(),
            table: Table::new(),
            trace: Trace::default(),
            round: 0,
        }
    }

    /// The algorithm: reduce the generators by one another; then select pairs, complete them to a matrix by symbolic
    /// preprocessing, eliminate, and adjoin the new rows, until no pair is left. Then reduce the tails.
    fn basis(
        mut self,
        generators: &[Polynomial<u64>],
        guide: &mut dyn Guide,
        watch: &Watch,
    ) -> Result<(Basis<Zp>, Trace)> {
        self.begin(generators, guide, watch)?;
        loop {
            let selected = self.running.select();
            if selected.is_empty() || self.trace.unit || guide.goal().is_some_and(|goal| self.has_reached(goal)) {
                return self.finish(guide, watch);
            }
            // In a degree order, the sugar of a round is its degree.
            let sugar = selected[0].sugar;
            let bound = if self.graded { u32::MAX } else { sugar };
            let mut builder = Builder::new(&self.running, &mut self.table, bound);
            builder.take_pairs(&selected)?;
            builder.close(watch)?;
            let (shape, columns) = builder.finish();
            self.eliminate(shape, &columns, sugar, guide, watch)?;
        }
    }

    /// Whether each of these vectors is a prefix of the exponents of a leading monomial.
    fn has_reached(&self, goal: &[Vec<u32>]) -> bool {
        let packing = &self.running.packing;
        let begins =
            |key: &packing::Key<W>, part: &Vec<u32>| (0..part.len()).all(|v| packing.exponent(key, v) == part[v]);
        goal.iter().all(|part| self.running.lead_keys().any(|key| begins(key, part)))
    }

    /// Reduces the generators by one another without multiplying any.
    fn begin(&mut self, generators: &[Polynomial<u64>], guide: &mut dyn Guide, watch: &Watch) -> Result<()> {
        let mut raw = Running::new(self.running.packing.clone(), true);
        for (index, f) in generators.iter().enumerate().filter(|(_, f)| !f.is_zero()) {
            let keys = f.terms().iter().map(|term| {
                let exponents = self.ring.layout().exponents(&term.monomial);
                raw.packing.key(&exponents).ok_or_else(overflow)
            });
            let keys = keys.collect::<Result<Vec<_>>>()?;
            raw.elements.push(keys);
            self.coefficients.push(f.terms().iter().map(|term| term.coefficient as u32).collect());
            self.trace.generators.push((index, f.terms().len()));
        }
        let all: Vec<u32> = (0..raw.elements.len() as u32).collect();
        let mut builder = Builder::new(&raw, &mut self.table, u32::MAX);
        builder.take_elements(&all, 0)?;
        let (shape, columns) = builder.finish();
        let given = self.coefficients.len();
        self.eliminate(shape, &columns, 0, guide, watch)?;
        self.coefficients.drain(..given);
        Ok(())
    }

    /// Reduces a matrix and adjoins its new rows.
    fn eliminate(
        &mut self,
        shape: Shape,
        columns: &Columns<W>,
        sugar: u32,
        guide: &mut dyn Guide,
        watch: &Watch,
    ) -> Result<()> {
        let terms = shape.entries.len() + self.coefficients.iter().map(Vec::len).sum::<usize>();
        watch.check_terms(terms)?;
        guide.allow(terms)?;
        watch.check_memory(self.bytes() + shape.bytes())?;
        self.report(&shape, 0, sugar, watch);
        let echelon = eliminate(&shape, &self.coefficients, self.p, self.elimination, watch)?;
        self.report(&shape, echelon.rows.len(), sugar, watch);
        self.round += 1;
        if !self.elimination.combinations {
            self.trace.record(shape, &echelon);
        }
        // The smallest leading monomial first, so that an element precedes those that it makes redundant.
        for row in echelon.rows.into_iter().rev() {
            watch.check()?;
            let keys: Vec<_> = row.columns.iter().map(|&column| columns[column as usize]).collect();
            self.trace.unit |= keys[0] == [0; W];
            let degree = |key| self.running.packing.degree(key);
            let sugar = if self.graded { degree(&keys[0]) } else { keys.iter().map(degree).fold(sugar, u32::max) };
            self.running.adjoin(keys, sugar)?;
            self.coefficients.push(row.coefficients);
        }
        Ok(())
    }

    /// Reports the matrix. `fresh` of its lower rows are known to be independent.
    fn report(&self, shape: &Shape, fresh: usize, degree: u32, watch: &Watch) {
        let (rows, rank) = (shape.upper.len() + shape.lower.len(), shape.upper.len() + fresh);
        let matrix = Matrix { degree: degree as usize, rows, columns: shape.columns, rank };
        watch.report_matrix("F4", self.round, self.running.open(), matrix);
    }

    /// Bytes of the monomials and the elements.
    fn bytes(&self) -> usize {
        let terms: usize = self.coefficients.iter().map(Vec::len).sum();
        self.table.bytes() + terms * (4 + size_of::<packing::Key<W>>()) + self.trace.bytes()
    }

    /// The reduced basis: the selected live elements with reduced tails, smallest leading monomial first.
    fn finish(mut self, guide: &dyn Guide, watch: &Watch) -> Result<(Basis<Zp>, Trace)> {
        let live = self.wanted(guide);
        let (tails, columns) = if guide.wants_tails() { self.tails(&live, watch)? } else { Default::default() };
        let mut exponents = vec![0; self.ring.variables().len()];
        let mut term = |key: &packing::Key<W>, coefficient: u32| {
            self.running.packing.unpack(key, &mut exponents);
            Ok(Term { coefficient: u64::from(coefficient), monomial: self.ring.monomial(&exponents)? })
        };
        let mut polynomials = Vec::with_capacity(live.len());
        for (index, element) in live.iter().enumerate() {
            let mut terms = vec![term(&self.running.elements[*element as usize][0], 1)?];
            if let Some(tail) = tails.get(index) {
                terms.reserve(tail.columns.len());
                for (&column, &coefficient) in tail.columns.iter().zip(&tail.coefficients) {
                    terms.push(term(&columns[column as usize], coefficient)?);
                }
            }
            polynomials.push(self.ring.descending(terms));
        }
        if !self.elimination.combinations {
            self.trace.supports = tails.into_iter().map(|tail| tail.columns.into()).collect();
        }
        Ok((Basis { ring: self.ring.clone(), polynomials, cofactors: Vec::new() }, self.trace))
    }

    /// The live elements that `guide` selects, smallest leading monomial first.
    fn wanted(&self, guide: &dyn Guide) -> Vec<u32> {
        let packing = &self.running.packing;
        let lead = |element: &u32| &self.running.elements[*element as usize][0];
        let mut live = self.running.live();
        live.sort_by_key(|element| packing.rank(lead(element)));
        let exponents = |element: &u32| {
            let mut exponents = vec![0; self.ring.variables().len()];
            packing.unpack(lead(element), &mut exponents);
            exponents
        };
        let leads: Vec<Vec<u32>> = live.iter().map(exponents).collect();
        guide.wanted(&leads).into_iter().map(|index| live[index]).collect()
    }

    /// The reduced tails of these elements, and the monomials of their columns.
    fn tails(&mut self, elements: &[u32], watch: &Watch) -> Result<(Vec<Sparse<u32>>, Columns<W>)> {
        let mut builder = Builder::new(&self.running, &mut self.table, u32::MAX);
        builder.take_elements(elements, 1)?;
        builder.close(watch)?;
        let (shape, columns) = builder.finish();
        let tails = normal_forms(&shape, &self.coefficients, self.p, self.elimination, watch)?;
        if !self.elimination.combinations {
            self.trace.last = trace::pruned(&shape);
        }
        Ok((tails, columns))
    }
}
