//! The numbers that the solver decides by, for those who print it ([`Constants`]).

use serde::Serialize;

use super::{answers, candidates, curve, polish, reduce, solve};
use crate::roots::EIGEN_STEPS;

/// What the modules beside this one define.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Constants {
    pub merge: f64,
    pub accept: f64,
    pub sound: f64,
    pub clear: f64,
    pub accurate: f64,
    pub unknown: f64,
    pub off: f64,
    pub far_off: f64,
    pub disturbances: Vec<f64>,
    pub direction: [f64; 3],
    pub origins: Vec<f64>,
    pub sound_origin: f64,
    pub blurred: f64,
    pub crowded: f64,
    pub long: f64,
    pub stages: usize,
    pub steps: usize,
    pub exact: f64,
    pub rounding: f64,
    pub shortened: usize,
    pub longest: f64,
    pub singular: f64,
    pub weak: f64,
    pub apart: f64,
    pub alike: f64,
    pub deepest: f64,
    /// QR steps for one deflation.
    pub max_steps: usize,
    /// Rounds of inverse iteration.
    pub rounds: usize,
    pub curve: Curve,
}

/// What walks along curves decide by.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Curve {
    pub rank: f64,
    pub steep: f64,
    pub flat: f64,
    pub early: usize,
    pub adrift: f64,
    pub level: f64,
    pub settled: f64,
    pub stride: f64,
    pub short: f64,
    pub rounds: usize,
    pub few: usize,
    pub paces: usize,
    pub narrowed: usize,
}

impl Curve {
    fn new() -> Self {
        Curve {
            rank: curve::RANK,
            steep: curve::STEEP,
            adrift: curve::ADRIFT,
            level: curve::LEVEL,
            settled: curve::SETTLED,
            stride: curve::STRIDE,
            short: curve::SHORT,
            flat: curve::FLAT,
            early: curve::EARLY,
            rounds: curve::ROUNDS,
            few: curve::FEW,
            paces: curve::PACES,
            narrowed: curve::NARROWED,
        }
    }
}

impl Constants {
    /// Those of doubles.
    pub fn new() -> Self {
        let [max_steps, rounds] = EIGEN_STEPS;
        Constants {
            max_steps,
            rounds,
            merge: answers::MERGE,
            accept: answers::ACCEPT,
            sound: solve::SOUND,
            clear: solve::CLEAR,
            accurate: solve::ACCURATE,
            unknown: solve::UNKNOWN,
            off: solve::OFF,
            far_off: solve::FAR_OFF,
            disturbances: solve::DISTURBANCES.to_vec(),
            direction: solve::DIRECTION,
            origins: candidates::ORIGINS.to_vec(),
            sound_origin: candidates::SOUND,
            blurred: candidates::BLURRED,
            crowded: candidates::CROWDED,
            long: solve::LONG,
            stages: solve::STAGES,
            steps: polish::STEPS,
            exact: polish::EXACT,
            rounding: polish::ROUNDING,
            shortened: polish::SHORTENED,
            longest: polish::LONGEST,
            singular: polish::SINGULAR,
            weak: reduce::WEAK,
            apart: answers::APART,
            alike: answers::ALIKE,
            deepest: candidates::DEEPEST,
            curve: Curve::new(),
        }
    }
}
