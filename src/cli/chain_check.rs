//! Numeric checks of a chain's solver by forward kinematics: the joints that made a target are among the answers, and each answer
//! reaches it.

use crate::derive::lift::Derived;
use crate::kinematics::JointKind;
use crate::solver::Solution;
use crate::witness::{Fault, Kind, Report, Row, Verdict};
use crate::{Result, Watch};

/// Number of targets.
const TARGETS: usize = 200;
/// An answer may be this far from its target: a share of the reach, or radians.
const MISS: f64 = 1e-10;
/// The joints of an answer are those that made the target within this (rad, or a share of the reach).
const SAME: f64 = 1e-6;

/// Checks `derived` at random targets: the same ones at every run.
///
/// # Errors
/// What `watch` stops with. Failed checks are in the report.
pub fn check(derived: &Derived, watch: &Watch) -> Result<Report> {
    let mut random = Random(1);
    let mut rows = Vec::with_capacity(TARGETS);
    for number in 0..TARGETS {
        watch.check()?;
        watch.report("check", number, TARGETS - number);
        rows.push(row(derived, number + 1, joints(derived, &mut random))?);
    }
    let names = |list: Vec<&String>| list.into_iter().cloned().collect();
    Ok(Report {
        inputs: names(derived.program.inputs.iter().map(|input| &input.name).collect()),
        joints: names(derived.program.joints.iter().map(|joint| &joint.name).collect()),
        rows,
    })
}

/// Joint values all over their ranges.
fn joints(derived: &Derived, random: &mut Random) -> Vec<f64> {
    let value = |joint: &crate::kinematics::Joint| match joint.kind {
        JointKind::Revolute => std::f64::consts::PI * random.between(),
        JointKind::Prismatic => derived.program.scale * random.between(),
    };
    derived.chain.joints().iter().map(value).collect()
}

fn row(derived: &Derived, number: usize, q: Vec<f64>) -> Result<Row> {
    let target = derived.reached(&q)?;
    let answers = derived.program.solve(&target)?;
    let mut worst = 0.0f64;
    for answer in &answers {
        worst = worst.max(miss(derived, &target, &answer.q)?);
    }
    let nearest = answers.iter().map(|answer| distance(derived, answer, &q)).reduce(f64::min);
    let mut faults = Vec::new();
    faults.extend((!nearest.is_some_and(|nearest| nearest <= SAME)).then_some(Fault::Missing));
    faults.extend((worst.is_nan() || worst > MISS).then_some(Fault::Residual));
    Ok(Row {
        number,
        kind: Kind::Random,
        target,
        joints: Some(q),
        solutions: answers.len(),
        exact: None,
        screw: None,
        oracle: None,
        worst_residual: Some(worst),
        nearest,
        verdict: if faults.is_empty() { Verdict::Pass } else { Verdict::Fail(faults) },
    })
}

/// How far the tip is from its target, lengths as shares of the reach.
fn miss(derived: &Derived, target: &[f64], q: &[f64]) -> Result<f64> {
    let reached = derived.reached(q)?;
    let turn = std::f64::consts::TAU;
    let miss = reached.iter().zip(target).zip(&derived.program.inputs).map(|((a, b), input)| match input.unit {
        crate::solver::Unit::Radian => (a - b - turn * ((a - b) / turn).round()).abs(),
        crate::solver::Unit::One => (a - b).abs(),
        _ => (a - b).abs() / derived.program.scale,
    });
    Ok(miss.fold(0.0, f64::max))
}

/// The largest difference of the joints, free ones left out.
fn distance(derived: &Derived, answer: &Solution, q: &[f64]) -> f64 {
    let turn = std::f64::consts::TAU;
    let joints = derived.chain.joints().iter().enumerate().filter(|(joint, _)| !answer.free.contains(joint));
    let one = |(index, joint): (usize, &crate::kinematics::Joint)| {
        let difference = answer.q[index] - q[index];
        match joint.kind {
            JointKind::Revolute => (difference - turn * (difference / turn).round()).abs(),
            JointKind::Prismatic => difference.abs() / derived.program.scale,
        }
    };
    joints.map(one).fold(0.0, f64::max)
}

/// Knuth's linear congruential generator (The Art of Computer Programming 2, 3.3.4).
struct Random(u64);

impl Random {
    /// A number in (-1, 1).
    fn between(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
