//! The six subproblems of A. Elias and J. Wen, "IK-Geo: Unified Robot Inverse Kinematics Using Subproblem Decomposition" (2022):
//! rotations R(k, q) about directions k through the origin.
//!
//! Vectors in metres, or in any one unit; angles in (-pi, pi] \[rad\]. 1 to 5 are the subproblems of [one](super::one_joint),
//! [two](super::two_joints) and [three joints](super::three_joints), with their tolerances. Of the sixth, *size* is the largest
//! magnitude of a coefficient or a right-hand side.

use nalgebra::{Matrix2, Point3, SMatrix, SVector, Unit, Vector2, Vector3};
use smallvec::SmallVec;

use super::descent::{Miss, descend};
use super::one_joint::{angles_at_height, rotate_to_distance};
use super::quartic::{Equation, Form, zeros};
use super::three_joints::three_screws_to_point;
use super::two_joints::two_screws_to_point;
use super::values::{Answers, ROUNDING, Reach, TOLERANCE, Values};
use crate::spatial::{Axis, Screw, angle};

/// Subproblem 1: the angle q with `R(k, q) p1 = p2`.
pub fn circle_point(k: &Unit<Vector3<f64>>, p1: &Vector3<f64>, p2: &Vector3<f64>) -> Values {
    circle_sphere(k, p1, p2, 0.0)
}

/// Subproblem 2: the angles with `R(k1, q1) p1 = R(k2, q2) p2`, at most two answers.
pub fn two_circles(
    k1: &Unit<Vector3<f64>>,
    k2: &Unit<Vector3<f64>>,
    p1: &Vector3<f64>,
    p2: &Vector3<f64>,
) -> Answers<2> {
    let (Some(first), Some(second)) = (turn(&-*k1, Vector3::zeros()), turn(k2, Vector3::zeros())) else {
        return Answers::none();
    };
    two_screws_to_point(&first, &second, &(*p2).into(), &(*p1).into(), Reach::EXACT)
}

/// Subproblem 3: the angles q with `|R(k, q) p1 - p2| = d`.
pub fn circle_sphere(k: &Unit<Vector3<f64>>, p1: &Vector3<f64>, p2: &Vector3<f64>, d: f64) -> Values {
    let axis = Axis::new(k.into_inner(), Point3::origin());
    axis.map_or(Values::None, |axis| rotate_to_distance(&axis, &(*p1).into(), &(*p2).into(), d, Reach::EXACT))
}

/// Subproblem 4: the angles q with `h . R(k, q) p = d`, for h of any length.
pub fn circle_plane(h: &Vector3<f64>, k: &Unit<Vector3<f64>>, p: &Vector3<f64>, d: f64) -> Values {
    let [one, c, s] = component(h, k, p);
    angles_at_height(c, s, d - one, (h.norm() * p.norm()).max(d.abs()), Reach::EXACT)
}

/// Subproblem 5: the angles with `p0 + R(k1, q1) p1 = R(k2, q2) (p2 + R(k3, q3) p3)`, at most four answers.
pub fn three_circles(k: [&Unit<Vector3<f64>>; 3], p: [&Vector3<f64>; 4]) -> Answers<3> {
    let [p0, p1, p2, p3] = p.map(|p| *p);
    let screws = (turn(&-*k[0], p0), turn(k[1], Vector3::zeros()), turn(k[2], p2));
    let (Some(first), Some(second), Some(third)) = screws else { return Answers::none() };
    three_screws_to_point([&first, &second, &third], &(p2 + p3).into(), &(p0 + p1).into(), Reach::EXACT)
}

/// Subproblem 6: the angles with `h1 . R(k1, q1) p1 + h2 . R(k2, q2) p2 = d1` and `h3 . R(k3, q1) p3 + h4 . R(k4, q2) p4 = d2`, at
/// most four answers.
///
/// A joint on which neither equation depends is free. Of a family of solutions (both equations depend on one and the same
/// combination of the angles) the member with q2 = 0 is returned, if there is one, and q2 is free.
pub fn four_circles(
    h: [&Vector3<f64>; 4],
    k: [&Unit<Vector3<f64>>; 4],
    p: [&Vector3<f64>; 4],
    d1: f64,
    d2: f64,
) -> Answers<2> {
    let parts: [Form; 4] = std::array::from_fn(|i| component(h[i], k[i], p[i]));
    Waves::new(parts, [d1, d2]).map_or(Answers::none(), |waves| waves.solve())
}

/// `h . R(k, q) p` as coefficients of 1, cos q, sin q.
fn component(h: &Vector3<f64>, k: &Unit<Vector3<f64>>, p: &Vector3<f64>) -> Form {
    let tangent = k.cross(p);
    let height = k.dot(h) * k.dot(p);
    [height, h.dot(&tangent.cross(k)), h.dot(&tangent)]
}

/// The rotation about `k` through a point; `None` when it is not finite.
fn turn(k: &Unit<Vector3<f64>>, point: Vector3<f64>) -> Option<Screw> {
    Screw::revolute(k.into_inner(), point.into()).ok()
}

/// Two equations `A u(q1) + B u(q2) = e`, u being cosine and sine, with coefficients of magnitude one and less.
struct Waves {
    a: Matrix2<f64>,
    b: Matrix2<f64>,
    e: Vector2<f64>,
}

/// Answers nearer than this may be the same \[rad\].
const MERGED: f64 = 1e-3;

impl Waves {
    /// `None` when a number is not finite.
    fn new(parts: [Form; 4], d: [f64; 2]) -> Option<Self> {
        let e = Vector2::new(d[0] - parts[0][0] - parts[1][0], d[1] - parts[2][0] - parts[3][0]);
        let matrix = |i: usize, j: usize| Matrix2::new(parts[i][1], parts[i][2], parts[j][1], parts[j][2]);
        let (a, b) = (matrix(0, 2), matrix(1, 3));
        let terms = parts.iter().flatten().chain(&d);
        let size = terms.fold(0.0, |size: f64, x| if x.is_finite() { size.max(x.abs()) } else { f64::NAN });
        let size = if size == 0.0 { 1.0 } else { size };
        size.is_finite().then(|| Waves { a: a / size, b: b / size, e: e / size })
    }

    fn solve(&self) -> Answers<2> {
        match [self.a, self.b].map(|m| m.norm() <= TOLERANCE) {
            [true, true] if self.e.norm() <= TOLERANCE => Answers::from([Values::Free; 2]),
            [true, true] => Answers::none(),
            [false, true] => self.settle(self.swapped().candidates().iter().map(|&q1| [q1, 0.0])).map(|q| [q[0], None]),
            [true, false] => self.settle(self.candidates().iter().map(|&q2| [0.0, q2])).map(|q| [None, q[1]]),
            [false, false] => self.both(),
        }
    }

    /// The answers when both angles matter.
    fn both(&self) -> Answers<2> {
        if self.equation().vanishes() {
            return self.settle(self.partners(0.0).map(|q1| [q1, 0.0])).map(|q| [q[0], None]);
        }
        if self.a.determinant().abs() * self.b.norm_squared() >= self.b.determinant().abs() * self.a.norm_squared() {
            let list = self.candidates();
            return self.settle(list.iter().flat_map(|&q2| self.partners(q2).map(move |q1| [q1, q2])));
        }
        let swapped = self.swapped();
        let list = swapped.candidates();
        self.settle(list.iter().flat_map(|&q1| swapped.partners(q1).map(move |q2| [q1, q2])))
    }

    /// The same equations with the angles exchanged.
    fn swapped(&self) -> Waves {
        Waves { a: self.b, b: self.a, e: self.e }
    }

    /// The quartic for the second angle: `|adj(A) (e - B u)|^2 = det(A)^2`.
    fn equation(&self) -> Equation {
        let adjugate = Matrix2::new(self.a.m22, -self.a.m12, -self.a.m21, self.a.m11);
        let (constant, waves) = (adjugate * self.e, -adjugate * self.b);
        let form = |i: usize| [constant[i], waves[(i, 0)], waves[(i, 1)]];
        let (one, det) = ([1.0, 0.0, 0.0], self.a.determinant());
        let terms = [(1.0, form(0), form(0)), (1.0, form(1), form(1)), (-det * det, one, one)];
        Equation { turns: true, terms: terms.into_iter().collect() }
    }

    /// Values of the second angle near which all solutions are: where A is singular, or nearly, the combination of the equations
    /// that the first angle hardly enters gives more of them.
    fn candidates(&self) -> SmallVec<[f64; 16]> {
        let mut list = self.equation().candidates();
        let columns = [self.a.column(0), self.a.column(1)];
        let range = if columns[0].norm() >= columns[1].norm() { columns[0] } else { columns[1] };
        let across = Vector2::new(-range.y, range.x);
        let form = [-across.dot(&self.e), across.dot(&self.b.column(0)), across.dot(&self.b.column(1))];
        list.extend(zeros(&form, true));
        list
    }

    /// The first angles that solve one of the equations, or come nearest to it, the second being known.
    fn partners(&self, q2: f64) -> impl Iterator<Item = f64> + use<> {
        let rest = self.e - self.b * Vector2::new(q2.cos(), q2.sin());
        let row = |i: usize| zeros(&[-rest[i], self.a[(i, 0)], self.a[(i, 1)]], true);
        row(0).into_iter().chain(row(1))
    }

    /// The candidates that polishing makes solutions, each once.
    fn settle(&self, candidates: impl Iterator<Item = [f64; 2]>) -> Answers<2> {
        let mut found = SmallVec::<[([f64; 2], f64); 8]>::new();
        for start in candidates {
            let (q, size) = descend(SVector::from(start), 40, |q| self.miss(q));
            let q = [angle::wrap(q[0]), angle::wrap(q[1])];
            if !Reach::EXACT.covers(size) {
                continue;
            }
            match found.iter_mut().find(|(old, miss)| self.is_same(old, &q, miss.max(size))) {
                None => found.push((q, size)),
                Some(old) if size < old.1 => *old = (q, size),
                Some(_) => {}
            }
        }
        found.iter().map(|(q, _)| q.map(Some)).collect()
    }

    /// Whether rounding cannot tell two solutions apart that miss by at most `miss`.
    fn is_same(&self, a: &[f64; 2], b: &[f64; 2], miss: f64) -> bool {
        let apart: [f64; 2] = std::array::from_fn(|i| angle::difference(b[i], a[i]));
        let between = SVector::from_fn(|i, _| a[i] + 0.5 * apart[i]);
        apart.iter().all(|x| x.abs() <= MERGED) && self.miss(&between).size <= miss + 2.0 * ROUNDING
    }

    fn miss(&self, q: &SVector<f64, 2>) -> Miss<2> {
        let [u, v] = [q[0], q[1]].map(|q| Vector2::new(q.cos(), q.sin()));
        let across = |u: Vector2<f64>| Vector2::new(-u.y, u.x);
        let f = self.a * u + self.b * v - self.e;
        let columns = [self.a * across(u), self.b * across(v)];
        let bends = [-self.a * u, -self.b * v];
        let hessian =
            SMatrix::from_fn(|i, j| columns[i].dot(&columns[j]) + if i == j { f.dot(&bends[i]) } else { 0.0 });
        Miss { size: f.norm(), gradient: SVector::from_fn(|i, _| columns[i].dot(&f)), hessian }
    }
}
