//! Any six joints by one eigenvalue problem: `groebot_runtime::six_axes`, `solver::eigenvalue`, `derive::eigenvalue`.

mod between;
mod counts;
mod curve;
mod derivations;
mod eigenvalues;
mod given;
mod program;
mod regular;
mod robots;
mod round;
mod sliding;
mod solver;

use std::f64::consts::{PI, TAU};

use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::{Chain, ChainParts, Joint, JointKind, LengthUnit, Task, Tip};
use groebot_runtime::six_axes::{self, Answer, Answers, Rigid};
use nalgebra::Vector3;
use num_traits::{One, Zero};

/// Axes with coordinates in tenths of a millimetre and directions in millionths.
pub type Axes = [([i64; 3], [i64; 3]); 6];

/// A deterministic pseudo-random generator: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in \[-1, 1).
    pub fn number(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// An integer from `low` to `high`.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        low + (self.word() % (high - low + 1) as u64) as i64
    }

    /// Six angles in \[-pi, pi).
    pub fn angles(&mut self) -> [f64; 6] {
        std::array::from_fn(|_| PI * self.number())
    }
}

pub fn rational(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// The largest difference of two joint vectors, with angles modulo 2 pi.
pub fn distance(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let difference = |(x, y): (&f64, &f64)| (x - y - TAU * ((x - y) / TAU).round()).abs();
    a.iter().zip(b).map(difference).fold(0.0, f64::max)
}

/// The joint values that reach the target.
pub fn found(answers: &Answers) -> Vec<Answer> {
    answers.as_slice().iter().filter(|answer| !answer.lost).copied().collect()
}

/// The distance between `q` and the nearest solution.
pub fn nearest(answers: &Answers, q: &[f64; 6]) -> f64 {
    found(answers).iter().map(|answer| distance(&answer.q, q)).fold(f64::INFINITY, f64::min)
}

/// The largest error of a solution at the last joint's frame: of a coordinate as a fraction of the chain's length, or of the rotation (rad). Rounding of long
/// displacements is subtracted.
pub fn residual(solver: &six_axes::Chain, answers: &Answers, target: &[f64; 12]) -> f64 {
    let wanted = last_frame(solver, target);
    let miss = |answer: &Answer| {
        let reached = last_frame(solver, &solver.forward(&answer.q));
        let column = |motion: &Rigid, k: usize| Vector3::from(motion.rotation.map(|row| row[k]));
        let turn: Vector3<f64> = (0..3).map(|k| column(&reached, k).cross(&column(&wanted, k)) * 0.5).sum();
        let error = (Vector3::from(wanted.translation) - Vector3::from(reached.translation)).amax();
        let sliding = answer.q.iter().zip(&solver.slides).filter(|(_, slides)| **slides);
        let longest = sliding.map(|(value, _)| value.abs()).fold(0.0, f64::max);
        f64::max((error - 2.0 * f64::EPSILON * longest) / solver.length, turn.amax())
    };
    found(answers).iter().map(miss).fold(0.0, f64::max)
}

/// The frame of the last joint at a target.
fn last_frame(solver: &six_axes::Chain, target: &[f64; 12]) -> Rigid {
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| target[3 + 3 * i + j]));
    let tip = Rigid { rotation, translation: [target[0], target[1], target[2]] };
    let place = solver.last.translation.map(|entry| entry * solver.length);
    tip.after(&solver.back).after(&Rigid { translation: place, ..solver.last })
}

/// The chain of revolute joints with these axes (directions and points), its tip at the origin.
pub fn chain(axes: &[([BigRational; 3], [BigRational; 3])]) -> Chain {
    chain_of(axes, &[])
}

/// Same as [`chain`], but the joints `sliding` are prismatic.
pub fn chain_of(axes: &[([BigRational; 3], [BigRational; 3])], sliding: &[usize]) -> Chain {
    let joint = |(index, (axis, point)): (usize, &([BigRational; 3], [BigRational; 3]))| Joint {
        mimic: None,
        name: format!("Joint{}", index + 1),
        symbol: (index + 1).to_string(),
        kind: if sliding.contains(&index) { JointKind::Prismatic } else { JointKind::Revolute },
        axis: axis.clone(),
        point: point.clone(),
        limits: None,
    };
    let unit = |i: usize, j: usize| if i == j { BigRational::one() } else { BigRational::zero() };
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| unit(i, j)));
    Chain::new(ChainParts {
        name: "chain".to_owned(),
        description: None,
        source: None,
        length_unit: LengthUnit::Metre,
        joints: axes.iter().enumerate().map(joint).collect(),
        tip: Tip { point: [0; 3].map(|_| BigRational::zero()), rotation },
        task: Task::Pose,
        direction: groebot_robot::kinematics::along_z(),
        given: Vec::new(),
        order: None,
        choice: None,
        meant: None,
    })
    .unwrap()
}

/// A chain whose axes have random integer directions and pass through random points within one metre.
pub fn random_chain(random: &mut Random) -> Chain {
    random_chain_of(random, &[])
}

/// Same as [`random_chain`], but the joints `sliding` are prismatic.
pub fn random_chain_of(random: &mut Random, sliding: &[usize]) -> Chain {
    let axes: Vec<_> = (0..6)
        .map(|_| {
            let axis = [0, 1, 2].map(|k| rational(random.integer(-9, 9) + if k == 2 { 20 } else { 0 }, 1));
            let turned = random.integer(0, 2) as usize;
            let axis = [0, 1, 2].map(|k| axis[(k + turned) % 3].clone());
            (axis, [0, 1, 2].map(|_| rational(random.integer(-1000, 1000), 1000)))
        })
        .collect();
    chain_of(&axes, sliding)
}
