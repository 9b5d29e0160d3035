//! Four circles: degenerate cases, invalid numbers, and the number of solutions by the oracle. The families are in
//! `subproblems_record`.

use groebot_robot::kinematics::oracle::Oracle;
use groebot_robot::kinematics::screw::circles::{four_circles, three_circles};
use groebot_robot::kinematics::screw::values::Reach;
use groebot_robot::spatial::Axis;
use nalgebra::{Point3, Unit, Vector3};

use super::instance::Random;
use super::subproblem_families::sp6_by;
use super::turned;

fn rotated(k: &Unit<Vector3<f64>>, q: f64, p: &Vector3<f64>) -> Vector3<f64> {
    turned(&Axis::central(*k), q, &Point3::from(*p)).coords
}

#[test]
fn the_oracle_finds_as_many_for_three_circles() {
    let mut random = Random(1);
    for _ in 0..40 {
        let (k, p) = ([(); 3].map(|()| random.direction()), [(); 3].map(|()| random.vector()));
        let q = [random.angle(), random.angle(), random.angle()];
        let right = |q: &[f64]| rotated(&k[1], q[1], &(p[1] + rotated(&k[2], q[2], &p[2])));
        let p0 = right(&q) - rotated(&k[0], q[0], &p[0]);
        let miss = |q: &[f64]| (p0 + rotated(&k[0], q[0], &p[0]) - right(q)).iter().copied().collect();
        let count = Oracle { seeds: 200, ..Oracle::default() }.solve(3, miss).unwrap().len();
        let found = three_circles([&k[0], &k[1], &k[2]], [&p0, &p[0], &p[1], &p[2]], Reach::EXACT);
        assert_eq!(found.len(), count, "{k:?} {p:?} {q:?}");
    }
}

#[test]
fn the_oracle_finds_as_many_for_four_circles() {
    let mut random = Random(2);
    for _ in 0..50 {
        let [h, p] = [(); 2].map(|()| [(); 4].map(|()| random.vector()));
        let (k, q) = ([(); 4].map(|()| random.direction()), [random.angle(), random.angle()]);
        let term = |i: usize, q: f64| h[i].dot(&rotated(&k[i], q, &p[i]));
        let sums = |q: &[f64]| [term(0, q[0]) + term(1, q[1]), term(2, q[0]) + term(3, q[1])];
        let [d1, d2] = sums(&q);
        let miss = |q: &[f64]| vec![sums(q)[0] - d1, sums(q)[1] - d2];
        let count = Oracle { seeds: 200, ..Oracle::default() }.solve(2, miss).unwrap().len();
        assert_eq!(four_circles(h, k, p, [d1, d2], Reach::EXACT).len(), count, "{h:?} {k:?} {p:?} {q:?}");
    }
}

/// One equation contains the first angle only: it has two solutions, and the other equation two for each.
#[test]
fn equations_that_part() {
    let (x, z) = (Vector3::x(), Vector3::z_axis());
    let h = [x, Vector3::zeros(), Vector3::zeros(), x];
    let answers = four_circles(h, [z; 4], [x; 4], [0.5, 0.25], Reach::EXACT);
    assert_eq!(answers.len(), 4);
    for answer in answers.iter() {
        assert!((answer[0].unwrap().cos() - 0.5).abs() < 1e-15 && (answer[1].unwrap().cos() - 0.25).abs() < 1e-15);
    }
}

/// Equal vectors in both equations for one of the angles.
#[test]
fn one_angle_alike_in_both_equations() {
    let mut random = Random(3);
    for _ in 0..200 {
        let [mut h, mut p] = [(); 2].map(|()| [(); 4].map(|()| random.vector()));
        let mut k = [(); 4].map(|()| random.direction());
        let alike = random.integer(0, 1) as usize;
        (h[alike + 2], k[alike + 2], p[alike + 2]) = (h[alike], k[alike], p[alike]);
        let verdict = sp6_by(h, k, p, [random.angle(), random.angle()]);
        assert!(!verdict.is_lost() && verdict.apart > 1e-9, "{verdict:?}");
    }
}

#[test]
fn nothing_comes_of_bad_numbers() {
    let mut random = Random(4);
    let [h, p] = [(); 2].map(|()| [(); 4].map(|()| random.vector()));
    let k = [(); 4].map(|()| random.direction());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for reach in [Reach::EXACT, Reach::Within(f64::NAN), Reach::Closest] {
            assert!(four_circles(h, k, p, [bad, 0.0], reach).is_empty());
            assert!(four_circles(h, k, p, [0.0, bad], reach).is_empty());
            for i in 0..4 {
                let (mut far, mut odd) = (p, h);
                far[i].x = bad;
                odd[i].y = bad;
                assert!(four_circles(h, k, far, [0.0, 0.0], reach).is_empty());
                assert!(four_circles(odd, k, p, [0.0, 0.0], reach).is_empty());
            }
        }
    }
    assert!(four_circles([Vector3::zeros(); 4], k, p, [0.0, 1.0], Reach::EXACT).is_empty());
    assert!(four_circles(h, k, p, [99.0, 0.0], Reach::EXACT).is_empty());
}
