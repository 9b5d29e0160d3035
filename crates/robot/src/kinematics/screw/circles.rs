//! IK-Geo's six subproblems: Elias and Wen, "IK-Geo: Unified Robot Inverse Kinematics Using Subproblem Decomposition"
//! (2022).
//!
//! Rotations R(k, q) about unit directions `k` through the origin. The first five are the subproblems of
//! [`super::one_joint`], [`super::two_joints`] and [`super::three_joints`] in another notation. The sixth has two
//! equations in two angles. Lengths in one unit, angles in radians, tolerances as in [`super::values`].

use nalgebra::{Matrix2, Point3, Unit, Vector2, Vector3};

use super::one_joint::{rotate_to_distance, rotate_to_plane, rotate_to_point};
use super::three_joints::three_screws_to_point;
use super::trigonometric::zeros_to;
use super::turn::Turn;
use super::two_joints::two_screws_to_point;
use super::values::{Answers, Reach, Values};
use crate::spatial::{Axis, Screw, angle};

/// Maximum number of refinement steps.
const STEPS: usize = 24;

type Direction = Unit<Vector3<f64>>;

/// Subproblem 1, circle and point: `R(k, q) p1 = p2`.
pub fn circle_point(k: &Direction, p1: &Vector3<f64>, p2: &Vector3<f64>, reach: Reach) -> Values {
    rotate_to_point(&Axis::central(*k), &point(p1), &point(p2), reach)
}

/// Subproblem 2, two circles: `R(k1, q1) p1 = R(k2, q2) p2`. Up to two solutions.
pub fn two_circles(k: [&Direction; 2], p1: &Vector3<f64>, p2: &Vector3<f64>, reach: Reach) -> Answers<2> {
    let [first, second] = k.map(|k| Screw::Revolute(Axis::central(*k)));
    let found = two_screws_to_point(&second, &first, &point(p1), &point(p2), reach);
    found.iter().map(|[back, q1]| [*q1, back.map(|q| -q)]).collect()
}

/// Subproblem 3, circle and sphere: `|R(k, q) p1 - p2| = d`. Up to two values.
pub fn circle_sphere(k: &Direction, p1: &Vector3<f64>, p2: &Vector3<f64>, d: f64, reach: Reach) -> Values {
    rotate_to_distance(&Axis::central(*k), &point(p1), &point(p2), d, reach)
}

/// Subproblem 4, circle and plane: `h . R(k, q) p = d`, h of length one. Up to two values.
pub fn circle_plane(h: &Direction, k: &Direction, p: &Vector3<f64>, d: f64, reach: Reach) -> Values {
    rotate_to_plane(&Axis::central(*k), &point(p), h, &point(&h.scale(d)), reach)
}

/// Subproblem 5, three circles: `p0 + R(k1, q1) p1 = R(k2, q2) (p2 + R(k3, q3) p3)`. Up to four solutions.
pub fn three_circles(k: [&Direction; 3], p: [&Vector3<f64>; 4], reach: Reach) -> Answers<3> {
    let axis = |k: &Direction, centre: &Vector3<f64>| Screw::Revolute(Axis::central(*k).shifted(centre));
    let screws = [axis(k[0], p[0]), axis(k[1], &Vector3::zeros()), axis(k[2], p[2])];
    let (from, to) = (point(&(p[2] + p[3])), point(&(p[0] + p[1])));
    let found = three_screws_to_point([&screws[0], &screws[1], &screws[2]], &from, &to, reach);
    found.iter().map(|[q1, q2, q3]| [q1.map(|q| -q), *q2, *q3]).collect()
}

/// Subproblem 6, four circles: `h1 . R(k1, q1) p1 + h2 . R(k2, q2) p2 = d1` and `h3 . R(k3, q1) p3 + h4 . R(k4, q2) p4
/// = d2`.
///
/// Up to four solutions. [`Reach::Closest`] adds none, because the equations have no common unit for a distance.
pub fn four_circles(
    h: [Vector3<f64>; 4],
    k: [Direction; 4],
    p: [Vector3<f64>; 4],
    [d1, d2]: [f64; 2],
    reach: Reach,
) -> Answers<2> {
    let terms: [Harmonic; 4] = std::array::from_fn(|i| Harmonic::new(&h[i], &k[i], &p[i]));
    let constant = [d1 - terms[0].constant - terms[1].constant, d2 - terms[2].constant - terms[3].constant];
    let pair = Pair { first: [terms[0].arm, terms[2].arm], second: [terms[1].arm, terms[3].arm], constant };
    pair.solve(reach)
}

/// `h . R(k, q) p = constant + arm . (cos q, sin q)`.
struct Harmonic {
    constant: f64,
    /// A vector in the plane z = 0.
    arm: Vector3<f64>,
}

impl Harmonic {
    fn new(h: &Vector3<f64>, k: &Direction, p: &Vector3<f64>) -> Self {
        let along = h.dot(k) * p.dot(k);
        Harmonic { constant: along, arm: Vector3::new(h.dot(p) - along, h.dot(&k.cross(p)), 0.0) }
    }
}

/// `first_i . (cos q1, sin q1) + second_i . (cos q2, sin q2) = constant_i`, i = 1, 2.
struct Pair {
    first: [Vector3<f64>; 2],
    second: [Vector3<f64>; 2],
    constant: [f64; 2],
}

impl Pair {
    fn solve(&self, reach: Reach) -> Answers<2> {
        let z = Vector3::z_axis();
        let (forth, back) = (Turn::new(&z, self.first), Turn::new(&z, self.second));
        let (turn, here, there, swapped) = if forth.is_singular() && !back.is_singular() {
            (back, self.second, self.first, true)
        } else {
            (forth, self.first, self.second, false)
        };
        let size = (0..2).map(|i| here[i].norm() + there[i].norm() + self.constant[i].abs()).fold(0.0, f64::max);
        let sides = |q: f64| {
            let (sine, cosine) = q.sin_cos();
            [0, 1].map(|i| self.constant[i] - there[i].x * cosine - there[i].y * sine)
        };
        let x = Vector3::x();
        let mut found: Answers<2> = Answers::default();
        for q in zeros_to(2, turn.grain(1.0, 0.0), |q| turn.condition(&x, sides(q))) {
            for other in turn.angles(&x, sides(q)).into_iter().flatten() {
                let (answer, miss) = self.refine(if swapped { [q, other] } else { [other, q] });
                let same = |known: &[Option<f64>; 2]| {
                    (0..2).all(|i| known[i].is_some_and(|q| angle::difference(q, answer[i]).abs() <= 1e-9))
                };
                if miss <= reach.slack(size) && !found.iter().any(same) {
                    found.push(answer.map(Some));
                }
            }
        }
        found
    }

    fn misses(&self, q: [f64; 2]) -> [f64; 2] {
        let ([s1, s2], [c1, c2]) = (q.map(f64::sin), q.map(f64::cos));
        [0, 1].map(|i| {
            let (a, b) = (self.first[i], self.second[i]);
            a.x * c1 + a.y * s1 + b.x * c2 + b.y * s2 - self.constant[i]
        })
    }

    /// The Jacobian of the residuals by the two angles.
    fn slopes(&self, q: [f64; 2]) -> Matrix2<f64> {
        let ([s1, s2], [c1, c2]) = (q.map(f64::sin), q.map(f64::cos));
        let [a, b] = [0, 1].map(|i| self.first[i].y * c1 - self.first[i].x * s1);
        let [c, d] = [0, 1].map(|i| self.second[i].y * c2 - self.second[i].x * s2);
        Matrix2::new(a, c, b, d)
    }

    /// Gauss-Newton refinement from `q`. Returns the best solution of all steps and the larger of its two residuals.
    /// Near a double solution the residual increases before it decreases.
    fn refine(&self, mut q: [f64; 2]) -> ([f64; 2], f64) {
        let mut miss = Vector2::from(self.misses(q));
        let mut best = (q, miss.amax());
        for _ in 0..STEPS {
            let slopes = self.slopes(q);
            let square = slopes.tr_mul(&slopes);
            let damping = Matrix2::identity() * (1e-15 * square.trace());
            let Some(inverse) = (square + damping).try_inverse() else { break };
            let step = inverse * slopes.tr_mul(&miss);
            q = [q[0] - step.x, q[1] - step.y];
            miss = Vector2::from(self.misses(q));
            if miss.amax() < best.1 {
                best = (q, miss.amax());
            } else if step.amax() <= 8.0 * f64::EPSILON {
                break;
            }
        }
        (best.0.map(angle::wrap), best.1)
    }
}

fn point(v: &Vector3<f64>) -> Point3<f64> {
    Point3::from(*v)
}
