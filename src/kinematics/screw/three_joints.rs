//! The subproblems of three joints: `exp(S1 q1) exp(S2 q2) exp(S3 q3) p = k` for any joints (with it subproblem 5 of Elias and
//! Wen, "IK-Geo" (2022), and Pardos-Gotor's PG7), and three parallel rotations onto a pose (PG8).
//!
//! Two joints are [eliminated](super::elimination); for each candidate of the remaining one the others follow from the
//! [two conditions](super::two_joints) on it. Each candidate is polished by Newton's method on the equation itself and kept when it
//! solves that, so that double roots, which an eliminant shifts by the square root of its rounding, are neither lost nor rough.
//!
//! Tolerance: that of [`two_joints`](super::two_joints). Where solutions come in families, the member with one joint at zero is
//! returned, and that joint is free: `p` on the third axis or `k` on the first; the second axis through `exp(S3 q3) p`;
//! coincident neighbours; and redundant joints (three parallel or three concurrent axes). A redundant joint that cannot be at zero
//! is returned at a value that it can have.

use std::f64::consts::TAU;

use nalgebra::{Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::elimination::{Elimination, Path};
use super::motion::{Candidates, Motion, coincide, holds, moved, opposite};
use super::two_joints::{candidates, rotate_about_parallel_axes, solve as solve_two};
use super::values::{Answers, Reach, TOLERANCE};
use crate::spatial::{Axis, Pose, Screw, angle};

/// How many values of a redundant joint are tried.
const SAMPLES: usize = 16;

/// All q1, q2, q3 with `exp(S1 q1) exp(S2 q2) exp(S3 q3) p = k` \[m\], for joints of either kind: at most four answers.
///
/// None when `k` is out of reach (see the [tolerance](self)) or a coordinate is not finite.
pub fn three_screws_to_point(screws: [&Screw; 3], p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Answers<3> {
    Motion::new(screws, p, k).map_or(Answers::none(), |motion| motion.to_metres(solve(&motion, reach)))
}

/// Pardos-Gotor 7: rotations of `p` about one axis and two parallel ones, at any angle to it, onto `k` \[m\].
///
/// As [`three_screws_to_point`], and like it right when `second` and `third` are not quite parallel.
pub fn rotate_skew_and_two_parallel(
    first: &Axis,
    second: &Axis,
    third: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<3> {
    let screws = [first, second, third].map(|axis| Screw::Revolute(*axis));
    three_screws_to_point([&screws[0], &screws[1], &screws[2]], p, k, reach)
}

/// Pardos-Gotor 8: rotations about three parallel axes (the directions may be opposite) that make `pose`,
/// `exp(S1 q1) exp(S2 q2) exp(S3 q3) = pose`: at most two answers.
///
/// None when `pose` turns about another direction by more than the reach \[rad\], or takes the third axis out of the reach of the
/// first two (the tolerance of [`two_joints`](super::two_joints)), or the axes are not parallel to 1e-9 rad, or a number is not finite.
/// The closest answer has the closest direction first, then the closest place.
pub fn rotate_three_parallel_to_pose(axes: [&Axis; 3], pose: &Pose, reach: Reach) -> Answers<3> {
    let [first, second, third] = axes;
    let w = first.direction();
    let Some((turn, tilt)) = turn_about(&w, pose) else { return Answers::none() };
    if !(second.is_parallel(first) && third.is_parallel(first)) || !reach.covers(tilt) {
        return Answers::none();
    }
    let elbow = third.foot(&first.point());
    let raised = pose * elbow;
    let target = match reach {
        Reach::Closest => raised - w.scale(w.dot(&(raised - elbow))),
        Reach::Within(_) => raised,
    };
    let sign = |axis: &Axis| axis.direction().dot(&w).signum();
    let pairs = rotate_about_parallel_axes(first, second, &elbow, &target, reach);
    pairs.map(|&[q1, q2]| {
        let rest = turn - q1.unwrap_or(0.0) - sign(second) * q2.unwrap_or(0.0);
        [q1, q2, Some(angle::wrap(sign(third) * rest))]
    })
}

/// The turn of `pose` about `w` in (-pi, pi] and the angle by which it tilts `w`; `None` when `pose` is not finite.
fn turn_about(w: &Unit<Vector3<f64>>, pose: &Pose) -> Option<(f64, f64)> {
    let quaternion = pose.rotation.quaternion();
    let turn = angle::wrap(2.0 * w.dot(&quaternion.imag()).atan2(quaternion.w));
    let turned = pose.rotation * w.into_inner();
    let tilt = w.cross(&turned).norm().atan2(w.dot(&turned));
    let finite = turn.is_finite() && tilt.is_finite() && pose.translation.vector.iter().all(|x| x.is_finite());
    finite.then_some((turn, tilt))
}

/// The answers in the motion's unit.
fn solve(motion: &Motion<3>, reach: Reach) -> Answers<3> {
    let ([first, second, third], p, k) = (motion.screws, motion.p, motion.k);
    let pair = |a, b| solve_two(&motion.with([a, b], p, k), reach);
    if holds(&third, &p) || coincide(&second, &third) {
        return pair(first, second).map(|&[q1, q2]| [q1, q2, None]);
    }
    if holds(&first, &k) {
        return pair(second, third).map(|&[q2, q3]| [None, q2, q3]);
    }
    if coincide(&first, &second) {
        return pair(first, third).map(|&[q1, q3]| [q1, None, q3]);
    }
    let forward = Elimination::new(&first, &second, &Path::new(&third, &p), &k);
    let backward = Elimination::new(&third, &second, &Path::new(&first, &k), &p);
    if backward.strength < forward.strength {
        let turned = |screw: usize, q: Option<f64>| q.map(|q| opposite(&motion.screws[screw], q));
        let answers = complete(&motion.reversed(), &backward, reach);
        return answers.map(|&[q3, q2, q1]| [turned(0, q1), turned(1, q2), turned(2, q3)]);
    }
    complete(motion, &forward, reach)
}

/// The answers, from the values of the third joint.
fn complete(motion: &Motion<3>, elimination: &Elimination, reach: Reach) -> Answers<3> {
    if elimination.vanishes() {
        return redundant(motion, reach);
    }
    let list = elimination.candidates().into_iter().flat_map(|q3| with_third(motion, q3));
    motion.settle(list.collect::<Candidates<3>>(), reach)
}

/// The candidates with the third joint at `q3`.
fn with_third(motion: &Motion<3>, q3: f64) -> SmallVec<[[f64; 3]; 4]> {
    let [first, second, third] = &motion.screws;
    let elbow = moved(third, q3, &motion.p);
    candidates(first, second, &elbow, &motion.k).into_iter().map(|[q1, q2]| [q1, q2, q3]).collect()
}

/// The answers with a redundant third joint at zero, else at the first value that has some.
fn redundant(motion: &Motion<3>, reach: Reach) -> Answers<3> {
    let [first, second, third] = motion.screws;
    let at = |q3: f64| motion.with([first, second], moved(&third, q3, &motion.p), motion.k);
    let exact = match reach {
        Reach::Closest => Reach::Within(TOLERANCE),
        within => within,
    };
    let answers = solve_two(&at(0.0), exact);
    if !answers.is_empty() {
        return answers.map(|&[q1, q2]| [q1, q2, None]);
    }
    let values = (1..SAMPLES).map(|i| match third {
        Screw::Revolute(_) => angle::wrap(TAU * i as f64 / SAMPLES as f64),
        Screw::Prismatic(_) => (i as f64 - SAMPLES as f64 / 2.0) / 2.0,
    });
    for q3 in values {
        let answers = solve_two(&at(q3), exact);
        if !answers.is_empty() {
            return answers.map(|&[q1, q2]| [q1, q2, Some(q3)]);
        }
    }
    motion.settle([], reach)
}
