//! The manipulator of six joints that reaches one pose in sixteen ways (R. Manseur and K. Doty, "A robot manipulator with 16 real inverse
//! kinematic solution sets", Int. J. Robotics Research 8 (1989) 75-79).

use groebot::Watch;
use groebot::number::{BigRational, Rationals, Ring};
use groebot::poly::{Order, PolynomialRing};
use groebot::real::{Options, RealSolution, solve};
use num_traits::ToPrimitive;

use super::{Ground, Poly, rational};

/// A matrix of homogeneous coordinates over the polynomials of the sines and cosines.
type Frame = [[Poly; 4]; 4];

/// d and a \[m\] and tan(alpha / 2) of the six links; the published twists are 90 and 1 degrees, here 1 / 115 is for the latter.
fn links() -> [[BigRational; 3]; 6] {
    let (zero, half_degree, right) = (rational(0, 1), rational(1, 115), rational(1, 1));
    let link = |d: &BigRational, a: &BigRational, tangent: &BigRational| [d.clone(), a.clone(), tangent.clone()];
    [
        link(&zero, &rational(3, 10), &right),
        link(&zero, &rational(1, 1), &half_degree),
        link(&rational(1, 5), &zero, &right),
        link(&zero, &rational(3, 2), &half_degree),
        link(&zero, &zero, &right),
        link(&zero, &zero, &half_degree),
    ]
}

/// The published pose, to six places.
const POSE: [[f64; 4]; 3] =
    [[-0.760117, -0.641689, 0.102262, -1.140175], [0.133333, 0.0, 0.991071, 0.0], [-0.635959, 0.766965, 0.085558, 0.0]];

/// A rotation, as a quaternion of integers, and a position next to the published pose: as that has six places, it is no pose exactly.
fn pose() -> [[BigRational; 4]; 3] {
    let [w, x, y, z] = [4199i64, -2892, 9525, 10000];
    let norm = w * w + x * x + y * y + z * z;
    let row = |entries: [i64; 3], p: BigRational| {
        let [a, b, c] = entries.map(|n| rational(n, norm));
        [a, b, c, p]
    };
    [
        row([w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)], rational(-1_140_175, 1_000_000)),
        row([2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)], rational(0, 1)),
        row([2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], rational(0, 1)),
    ]
}

/// The cosine and the sine of an angle from the tangent of its half.
fn circle_point(tangent: &BigRational) -> [BigRational; 2] {
    let (one, square) = (rational(1, 1), tangent * tangent);
    [(&one - &square) / (&one + &square), tangent * rational(2, 1) / (one + square)]
}

/// Rz(theta) Tz(d) Tx(a) Rx(alpha); cosine and sine of theta are the variables `2 i` and `2 i + 1`.
fn link(ring: &Ground, index: usize) -> Frame {
    let [d, a, tangent] = &links()[index];
    let [k, m] = circle_point(tangent);
    let [c, s] = [ring.variable(2 * index), ring.variable(2 * index + 1)];
    let number = |q: &BigRational| ring.constant(q.clone());
    let zero = || ring.zero();
    [
        [c.clone(), ring.scale(&s, &-&k), ring.scale(&s, &m), ring.scale(&c, a)],
        [s.clone(), ring.scale(&c, &k), ring.scale(&c, &-&m), ring.scale(&s, a)],
        [zero(), number(&m), number(&k), number(d)],
        [zero(), zero(), zero(), ring.one()],
    ]
}

fn product(ring: &Ground, a: &Frame, b: &Frame) -> Frame {
    let entry = |i: usize, j: usize| (0..4).fold(ring.zero(), |sum, k| ring.add(&sum, &ring.mul(&a[i][k], &b[k][j])));
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The inverse of a rigid motion.
fn inverse(ring: &Ground, a: &Frame) -> Frame {
    let shift = |i: usize| (0..3).fold(ring.zero(), |sum, k| ring.sub(&sum, &ring.mul(&a[k][i], &a[k][3])));
    let entry = |i: usize, j: usize| match (i, j) {
        (3, _) => a[3][j].clone(),
        (_, 3) => shift(i),
        _ => a[j][i].clone(),
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// T1 T2 T3 = G (T4 T5 T6)^-1: twelve entries and six circles.
fn equations(ring: &Ground) -> Vec<Poly> {
    let chain = |from: usize| {
        let two = product(ring, &link(ring, from), &link(ring, from + 1));
        product(ring, &two, &link(ring, from + 2))
    };
    let last = [rational(0, 1), rational(0, 1), rational(0, 1), rational(1, 1)];
    let [first, second, third] = pose();
    let goal = [first, second, third, last].map(|row| row.map(|q| ring.constant(q)));
    let (left, right) = (chain(0), product(ring, &goal, &inverse(ring, &chain(3))));
    let entries = (0..12).map(|k| ring.sub(&left[k / 4][k % 4], &right[k / 4][k % 4]));
    let square = |v: usize| ring.pow(&ring.variable(v), 2);
    let circles = (0..6).map(|i| ring.sub(&ring.add(&square(2 * i), &square(2 * i + 1)), &ring.one()));
    entries.chain(circles).collect()
}

/// The pose of the chain at a solution, by numbers.
fn forward(solution: &RealSolution) -> [[f64; 4]; 3] {
    let number = |q: &BigRational| q.to_f64().expect("a number");
    let middle = |v: usize| number(&((&solution.coordinates[v].low + &solution.coordinates[v].high) / rational(2, 1)));
    let mut frame = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for (i, [d, a, tangent]) in links().iter().enumerate() {
        let (c, s, [d, a]) = (middle(2 * i), middle(2 * i + 1), [d, a].map(number));
        let [k, m] = circle_point(tangent).map(|q| number(&q));
        let link = [[c, -s * k, s * m, c * a], [s, c * k, -c * m, s * a], [0.0, m, k, d], [0.0, 0.0, 0.0, 1.0]];
        frame = frame.map(|row| std::array::from_fn(|j| (0..4).map(|k| row[k] * link[k][j]).sum()));
    }
    frame
}

fn assert_close(a: &[[f64; 4]; 3], b: &[[f64; 4]; 3], tolerance: f64) {
    let apart = a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(apart <= tolerance, "{apart}: {a:?}");
}

/// Sixteen is the published number, and the one that Singular's `nrRootsDeterm` counts for these equations without joint 6.
#[test]
fn sixteen_ways_to_one_pose() {
    let names: Vec<String> = (1..=6).flat_map(|i| [format!("c{i}"), format!("s{i}")]).collect();
    let ring = PolynomialRing::new(Rationals, &names, Order::GrevLex).unwrap();
    let found = solve(&ring, &equations(&ring), &Options::default(), &Watch::none()).unwrap();
    assert_eq!(found.len(), 16);
    let goal = pose().map(|row| row.map(|q| q.to_f64().expect("a number")));
    assert_close(&goal, &POSE, 1e-4);
    for solution in &found {
        assert_close(&forward(solution), &goal, 1e-12);
        assert_eq!(solution.multiplicity, 1);
    }
    assert_eq!(found[0].representation().polynomial.degree(), Some(16), "no complex solution beside them");
}
