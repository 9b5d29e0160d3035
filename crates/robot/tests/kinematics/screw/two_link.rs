//! The two-link screw solver: known joint angles, forward kinematics, singular poses, and the numeric oracle.

use std::f64::consts::PI;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::oracle::Oracle;
use groebot_robot::kinematics::screw::two_link::{Solution, TwoLink};
use groebot_robot::spatial::Axis;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::{same, turned};
use crate::spatial::{axis, direction};

/// Hip at the origin, axes along y, both links hanging down.
fn leg(thigh: f64, shank: f64) -> TwoLink {
    let hip = Axis::new(Vector3::y(), Point3::origin()).unwrap();
    let knee = Axis::new(Vector3::y(), Point3::new(0.0, 0.0, -thigh)).unwrap();
    TwoLink::new(hip, knee, Point3::new(0.0, 0.0, -thigh - shank)).unwrap()
}

/// Two axes and a tip. The links have any direction across the axes, and the points are anywhere along them.
#[derive(Clone, Debug)]
struct Arm {
    first: Axis,
    second: Axis,
    tip: Point3<f64>,
    lengths: [f64; 2],
}

impl Arm {
    fn solver(&self) -> TwoLink {
        TwoLink::new(self.first, self.second, self.tip).unwrap()
    }

    fn forward(&self, q: [f64; 2]) -> Point3<f64> {
        turned(&self.first, q[0], &turned(&self.second, q[1], &self.tip))
    }

    /// The smaller singular value of the Jacobian, divided by the reach: |det| = L1 L2 |sin|, divided by the larger.
    fn sigma(&self, q: [f64; 2]) -> f64 {
        let tip = self.forward(q);
        let elbow = turned(&self.first, q[0], &self.second.point());
        let w = self.first.direction();
        let columns = [w.cross(&(tip - self.first.point())), w.cross(&(tip - elbow))];
        let determinant = w.dot(&columns[0].cross(&columns[1])).abs();
        let reach = self.lengths[0] + self.lengths[1];
        determinant / columns[0].norm().hypot(columns[1].norm()) / reach
    }
}

fn arm() -> impl Strategy<Value = Arm> {
    let along = (-1.0..1.0, -1.0..1.0);
    (axis(), 0.05..1.0, 0.05..1.0, direction(), direction(), along, any::<bool>()).prop_filter_map(
        "along the axis",
        |(first, upper, fore, to_elbow, to_tip, (elbow_along, tip_along), flip): (Axis, f64, f64, _, _, _, bool)| {
            let w = first.direction().into_inner();
            let across = |x: Vector3<f64>| (x - w * w.dot(&x)).try_normalize(1e-2);
            let elbow: Point3<f64> = first.point() + across(to_elbow)? * upper + w * elbow_along;
            let tip = elbow + across(to_tip)? * fore + w * tip_along;
            let second = Axis::new(if flip { -w } else { w }, elbow).unwrap();
            Some(Arm { first, second, tip, lengths: [upper, fore] })
        },
    )
}

/// Checks every solution by forward kinematics; free joints take several angles.
fn check(solver: &TwoLink, target: &Point3<f64>, answers: &[Solution], tolerance: f64) {
    assert!(answers.len() <= 2);
    assert!(answers.len() < 2 || answers.iter().all(|a| a.q[0].is_some()), "a free joint counts once: {answers:?}");
    for answer in answers {
        for free in [0.0, 1.0, -2.5] {
            for angle in answer.q.iter().flatten() {
                assert!(-PI < *angle && *angle <= PI);
            }
            let error = (solver.forward(answer.q.map(|q| q.unwrap_or(free))) - target).norm();
            assert!(error <= tolerance * solver.reach(), "{answer:?} misses by {error:e}");
            assert!(answer.residual <= tolerance * solver.reach());
        }
    }
}

#[test]
fn a_leg_bends_in_both_directions() {
    // Thigh 3, shank 4, target 5 below the hip: a right angle at the knee.
    let answers = leg(3.0, 4.0).solve(&Point3::new(0.0, 0.0, -5.0)).unwrap();
    let hip = (4.0_f64 / 5.0).asin();
    assert_eq!(answers.len(), 2);
    assert!(answers.iter().all(|a| same(a.q[0].unwrap().abs(), hip, 1e-15)));
    assert!(answers.iter().all(|a| same(a.q[1].unwrap().abs(), PI / 2.0, 1e-15)));
    assert!(answers.iter().all(|a| a.q[0].unwrap() * a.q[1].unwrap() < 0.0));
    assert!(answers[0].q[1].unwrap() * answers[1].q[1].unwrap() < 0.0);
}

#[test]
fn full_stretch_and_full_fold_have_one_answer() {
    let arm = leg(0.3, 0.2);
    for angle in [0.0, 0.4, 2.0, PI, -0.1, -3.0_f64] {
        let towards = Vector3::new(-angle.sin(), 0.0, -angle.cos());
        for (distance, knee) in [(0.5, 0.0), (0.1, PI)] {
            let target = Point3::from(towards * distance);
            let answers = arm.solve(&target).unwrap();
            let [answer] = answers[..] else { panic!("{answers:?}") };
            assert!(same(answer.q[1].unwrap(), knee, 1e-7), "{answer:?}");
            assert!(same(answer.q[0].unwrap(), angle, 1e-7), "{answer:?} at {angle}");
            check(&arm, &target, &answers, 1e-14);
        }
    }
}

#[test]
fn the_base_is_reached_by_equal_links_only_and_frees_the_hip() {
    let answers = leg(0.28, 0.28).solve(&Point3::origin()).unwrap();
    let [Solution { q: [None, Some(knee)], .. }] = answers[..] else { panic!("{answers:?}") };
    assert!(same(knee, PI, 1e-12));
    check(&leg(0.28, 0.28), &Point3::origin(), &answers, 1e-12);
    assert_eq!(leg(0.1, 0.1029).solve(&Point3::origin()).unwrap(), vec![]);
    assert_eq!(leg(0.1029, 0.1).solve(&Point3::origin()).unwrap(), vec![]);
}

#[test]
fn a_tip_on_the_second_axis_frees_the_knee() {
    let hip = Axis::new(Vector3::y(), Point3::origin()).unwrap();
    let knee = Axis::new(Vector3::y(), Point3::new(0.0, 0.5, -1.0)).unwrap();
    let arm = TwoLink::new(hip, knee, Point3::new(0.0, 0.0, -1.0)).unwrap();
    let target = Point3::new(-1.0, 0.0, 0.0);
    let answers = arm.solve(&target).unwrap();
    let [Solution { q: [Some(hip), None], .. }] = answers[..] else { panic!("{answers:?}") };
    assert!(same(hip, PI / 2.0, 1e-15));
    check(&arm, &target, &answers, 1e-15);
    assert_eq!(arm.solve(&Point3::new(-0.9, 0.0, 0.0)).unwrap(), vec![]);
}

#[test]
fn targets_beside_the_plane_or_out_of_reach_have_no_answer() {
    let arm = leg(0.3, 0.2);
    for target in [[0.0, 1e-9, -0.4], [0.0, 0.0, -0.5000001], [0.0, 0.0, -0.0999999], [1e200, 0.0, 1e200], [1e308; 3]] {
        assert_eq!(arm.solve(&Point3::from(target)).unwrap(), vec![], "{target:?}");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(arm.solve(&Point3::new(0.0, bad, 0.0)).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

#[test]
fn chains_that_are_not_planar_are_refused() {
    let hip = Axis::new(Vector3::y(), Point3::origin()).unwrap();
    let tip = Point3::new(0.0, 0.0, -1.0);
    let skew = Axis::new(Vector3::new(0.0, 1.0, 1e-9), Point3::new(0.0, 0.0, -0.5)).unwrap();
    let same = Axis::new(-Vector3::y(), Point3::new(0.0, 3.0, 0.0)).unwrap();
    let knee = Axis::new(Vector3::y(), Point3::new(0.0, 0.0, -0.5)).unwrap();
    for (second, tip) in [(skew, tip), (same, tip), (hip, hip.point()), (knee, tip * f64::NAN)] {
        assert_eq!(TwoLink::new(hip, second, tip).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

/// Targets cross both limits by 10^-k: two solutions inside, the limit within 1e-12 of the reach, none outside.
#[test]
fn the_limits_are_crossed_in_order() {
    for (thigh, shank) in [(0.1, 0.1029), (0.3, 0.05), (0.28, 0.28)] {
        let arm = leg(thigh, shank);
        let towards = Vector3::new(0.6, 0.0, -0.8);
        for (limit, inwards) in [(thigh + shank, -1.0), ((thigh - shank).abs(), 1.0)] {
            for exponent in 1..=16 {
                let step = 10f64.powi(-exponent) * (thigh + shank);
                let inside = Point3::from(towards * (limit + inwards * step));
                let answers = arm.solve(&inside).unwrap();
                check(&arm, &inside, &answers, 1e-12);
                assert!(answers.len() == 2 || (answers.len() == 1 && exponent > 11), "{exponent}: {answers:?}");
                // Beyond the fold of equal links is the other side of the annulus: nothing to test.
                let outside = limit - inwards * step;
                if outside > 0.0 {
                    let outside = Point3::from(towards * outside);
                    let answers = arm.solve(&outside).unwrap();
                    assert!(exponent == 12 || answers.is_empty() == (exponent < 12), "{exponent}: {answers:?}");
                    check(&arm, &outside, &answers, 1.01e-12);
                }
            }
        }
    }
}

/// Equal links near the base: every target is reached, with the known angles while they are determined.
#[test]
fn the_base_is_approached_in_order() {
    let arm = leg(0.28, 0.28);
    for exponent in 1..=18 {
        let q = [0.9, PI - 10f64.powi(-exponent)];
        let target = arm.forward(q);
        let answers = arm.solve(&target).unwrap();
        check(&arm, &target, &answers, 1e-12);
        let known = |a: &Solution| {
            let hip = a.q[0].is_none_or(|hip| same(hip, q[0], 1e-15 * 10f64.powi(exponent)));
            hip && same(a.q[1].unwrap(), q[1], 1e-11)
        };
        assert!(answers.iter().any(known), "{exponent}: {q:?} is not among {answers:?}");
    }
}

proptest! {
    #![proptest_config(crate::cases(20_000))]

    #[test]
    fn the_angles_that_made_the_target_are_found(arm in arm(), q1 in -PI..PI, q2 in -PI..PI) {
        let (solver, q) = (arm.solver(), [q1, q2]);
        let target = arm.forward(q);
        let answers = solver.solve(&target).unwrap();
        check(&solver, &target, &answers, 1e-13);
        let sigma = arm.sigma(q);
        let matching = if sigma > 1e-3 { 1e-9 } else { (1e-13 / sigma).max(1e-7) };
        let known = |a: &Solution| (0..2).all(|i| a.q[i].is_none_or(|angle| same(angle, q[i], matching)));
        prop_assert!(answers.iter().any(known), "{q:?} is not among {answers:?}, sigma {sigma:e}");
        prop_assert!(sigma < 1e-6 || answers.len() == 2);
    }

    #[test]
    fn stretched_and_folded_arms_are_reached(arm in arm(), q1 in -PI..PI) {
        let solver = arm.solver();
        let to_base = arm.first.foot(&arm.tip) - arm.second.foot(&arm.tip);
        let to_tip = arm.tip - arm.second.foot(&arm.tip);
        let w = arm.second.direction();
        let folded = w.dot(&to_tip.cross(&to_base)).atan2(to_tip.dot(&to_base));
        for q2 in [folded, folded + PI] {
            let target = arm.forward([q1, q2]);
            let answers = solver.solve(&target).unwrap();
            prop_assert!(!answers.is_empty());
            check(&solver, &target, &answers, 1e-13);
            prop_assert!(answers.iter().all(|a| same(a.q[1].unwrap(), q2, 1e-6)), "{q2} is not {answers:?}");
        }
    }

    #[test]
    fn targets_outside_the_ring_have_no_answer(arm in arm(), angle in -PI..PI, share in 1e-9..0.9_f64) {
        let [upper, fore] = arm.lengths;
        let foot = arm.first.foot(&arm.tip);
        let towards = (arm.second.foot(&arm.tip) - foot).normalize();
        let ring = [(upper + fore) * (1.0 + share), (upper - fore).abs() * (1.0 - share)];
        for distance in ring {
            let target = turned(&arm.first, angle, &(foot + towards * distance));
            let near_the_ring = ((upper - fore).abs() - distance).abs() < 1e-10;
            prop_assert!(near_the_ring || arm.solver().solve(&target).unwrap().is_empty());
        }
    }
}

proptest! {
    #![proptest_config(crate::cases(50))]

    #[test]
    fn the_oracle_finds_the_same_answers(arm in arm(), q1 in -PI..PI, q2 in -PI..PI) {
        prop_assume!(arm.sigma([q1, q2]) > 1e-2);
        let target = arm.forward([q1, q2]);
        let answers = arm.solver().solve(&target).unwrap();
        let witnesses = Oracle::default()
            .solve(2, |q| (arm.forward([q[0], q[1]]) - target).as_slice().to_vec())
            .unwrap();
        prop_assert_eq!(answers.len(), witnesses.len());
        for answer in answers {
            let agrees = |w: &[f64]| (0..2).all(|i| same(w[i], answer.q[i].unwrap(), 1e-8));
            prop_assert!(witnesses.iter().any(|w| agrees(&w.q)), "{answer:?} is not among {witnesses:?}");
        }
    }
}
