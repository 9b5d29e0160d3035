//! Sparse interpolation of rational functions modulo one prime: computation of the supports.
//!
//! On lines `p[j] = v[j] t^w[j]` a function is a quotient in `t`. Its coefficients, divided by one that is a single
//! monomial in `v`, are sums of monomials of `v`. Along a geometric sequence of `v` they are sums of powers (Ben-Or and
//! Tiwari). Logarithms of the bases of these powers give the exponents. The prime is chosen so that logarithms are
//! cheap, and the exponents are the digits of one number.

use std::collections::HashMap;

use super::line::{Nodes, Quotient};
use super::pattern::{Functions, Pattern, Place, Slot, distinct_units, points_on_lines, power_product};
use super::prime::{Prime, SmoothPrime};
use super::sequence::{distinct_roots, factors, minimal_polynomial};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result, Watch};

/// The lengths of the shortest and of the longest sequences that are tried.
const SHORTEST: usize = 4;
const MOST_LINES: usize = 1 << 14;
/// Maximum number of nodes on a line.
pub(super) const MOST_NODES: usize = 256;

/// Result for the first prime: a pattern and its factors for each function.
#[derive(Clone, Debug)]
pub(super) struct Learned {
    pub field: Prime,
    pub patterns: Vec<Pattern>,
    pub factors: Vec<Vec<Vec<u64>>>,
}

/// The pattern of a function, and its factors modulo the prime.
type Settled = (Pattern, Vec<Vec<u64>>);

/// Computes the supports of all functions.
///
/// # Errors
/// [`ErrorKind::Unsupported`] when the functions are too dense; the error with which `watch` stops the work.
pub(super) fn learn(functions: &impl Functions, watch: &Watch) -> Result<Learned> {
    let primes = SmoothPrime::all().into_iter().filter(|prime| functions.admit(prime.field));
    for (seed, prime) in primes.enumerate() {
        let mut search = Search::new(functions, prime, seed as u64);
        if search.probe(watch)? && search.run(watch)? {
            return Ok(search.into_learned());
        }
    }
    let text = "the coefficients are too dense for interpolation; compute over the field of fractions instead";
    Err(Error::new(ErrorKind::Unsupported, text))
}

/// The sequences of lines with the same weights.
struct Lines {
    weights: Vec<u32>,
    nodes: Option<Nodes>,
    offsets: Vec<u64>,
    bases: Vec<u64>,
    /// The base of the digits of the exponents.
    radix: i64,
    /// `quotients[f][i]`: function `f` on line `i`.
    quotients: Vec<Vec<Quotient>>,
}

struct Search<'a, S: Functions> {
    functions: &'a S,
    prime: SmoothPrime,
    stream: SplitMix64,
    settled: Vec<Option<Settled>>,
    probe: (Vec<u64>, Vec<u64>),
    /// Logarithms computed so far. The same monomials occur repeatedly.
    logarithms: HashMap<u64, i64>,
}

impl<'a, S: Functions> Search<'a, S> {
    fn new(functions: &'a S, prime: SmoothPrime, seed: u64) -> Self {
        let settled = vec![None; functions.count()];
        Search {
            functions,
            prime,
            stream: SplitMix64::new(seed),
            settled,
            probe: Default::default(),
            logarithms: HashMap::new(),
        }
    }

    /// Evaluates the functions at the point of the later test.
    fn probe(&mut self, watch: &Watch) -> Result<bool> {
        let point = distinct_units(self.prime.field, &mut self.stream, self.functions.parameters());
        let values = self.functions.values(self.prime.field, std::slice::from_ref(&point), watch)?;
        let Some(values) = values.into_iter().next().flatten() else { return Ok(false) };
        self.probe = (point, values);
        Ok(true)
    }

    fn is_done(&self) -> bool {
        self.settled.iter().all(Option::is_some)
    }

    /// Tries longer and longer sequences for more and more weights. Later weights get shorter sequences.
    fn run(&mut self, watch: &Watch) -> Result<bool> {
        let mut waiting = weight_vectors(self.functions.parameters()).into_iter();
        let mut open: Vec<Lines> = Vec::new();
        let mut longest = SHORTEST / 2;
        while !self.is_done() && longest <= MOST_LINES {
            for (rank, lines) in open.iter_mut().enumerate() {
                watch.report("interpolation", self.settled.iter().flatten().count(), self.settled.len());
                let is_open = !self.is_done() && longest >> rank >= SHORTEST;
                if is_open && self.extend(lines, longest >> rank, watch)? {
                    self.settle_all(lines, watch)?;
                }
            }
            if !self.is_done() {
                open.extend(self.next_promising(&mut waiting, watch)?);
            }
            longest *= 2;
        }
        Ok(self.is_done())
    }

    /// The next weights that are promising on several lines.
    fn next_promising(&mut self, waiting: &mut impl Iterator<Item = Vec<u32>>, watch: &Watch) -> Result<Option<Lines>> {
        for weights in waiting {
            let mut lines = self.lines(weights);
            if self.extend(&mut lines, SHORTEST, watch)? && self.is_promising(&lines) {
                return Ok(Some(lines));
            }
        }
        Ok(None)
    }

    /// Empty lines with random offsets and with bases that encode exponents as digits.
    fn lines(&mut self, weights: Vec<u32>) -> Lines {
        let field = self.prime.field;
        let pivot = pivot(&weights);
        let others = weights.len() - 1;
        let radix = radix(field, others);
        let mut exponent = 1u64;
        let (mut offsets, mut bases) = (Vec::new(), Vec::new());
        for variable in 0..weights.len() {
            let fixed = variable == pivot;
            offsets.push(if fixed { 1 } else { self.stream.unit(field.p) });
            bases.push(if fixed { 1 } else { field.pow(self.prime.generator, exponent) });
            if !fixed {
                exponent = exponent.saturating_mul(radix as u64);
            }
        }
        Lines { weights, nodes: None, offsets, bases, radix, quotients: vec![Vec::new(); self.functions.count()] }
    }

    /// Extends the sequences to length `count`; `false` when the weights are not suitable.
    fn extend(&mut self, lines: &mut Lines, count: usize, watch: &Watch) -> Result<bool> {
        if lines.nodes.is_none() && !self.find_degrees(lines, watch)? {
            return Ok(false);
        }
        let Some(nodes) = &lines.nodes else { return Ok(false) };
        let done = lines.quotients.iter().map(Vec::len).max().unwrap_or(0);
        if done >= count {
            return Ok(true);
        }
        let directions = (lines.offsets.as_slice(), lines.bases.as_slice());
        let points = points_on_lines(&nodes.nodes, self.prime.field, &lines.weights, directions, done..count);
        let values = self.functions.values(self.prime.field, &points, watch)?;
        let Some(values) = values.into_iter().collect::<Option<Vec<_>>>() else { return Ok(false) };
        for line in values.chunks(nodes.count()) {
            watch.check()?;
            for (f, quotients) in lines.quotients.iter_mut().enumerate() {
                if self.settled[f].is_none() {
                    let values: Vec<u64> = line.iter().map(|values| values[f]).collect();
                    let Some(quotient) = nodes.quotient_of(&values, quotients[0].degrees()) else { return Ok(false) };
                    quotients.push(quotient);
                }
            }
        }
        Ok(true)
    }

    /// Evaluates the first line with as many nodes as its degrees require.
    fn find_degrees(&mut self, lines: &mut Lines, watch: &Watch) -> Result<bool> {
        let field = self.prime.field;
        let all = distinct_units(field, &mut self.stream, MOST_NODES);
        let (mut count, mut values) = (0, Vec::new());
        while count < MOST_NODES {
            let next = if count < 32 { count + 8 } else { count * 2 };
            let points =
                points_on_lines(&all[count..next], field, &lines.weights, (&lines.offsets, &lines.bases), 0..1);
            for row in self.functions.values(field, &points, watch)? {
                let Some(row) = row else { return Ok(false) };
                values.push(row);
            }
            count = next;
            let nodes = Nodes::new(field, all[..count].to_vec());
            let function = |f: usize| nodes.quotient(&values.iter().map(|row: &Vec<u64>| row[f]).collect::<Vec<_>>());
            if let Some(quotients) = (0..self.functions.count()).map(function).collect::<Option<Vec<_>>>() {
                let size = |quotient: &Quotient| quotient.degrees().0 + quotient.degrees().1 + 1;
                let needed = quotients.iter().map(size).max().unwrap_or(1);
                lines.nodes = Some(Nodes::new(field, all[..needed].to_vec()));
                lines.quotients = quotients.into_iter().map(|quotient| vec![quotient]).collect();
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether, for each function, outer coefficients in numerator and denominator have a monomial as their ratio.
    fn is_promising(&self, lines: &Lines) -> bool {
        let field = self.prime.field;
        let geometric = |a: Place, b: Place, line: &[Quotient]| {
            let ends = |i: usize| (a.of(&line[i]), b.of(&line[i]));
            let ratio = |i: usize, j: usize| (field.mul(ends(i).0, ends(j).1), field.mul(ends(j).0, ends(i).1));
            let (first, second) = (ratio(1, 0), ratio(2, 1));
            field.mul(first.0, second.1) == field.mul(second.0, first.1)
        };
        (0..self.settled.len()).filter(|&f| self.settled[f].is_none()).all(|f| {
            let line = &lines.quotients[f];
            let places = outer_places(&line[0]);
            let (tops, bottoms): (Vec<Place>, Vec<Place>) = places.into_iter().partition(|place| place.top);
            line[0].degrees().1 == 0
                || tops.is_empty()
                || line.len() < 3
                || tops.iter().any(|&a| bottoms.iter().any(|&b| geometric(a, b, line)))
        })
    }

    /// Determines every function whose sequences are long enough.
    fn settle_all(&mut self, lines: &Lines, watch: &Watch) -> Result<()> {
        for f in 0..self.settled.len() {
            watch.check()?;
            if self.settled[f].is_none() {
                self.settled[f] = self.settle(lines, f, watch)?;
            }
        }
        Ok(())
    }

    fn settle(&mut self, lines: &Lines, f: usize, watch: &Watch) -> Result<Option<Settled>> {
        let sequence = &lines.quotients[f];
        if sequence[0].numerator.is_empty() {
            return Ok(Some((Pattern::zero(&lines.weights), vec![vec![1]])));
        }
        for normal in outer_places(&sequence[0]) {
            let found = self.pattern(lines, sequence, normal, watch)?;
            if let Some(found) = found.filter(|found| self.passes(f, &found.0, &found.1)) {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Whether the function has the correct value at the probe point.
    fn passes(&self, f: usize, pattern: &Pattern, factors: &[Vec<u64>]) -> bool {
        let (numerator, denominator) = pattern.value(self.prime.field, factors, &self.probe.0);
        denominator != 0 && numerator == self.prime.field.mul(denominator, self.probe.1[f])
    }

    /// The support when the coefficient at `normal` is a single monomial.
    fn pattern(
        &mut self,
        lines: &Lines,
        sequence: &[Quotient],
        normal: Place,
        watch: &Watch,
    ) -> Result<Option<Settled>> {
        let field = self.prime.field;
        let scales: Vec<u64> = sequence.iter().map(|line| normal.of(line)).collect();
        let Some(scales) = field.inverses(&scales) else { return Ok(None) };
        let mut candidates = Vec::new();
        for place in places(&sequence[0]) {
            let scaled = sequence.iter().zip(&scales).map(|(line, &scale)| field.mul(place.of(line), scale));
            let values: Vec<u64> = scaled.collect();
            let Some(polynomial) = minimal_polynomial(field, &values, watch)? else { return Ok(None) };
            candidates.push((place, polynomial, values));
        }
        let (mut slots, mut all_factors) = (Vec::new(), Vec::new());
        for (place, polynomial, values) in candidates {
            let Some(roots) = distinct_roots(field, &polynomial, &mut self.stream, watch)? else { return Ok(None) };
            let step = place.power as i64 - normal.power as i64;
            let exponents: Vec<Vec<i32>> = roots.iter().map(|&root| self.exponents(lines, root, step)).collect();
            let Some(found) = factors(field, &roots, &values, watch)? else { return Ok(None) };
            let unscaled = found
                .into_iter()
                .zip(&exponents)
                .map(|(factor, e)| field.mul(factor, field.inverse(power_product(field, &lines.offsets, e))));
            all_factors.push(unscaled.collect());
            slots.push(Slot { place, exponents });
        }
        let pattern = Pattern { weights: lines.weights.clone(), degrees: sequence[0].degrees(), normal, slots };
        Ok(Some((pattern, all_factors)))
    }

    /// The exponents of the monomial whose value at the bases is `root`; `step` is its weight.
    fn exponents(&mut self, lines: &Lines, root: u64, step: i64) -> Vec<i32> {
        let order = (self.prime.field.p - 1) as i64;
        let prime = self.prime;
        let logarithm = *self.logarithms.entry(root).or_insert_with(|| prime.logarithm(root) as i64);
        let mut rest = if logarithm > order / 2 { logarithm - order } else { logarithm };
        let pivot = pivot(&lines.weights);
        let mut exponents = vec![0i32; lines.weights.len()];
        let mut weight = 0;
        for variable in (0..exponents.len()).filter(|&v| v != pivot) {
            let digit = (rest + lines.radix / 2).rem_euclid(lines.radix) - lines.radix / 2;
            rest = (rest - digit) / lines.radix;
            exponents[variable] = digit as i32;
            weight += digit * i64::from(lines.weights[variable]);
        }
        exponents[pivot] = (step - weight) as i32;
        exponents
    }

    fn into_learned(self) -> Learned {
        let (patterns, factors) = self.settled.into_iter().flatten().unzip();
        Learned { field: self.prime.field, patterns, factors }
    }
}

/// The first variable of weight one; its exponent follows from the others.
fn pivot(weights: &[u32]) -> usize {
    weights.iter().position(|&w| w == 1).expect("every weight vector has a one")
}

/// The largest odd base such that a number with `digits` digits stays below `p - 1`.
fn radix(field: Prime, digits: usize) -> i64 {
    let fits = |radix: u64| (0..digits).try_fold(1u64, |n, _| n.checked_mul(radix)).is_some_and(|n| n < field.p - 1);
    let (mut low, mut high) = (1u64, 1 << 20);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if fits(middle) { low = middle } else { high = middle }
    }
    (low - (low + 1) % 2) as i64
}

/// All places where the quotient is not zero.
fn places(quotient: &Quotient) -> Vec<Place> {
    let nonzero = |top: bool, f: &[u64]| -> Vec<Place> {
        (0..f.len()).filter(|&power| f[power] != 0).map(|power| Place { top, power }).collect()
    };
    [nonzero(false, &quotient.denominator), nonzero(true, &quotient.numerator)].concat()
}

/// Leading and lowest places of denominator and numerator.
fn outer_places(quotient: &Quotient) -> Vec<Place> {
    let all = places(quotient);
    let ends = |top: bool| {
        let part: Vec<Place> = all.iter().copied().filter(|place| place.top == top).collect();
        let mut ends: Vec<Place> = part.last().into_iter().chain(part.first()).copied().collect();
        ends.dedup();
        ends
    };
    [ends(false), ends(true)].concat()
}

/// Weights in the order of trial. First single variables, if there are few. Else different weights for all variables,
/// which usually isolate a corner of every support. Then larger random weights.
pub(super) fn weight_vectors(parameters: usize) -> Vec<Vec<u32>> {
    let mut stream = SplitMix64::new(1);
    if parameters <= 2 {
        let unit = |v: usize| (0..parameters).map(|k| u32::from(k == v)).collect();
        let random = |height: u64| random_weights(parameters, height, &mut stream);
        return (0..parameters).map(unit).chain((2..=40).map(random)).collect();
    }
    let permuted = |_| {
        let mut weights: Vec<u32> = (0..parameters as u32).collect();
        (1..parameters).rev().for_each(|k| weights.swap(k, stream.word() as usize % (k + 1)));
        weights
    };
    let mut vectors: Vec<Vec<u32>> = Vec::new();
    for weights in (0..12).map(permuted) {
        if !vectors.contains(&weights) {
            vectors.push(weights);
        }
    }
    vectors.extend((4..=40).map(|height| random_weights(parameters, height, &mut stream)));
    vectors
}

/// Random weights below `height`; one of them is one.
fn random_weights(parameters: usize, height: u64, stream: &mut SplitMix64) -> Vec<u32> {
    let mut weights: Vec<u32> = (0..parameters).map(|_| (stream.word() % height) as u32).collect();
    weights[stream.word() as usize % parameters] = 1;
    weights
}
