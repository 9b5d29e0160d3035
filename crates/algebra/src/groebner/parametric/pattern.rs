//! The support of a rational function, computed once, and its coefficients modulo any prime.

use super::line::{Nodes, Quotient};
use super::prime::Prime;
use super::sequence;
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// Rational functions of parameters that can be evaluated.
pub(super) trait Functions {
    /// Number of parameters.
    fn parameters(&self) -> usize;
    /// Number of functions.
    fn count(&self) -> usize;
    /// Whether the prime divides none of the numbers in the functions. All but finitely many primes qualify.
    fn admit(&self, field: Prime) -> bool;
    /// The values of all functions at each point; `None` where one is not defined.
    fn values(&self, field: Prime, points: &[Vec<u64>], watch: &Watch) -> Result<Vec<Option<Vec<u64>>>>;
}

/// The coefficient of one power of `t` in the numerator or the denominator, on the lines `p[j] = v[j] t^w[j]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub top: bool,
    pub power: usize,
}

impl Place {
    pub fn of(self, quotient: &Quotient) -> u64 {
        if self.top { quotient.numerator[self.power] } else { quotient.denominator[self.power] }
    }
}

/// The monomials of the parameters at one place, divided by the one monomial of the normal place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slot {
    pub place: Place,
    pub exponents: Vec<Vec<i32>>,
}

/// The support of one function. At the normal place, numerator or denominator has a single monomial. Coefficients
/// divided by the one there have a common scale on all lines (J. van der Hoeven and G. Lecerf, "On sparse interpolation
/// of rational functions and gcds", ACM Communications in Computer Algebra 55, 2021, fix the scale by this method).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pattern {
    pub weights: Vec<u32>,
    pub degrees: (usize, usize),
    pub normal: Place,
    pub slots: Vec<Slot>,
}

impl Pattern {
    /// The pattern of the zero function.
    pub fn zero(weights: &[u32]) -> Self {
        let normal = Place { top: false, power: 0 };
        let slots = vec![Slot { place: normal, exponents: vec![vec![0; weights.len()]] }];
        Pattern { weights: weights.to_vec(), degrees: (0, 0), normal, slots }
    }

    /// The largest number of monomials at one place, which is the number of lines needed.
    pub fn lines(&self) -> usize {
        self.slots.iter().map(|slot| slot.exponents.len()).max().unwrap_or(1)
    }

    /// The number of points on a line.
    pub fn nodes(&self) -> usize {
        self.degrees.0 + self.degrees.1 + 1
    }

    /// The numerator and the denominator at `point`. `factors[s][i]` is the factor of monomial `i` of slot `s`.
    pub fn value(&self, field: Prime, factors: &[Vec<u64>], point: &[u64]) -> (u64, u64) {
        let (mut numerator, mut denominator) = (0, 0);
        for (slot, factors) in self.slots.iter().zip(factors) {
            let part = if slot.place.top { &mut numerator } else { &mut denominator };
            for (exponents, &factor) in slot.exponents.iter().zip(factors) {
                *part = field.reduce(*part + factor * power_product(field, point, exponents));
            }
        }
        (numerator, denominator)
    }

    /// The factors of all monomials, from the function on `lines` whose directions are the powers of `bases`.
    fn solve(&self, field: Prime, bases: &[u64], lines: &[Quotient], watch: &Watch) -> Result<Option<Vec<Vec<u64>>>> {
        let lines = &lines[..self.lines()];
        let scales: Vec<u64> = lines.iter().map(|line| self.normal.of(line)).collect();
        let Some(scales) = field.inverses(&scales) else { return Ok(None) };
        let solve_slot = |slot: &Slot| {
            let roots: Vec<u64> = slot.exponents.iter().map(|e| power_product(field, bases, e)).collect();
            let values = lines.iter().zip(&scales).map(|(line, &scale)| field.mul(slot.place.of(line), scale));
            sequence::factors(field, &roots, &values.take(roots.len()).collect::<Vec<_>>(), watch)
        };
        self.slots.iter().map(solve_slot).collect()
    }
}

/// The product of the powers of `bases`; exponents may be negative.
pub(super) fn power_product(field: Prime, bases: &[u64], exponents: &[i32]) -> u64 {
    let powers = bases.iter().zip(exponents).filter(|(_, e)| **e != 0);
    powers.fold(1, |product, (&base, &e)| field.mul(product, field.signed_pow(base, i64::from(e))))
}

/// The points of all nodes on the lines `range` with directions `offset[j] bases[j]^line`.
pub(super) fn points_on_lines(
    nodes: &[u64],
    field: Prime,
    weights: &[u32],
    directions: (&[u64], &[u64]),
    range: std::ops::Range<usize>,
) -> Vec<Vec<u64>> {
    let (offsets, bases) = directions;
    let start = |(&offset, &base): (&u64, &u64)| field.mul(offset, field.pow(base, range.start as u64));
    let mut direction: Vec<u64> = offsets.iter().zip(bases).map(start).collect();
    let mut points = Vec::with_capacity(range.len() * nodes.len());
    for _ in range {
        for &node in nodes {
            let coordinate = |(&v, &w): (&u64, &u32)| field.mul(v, field.pow(node, u64::from(w)));
            points.push(direction.iter().zip(weights).map(coordinate).collect());
        }
        direction.iter_mut().zip(bases).for_each(|(v, &base)| *v = field.mul(*v, base));
    }
    points
}

/// The factors of all functions modulo another prime; `None` when the prime or the random points are unlucky.
pub(super) fn factors_modulo(
    functions: &impl Functions,
    patterns: &[Pattern],
    field: Prime,
    stream: &mut SplitMix64,
    watch: &Watch,
) -> Result<Option<Vec<Vec<Vec<u64>>>>> {
    let mut found = vec![Vec::new(); patterns.len()];
    let mut kinds: Vec<&[u32]> = patterns.iter().map(|pattern| pattern.weights.as_slice()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for weights in kinds {
        let members: Vec<usize> = (0..patterns.len()).filter(|&f| patterns[f].weights == weights).collect();
        let most = |size: fn(&Pattern) -> usize| members.iter().map(|&f| size(&patterns[f])).max().unwrap_or(1);
        let (count, lines) = (most(Pattern::nodes), most(Pattern::lines));
        let nodes = Nodes::new(field, distinct_units(field, stream, count));
        let bases: Vec<u64> = weights.iter().map(|_| stream.unit(field.p)).collect();
        let ones = vec![1; bases.len()];
        let points = points_on_lines(&nodes.nodes, field, weights, (&ones, &bases), 0..lines);
        let Some(values) = functions.values(field, &points, watch)?.into_iter().collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        for f in members {
            watch.check()?;
            let quotient = |line: &[Vec<u64>]| {
                let values: Vec<u64> = line.iter().map(|values| values[f]).collect();
                nodes.quotient_of(&values, patterns[f].degrees)
            };
            let needed = values.chunks(count).take(patterns[f].lines());
            let Some(quotients) = needed.map(quotient).collect::<Option<Vec<_>>>() else { return Ok(None) };
            let Some(factors) = patterns[f].solve(field, &bases, &quotients, watch)? else { return Ok(None) };
            found[f] = factors;
        }
    }
    Ok(Some(found))
}

/// `count` distinct nonzero elements.
pub(super) fn distinct_units(field: Prime, stream: &mut SplitMix64, count: usize) -> Vec<u64> {
    let first = 1 + stream.word() % (field.p - 1 - count as u64);
    (first..first + count as u64).collect()
}
