//! The solver of any six revolute joints, offline: which formulations of the eigenvalue problem hold for a chain, proved modulo primes,
//! and which of them are accurate ([`formulations`], [`crate::solver::template::SixAxes`]).

mod derived;
mod program;
mod rank;
mod residue;
mod stages;
mod survey;

pub use derived::DerivedSixAxes;
pub use rank::Determinant;
pub use residue::Residue;
pub use survey::survey;

use crate::kinematics::{Chain, JointKind, Task};
use crate::number::primes_below;
use crate::solver::template::{Formulation, Line, Template};
use crate::spatial::Screw;
use crate::{Error, ErrorKind, Result};

/// Primes at each of which a formulation's determinant is evaluated.
const PRIMES: usize = 3;

/// A formulation whose equations are independent for a generic target.
#[derive(Clone, Debug, PartialEq)]
pub struct Regular {
    /// The formulation.
    pub formulation: Formulation,
    /// One at least is not zero: that proves it.
    pub determinants: Vec<Determinant>,
}

/// The regular formulations of `chain`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a chain of anything but six revolute joints and a task other than a pose.
pub fn formulations(chain: &Chain) -> Result<Vec<Regular>> {
    fits(chain)?;
    let mut regular = Vec::new();
    for formulation in all() {
        let primes = primes_below(1 << 31).enumerate();
        let found = primes.map(|(seed, prime)| Determinant::evaluate(chain, formulation, prime, seed as u64));
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

/// Whether the eigenvalue problem is one for `chain`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] that says what it is for.
pub fn fits(chain: &Chain) -> Result<()> {
    let revolute = chain.joints().iter().all(|joint| joint.kind == JointKind::Revolute);
    if revolute && chain.joints().len() == 6 && chain.task() == Task::Pose && chain.given().is_empty() {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Unsupported, "the eigenvalue problem is for the pose of six revolute joints, none given"))
}

/// The lines of the joints' axes, directions of length one, in the chain's unit of length.
pub fn lines(chain: &Chain) -> Option<[Line<f64>; 6]> {
    let line = |screw: &Screw| match screw {
        Screw::Revolute(axis) => {
            Some(Line { direction: axis.direction().into_inner().into(), point: axis.point().coords.into() })
        }
        Screw::Prismatic(_) => None,
    };
    let lines: Option<Vec<_>> = chain.screws().iter().map(line).collect();
    lines?.try_into().ok()
}

/// The solver of `chain`, its best regular formulations in order.
///
/// # Errors
/// As [`formulations`]; [`ErrorKind::Unsupported`] when no formulation is regular and accurate.
pub fn solver(chain: &Chain) -> Result<Template> {
    let regular: Vec<Formulation> = formulations(chain)?.into_iter().map(|regular| regular.formulation).collect();
    let none =
        || Error::new(ErrorKind::Unsupported, "no formulation of the eigenvalue problem is regular for this chain");
    let lines = lines(chain).ok_or_else(none)?;
    let length = typical_length(&lines);
    let best = survey(&lines, length, &regular);
    if best.is_empty() { Err(none()) } else { Ok(Template::new(lines, length, best)) }
}

/// The longest way from one axis' point to the next one's; one for a chain that is a point.
fn typical_length(lines: &[Line<f64>; 6]) -> f64 {
    let way = |a: &Line<f64>, b: &Line<f64>| (0..3).map(|k| (a.point[k] - b.point[k]).powi(2)).sum::<f64>().sqrt();
    let longest = lines.windows(2).map(|pair| way(&pair[0], &pair[1])).fold(0.0, f64::max);
    if longest > 0.0 { longest } else { 1.0 }
}
