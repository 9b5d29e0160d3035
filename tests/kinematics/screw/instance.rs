//! Instances of subproblems with a known answer, and what is asked of the answers to them.

use std::f64::consts::PI;

use groebot::kinematics::screw::values::Answers;
use groebot::spatial::{Axis, Screw, angle};
use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};

use super::turned;

/// A sequence of random numbers (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * ((z >> 11) as f64 / (1_u64 << 53) as f64)
    }

    pub fn angle(&mut self) -> f64 {
        self.uniform(-PI, PI)
    }

    pub fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.uniform(-size, size))
    }

    pub fn point(&mut self) -> Point3<f64> {
        self.vector(1.0).into()
    }

    pub fn direction(&mut self) -> Unit<Vector3<f64>> {
        loop {
            let v = self.vector(1.0);
            if (0.1..1.0).contains(&v.norm()) {
                return Unit::new_normalize(v);
            }
        }
    }

    pub fn axis(&mut self) -> Axis {
        Axis::new(self.direction().into_inner(), self.point()).unwrap()
    }

    pub fn flip(&mut self) -> f64 {
        if self.uniform(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 }
    }

    pub fn screw(&mut self, revolute: bool) -> Screw {
        if revolute { Screw::Revolute(self.axis()) } else { Screw::Prismatic(self.direction()) }
    }

    pub fn rotation(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_axis_angle(&self.direction(), self.angle())
    }
}

/// `p` moved by one joint, without the library's own motions.
pub fn moved(screw: &Screw, q: f64, p: &Point3<f64>) -> Point3<f64> {
    match screw {
        Screw::Revolute(axis) => turned(axis, q, p),
        Screw::Prismatic(direction) => p + direction.into_inner() * q,
    }
}

/// `p` moved by joints, the last one first.
pub fn forward<const N: usize>(screws: &[Screw; N], q: [f64; N], p: &Point3<f64>) -> Point3<f64> {
    screws.iter().zip(q).rev().fold(*p, |p, (screw, q)| moved(screw, q, &p))
}

/// What the answers to one instance are worth.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// The known answer is not among them.
    pub lost: bool,
    /// One answer stands there twice.
    pub repeated: bool,
    /// The largest residual of an answer, relative to the size.
    pub residual: f64,
    /// How well the known answer is determined: the smallest singular value of the equation, per size.
    pub sigma: f64,
    pub count: usize,
}

/// The distance within which a known answer must be found: 1e-9 when it is well determined.
pub fn matching(sigma: f64) -> f64 {
    if sigma > 1e-3 { 1e-9 } else { (1e-13 / sigma).clamp(1e-7, 1e-5) }
}

/// The difference of two values of a joint.
pub fn apart(screw: &Screw, a: f64, b: f64) -> f64 {
    match screw {
        Screw::Revolute(_) => angle::difference(a, b).abs(),
        Screw::Prismatic(_) => (a - b).abs(),
    }
}

/// Judges the answers to `exp(S1 q1) .. exp(SN qN) p = k`, made from `known`; free joints are tried at several values.
pub fn judge<const N: usize>(screws: &[Screw; N], p: &Point3<f64>, known: [f64; N], answers: &Answers<N>) -> Verdict {
    let k = forward(screws, known, p);
    let size = size(screws, p, &k);
    let sigma = sigma(screws, p, known, size);
    let near = |answer: &[Option<f64>; N]| {
        (0..N).all(|i| answer[i].is_none_or(|q| apart(&screws[i], q, known[i]) <= matching(sigma) * size.max(1.0)))
    };
    let same = |a: &[Option<f64>; N], b: &[Option<f64>; N]| {
        (0..N).all(|i| match (a[i], b[i]) {
            (Some(a), Some(b)) => apart(&screws[i], a, b) <= 1e-8,
            (a, b) => a == b,
        })
    };
    let residual =
        answers.iter().map(|answer| (forward(screws, answer.map(|q| q.unwrap_or(0.0)), p) - k).norm() / size);
    Verdict {
        lost: !answers.iter().any(near),
        repeated: (1..answers.len()).any(|i| (0..i).any(|j| same(&answers[i], &answers[j]))),
        residual: residual.fold(0.0, f64::max),
        sigma,
        count: answers.len(),
    }
}

/// The size of the problem, as the library's documentation defines it.
pub fn size<const N: usize>(screws: &[Screw; N], p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let arm = |screw: &Screw| if let Screw::Revolute(axis) = screw { axis.distance_to(p) } else { 0.0 };
    screws.iter().map(arm).fold((k - p).norm(), f64::max)
}

/// A lower bound of the smallest singular value of the velocities, per size, and of a quarter of the angle between two of them.
pub fn sigma<const N: usize>(screws: &[Screw; N], p: &Point3<f64>, q: [f64; N], size: f64) -> f64 {
    let columns: Vec<Vector3<f64>> = (0..N)
        .map(|i| {
            let elbow = screws[i + 1..].iter().zip(&q[i + 1..]).rev().fold(*p, |p, (screw, q)| moved(screw, *q, &p));
            let velocity = match &screws[i] {
                Screw::Revolute(axis) => axis.direction().cross(&(elbow - axis.point())) / size,
                Screw::Prismatic(direction) => direction.into_inner(),
            };
            let tip = screws[..=i].iter().zip(&q).rev().fold(elbow, |p, (screw, q)| moved(screw, *q, &p));
            let after =
                screws[..=i].iter().zip(&q).rev().fold(elbow + velocity * size, |p, (screw, q)| moved(screw, *q, &p));
            (after - tip) / size
        })
        .collect();
    let norm: f64 = columns.iter().map(|c| c.norm_squared()).sum();
    match columns[..] {
        [a] => a.norm(),
        [a, b] => a.cross(&b).norm() / norm.sqrt(),
        [a, b, c] => 2.0 * a.dot(&b.cross(&c)).abs() / norm,
        _ => unreachable!(),
    }
}
