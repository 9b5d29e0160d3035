//! Numbers that the skeletons compare with, and those of the arc tangent.

use serde::Serialize;

use super::printer::number;
use crate::solver::{
    ACCEPT, ADRIFT, ALIKE, ALONE, APART, APPROACHES, ARRIVED, ASIDE, BESIDE, BLUR, CONSISTENT, DISTINCT, DOUBLINGS,
    EIGHTH, FARTHER, FARTHEST, GRAZING, INVERSIONS, LEVER, MEETING, MERGE, MILD, NARROWS, NEAR, OVERSHOT, PATIENCE,
    PIVOT, PLAIN, POLISH_STEPS, POLISHED, REGULAR, REST, RETURNS, ROUNDING, SERIES, SHORT, SINGULAR, STAGES, STEEP,
    STIFF, TINY, TURN, TWIN,
};

/// A critical point where a polynomial misses zero by this share of its size counts as a root: as in the library.
const TANGENT: f64 = 1e-10;

/// The arc tangent of `solver::angle`.
#[derive(Serialize)]
pub(super) struct Arc {
    eighth: String,
    rest: String,
    series: Vec<String>,
}

impl Arc {
    pub fn new() -> Self {
        Arc { eighth: number(EIGHTH), rest: number(REST), series: SERIES.iter().map(|&c| number(c)).collect() }
    }
}

/// What is near, merged, polished: the names of the skeletons for the library's constants.
#[derive(Serialize)]
pub(super) struct Tolerances {
    accept: String,
    merge: String,
    blur: String,
    resolution: String,
    near: String,
    beside: String,
    meeting: String,
    tiny: String,
    pivot: String,
    polish_steps: usize,
    polished: String,
    short: String,
    patience: usize,
    overshot: String,
    adrift: String,
    alike: String,
    distinct: String,
    alone: String,
    aside: String,
    narrows: usize,
    singular: String,
    regular: String,
    doublings: usize,
    apart: String,
    arrived: String,
    lever: String,
    twin: String,
    inversions: usize,
    approaches: usize,
    plain: String,
    steep: String,
    mild: String,
    turn: String,
    farther: String,
    farthest: String,
    returns: usize,
    stiff: String,
    stages: usize,
    consistent: String,
    /// A leading coefficient below this share of the largest coefficient counts as zero.
    negligible: String,
    /// A critical point where a polynomial misses zero by this share of its size counts as a root.
    tangent: String,
    /// The same of the square of a joint's sine behind a quartic, whose roots are off by more.
    grazing: String,
    /// How far a joint may be beyond a limit.
    slack: String,
}

impl Tolerances {
    pub fn new() -> Self {
        Tolerances {
            accept: number(ACCEPT),
            merge: number(MERGE),
            blur: number(BLUR),
            resolution: number(ROUNDING),
            near: number(NEAR),
            beside: number(BESIDE),
            meeting: number(MEETING),
            tiny: number(TINY),
            pivot: number(PIVOT),
            polish_steps: POLISH_STEPS,
            polished: number(POLISHED),
            short: number(SHORT),
            patience: PATIENCE,
            overshot: number(OVERSHOT),
            adrift: number(ADRIFT),
            alike: number(ALIKE),
            distinct: number(DISTINCT),
            alone: number(ALONE),
            aside: number(ASIDE),
            narrows: NARROWS,
            singular: number(SINGULAR),
            regular: number(REGULAR),
            doublings: DOUBLINGS,
            apart: number(APART),
            arrived: number(ARRIVED),
            lever: number(LEVER),
            twin: number(TWIN),
            inversions: INVERSIONS,
            approaches: APPROACHES,
            plain: number(PLAIN),
            steep: number(STEEP),
            mild: number(MILD),
            turn: number(TURN),
            farther: number(FARTHER),
            farthest: number(FARTHEST),
            returns: RETURNS,
            stiff: number(STIFF),
            stages: STAGES,
            consistent: number(CONSISTENT),
            negligible: number(1e-290),
            tangent: number(TANGENT),
            grazing: number(GRAZING),
            slack: number(1e-9),
        }
    }

    /// Those of single precision: what is a share of rounding in double precision is about that share of rounding here, and what is near
    /// the square root of rounding, as merging is, is so here.
    pub fn single() -> Self {
        Tolerances {
            accept: number(3e-5),
            merge: number(2e-3),
            blur: number(3e-2),
            resolution: number(5e-6),
            near: number(1e-2),
            // Nothing that is not found holds this well.
            beside: number(1e-2),
            meeting: number(1e-2),
            pivot: number(1e-4),
            polished: number(2e-7),
            short: number(1e-4),
            adrift: number(1e-3),
            alike: number(1e-6),
            alone: number(5e-6),
            singular: number(3e-5),
            distinct: number(1e-2),
            // Shorter ways are lost in rounding.
            narrows: 1,
            regular: number(1e-2),
            consistent: number(1e-4),
            negligible: number(1e-30),
            tangent: number(1e-4),
            grazing: number(1e-4),
            slack: number(1e-5),
            ..Tolerances::new()
        }
    }
}
