//! The subproblems of three joints that carry a point to a point, `e^(S1 q1) e^(S2 q2) e^(S3 q3) p = k`, for any
//! screws: IK-Geo's three circles, PG7, and all combinations with translations; and three rotations about parallel axes
//! to a pose (PG8).
//!
//! The first joint is eliminated by two of its invariants. For a revolute joint these are the height along its axis and
//! the distance from a point of it; for a prismatic joint, two heights across its direction. Both are linear in the
//! second joint's cosine and sine with constant factors (see `turn.rs`). So one equation of degree four remains for the
//! third joint. Candidates are refined and accepted when they reach `k`. The tolerances are in [`super::values`].

use nalgebra::{Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::one_joint::{
    rotate_to_plane, rotate_to_point, translate_to_distance, translate_to_plane, translate_to_point,
};
use super::polish::polish;
use super::polynomial;
use super::trigonometric;
use super::turn::Turn;
use super::two_joints::{rotate_about_parallel_axes, size, two_screws_to_point};
use super::values::{Answers, Reach, TOLERANCE, Values};
use crate::spatial::line::PARALLEL;
use crate::spatial::{Axis, Pose, Screw, angle};

/// Tolerance of a condition for a candidate. The point that it reaches decides.
const CANDIDATE: Reach = Reach::Within(1e-4);

/// A target within this distance of the first axis, relative to the size, is near it.
const NEAR_AXIS: f64 = 0.03;

type Candidates = SmallVec<[[Option<f64>; 3]; 8]>;

/// Solves `e^(S1 q1) e^(S2 q2) e^(S3 q3) p = k` for any three screws: up to four solutions.
///
/// The third joint is free when `p` is on its axis, the first when `k` is on its axis. With [`Reach::Closest`] and a
/// target out of reach, the values of the nearest point are returned.
pub fn three_screws_to_point(screws: [&Screw; 3], p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Answers<3> {
    let centres: SmallVec<[Point3<f64>; 3]> = screws.iter().filter_map(|s| s.axis()).map(Axis::point).collect();
    let size = size(&centres, p, k);
    if !size.is_finite() {
        return Answers::default();
    }
    let holds =
        |screw: &Screw, x: &Point3<f64>| screw.axis().is_some_and(|axis| axis.distance_to(x) <= TOLERANCE * size);
    if holds(screws[2], p) {
        let two = two_screws_to_point(screws[0], screws[1], p, k, reach);
        return two.iter().map(|[a, b]| [*a, *b, None]).collect();
    }
    if holds(screws[0], k) {
        let two = two_screws_to_point(screws[1], screws[2], p, k, reach);
        return two.iter().map(|[b, c]| [None, *b, *c]).collect();
    }
    let miss = reach.slack(4.0).min(1e-2);
    let candidates = match screws {
        [Screw::Revolute(_), Screw::Prismatic(_), Screw::Prismatic(_)] => backwards(screws, p, k),
        [first, Screw::Revolute(second), third] => turned(first, second, third, p, k, size, miss),
        [first, Screw::Prismatic(second), third] => slid(first, second, third, p, k, size, miss),
    };
    polish(&screws.map(|screw| *screw), p, k, size, reach, candidates.into_iter())
}

/// PG7: a rotation about a skew axis followed by two rotations about parallel axes: up to four solutions.
pub fn rotate_skew_and_two_parallel(
    skew: &Axis,
    parallel: [&Axis; 2],
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<3> {
    let [second, third] = parallel.map(|axis| Screw::Revolute(*axis));
    three_screws_to_point([&Screw::Revolute(*skew), &second, &third], p, k, reach)
}

/// PG8: rotations about three parallel axes whose product is `pose`: up to two solutions.
///
/// There are none when `pose` tilts the planes normal to the axes by more than the tolerance of `reach`.
pub fn rotate_three_parallel_to_pose(axes: [&Axis; 3], pose: &Pose, reach: Reach) -> Answers<3> {
    let w = axes[0].direction();
    let keeps = (pose.rotation * w.into_inner() - w.into_inner()).norm() <= reach.slack(1.0);
    if !(keeps && axes[0].is_parallel(axes[1]) && axes[0].is_parallel(axes[2])) {
        return Answers::default();
    }
    let sum = 2.0 * w.dot(&pose.rotation.imag()).atan2(pose.rotation.scalar());
    let p = axes[2].point();
    let sign = |axis: &Axis| w.dot(&axis.direction()).signum();
    let complete = |[a, b]: &[Option<f64>; 2]| {
        let rest = sum - a.unwrap_or(0.0) - sign(axes[1]) * b.unwrap_or(0.0);
        [*a, *b, Some(angle::wrap(sign(axes[2]) * rest))]
    };
    rotate_about_parallel_axes(axes[0], axes[1], &p, &(pose * p), reach).iter().map(complete).collect()
}

/// A rotation before two translations, by the inverse problem: `e^-S3 e^-S2 e^-S1 k = p`.
fn backwards(screws: [&Screw; 3], p: &Point3<f64>, k: &Point3<f64>) -> Candidates {
    let found = two_slides(screws[2], screws[1], screws[0], k, p);
    found.into_iter().map(|[c, b, a]| [a.map(|q| -q), b.map(|q| -q), c.map(|q| -q)]).collect()
}

/// Invariants of the first joint for a point: two vectors and right sides such that `a_i . (x - origin) = b_i(x)`.
struct Invariants {
    a: [Vector3<f64>; 2],
    /// The height of `k` along the first vector, from the origin.
    first: f64,
    second: Second,
}

enum Second {
    /// The height along the second vector.
    Height(f64),
    /// The squared distance from the axis' point, which is the second vector.
    Distance(f64),
}

impl Invariants {
    /// The invariants of `screw`, relative to `origin`.
    fn new(screw: &Screw, k: &Point3<f64>, origin: &Point3<f64>) -> Invariants {
        let displacement = k - origin;
        match screw {
            Screw::Revolute(axis) => {
                // The point of the axis at the height of the origin keeps the numbers small.
                let axis = axis.level_with(origin);
                let (w, arm) = (axis.direction().into_inner(), axis.point() - origin);
                let square = (k - axis.point()).norm_squared() - arm.norm_squared();
                Invariants { a: [w, arm], first: w.dot(&displacement), second: Second::Distance(square) }
            }
            Screw::Prismatic(direction) => {
                let across = direction.cross(&Vector3::ith(direction.iamin(), 1.0)).normalize();
                let other = direction.cross(&across);
                Invariants {
                    a: [across, other],
                    first: across.dot(&displacement),
                    second: Second::Height(other.dot(&displacement)),
                }
            }
        }
    }

    /// The right sides for `y`, the point relative to the origin. The second joint preserves its length.
    fn sides(&self, y: &Vector3<f64>) -> [f64; 2] {
        match self.second {
            Second::Height(height) => [self.first, height],
            Second::Distance(square) => [self.first, (y.norm_squared() - square) / 2.0],
        }
    }
}

/// The second joint is revolute.
fn turned(
    first: &Screw,
    second: &Axis,
    third: &Screw,
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    miss: f64,
) -> Candidates {
    let kept = Invariants::new(first, k, &second.point());
    let turn = Turn::new(&second.direction(), kept.a);
    let relative = |q: f64| third.carry(q, p) - second.point();
    let condition = |q: f64| {
        let y = relative(q);
        turn.condition(&y, kept.sides(&y))
    };
    let angles = |q: f64| {
        let y = relative(q);
        let flat = (y - second.direction().scale(second.direction().dot(&y))).norm();
        if flat <= TOLERANCE * size { [Some(0.0), None] } else { turn.angles(&y, kept.sides(&y)) }
    };
    let thirds: SmallVec<[f64; 16]> = match third {
        Screw::Revolute(_) => trigonometric::zeros_to(2, turn.grain(size, miss), condition),
        Screw::Prismatic(_) => polynomial::zeros(size, turn.grain(size, miss), condition),
    };
    let mut found = Candidates::new();
    for q3 in thirds {
        for q2 in angles(q3).into_iter().flatten() {
            let y = third.carry(q3, p);
            let x = second.rotate(q2, &y);
            let back = second.through_origin().rotate(q2, &velocity(third, &y).into()).coords;
            let normal = velocity(&Screw::Revolute(*second), &x).cross(&back);
            found.extend(reach_by(first, &x, k, &normal, size).into_iter().map(|q1| [q1, Some(q2), Some(q3)]));
        }
    }
    found
}

/// The second joint is prismatic.
fn slid(
    first: &Screw,
    second: &Unit<Vector3<f64>>,
    third: &Screw,
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    miss: f64,
) -> Candidates {
    let axis = match first {
        Screw::Prismatic(_) => return two_slides(first, &Screw::Prismatic(*second), third, p, k),
        Screw::Revolute(axis) => axis.level_with(k),
    };
    let (w, slope) = (axis.direction(), axis.direction().dot(second));
    let height = |q: f64| w.dot(&(k - third.carry(q, p)));
    let radius = (k - axis.point()).norm();
    // If the prismatic joint is normal to the axis, it does not change the height, and the third joint alone must.
    let level = slope.abs() <= PARALLEL;
    let condition = |q: f64| {
        if level {
            return height(q);
        }
        let y = (third.carry(q, p) - axis.point()) * slope + second.scale(height(q));
        y.norm_squared() - (slope * radius).powi(2)
    };
    let grain = miss * if level { size } else { size * size };
    let thirds: SmallVec<[f64; 16]> = match third {
        Screw::Revolute(_) => trigonometric::zeros_to(if level { 1 } else { 2 }, grain, condition),
        Screw::Prismatic(_) => polynomial::zeros(size, grain, condition),
    };
    let mut found = Candidates::new();
    for q3 in thirds {
        let x = third.carry(q3, p);
        let slides = translate_to_distance(second, &x, &axis.point(), radius, CANDIDATE);
        let slides = if level { slides } else { Values::One(height(q3) / slope) };
        for q2 in slides.iter() {
            let normal = second.cross(&velocity(third, &x));
            let firsts = reach_by(first, &(x + second.scale(q2)), k, &normal, size);
            found.extend(firsts.into_iter().map(|q1| [q1, Some(q2), Some(q3)]));
        }
    }
    found
}

/// The first two joints are prismatic: the third must move the point to its height over their plane.
fn two_slides(first: &Screw, second: &Screw, third: &Screw, p: &Point3<f64>, k: &Point3<f64>) -> Candidates {
    let (Screw::Prismatic(v1), Screw::Prismatic(v2)) = (first, second) else { return Candidates::new() };
    let mut found = Candidates::new();
    let Some(normal) = Unit::try_new(v1.cross(v2), PARALLEL) else {
        // Two equal directions: the second joint is free, and the others are a problem of two joints.
        let two = two_screws_to_point(first, third, p, k, CANDIDATE);
        found.extend(two.iter().map(|[a, c]| [*a, None, *c]));
        return found;
    };
    let thirds = match third {
        Screw::Revolute(axis) => rotate_to_plane(axis, p, &normal, k, CANDIDATE),
        Screw::Prismatic(v3) => translate_to_plane(v3, p, &normal, k, CANDIDATE),
    };
    for q3 in thirds.choices() {
        let x = third.carry(q3.unwrap_or(0.0), p);
        let two = two_screws_to_point(first, second, &x, k, CANDIDATE);
        found.extend(two.iter().map(|[a, b]| [*a, *b, q3]));
    }
    found
}

/// The values of the first joint that move `x` near `k`, while the other joints move it on a surface with this
/// `normal`.
///
/// If `k` is near the first axis, the angle is ill-conditioned. Then two angles move `k` back to the surface.
fn reach_by(
    first: &Screw,
    x: &Point3<f64>,
    k: &Point3<f64>,
    normal: &Vector3<f64>,
    size: f64,
) -> SmallVec<[Option<f64>; 3]> {
    let axis = match first {
        Screw::Prismatic(direction) => {
            return translate_to_point(direction, x, k, Reach::Closest).iter().map(Some).collect();
        }
        Screw::Revolute(axis) => axis,
    };
    let towards = rotate_to_point(axis, x, k, Reach::Closest).choices();
    let mut found: SmallVec<[Option<f64>; 3]> = towards.into_iter().map(|q| Some(q.unwrap_or(0.0))).collect();
    if let Some(normal) = Unit::try_new(*normal, 0.0).filter(|_| axis.distance_to(k) <= NEAR_AXIS * size) {
        found.extend(rotate_to_plane(axis, k, &normal, x, Reach::Closest).negated().iter().map(Some));
    }
    found
}

/// The velocity of `x` for a unit velocity of the joint.
fn velocity(screw: &Screw, x: &Point3<f64>) -> Vector3<f64> {
    match screw {
        Screw::Revolute(axis) => axis.direction().cross(&(x - axis.point())),
        Screw::Prismatic(direction) => direction.into_inner(),
    }
}
