//! Estimate of the number of points for interpolation, up to the caller's limit.

use super::learn::{MOST_NODES, weight_vectors};
use super::line::Nodes;
use super::pattern::{Functions, distinct_units, points_on_lines};
use super::prime::{Prime, SmoothPrime};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// Number of nodes that are evaluated together.
const STEP: usize = 8;

/// The values of all functions on one line, at the nodes evaluated so far.
pub(super) struct Estimate {
    field: Prime,
    nodes: Vec<u64>,
    weights: Vec<u32>,
    direction: Vec<u64>,
    values: Vec<Vec<u64>>,
    /// The function that last showed that there were not enough nodes.
    hardest: usize,
    /// The number of nodes for all functions, once it is known.
    needed: Option<usize>,
}

impl Estimate {
    /// An empty estimate for functions of this many parameters.
    pub fn new(parameters: usize) -> Self {
        let [prime, ..] = SmoothPrime::all();
        let (field, mut stream) = (prime.field, SplitMix64::new(0));
        let nodes = distinct_units(field, &mut stream, MOST_NODES);
        let direction = (0..parameters).map(|_| stream.unit(field.p)).collect();
        let weights = weight_vectors(parameters).swap_remove(0);
        Estimate { field, nodes, weights, direction, values: Vec::new(), hardest: 0, needed: None }
    }

    /// Twice the square of the number of nodes on one line. As many lines as a line has nodes usually determine the
    /// functions, half of the time with other weights. If the estimate reaches `enough`, the result is a lower bound.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub fn points(&mut self, functions: &impl Functions, enough: usize, watch: &Watch) -> Result<usize> {
        let most = enough.div_ceil(2).isqrt().saturating_add(1).min(MOST_NODES);
        while self.needed.is_none() && self.values.len() < most && functions.count() > 0 {
            if !self.extend(functions, watch)? {
                break;
            }
        }
        let count = if functions.count() == 0 { 0 } else { self.needed.unwrap_or(most.max(self.values.len())) };
        Ok(2 * count * count)
    }

    /// Evaluates more nodes; `false` where a function has no value.
    fn extend(&mut self, functions: &impl Functions, watch: &Watch) -> Result<bool> {
        let (first, ones) = (self.values.len(), vec![1; self.weights.len()]);
        let next = if first < 4 * STEP { first + STEP } else { 2 * first };
        let nodes = &self.nodes[first..next.min(MOST_NODES)];
        let points = points_on_lines(nodes, self.field, &self.weights, (&self.direction, &ones), 0..1);
        for row in functions.values(self.field, &points, watch)? {
            let Some(row) = row else { return Ok(false) };
            self.values.push(row);
        }
        self.needed = self.nodes_needed(functions.count());
        Ok(true)
    }

    /// The number of nodes that all functions need; `None` when there are not enough.
    fn nodes_needed(&mut self, count: usize) -> Option<usize> {
        let nodes = Nodes::new(self.field, self.nodes[..self.values.len()].to_vec());
        let mut needed = 1;
        for f in (self.hardest..count).chain(0..self.hardest) {
            let values: Vec<u64> = self.values.iter().map(|row| row[f]).collect();
            let Some(quotient) = nodes.quotient(&values) else {
                self.hardest = f;
                return None;
            };
            let (top, bottom) = quotient.degrees();
            needed = needed.max(top + bottom + 1);
        }
        Some(needed)
    }
}
