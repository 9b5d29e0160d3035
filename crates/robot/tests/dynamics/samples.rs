//! Random states, a robot with masses, and comparison of vectors.

use groebot_algebra::number::BigRational;
use groebot_robot::dynamics::Base;
use groebot_robot::model::{Mass, Origin, Robot};
use groebot_robot::spatial::Pose;
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};

/// SplitMix64 (Steele, Lea and Flood 2014), numbers between -1 and 1.
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn numbers(&mut self, count: usize, most: f64) -> Vec<f64> {
        (0..count).map(|_| most * self.number()).collect()
    }
}

/// The UR5 of the corpus has no masses: each link gets a different mass, off its axis.
pub fn ur5() -> Robot {
    let mut parts = Robot::from_urdf(include_str!("../../../../tests/corpus/urdf/ur5.urdf")).unwrap().parts().clone();
    let share = |numerator: i64, denominator: i64| BigRational::new(numerator.into(), denominator.into());
    for (number, link) in (1..).zip(&mut parts.links) {
        let mut origin = Origin::identity();
        origin.placement.origin = [share(number, 50), share(-1, 20), share(3, 10 + number)];
        let [little, much] = [share(number, 200), share(number, 40)];
        let moments = [much.clone(), little, share(0, 1), much.clone(), share(-number, 300), much];
        link.mass = Some(Mass { mass: share(9 - number, 2), origin, moments });
    }
    Robot::new(parts).unwrap()
}

/// The configuration of a floating root and of joints.
pub fn floating(random: &mut Random, joints: usize) -> Vec<f64> {
    let mut q = random.numbers(7 + joints, 2.0);
    let length = DVector::from_column_slice(&q[3..7]).norm();
    q[3..7].iter_mut().for_each(|x| *x /= length);
    q
}

pub fn assert_near(found: &DMatrix<f64>, expected: &DMatrix<f64>, share: f64, what: &str) {
    let miss = (found - expected).amax();
    assert!(miss <= share * expected.amax().max(1.0), "{what}: off by {miss:e} of {:e}", expected.amax());
}

/// Asserts that vectors agree.
pub fn near(found: &[f64], expected: &[f64], least: f64, what: &str) {
    let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    let miss = found.iter().zip(expected).fold(0.0, |miss: f64, (a, b)| miss.max((a - b).abs()));
    assert!(found.len() == expected.len() && miss <= least * size, "{what}: off by {miss:e} of {size:e}");
}

/// A configuration after motion with a velocity for a time. The velocity of a floating root is in its own frame.
pub fn moved(base: Base, q: &[f64], velocity: &[f64], time: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    let joints = if base == Base::Fixed { 0 } else { 7 };
    if base == Base::Floating {
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5]));
        let path = groebot_robot::spatial::Twist {
            v: Vector3::from_column_slice(&velocity[..3]) * time,
            w: Vector3::from_column_slice(&velocity[3..6]) * time,
        };
        let pose = Pose::from_parts(Vector3::from_column_slice(&q[..3]).into(), turn) * path.exp(1.0);
        q[..3].copy_from_slice(pose.translation.vector.as_slice());
        q[3..7].copy_from_slice(pose.rotation.coords.as_slice());
    }
    let first = joints.min(6);
    q[joints..].iter_mut().zip(&velocity[first..]).for_each(|(q, rate)| *q += rate * time);
    q
}
