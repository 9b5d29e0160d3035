//! The derivation of solvers for any six joints. It finds the formulations of the eigenvalue problem that are regular, proved modulo primes, and those that are
//! accurate ([`formulations`], [`crate::solver::eigenvalue::SixAxes`]).

mod given;
mod method;
mod profile;
mod program;
mod rank;
mod report;
mod residue;
mod rows;
mod screw;
mod survey;
mod vector;

pub(super) use method::{Claims, is_certificate};
pub use method::{Eigenvalue, EigenvalueView};
pub use rank::Determinant;
pub use residue::Residue;
pub use survey::survey;

use given::Six;
use groebot_runtime::six_axes;
use num_traits::ToPrimitive;

use crate::solver::eigenvalue::{Formulation, Layout, Line};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::primes_below;
use groebot_robot::kinematics::{Chain, JointKind};
use groebot_robot::spatial::Screw;

/// The number of primes at which a formulation's determinant is evaluated.
const PRIMES: usize = 3;

/// A formulation whose equations are independent for a generic target.
#[derive(Clone, Debug, PartialEq)]
pub struct Regular {
    /// The formulation.
    pub formulation: Formulation,
    /// Its determinants modulo primes. At least one is not zero, which is the proof.
    pub determinants: Vec<Determinant>,
}

/// The regular formulations of `chain`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a chain that does not fit the eigenvalue problem ([`fits`]).
pub fn formulations(chain: &Chain) -> Result<Vec<Regular>> {
    let six = Six::of(chain)?;
    let mut regular = Vec::new();
    for formulation in all() {
        let primes = primes_below(1 << 31).enumerate();
        let found = primes.map(|(seed, prime)| Determinant::of_six(&six, formulation, prime, seed as u64));
        let determinants: Vec<Determinant> = found.filter_map(Result::ok).take(PRIMES).collect();
        if determinants.iter().any(|determinant| determinant.value != 0) {
            regular.push(Regular { formulation, determinants });
        }
    }
    Ok(regular)
}

/// All formulations.
pub fn all() -> impl Iterator<Item = Formulation> {
    (0..6).flat_map(|hidden| [false, true].map(|second| Formulation { hidden, second }))
}

/// Checks that the eigenvalue problem fits `chain`: a pose with six unknown joints, and all others given, anywhere in the chain.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the supported chains.
pub fn fits(chain: &Chain) -> Result<()> {
    Six::of(chain).map(drop)
}

/// By joint of a chain of six: whether it is prismatic.
fn slides(chain: &Chain) -> [bool; 6] {
    std::array::from_fn(|joint| chain.joints()[joint].kind == JointKind::Prismatic)
}

/// The axes of the joints of a chain of six. Directions have length one; points are in the chain's length unit.
pub(crate) fn layout(chain: &Chain) -> Layout {
    let lines = std::array::from_fn(|joint| line(chain, joint));
    Layout { lines, slides: slides(chain), length: typical_length(&lines) }
}

/// The axis of a joint at zero joint values. The point of a prismatic joint is that of its description.
pub(in crate::derive) fn line(chain: &Chain, joint: usize) -> Line {
    match &chain.screws()[joint] {
        Screw::Revolute(axis) => {
            Line { direction: axis.direction().into_inner().into(), point: axis.point().coords.into() }
        }
        Screw::Prismatic(direction) => {
            let point = chain.joints()[joint].point.each_ref().map(|entry| entry.to_f64().unwrap_or(0.0));
            Line { direction: direction.into_inner().into(), point }
        }
    }
}

/// The solver of `chain`, with its best regular formulations in order. Given joints are at zero.
///
/// # Errors
/// As [`formulations`]; [`ErrorKind::Unsupported`] if no formulation is regular and accurate.
pub fn solver(chain: &Chain) -> Result<six_axes::Chain> {
    let best: Vec<Formulation> = ranked(chain)?.into_iter().map(|regular| regular.formulation).collect();
    Ok(layout(&Six::of(chain)?.chain).chain(&program::tip(chain), &best))
}

/// The regular formulations of `chain` that are accurate, the most accurate first. There is at least one.
///
/// # Errors
/// As [`formulations`]; [`ErrorKind::Unsupported`] if no formulation is regular and accurate.
pub(super) fn ranked(chain: &Chain) -> Result<Vec<Regular>> {
    let regular = formulations(chain)?;
    let known: Vec<Formulation> = regular.iter().map(|regular| regular.formulation).collect();
    let six = Six::of(chain)?;
    let best = survey::with_given(&layout(&six.chain), &six.between, &known);
    if best.is_empty() {
        let text = "no formulation of the eigenvalue problem is regular and accurate for this chain";
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let proof = |formulation: &Formulation| regular.iter().find(|regular| regular.formulation == *formulation).cloned();
    Ok(best.iter().filter_map(proof).collect())
}

/// The greatest distance between the points of two consecutive axes; one if all points are equal.
fn typical_length(lines: &[Line; 6]) -> f64 {
    let distance = |a: &Line, b: &Line| (0..3).map(|k| (a.point[k] - b.point[k]).powi(2)).sum::<f64>().sqrt();
    let longest = lines.windows(2).map(|pair| distance(&pair[0], &pair[1])).fold(0.0, f64::max);
    if longest > 0.0 { longest } else { 1.0 }
}
