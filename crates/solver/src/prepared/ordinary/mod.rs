//! Ordinary targets: one case of each block applies, so that all candidates come from straight-line code. Main type:
//! [`Ordinary`].
//!
//! Many targets are solved several at once, one per lane. Of one target, all candidates are found at once, one per lane.
//! Where a target is not ordinary, the run time solves it, with the same operations and more.

mod execute;
mod graph;
mod many;
mod one;
mod plan;

use groebot_runtime::lanes::{Lanes, Mask};
use groebot_runtime::tolerances::ACCEPTANCE;
use groebot_runtime::{Joint, Number};

use self::execute::{Row, WIDTH};
use self::graph::Graph;
use self::plan::{Abreast, Plan, Rows};
use crate::{Facts, Layout};

/// The maximal number of a target's numbers.
const MOST_INPUTS: usize = 32;

/// The code for ordinary targets.
#[derive(Clone, Debug)]
pub(super) struct Ordinary {
    many: Plan,
    one: Plan,
    /// The number of candidates in a row of values, 1 or 2: the second one of a pair differs in signs.
    twins: usize,
    /// By place, whether its sign changes in the second candidate of a pair.
    turned: Vec<bool>,
    branches: Vec<usize>,
    /// By size, the equations that have it.
    of_size: Vec<Vec<usize>>,
}

impl Ordinary {
    /// The code of a program whose targets may be solved several at once.
    pub fn new(layout: &Layout<'_>, facts: &Facts) -> Option<Self> {
        let graph = Graph::new(layout, facts).filter(|_| (1..=MOST_INPUTS).contains(&facts.inputs))?;
        let (candidates, twins) = (facts.candidates, facts.twins);
        let roots = graph.roots - usize::from(twins == 2);
        let of_size = |size| (0..facts.equations).filter(|&equation| facts.size_of[equation] == size).collect();
        Some(Ordinary {
            many: Plan::new(&graph, Abreast::Targets { roots }),
            one: Plan::new(&graph, Abreast::Candidates { rows: candidates.div_ceil(WIDTH) }),
            twins,
            turned: (0..facts.places).map(|place| twins == 2 && facts.turned.contains(&place)).collect(),
            of_size: (0..facts.sizes.len()).map(of_size).collect(),
            branches: graph.branches,
        })
    }

    /// The residual and the relative residual in each lane of a row.
    #[inline(always)]
    fn measure(&self, plan: &Plan, memory: &[Row], row: usize) -> [Lanes<WIDTH>; 2] {
        let number = |rows: &Rows| memory[rows.at(row)].0;
        let [mut residual, mut relative] = [Lanes::of(0.0); 2];
        for (size, equations) in plan.sizes.iter().zip(&self.of_size) {
            let mut largest = Lanes::of(0.0);
            for &equation in equations {
                largest = largest.greater(number(&plan.residuals[equation]).abs());
            }
            residual = residual.greater(largest);
            relative = relative.greater(largest / number(size).max(Lanes::of(f64::MIN_POSITIVE)));
        }
        [residual, relative]
    }
}

/// Whether a relative residual is not within rounding.
#[inline(always)]
fn misses(relative: Lanes<WIDTH>) -> Mask<WIDTH> {
    Lanes::of(ACCEPTANCE.rounding).exceeds(relative).inverted()
}

/// Whether a joint's numbers are not finite, or not a cosine and a sine.
#[inline(always)]
fn is_unsound(joint: Joint, number: impl Fn(usize) -> Lanes<WIDTH>) -> Mask<WIDTH> {
    match joint {
        Joint::Angle([c, s]) => {
            let (c, s) = (number(c), number(s));
            Lanes::of(ACCEPTANCE.rounding).exceeds((c * c + s * s - 1.0).abs()).inverted()
        }
        Joint::Length(place) => Lanes::of(f64::MAX).exceeds(number(place).abs()).inverted(),
    }
}
