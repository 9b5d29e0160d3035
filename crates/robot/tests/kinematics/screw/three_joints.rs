//! The subproblems of three joints: degenerate cases by name, the nearest values, and the number of solutions by the
//! oracle.

use groebot_robot::kinematics::screw::three_joints::{
    rotate_skew_and_two_parallel, rotate_three_parallel_to_pose, three_screws_to_point,
};
use groebot_robot::kinematics::screw::values::{Answers, Reach};
use groebot_robot::spatial::{Axis, Pose, Screw};
use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::instance::{Random, carried, judge, least_distance, oracle_count, scaled, size};

/// T is a revolute joint, in all eight combinations.
fn kinds() -> impl Iterator<Item = [bool; 3]> + Clone {
    (0..8).map(|number| [0, 1, 2].map(|joint| number >> joint & 1 == 1))
}

fn solve(screws: &[Screw; 3], p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Answers<3> {
    three_screws_to_point([&screws[0], &screws[1], &screws[2]], p, k, reach)
}

fn miss(screws: &[Screw; 3], answer: &[Option<f64>; 3], p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    (carried(screws, &answer.map(|q| q.unwrap_or(0.0)), p) - k).norm()
}

fn values(random: &mut Random, turns: [bool; 3]) -> [f64; 3] {
    turns.map(|turns| if turns { random.angle() } else { random.within(-1.0, 1.0) })
}

#[test]
fn a_point_on_the_third_axis_leaves_it_free() {
    let mut random = Random(1);
    for turns in kinds().filter(|turns| turns[2]) {
        let screws = turns.map(|turns| random.screw(turns));
        let axis = screws[2].axis().unwrap();
        let p = axis.point() + axis.direction().scale(0.4);
        let k = carried(&screws, &values(&mut random, turns), &p);
        let answers = solve(&screws, &p, &k, Reach::EXACT);
        assert!(!answers.is_empty(), "{turns:?}");
        for answer in answers.iter() {
            assert_eq!(answer[2], None);
            assert!(miss(&screws, answer, &p, &k) < 1e-12);
        }
    }
}

#[test]
fn a_target_on_the_first_axis_leaves_it_free() {
    let mut random = Random(2);
    for turns in kinds().filter(|turns| turns[0]) {
        let mut screws = turns.map(|turns| random.screw(turns));
        let (p, q) = (random.point(), values(&mut random, turns));
        // The first axis passes through the point that the others reach.
        let k = carried(&screws[1..], &q[1..], &p);
        screws[0] = Screw::Revolute(Axis::central(random.direction()).shifted(&k.coords));
        let answers = solve(&screws, &p, &k, Reach::EXACT);
        assert!(!answers.is_empty(), "{turns:?}");
        for answer in answers.iter() {
            assert_eq!(answer[0], None);
            assert!(miss(&screws, answer, &p, &k) < 1e-12);
        }
    }
}

#[test]
fn two_slides_along_one_direction_leave_the_second_free() {
    let mut random = Random(3);
    let first = random.screw(false);
    let screws = [first, first, random.screw(true)];
    let p = random.point();
    let k = carried(&screws, &[0.4, 0.3, 1.0], &p);
    let answers = solve(&screws, &p, &k, Reach::EXACT);
    assert!(!answers.is_empty());
    assert!(answers.iter().all(|answer| answer[1].is_none() && miss(&screws, answer, &p, &k) < 1e-12));
}

/// The third axis passes p, or the first one k, at a distance of 10^-e: the solution stays, down to the distance at
/// which the axis counts as passing through.
#[test]
fn an_axis_leaves_its_point_in_order() {
    let mut random = Random(4);
    for exponent in 1..=8 {
        for _ in 0..20 {
            let near = |x: &Point3<f64>, random: &mut Random| {
                let axis = Axis::central(random.direction()).shifted(&x.coords);
                Screw::Revolute(axis.shifted(&random.across(&axis.direction()).scale(10f64.powi(-exponent))))
            };
            let (p, q) = (random.point(), [random.angle(), random.angle(), random.angle()]);
            let mut screws = [random.screw(true), random.screw(true), random.screw(true)];
            screws[2] = near(&p, &mut random);
            let k = carried(&screws, &q, &p);
            let verdict = judge(&screws, &p, &k, &q, &solve(&screws, &p, &k, Reach::EXACT));
            assert!(!verdict.is_lost(), "third axis, {exponent}: {verdict:?}");
        }
    }
}

#[test]
fn targets_out_of_reach_have_no_answer() {
    let mut random = Random(5);
    for _ in 0..200 {
        let screws = [random.screw(true), random.screw(true), random.screw(true)];
        let (p, k) = (random.point(), Point3::from(random.direction().scale(30.0)));
        assert!(solve(&screws, &p, &k, Reach::EXACT).is_empty());
        assert!(!solve(&screws, &p, &k, Reach::Closest).is_empty());
    }
}

/// An arm with lengths 1 and 1 on a rotating base, 10^-e inside and outside its longest reach.
#[test]
fn the_longest_reach_is_crossed_in_order() {
    let axis = |w: Vector3<f64>, x: f64| Screw::revolute(w, Point3::new(x, 0.0, 0.0)).unwrap();
    let screws = [axis(Vector3::z(), 0.0), axis(Vector3::y(), 0.0), axis(Vector3::y(), 1.0)];
    let p = Point3::new(2.0, 0.0, 0.0);
    let path = Vector3::new(0.6, 0.0, 0.8).normalize();
    for exponent in 1..=16 {
        let step = 10f64.powi(-exponent);
        let inside = solve(&screws, &p, &Point3::from(path * (2.0 - step)), Reach::EXACT);
        assert!(!inside.is_empty(), "{exponent}");
        let outside = Point3::from(path * (2.0 + step));
        let count = solve(&screws, &p, &outside, Reach::EXACT).len();
        assert!(exponent == 12 || exponent == 11 || (count == 0) == (exponent < 12), "{exponent}: {count}");
        let wide = solve(&screws, &p, &outside, Reach::Within(1e-6));
        assert!(exponent == 6 || wide.is_empty() == (exponent < 6), "{exponent}: {wide:?}");
    }
}

#[test]
fn closest_is_no_farther_than_any_value_of_a_grid() {
    let mut random = Random(6);
    for turns in kinds().chain(kinds()) {
        let screws = turns.map(|turns| random.screw(turns));
        let (p, k) = (random.point(), random.point() * 3.0);
        let answers = solve(&screws, &p, &k, Reach::Closest);
        let least = least_distance(&screws, &p, &k, 40);
        assert!(!answers.is_empty(), "{turns:?}");
        for answer in answers.iter() {
            let miss = miss(&screws, answer, &p, &k);
            assert!(miss <= least + 1e-6 * size(&screws, &p, &k), "{turns:?}: {miss} is more than {least}");
        }
    }
}

#[test]
fn nothing_comes_of_bad_numbers() {
    let mut random = Random(7);
    for turns in kinds() {
        let screws = turns.map(|turns| random.screw(turns));
        let good = random.point();
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let bad_point = Point3::new(0.3, bad, 0.1);
            for reach in [Reach::EXACT, Reach::Within(f64::NAN), Reach::Closest] {
                for (p, k) in [(bad_point, good), (good, bad_point), (bad_point, bad_point)] {
                    assert!(solve(&screws, &p, &k, reach).is_empty(), "{turns:?} {p} {k} {reach:?}");
                }
            }
        }
    }
}

#[test]
fn any_magnitude_will_do() {
    let mut random = Random(8);
    for (turns, exponent) in kinds().flat_map(|kinds| (-6..=6).map(move |exponent| (kinds, exponent))) {
        let unit = 10f64.powi(exponent);
        let screws = turns.map(|turns| scaled(&random.screw(turns), unit));
        let q = turns.map(|turns| if turns { random.angle() } else { random.within(-unit, unit) });
        let p = random.point() * unit;
        let k = carried(&screws, &q, &p);
        let verdict = judge(&screws, &p, &k, &q, &solve(&screws, &p, &k, Reach::EXACT));
        assert!(!verdict.is_lost() && verdict.residuals.iter().all(|x| *x < 1e-12), "{turns:?} {unit:e} {verdict:?}");
    }
}

#[test]
fn the_oracle_finds_as_many() {
    let mut random = Random(9);
    for _ in 0..50 {
        let (p, q) = (random.point(), [random.angle(), random.angle(), random.angle()]);
        let parallel = random.axis();
        let axes = [random.axis(), parallel, parallel.shifted(&random.vector())];
        let screws = axes.map(Screw::Revolute);
        let k = carried(&screws, &q, &p);
        let answers = rotate_skew_and_two_parallel(&axes[0], [&axes[1], &axes[2]], &p, &k, Reach::EXACT);
        assert_eq!(answers.len(), oracle_count(&screws, &p, &k), "{axes:?} {p} {q:?}");
    }
    for turns in kinds().filter(|turns| turns.iter().any(|turns| *turns)).cycle().take(35) {
        let screws = turns.map(|turns| random.screw(turns));
        let p = random.point();
        let k = carried(&screws, &values(&mut random, turns), &p);
        assert_eq!(solve(&screws, &p, &k, Reach::EXACT).len(), oracle_count(&screws, &p, &k), "{screws:?} {p} {k}");
    }
}

#[test]
fn a_pose_that_tilts_the_axes_has_no_answer() {
    let upright = |x: f64| Axis::new(Vector3::z(), Point3::new(x, 0.0, 0.0)).unwrap();
    let axes = [upright(0.0), upright(1.0), upright(1.8)];
    let turned = |tilt: f64, height: f64| {
        let turn = UnitQuaternion::from_euler_angles(tilt, 0.0, 0.5);
        Pose::from_parts(Vector3::new(-0.5, 0.1, height).into(), turn)
    };
    let solve = |pose: &Pose| rotate_three_parallel_to_pose([&axes[0], &axes[1], &axes[2]], pose, Reach::EXACT).len();
    assert_eq!(solve(&turned(0.0, 0.0)), 2);
    assert_eq!(solve(&turned(1e-9, 0.0)), 0);
    assert_eq!(solve(&turned(0.0, 1e-9)), 0);
    assert_eq!(solve(&Pose::translation(9.0, 0.0, 0.0)), 0);
    assert_eq!(solve(&Pose::translation(f64::NAN, 0.0, 0.0)), 0);
}
