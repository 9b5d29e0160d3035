//! The subproblems of two joints: degenerate cases by name, the boundary of the reach, the nearest values, and errors
//! of the literature's formulas for two axes.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::kinematics::screw::two_joints::{rotate_about_parallel_axes, translate_twice, two_screws_to_point};
use groebot_robot::kinematics::screw::values::{Answers, Reach};
use groebot_robot::spatial::{Axis, Screw};
use nalgebra::{Point3, Unit, Vector3};

use super::instance::{Random, carried, judge, least_distance, oracle_count, scaled, size};
use super::turned;

const KINDS: [[bool; 2]; 4] = [[true, true], [true, false], [false, true], [false, false]];

fn solve(screws: &[Screw; 2], p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Answers<2> {
    two_screws_to_point(&screws[0], &screws[1], p, k, reach)
}

fn upright(x: f64, y: f64) -> Axis {
    Axis::new(Vector3::z(), Point3::new(x, y, 0.0)).unwrap()
}

/// The point that a solution reaches, with free joints at `free`.
fn reached(screws: &[Screw; 2], answer: &[Option<f64>; 2], p: &Point3<f64>) -> Point3<f64> {
    carried(screws, &answer.map(|q| q.unwrap_or(0.0)), p)
}

#[test]
fn coincident_axes_leave_the_second_joint_free() {
    let p = Point3::new(1.0, 0.0, 0.5);
    for second in [upright(0.0, 0.0), Axis::new(-Vector3::z(), Point3::new(0.0, 0.0, 3.0)).unwrap()] {
        let axes = [upright(0.0, 0.0), second];
        let answers = rotate_about_parallel_axes(&axes[0], &axes[1], &p, &Point3::new(0.0, 1.0, 0.5), Reach::EXACT);
        assert_eq!(answers.len(), 1);
        assert_eq!(answers[0][1], None);
        assert!((answers[0][0].unwrap() - FRAC_PI_2).abs() < 1e-15);
        let higher = Point3::new(0.0, 1.0, 0.6);
        assert!(rotate_about_parallel_axes(&axes[0], &axes[1], &p, &higher, Reach::EXACT).is_empty());
    }
}

#[test]
fn a_point_on_the_second_axis_leaves_it_free() {
    let skew = Axis::new(Vector3::new(1.0, 0.0, 1.0), Point3::new(1.0, 0.5, 0.2)).unwrap();
    for second in [upright(1.0, 0.5), skew] {
        let p = second.point() + second.direction().scale(0.7);
        let screws = [upright(0.0, 0.0), second].map(Screw::Revolute);
        let k = turned(&upright(0.0, 0.0), 0.8, &p);
        let answers = solve(&screws, &p, &k, Reach::EXACT);
        assert_eq!(answers.len(), 1, "{answers:?}");
        assert_eq!(answers[0][1], None);
        assert!((answers[0][0].unwrap() - 0.8).abs() < 1e-14);
    }
}

#[test]
fn a_target_on_the_first_axis_leaves_it_free() {
    let screws = [upright(0.0, 0.0), upright(1.0, 0.0)].map(Screw::Revolute);
    let (p, k) = (Point3::new(1.0, 1.0, 0.0), Point3::origin());
    let answers = solve(&screws, &p, &k, Reach::EXACT);
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert_eq!(answers[0][0], None);
    assert!((reached(&screws, &answers[0], &p) - k).norm() < 1e-15);
}

#[test]
fn antiparallel_axes_turn_against_each_other() {
    let down = Axis::new(-Vector3::z(), Point3::new(1.0, 0.0, 9.0)).unwrap();
    let p = Point3::new(2.0, 0.0, 0.0);
    let k = turned(&upright(0.0, 0.0), 0.5, &turned(&down, 1.0, &p));
    let answers = rotate_about_parallel_axes(&upright(0.0, 0.0), &down, &p, &k, Reach::EXACT);
    assert_eq!(answers.len(), 2);
    let screws = [upright(0.0, 0.0), down].map(Screw::Revolute);
    let verdict = judge(&screws, &p, &k, &[0.5, 1.0], &answers);
    assert!(verdict.nearest < 1e-14, "{verdict:?}");
}

#[test]
fn a_stretched_elbow_has_one_answer() {
    let screws = [upright(0.0, 0.0), upright(1.0, 0.0)].map(Screw::Revolute);
    let p = Point3::new(2.0, 0.0, 0.0);
    for (k, q) in [(Point3::new(0.0, 2.0, 0.0), [FRAC_PI_2, 0.0]), (Point3::new(2.0, 0.0, 0.0), [0.0, 0.0])] {
        let answers = solve(&screws, &p, &k, Reach::EXACT);
        assert_eq!(answers.len(), 1);
        assert!(judge(&screws, &p, &k, &q, &answers).nearest < 1e-15);
    }
}

#[test]
fn meeting_axes_and_a_point_in_their_plane_have_one_answer() {
    let lying = Axis::new(Vector3::x(), Point3::origin()).unwrap();
    let screws = [upright(0.0, 0.0), lying].map(Screw::Revolute);
    // The point is at its highest position.
    let p = Point3::new(1.0, 2.0, 0.0);
    let k = turned(&upright(0.0, 0.0), 0.3, &turned(&lying, FRAC_PI_2, &p));
    let answers = solve(&screws, &p, &k, Reach::EXACT);
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert!(judge(&screws, &p, &k, &[0.3, FRAC_PI_2], &answers).nearest < 1e-7);
}

#[test]
fn parallel_slides_leave_the_second_free() {
    let v = Unit::new_normalize(Vector3::new(1.0, 2.0, 2.0));
    let (p, along) = (Point3::new(0.1, 0.2, 0.3), v.scale(3.0));
    for other in [v, -v] {
        let answers = translate_twice(&v, &other, &p, &(p + along), Reach::EXACT);
        assert_eq!(answers.len(), 1);
        assert!(answers[0][1].is_none() && (answers[0][0].unwrap() - 3.0).abs() < 1e-15);
        assert!(translate_twice(&v, &other, &p, &(p + along + Vector3::x()), Reach::EXACT).is_empty());
    }
}

#[test]
fn a_short_distance_far_from_the_origin_is_reached() {
    let mut random = Random(1);
    for exponent in 1..=16 {
        let screws = [random.screw(false), random.screw(false)];
        let (p, q) = (random.point() * 100.0, [10f64.powi(-exponent), -10f64.powi(-exponent)]);
        let k = carried(&screws, &q, &p);
        assert_eq!(solve(&screws, &p, &k, Reach::EXACT).len(), 1, "{exponent}");
    }
}

/// Targets off the surface that p sweeps, by 10^-e of the size: no solution where that exceeds the tolerance, a
/// solution where it does not.
#[test]
fn targets_off_the_reach_are_refused_by_the_size() {
    let mut random = Random(2);
    for (turns, exponent) in KINDS.iter().flat_map(|kinds| (1..=16).map(move |exponent| (kinds, exponent))) {
        let screws = turns.map(|turns| random.screw(turns));
        let (p, q) = (random.point(), [0.7, -0.4]);
        let k = carried(&screws, &q, &p);
        let step = 1e-6;
        let [a, b] = [[q[0] + step, q[1]], [q[0], q[1] + step]].map(|q| carried(&screws, &q, &p) - k);
        let normal = a.cross(&b).normalize();
        let size = size(&screws, &p, &k);
        let off = k + normal * (10f64.powi(-exponent) * size);
        let count = solve(&screws, &p, &off, Reach::EXACT).len();
        match exponent {
            // Over a large distance the surface may come back.
            ..6 => {}
            6..12 => assert_eq!(count, 0, "{turns:?} {exponent}"),
            12 => {}
            _ => assert!(count > 0, "{turns:?} {exponent}"),
        }
        let wide = solve(&screws, &p, &off, Reach::Within(10.0 * 10f64.powi(-exponent) + 1e-12));
        assert!(exponent < 6 || !wide.is_empty(), "{turns:?} {exponent}");
    }
}

/// Targets inside the end of the reach of an elbow by 10^-e: always solved, within the square root of the rounding
/// error.
#[test]
fn targets_inside_the_end_are_answered() {
    let screws = [upright(0.0, 0.0), upright(1.0, 0.0)].map(Screw::Revolute);
    let p = Point3::new(1.7, 0.0, 0.0);
    for (end, inwards) in [(1.7, -1.0), (0.3, 1.0)] {
        for exponent in 1..=16 {
            let step = inwards * 10f64.powi(-exponent);
            let answers = solve(&screws, &p, &Point3::new(0.0, end + step, 0.0), Reach::EXACT);
            assert!(!answers.is_empty(), "{end} {exponent}");
            assert!(exponent > 13 || answers.len() == 2, "{end} {exponent}");
            let outside = solve(&screws, &p, &Point3::new(0.0, end - step, 0.0), Reach::EXACT);
            assert!(exponent == 12 || outside.is_empty() == (exponent < 12), "{end} {exponent}");
            let wide = solve(&screws, &p, &Point3::new(0.0, end - step, 0.0), Reach::Within(1e-6));
            assert!(exponent == 6 || wide.is_empty() == (exponent < 6), "{end} {exponent}");
        }
    }
}

#[test]
fn closest_is_no_farther_than_any_value_of_a_grid() {
    let mut random = Random(3);
    for turns in KINDS.iter().cycle().take(80) {
        let screws = turns.map(|turns| random.screw(turns));
        let (p, k) = (random.point(), random.point() * 2.0);
        let answers = solve(&screws, &p, &k, Reach::Closest);
        let least = least_distance(&screws, &p, &k, 150);
        assert!(!answers.is_empty(), "{turns:?}");
        for answer in answers.iter() {
            let miss = (reached(&screws, answer, &p) - k).norm();
            assert!(miss <= least + 1e-6 * size(&screws, &p, &k), "{turns:?}: {miss} is more than {least}");
        }
    }
}

#[test]
fn closest_for_parallel_axes() {
    let mut random = Random(4);
    for _ in 0..50 {
        let first = random.axis();
        let axes = [first, first.shifted(&random.vector())];
        let (screws, p, k) = (axes.map(Screw::Revolute), random.point(), random.point() * 2.0);
        let answers = rotate_about_parallel_axes(&axes[0], &axes[1], &p, &k, Reach::Closest);
        let least = least_distance(&screws, &p, &k, 200);
        assert!(!answers.is_empty());
        for answer in answers.iter() {
            let miss = (reached(&screws, answer, &p) - k).norm();
            assert!(miss <= least + 1e-6 * size(&screws, &p, &k), "{miss} is more than {least}");
        }
    }
}

#[test]
fn nothing_comes_of_bad_numbers() {
    let mut random = Random(5);
    for turns in KINDS {
        let screws = turns.map(|turns| random.screw(turns));
        let good = random.point();
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..3 {
                let mut bad_point = good;
                bad_point[i] = bad;
                for reach in [Reach::EXACT, Reach::Within(f64::NAN), Reach::Closest] {
                    for (p, k) in [(bad_point, good), (good, bad_point), (bad_point, bad_point)] {
                        assert!(solve(&screws, &p, &k, reach).is_empty(), "{turns:?} {p} {k} {reach:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn any_magnitude_will_do() {
    let mut random = Random(6);
    for (turns, exponent) in KINDS.iter().flat_map(|kinds| (-6..=6).map(move |exponent| (kinds, exponent))) {
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
    let mut random = Random(7);
    for _ in 0..25 {
        let (p, q, w, centre) = (random.point(), [random.angle(), random.angle()], random.direction(), random.vector());
        let meeting = [0, 1].map(|_| Axis::central(random.direction()).shifted(&centre));
        let parallel = [0, 1].map(|_| Axis::central(w).shifted(&random.vector()));
        let skew = [random.axis(), random.axis()];
        for axes in [meeting, parallel, skew] {
            let screws = axes.map(Screw::Revolute);
            let k = carried(&screws, &q, &p);
            assert_eq!(solve(&screws, &p, &k, Reach::EXACT).len(), oracle_count(&screws, &p, &k), "{axes:?} {p} {q:?}");
        }
    }
}

/// The points c of RH0 (2-31), with the denominator of alpha and beta as a parameter, and whether gamma is real.
fn printed(
    axes: &[Axis; 2],
    r: [Point3<f64>; 2],
    p: &Point3<f64>,
    k: &Point3<f64>,
    denominator: f64,
) -> Vec<Point3<f64>> {
    let [w1, w2] = axes.each_ref().map(|axis| axis.direction().into_inner());
    let (u, v, dot) = (p - r[1], k - r[0], w1.dot(&w2));
    let alpha = (dot * w2.dot(&u) - w1.dot(&v)) / denominator;
    let beta = (dot * w1.dot(&v) - w2.dot(&u)) / denominator;
    let square = u.norm_squared() - alpha * alpha - beta * beta - 2.0 * alpha * beta * dot;
    let gamma = (square / w1.cross(&w2).norm_squared()).sqrt();
    [gamma, -gamma].map(|gamma| r[1] + w1 * alpha + w2 * beta + w1.cross(&w2) * gamma).into_iter().collect()
}

/// The distance of a point from the circle of p about the second axis and from that of k about the first.
fn off_both(axes: &[Axis; 2], p: &Point3<f64>, k: &Point3<f64>, c: &Point3<f64>) -> f64 {
    let off = |axis: &Axis, x: &Point3<f64>| {
        let height = axis.direction().dot(&(c - x));
        height.hypot(axis.distance_to(c) - axis.distance_to(x))
    };
    off(&axes[1], p).max(off(&axes[0], k))
}

/// RH0 (2-31) is valid for axes that intersect in r. Skew axes have no common r, and with the feet of the common normal
/// both points are off the circles. The one common point is found.
#[test]
fn rh0_2_31_holds_for_meeting_axes_only() {
    let mut random = Random(8);
    for _ in 0..200 {
        let centre = random.point();
        let meeting = [0, 1].map(|_| Axis::central(random.direction()).shifted(&centre.coords));
        let skew = [random.axis(), random.axis()];
        let (p, q) = (random.point(), [random.angle(), random.angle()]);
        let denominator = |axes: &[Axis; 2]| axes[0].direction().dot(&axes[1].direction()).powi(2) - 1.0;
        if denominator(&meeting).abs() < 0.1 || denominator(&skew).abs() < 0.1 {
            continue;
        }
        let k = carried(&meeting.map(Screw::Revolute), &q, &p);
        for c in printed(&meeting, [centre; 2], &p, &k, denominator(&meeting)) {
            assert!(off_both(&meeting, &p, &k, &c) < 1e-6 || c.coords.norm().is_nan());
        }
        let (a, b) = skew[0].nearest_points(&skew[1]).unwrap();
        let k = carried(&skew.map(Screw::Revolute), &q, &p);
        let points = printed(&skew, [a, b], &p, &k, denominator(&skew));
        let good = points.iter().filter(|c| off_both(&skew, &p, &k, c) < 1e-9).count();
        assert!(good < 2, "two circles about skew axes met twice");
        let answers = solve(&skew.map(Screw::Revolute), &p, &k, Reach::EXACT);
        assert_eq!(answers.len(), 1);
        assert!(!judge(&skew.map(Screw::Revolute), &p, &k, &q, &answers).is_lost());
    }
}

/// With 1 - w1.w2 instead of 1 - (w1.w2)^2, as in public implementations of the skew problem, alpha and beta are wrong
/// unless the axes are normal to each other.
#[test]
fn one_minus_the_product_is_not_one_minus_its_square() {
    let mut random = Random(9);
    let (mut wrong, mut trials) = (0, 0);
    for _ in 0..200 {
        let centre = random.point();
        let axes = [0, 1].map(|_| Axis::central(random.direction()).shifted(&centre.coords));
        let dot = axes[0].direction().dot(&axes[1].direction());
        if !(0.1..0.9).contains(&dot.abs()) {
            continue;
        }
        let (p, q) = (random.point(), [random.angle(), random.angle()]);
        let (screws, k) = (axes.map(Screw::Revolute), carried(&axes.map(Screw::Revolute), &q, &p));
        let best = |denominator: f64| {
            let points = printed(&axes, [centre; 2], &p, &k, denominator);
            points.iter().map(|c| off_both(&axes, &p, &k, c)).fold(f64::INFINITY, f64::min)
        };
        trials += 1;
        // Where gamma is not real there is no point, and the infinite distance stays.
        wrong += usize::from(best(dot - 1.0) >= 1e-3);
        assert!(best(dot * dot - 1.0) < 1e-6);
        assert!(!judge(&screws, &p, &k, &q, &solve(&screws, &p, &k, Reach::EXACT)).is_lost());
    }
    assert!(wrong * 10 > trials * 9, "{wrong} of {trials}");
}

/// Angles stay in (-pi, pi] at the half turn.
#[test]
fn a_half_turn_is_positive() {
    let screws = [upright(0.0, 0.0), upright(1.0, 0.0)].map(Screw::Revolute);
    let answers = solve(&screws, &Point3::new(2.0, 0.0, 0.0), &Point3::new(-2.0, 0.0, 0.0), Reach::EXACT);
    assert_eq!(answers.len(), 1);
    assert_eq!(answers[0][0], Some(PI));
}
