//! Pseudorandom inputs that are equal on every machine.

use std::f64::consts::PI;

use groebot::kinematics::Chain;
use groebot::spatial::{Axis, Pose};
use nalgebra::{Point3, Vector3};

/// Number of inputs of a measurement.
pub const COUNT: usize = 256;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number, uniform in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// An angle, uniform on the circle \[rad\].
    pub fn angle(&mut self) -> f64 {
        self.between(-PI, PI)
    }

    /// A vector in the cube from -1 to 1, not near its centre.
    pub fn vector(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| self.between(-1.0, 1.0));
            if v.norm() > 0.1 {
                return v;
            }
        }
    }

    /// A point \[m\].
    pub fn point(&mut self) -> Point3<f64> {
        self.vector().into()
    }

    /// An axis through the origin.
    pub fn axis(&mut self) -> Axis {
        Axis::new(self.vector(), Point3::origin()).expect("a vector that is not zero")
    }
}

/// `COUNT` joint vectors of `chain`, uniform on the circles, and the poses of its tip in its length unit.
pub fn poses(chain: &Chain) -> Vec<(Vec<f64>, Pose)> {
    many_poses(chain, COUNT)
}

/// Same as [`poses`], but with `count` poses.
pub fn many_poses(chain: &Chain, count: usize) -> Vec<(Vec<f64>, Pose)> {
    let mut random = Random(7);
    let joints = chain.joints().len();
    let q = (0..count).map(|_| (0..joints).map(|_| random.angle()).collect::<Vec<f64>>());
    q.map(|q| (q.clone(), chain.forward(&q).expect("finite values"))).collect()
}

/// Number of steps of the search for a sign change of the Jacobian's determinant during one turn of a joint.
const STEPS: usize = 64;

/// Singular poses that `chain` reaches. From random joint values one joint is rotated until the Jacobian's determinant changes its sign. The zero is found by
/// bisection to rounding.
pub fn singular_poses(chain: &Chain, count: usize) -> Vec<Pose> {
    let mut random = Random(11);
    let joints = chain.joints().len();
    let mut poses = Vec::with_capacity(count);
    while poses.len() < count {
        let q: Vec<f64> = (0..joints).map(|_| random.angle()).collect();
        let joint = random.bits() as usize % joints;
        if let Some(q) = singular_along(chain, q, joint) {
            poses.push(chain.forward(&q).expect("finite values"));
        }
    }
    poses
}

fn singular_along(chain: &Chain, mut q: Vec<f64>, joint: usize) -> Option<Vec<f64>> {
    let mut determinant = |value: f64| {
        q[joint] = value;
        chain.spatial_jacobian(&q).expect("finite values").fixed_view::<6, 6>(0, 0).determinant()
    };
    let start = -PI;
    let at = |step: usize| start + 2.0 * PI * step as f64 / STEPS as f64;
    let changes =
        |determinant: &mut dyn FnMut(f64) -> f64, step: usize| determinant(at(step)) * determinant(at(step + 1)) < 0.0;
    let step = (0..STEPS).find(|&step| changes(&mut determinant, step))?;
    let (mut low, mut high) = (at(step), at(step + 1));
    let sign = determinant(low).signum();
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        (low, high) = if determinant(middle).signum() == sign { (middle, high) } else { (low, middle) };
    }
    q[joint] = low;
    Some(q)
}
