//! The subproblems of two joints that carry a point to a point, `e^(S1 q1) e^(S2 q2) p = k`, for any axes: Paden-Kahan
//! 2 (RH0 2.3.3), PG2, PG4, PG6, and a rotation with a translation.
//!
//! Eliminating the first joint gives one condition on the second (a component along its axis, or a distance from a
//! point of it). Then the first joint moves to the point. Candidates are refined by Gauss-Newton and accepted when they
//! reach `k`. Skew axes have one of two solutions, which a formula for intersecting axes does not give. The tolerances
//! are in [`super::values`]; the size of the problem is the largest distance of p and k from the axes' points, or from
//! each other.

use nalgebra::{Point3, Unit, Vector3};

use super::one_joint::{rotate_to_distance, rotate_to_plane, translate_to_distance, translate_to_point};
use super::polish::polish;
use super::values::{Answers, Reach, TOLERANCE, Values, displacement_size};
use crate::spatial::{Axis, Screw};

/// Tolerance of a condition for a candidate. The point that it reaches decides.
const CANDIDATE: f64 = 1e-6;

/// Solves `e^(S1 q1) e^(S2 q2) p = k` for any two screws: PK2, PG2, PG4, PG6, or a rotation and a translation.
///
/// Up to two solutions. With [`Reach::Closest`] and a target out of reach, the values of the nearest point are
/// returned.
pub fn two_screws_to_point(
    first: &Screw,
    second: &Screw,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    match (first, second) {
        (Screw::Revolute(a), Screw::Revolute(b)) if a.is_parallel(b) => rotate_about_parallel_axes(a, b, p, k, reach),
        (Screw::Revolute(a), Screw::Revolute(b)) => rotate_about_crossing_axes(a, b, p, k, reach),
        (Screw::Prismatic(v1), Screw::Prismatic(v2)) => translate_twice(v1, v2, p, k, reach),
        (Screw::Revolute(axis), Screw::Prismatic(direction)) => translate_then_rotate(axis, direction, p, k, reach),
        (Screw::Prismatic(direction), Screw::Revolute(axis)) => rotate_then_translate(direction, axis, p, k, reach),
    }
}

/// Paden-Kahan 2, RH0 (2-30), (2-31): rotations about intersecting axes. Same as [`rotate_about_skew_axes`].
pub fn rotate_about_meeting_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Revolute(*first), &Screw::Revolute(*second), p, k, reach)
}

/// PG6: rotations about skew axes, at any angle.
///
/// Up to two solutions for intersecting axes, up to one for skew axes. The circles of `p` and `k` about skew axes have
/// at most one common point.
pub fn rotate_about_skew_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Revolute(*first), &Screw::Revolute(*second), p, k, reach)
}

/// PG4: rotations about parallel axes.
///
/// The second joint is free when the axes coincide or `p` is on the second one. The first joint is free when `k` is on
/// its axis. No solutions when `k` is not at the height of `p`, or a coordinate is not finite.
pub fn rotate_about_parallel_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    let (first, second) = (first.level_with(p), second.level_with(p));
    let w = first.direction();
    let height = w.dot(&(k - p));
    let size = size(&[first.point(), second.point()], p, k);
    if !(size.is_finite() && height.abs() <= reach.slack(size)) {
        return Answers::default();
    }
    let level = k - w.scale(height);
    let distance = (level - first.point()).norm();
    let bend = rotate_to_distance(&second, p, &first.point(), distance, reach);
    let turned = |q2: Option<f64>| complete(&first, p, &level, size, q2, |q| second.rotate(q, p));
    bend.choices().into_iter().filter_map(turned).collect()
}

/// The rotation of the first joint that moves `p`, already moved by the second joint, to `k`.
fn complete(
    first: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    second: Option<f64>,
    moved: impl Fn(f64) -> Point3<f64>,
) -> Option<[Option<f64>; 2]> {
    let c = second.map_or(*p, moved);
    let (w, u, v) = (first.direction(), c - first.point(), k - first.point());
    let (u, v) = (u - w.scale(w.dot(&u)), v - w.scale(w.dot(&v)));
    let radius = u.norm_squared().max(v.norm_squared()).sqrt();
    let bearing = w.dot(&u.cross(&v)).atan2(u.dot(&v));
    radius.is_finite().then_some([(radius > TOLERANCE * size).then_some(bearing), second])
}

/// Rotations about axes that are not parallel.
fn rotate_about_crossing_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    if let Some(both) = both_at_a_crossing(first, second, p, k) {
        return both;
    }
    let size = size(&[first.point(), second.point()], p, k);
    if !size.is_finite() {
        return Answers::default();
    }
    let bend = rotate_to_plane(second, p, &first.direction(), k, reach.at_least(CANDIDATE));
    let turned = |q2: Option<f64>| complete(first, p, k, size, q2, |q| second.rotate(q, p));
    let candidates = bend.choices().into_iter().filter_map(turned);
    let screws = [Screw::Revolute(*first), Screw::Revolute(*second)];
    polish(&screws, p, k, size, reach, candidates)
}

/// RH0 (2-31) where it is accurate: the axes intersect, their directions are well separated, and the two solutions are
/// well separated from each other and from the axes. `None` elsewhere.
fn both_at_a_crossing(first: &Axis, second: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Option<Answers<2>> {
    const WELL: f64 = 0.02;
    let (w1, w2) = (first.direction(), second.direction());
    let (u, v) = (p - first.point(), k - first.point());
    let (square, cosine) = (u.norm_squared(), w1.dot(&w2));
    let sine_square = 1.0 - cosine * cosine;
    let exact = (8.0 * f64::EPSILON).powi(2) * square;
    let meets = (second.point() - first.point()).norm_squared() <= exact;
    let fits = (square - v.norm_squared()).abs() <= 8.0 * f64::EPSILON * square;
    let (height1, height2) = (w1.dot(&v), w2.dot(&u));
    let (alpha, beta) = ((height1 - cosine * height2) / sine_square, (height2 - cosine * height1) / sine_square);
    let rest = square - alpha * height1 - beta * height2;
    let apart = [rest, square - height1 * height1, square - height2 * height2].iter().all(|x| *x > WELL * square);
    if !(meets && fits && apart && sine_square > WELL) {
        return None;
    }
    let (level, up) = (w1.scale(alpha) + w2.scale(beta), w1.cross(&w2) * (rest / sine_square).sqrt());
    let answer = |c: Vector3<f64>| {
        let q1 = w1.dot(&c.cross(&v)).atan2(c.dot(&v) - height1 * height1);
        let q2 = w2.dot(&u.cross(&c)).atan2(u.dot(&c) - height2 * height2);
        [Some(q1), Some(q2)]
    };
    Some([answer(level + up), answer(level - up)].into_iter().collect())
}

/// PG2: two translations.
///
/// One solution, when `k - p` is in the plane of the directions. If these are parallel the second joint is free.
pub fn translate_twice(
    first: &Unit<Vector3<f64>>,
    second: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    let (displacement, normal) = (k - p, first.cross(second));
    if normal.norm() <= TOLERANCE {
        return translate_to_point(first, p, k, reach).iter().map(|q| [Some(q), None]).collect();
    }
    let square = normal.norm_squared();
    if !(displacement.norm().is_finite()
        && normal.dot(&displacement).abs() / square.sqrt() <= reach.slack(displacement_size(p, k)))
    {
        return Answers::default();
    }
    let part = |a: &Vector3<f64>, b: &Vector3<f64>| a.cross(b).dot(&normal) / square;
    std::iter::once([Some(part(&displacement, second)), Some(part(first, &displacement))]).collect()
}

/// A translation, then a rotation: `R (p + v q2) = k`.
///
/// The translated point must have the same distance from a point of the axis as `k`. If the direction is not normal to
/// the axis, one of the two candidates reaches `k`, else both.
fn translate_then_rotate(
    axis: &Axis,
    direction: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    let axis = axis.level_with(k);
    let size = size(&[axis.point()], p, k);
    if !size.is_finite() {
        return Answers::default();
    }
    let moved = |q: f64| p + direction.scale(q);
    let distance = (k - axis.point()).norm();
    let along = axis.direction().cross(direction).norm() <= TOLERANCE;
    let slides = if along {
        Values::One(direction.dot(&(k - axis.foot(p))))
    } else {
        translate_to_distance(direction, p, &axis.point(), distance, reach.at_least(CANDIDATE))
    };
    let turned = |q2: Option<f64>| complete(&axis, p, k, size, q2, moved);
    let screws = [Screw::Revolute(axis), Screw::Prismatic(*direction)];
    polish(&screws, p, k, size, reach, slides.choices().into_iter().filter_map(turned))
}

/// A rotation, then a translation: `R p + v q1 = k`, which is `R^-1 (k - v q1) = p`.
fn rotate_then_translate(
    direction: &Unit<Vector3<f64>>,
    axis: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    let back = translate_then_rotate(axis, direction, k, p, reach);
    back.iter().map(|[turn, slide]| [slide.map(|q| -q), turn.map(|q| -q)]).collect()
}

/// The largest distance of `p` and `k` from the centres and from each other; NaN when a coordinate is NaN.
pub(super) fn size(centres: &[Point3<f64>], p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let displacement = displacement_size(p, k);
    let far = |centre: &Point3<f64>| (p - centre).norm().max((k - centre).norm());
    if displacement.is_nan() { displacement } else { centres.iter().map(far).fold(displacement, f64::max) }
}
