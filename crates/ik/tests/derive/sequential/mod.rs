//! Tests of `groebot_ik::derive::sequential`.

mod certificate;
mod families;
mod form_basis;
mod robots;
mod singular;

use std::f64::consts::TAU;

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::{Chain, JointKind, Solution};

/// The derivation of a chain.
fn derive(chain: &Chain) -> Derivation {
    Derivation::sequentially(chain, &Watch::none()).unwrap_or_else(|error| panic!("{}: {error}", chain.name()))
}

/// Knuth's linear congruential generator (The Art of Computer Programming 2, 3.3.4).
struct Random(u64);

impl Random {
    /// A number in (-1, 1).
    fn between(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Joint values of a chain.
    fn joints(&mut self, chain: &Chain) -> Vec<f64> {
        let reach = chain.reach();
        let mut value = |kind: JointKind| match kind {
            JointKind::Revolute => 0.5 * TAU * self.between(),
            JointKind::Prismatic => reach * self.between(),
        };
        chain.joints().iter().map(|joint| value(joint.kind)).collect()
    }
}

/// The largest difference of two joint vectors (rad or length), without the joints in `free`.
fn distance(chain: &Chain, a: &[f64], b: &[f64], free: &[usize]) -> f64 {
    let one = |joint: usize| {
        let difference = a[joint] - b[joint];
        match chain.joints()[joint].kind {
            JointKind::Revolute => difference - TAU * (difference / TAU).round(),
            JointKind::Prismatic => difference,
        }
    };
    (0..a.len()).filter(|joint| !free.contains(joint)).map(one).fold(0.0, |most: f64, d| most.max(d.abs()))
}

/// The distance between the solution's tip and the target, lengths as fractions of the reach.
fn miss(derived: &Derivation, target: &[f64], answer: &Solution) -> f64 {
    let reached = derived.reached(&answer.q).unwrap();
    let size = |name: &str| if name.starts_with('p') && name != "phi" { derived.program().scale } else { 1.0 };
    let gap = |((a, b), name): ((&f64, &f64), &str)| {
        let difference = if name == "phi" { (a - b) - TAU * ((a - b) / TAU).round() } else { a - b };
        difference.abs() / size(name)
    };
    let names = derived.program().inputs.iter().map(|input| input.name.as_str());
    reached.iter().zip(target).zip(names).map(gap).fold(0.0, f64::max)
}
