//! Random subproblems with a solution known by construction, and the quality of a solver's solutions.

use groebot_robot::kinematics::oracle::{Oracle, Unknown};
use groebot_robot::kinematics::screw::values::{Answers, Values};
use groebot_robot::spatial::{Axis, Screw, angle};
use nalgebra::{DMatrix, Point3, Unit, Vector3};

use super::turned;

/// A random stream that depends on the seed only: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number between `low` and `high`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An integer from `low` to `high`.
    pub fn integer(&mut self, low: i32, high: i32) -> i32 {
        low + (self.next() % (high - low + 1) as u64) as i32
    }

    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.within(-1.0, 1.0))
    }

    pub fn point(&mut self) -> Point3<f64> {
        Point3::from(self.vector())
    }

    pub fn direction(&mut self) -> Unit<Vector3<f64>> {
        loop {
            let v = self.vector();
            if (0.1..1.0).contains(&v.norm()) {
                return Unit::new_normalize(v);
            }
        }
    }

    /// A direction perpendicular to `w`.
    pub fn across(&mut self, w: &Vector3<f64>) -> Unit<Vector3<f64>> {
        loop {
            let v = w.cross(&self.vector());
            if v.norm() > 0.1 * w.norm() {
                return Unit::new_normalize(v);
            }
        }
    }

    pub fn angle(&mut self) -> f64 {
        self.within(-std::f64::consts::PI, std::f64::consts::PI)
    }

    pub fn axis(&mut self) -> Axis {
        Axis::central(self.direction()).shifted(&self.vector())
    }

    /// A revolute or prismatic joint.
    pub fn screw(&mut self, turns: bool) -> Screw {
        if turns { Screw::Revolute(self.axis()) } else { Screw::Prismatic(self.direction()) }
    }
}

/// `p` moved by a joint, by nalgebra's rotation.
pub fn moved(screw: &Screw, q: f64, p: &Point3<f64>) -> Point3<f64> {
    match screw {
        Screw::Revolute(axis) => turned(axis, q, p),
        Screw::Prismatic(direction) => p + direction.into_inner() * q,
    }
}

/// `p` moved by all joints, the last one first.
pub fn carried(screws: &[Screw], q: &[f64], p: &Point3<f64>) -> Point3<f64> {
    screws.iter().zip(q).rev().fold(*p, |x, (screw, q)| moved(screw, *q, &x))
}

/// A subproblem.
pub struct Question<'a> {
    /// The unit of each unknown: one radian, or the size of the problem for a displacement.
    pub units: &'a [f64],
    /// Which unknowns are angles.
    pub turns: &'a [bool],
    /// The residuals, relative to the size of the problem.
    pub misses: &'a dyn Fn(&[f64]) -> Vec<f64>,
}

/// Quality of the solutions to a subproblem with a known solution.
#[derive(Debug)]
pub struct Verdict {
    /// The relative residual of each solution.
    pub residuals: Vec<f64>,
    /// Distance of the known solution from the nearest one, in the unknowns' units.
    pub nearest: f64,
    /// A lower bound of the smallest singular value of the derivative at the known solution.
    pub sigma: f64,
    /// The smallest distance of two solutions.
    pub apart: f64,
    /// Whether all angles are in (-pi, pi].
    pub in_range: bool,
}

impl Question<'_> {
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let part = |i: usize| if self.turns[i] { angle::difference(a[i], b[i]) } else { (a[i] - b[i]) / self.units[i] };
        (0..a.len()).map(|i| part(i).abs()).fold(0.0, f64::max)
    }

    /// A lower bound of the smallest singular value of the derivative at `q`: its volume divided by its length. By
    /// central differences and a QR decomposition.
    pub fn sigma(&self, q: &[f64]) -> f64 {
        const STEP: f64 = 1e-5;
        let column = |i: usize| {
            let at = |step: f64| {
                let mut moved = q.to_vec();
                moved[i] += step * self.units[i];
                (self.misses)(&moved)
            };
            let (ahead, after) = (at(STEP), at(-STEP));
            ahead.iter().zip(after).map(|(a, b)| (a - b) / (2.0 * STEP)).collect::<Vec<_>>()
        };
        let columns: Vec<f64> = (0..q.len()).flat_map(column).collect();
        let jacobian = DMatrix::from_column_slice(columns.len() / q.len(), q.len(), &columns);
        let length = jacobian.norm();
        let volume: f64 = jacobian.qr().r().diagonal().iter().map(|r| r.abs()).product();
        volume / length.powi(q.len() as i32 - 1)
    }

    /// Euclidean norm of the residual.
    pub fn residual(&self, q: &[f64]) -> f64 {
        (self.misses)(q).iter().map(|miss| miss * miss).sum::<f64>().sqrt()
    }

    pub fn judge(&self, known: &[f64], answers: &[Vec<Option<f64>>]) -> Verdict {
        let filled = |answer: &Vec<Option<f64>>| answer.iter().map(|q| q.unwrap_or(0.0)).collect::<Vec<_>>();
        let list: Vec<Vec<f64>> = answers.iter().map(filled).collect();
        // A solution with a free joint represents a curve of solutions.
        let is_free = answers.iter().flatten().any(Option::is_none);
        let near = |a: &Vec<f64>| if is_free { 0.0 } else { self.distance(a, known) };
        let pairs = (0..list.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let turns = |a: &Vec<f64>| (0..a.len()).all(|i| !self.turns[i] || angle::wrap(a[i]) == a[i]);
        Verdict {
            residuals: list.iter().map(|a| self.residual(a)).collect(),
            nearest: list.iter().map(near).fold(f64::INFINITY, f64::min),
            sigma: self.sigma(known),
            apart: pairs.map(|(i, j)| self.distance(&list[i], &list[j])).fold(f64::INFINITY, f64::min),
            in_range: list.iter().all(turns),
        }
    }
}

impl Verdict {
    /// Whether the known solution is missing. A residual may reach the tolerance, 1e-12 of the size. It displaces a
    /// simple solution by 1e-12 / sigma, and a double solution with curvature c by sqrt(1e-12 / c).
    pub fn is_lost(&self) -> bool {
        self.nearest > 1e-9 + (1e-12 / self.sigma).min(1e-2)
    }
}

/// The values of one joint as solutions.
pub fn list(values: Values) -> Vec<Vec<Option<f64>>> {
    match values {
        Values::Free => vec![vec![None]],
        values => values.iter().map(|q| vec![Some(q)]).collect(),
    }
}

/// Evaluates solutions of `screws p = k`.
pub fn judge<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    k: &Point3<f64>,
    known: &[f64; N],
    answers: &Answers<N>,
) -> Verdict {
    let size = size(screws, p, k);
    let turns = screws.map(|screw| screw.axis().is_some());
    let misses = |q: &[f64]| ((carried(screws, q, p) - k) / size).iter().copied().collect();
    let units = turns.map(|turns| if turns { 1.0 } else { size });
    let answers: Vec<_> = answers.iter().map(|answer| answer.to_vec()).collect();
    Question { units: &units, turns: &turns, misses: &misses }.judge(known, &answers)
}

/// The size of a subproblem of several joints as in `values.rs`: the largest distance of p and k from the axes' points
/// and from each other.
pub fn size(screws: &[Screw], p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let centres = screws.iter().filter_map(|screw| screw.axis()).map(Axis::point);
    centres.map(|c| (p - c).norm().max((k - c).norm())).fold((k - p).norm(), f64::max)
}

/// The smallest distance from `k` on a grid of `steps` values of each joint, with displacements up to 3.
pub fn least_distance(screws: &[Screw], p: &Point3<f64>, k: &Point3<f64>, steps: usize) -> f64 {
    let value = |i: usize, number: usize| {
        let share = (number / steps.pow(i as u32) % steps) as f64 / steps as f64;
        if screws[i].axis().is_some() { std::f64::consts::TAU * share } else { 6.0 * share - 3.0 }
    };
    let distance = |number: usize| {
        let q: Vec<f64> = (0..screws.len()).map(|i| value(i, number)).collect();
        (carried(screws, &q, p) - k).norm()
    };
    (0..steps.pow(screws.len() as u32)).map(distance).fold(f64::INFINITY, f64::min)
}

/// The number of solutions of `screws p = k` that the numeric oracle finds.
pub fn oracle_count(screws: &[Screw], p: &Point3<f64>, k: &Point3<f64>) -> usize {
    let unknown = |screw: &Screw| match screw {
        Screw::Revolute(_) => Unknown::Angle,
        Screw::Prismatic(_) => Unknown::Displacement { low: -3.0, high: 3.0 },
    };
    let unknowns: Vec<Unknown> = screws.iter().map(unknown).collect();
    let oracle = Oracle { seeds: 200, ..Oracle::default() };
    let miss = |q: &[f64]| (carried(screws, q, p) - k).iter().copied().collect();
    oracle.search(&unknowns, miss).unwrap().len()
}

/// Same joint, but scaled by `unit`.
pub fn scaled(screw: &Screw, unit: f64) -> Screw {
    match screw {
        Screw::Revolute(axis) => {
            Screw::Revolute(Axis::central(axis.direction()).shifted(&(axis.point().coords * unit)))
        }
        sliding => *sliding,
    }
}
