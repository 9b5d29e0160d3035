//! Real solutions of systems: known numbers of real solutions, planted solutions, exact signs.

pub(crate) mod sixteen;

use std::cmp::Ordering;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use groebot_algebra::groebner::Basis;
use groebot_algebra::number::{BigInt, BigRational, Rationals};
use groebot_algebra::poly::{Polynomial, PolynomialRing, parse};
use groebot_algebra::real::{Options, RealSolution, solve, solve_basis};
use groebot_algebra::{ErrorKind, Result, Watch};
use num_traits::One;
use proptest::prelude::*;

use crate::corpus::groebner::{case, read_basis};

use sixteen::{rational, system};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

fn try_solve<S: AsRef<str>>(variables: &[S], equations: &[S]) -> Result<Vec<RealSolution>> {
    let (ring, generators) = system(variables, equations);
    solve(&ring, &generators, &Options::default(), &Watch::none())
}

fn all<S: AsRef<str>>(variables: &[S], equations: &[S]) -> Vec<RealSolution> {
    try_solve(variables, equations).unwrap()
}

fn numbered(count: usize) -> Vec<String> {
    (0..count).map(|i| format!("x{i}")).collect()
}

/// Katsura's system with `n + 1` unknowns.
fn katsura(n: usize) -> (Vec<String>, Vec<String>) {
    let index = |i: i64| i.unsigned_abs() as usize;
    let n = n as i64;
    let pairs = |m: i64| (-n..=n).filter(move |l| (m - l).abs() <= n);
    let sum = |m: i64| pairs(m).map(|l| format!("x{}*x{}", index(l), index(m - l))).collect::<Vec<_>>().join(" + ");
    let mut equations: Vec<String> = (0..n).map(|m| format!("{} - x{m}", sum(m))).collect();
    equations.push(format!("x0 + {} - 1", (1..=n).map(|i| format!("2*x{i}")).collect::<Vec<_>>().join(" + ")));
    (numbered(n as usize + 1), equations)
}

fn cyclic(n: usize) -> (Vec<String>, Vec<String>) {
    let product = |i: usize, k: usize| (0..k).map(|j| format!("x{}", (i + j) % n)).collect::<Vec<_>>().join("*");
    let mut equations: Vec<String> =
        (1..n).map(|k| (0..n).map(|i| product(i, k)).collect::<Vec<_>>().join(" + ")).collect();
    equations.push(format!("{} - 1", product(0, n)));
    (numbered(n), equations)
}

/// Noonburg's neural network.
fn noon(n: usize) -> (Vec<String>, Vec<String>) {
    let squares = |i: usize| (0..n).filter(|&j| j != i).map(|j| format!("x{j}^2")).collect::<Vec<_>>().join(" + ");
    let equations = (0..n).map(|i| format!("10*x{i}*({}) - 11*x{i} + 10", squares(i))).collect();
    (numbered(n), equations)
}

/// Morgan's economic model.
fn eco(n: usize) -> (Vec<String>, Vec<String>) {
    let last = n - 1;
    let row = |k: usize| (0..last - k - 1).map(|i| format!(" + x{i}*x{}", i + k + 1)).collect::<String>();
    let mut equations: Vec<String> = (0..last).map(|k| format!("(x{k}{})*x{last} - {}", row(k), k + 1)).collect();
    equations.push(format!("{} + 1", numbered(last).join(" + ")));
    (numbered(n), equations)
}

/// Checks that every generator is zero at every solution, and that the boxes are disjoint and narrow.
fn assert_solves(ring: &Ground, generators: &[Poly], solutions: &[RealSolution]) {
    let width = BigRational::new(BigInt::one(), BigInt::one() << Options::default().precision);
    for (i, solution) in solutions.iter().enumerate() {
        assert!(solution.coordinates.iter().all(|side| side.low <= side.high && side.width() <= width));
        let apart = |other: &RealSolution| {
            let mut sides = solution.coordinates.iter().zip(&other.coordinates);
            sides.any(|(a, b)| a.high < b.low || b.high < a.low)
        };
        assert!(solutions[..i].iter().all(apart), "boxes {i} and another meet");
        for generator in generators {
            assert_eq!(solution.sign(ring, generator, &Watch::none()).unwrap(), Ordering::Equal);
        }
    }
}

fn assert_count((variables, equations): (Vec<String>, Vec<String>), count: usize) {
    let (ring, generators) = system(&variables, &equations);
    let solutions = solve(&ring, &generators, &Options::default(), &Watch::none()).unwrap();
    assert_eq!(solutions.len(), count, "{equations:?}");
    assert_solves(&ring, &generators, &solutions);
}

/// Counted by msolve 0.10.1 (`msolve -f FILE`, the number of boxes in its output).
#[test]
fn families_have_the_numbers_of_real_solutions_that_msolve_finds() {
    for (n, count) in [(3, 6), (4, 12), (5, 16)] {
        assert_count(katsura(n), count);
    }
    assert_count(cyclic(5), 10);
    assert_count(noon(3), 7);
    assert_count(noon(4), 15);
    for (n, count) in [(5, 4), (6, 4), (7, 8)] {
        assert_count(eco(n), count);
    }
}

/// As above; these take seconds.
#[test]
#[ignore = "the bases over Q take seconds"]
fn large_families_have_the_numbers_of_real_solutions_that_msolve_finds() {
    assert_count(katsura(6), 32);
    assert_count(katsura(7), 44);
    assert_count(eco(8), 8);
}

/// From the bases of Singular in tests/corpus. The counts are msolve's.
#[test]
fn katsura_6_and_cyclic_6_from_stored_bases() {
    for (name, count) in [("katsura_6-grevlex-q", 32), ("cyclic_6-grevlex-q", 24)] {
        let case = case(name);
        let ring = case.ring(&Rationals);
        let polynomials = read_basis(&ring, &case.basis);
        let basis = Basis { ring: ring.clone(), polynomials, cofactors: Vec::new() };
        let solutions = solve_basis(&basis, &case.generators(&ring), &Options::default(), &Watch::none()).unwrap();
        assert_eq!(solutions.len(), count, "{name}");
    }
}

/// Two links of length `a` and `b` in the plane at the angles whose half-angle tangents are `s` and `t`.
fn two_links(a: i64, b: i64, s: (i64, i64), t: (i64, i64)) -> (Vec<BigRational>, Vec<BigRational>, Vec<RealSolution>) {
    let turn = |(n, d): (i64, i64)| [rational(d * d - n * n, d * d + n * n), rational(2 * n * d, d * d + n * n)];
    let ([c1, s1], [c2, s2]) = (turn(s), turn(t));
    let (c12, s12) = (&c1 * &c2 - &s1 * &s2, &s1 * &c2 + &c1 * &s2);
    let along = |c: &BigRational, c12: &BigRational| c * rational(a, 1) + c12 * rational(b, 1);
    let (x, y) = (along(&c1, &c12), along(&s1, &s12));
    let equations = [
        format!("{a}*c1 + {b}*(c1*c2 - s1*s2) - ({x})"),
        format!("{a}*s1 + {b}*(s1*c2 + c1*s2) - ({y})"),
        "c1^2 + s1^2 - 1".to_owned(),
        "c2^2 + s2^2 - 1".to_owned(),
    ];
    let solutions = all(&["c1", "s1", "c2", "s2"].map(str::to_owned), &equations);
    // The other solution is the mirror image at the line from the base to the tip.
    let square = &x * &x + &y * &y;
    let project = (&c1 * &x + &s1 * &y) / &square * rational(2, 1);
    let mirror = vec![&project * &x - &c1, &project * &y - &s1, c2.clone(), -s2.clone()];
    (vec![c1, s1, c2, s2], mirror, solutions)
}

fn is_at(solution: &RealSolution, point: &[BigRational]) -> bool {
    solution.coordinates.iter().zip(point).all(|(side, x)| side.contains(x))
}

proptest! {
    #![proptest_config(crate::cases(24))]

    #[test]
    fn two_links_have_both_elbows(a in 1i64..9, b in 1i64..9, s in (-9i64..9, 1i64..9), t in (-9i64..9, 1i64..9)) {
        prop_assume!(a != b || t.0 != 0);
        let (planted, mirror, solutions) = two_links(a, b, s, t);
        prop_assert_eq!(solutions.len(), if t.0 == 0 { 1 } else { 2 });
        prop_assert_eq!(solutions.iter().map(|x| x.multiplicity).sum::<usize>(), 2);
        for point in [planted, mirror] {
            prop_assert_eq!(solutions.iter().filter(|x| is_at(x, &point)).count(), 1);
        }
    }

    /// `p(x + a y) = q(y + b x) = 0` with rational roots: a grid of points with products of multiplicities.
    #[test]
    fn planted_grids_are_found(
        p in prop::collection::btree_map(-9i64..9, 1usize..3, 1..4),
        q in prop::collection::btree_map(-9i64..9, 1usize..3, 1..3),
        a in -2i64..3, b in -2i64..3,
    ) {
        prop_assume!(a * b != 1);
        let factors = |form: &str, roots: &std::collections::BTreeMap<i64, usize>| {
            roots.iter().map(|(n, m)| format!("(3*({form}) - ({n}))^{m}")).collect::<Vec<_>>().join("*")
        };
        let solutions = all(&["x", "y"], &[&factors(&format!("x + {a}*y"), &p)[..], &factors(&format!("y + {b}*x"), &q)]);
        prop_assert_eq!(solutions.len(), p.len() * q.len());
        for (n, times) in &p {
            for (m, others) in &q {
                let determinant = rational(3 * (1 - a * b), 1);
                let point = [rational(n - a * m, 1) / &determinant, rational(m - b * n, 1) / &determinant];
                let here: Vec<_> = solutions.iter().filter(|x| is_at(x, &point)).collect();
                prop_assert_eq!(here.len(), 1);
                prop_assert_eq!(here[0].multiplicity, times * others);
                let doubles = point.map(|x| num_traits::ToPrimitive::to_f64(&x).unwrap());
                prop_assert_eq!(here[0].approximate(), doubles);
            }
        }
    }
}

/// The NAO leg in the sagittal plane (NAO section 6.7, millimetres) at (60, 150): both solutions satisfy `20580 c4 =
/// px^2 + pz^2 - 20588.41` (6.7.18), and the knee bends forwards or backwards.
#[test]
fn the_nao_leg_has_two_solutions() {
    let equations = [
        "102.9*(c3*s4 + s3*c4) + 100*s3 - 60",
        "102.9*(c3*c4 - s3*s4) + 100*c3 - 150",
        "c3^2 + s3^2 - 1",
        "c4^2 + s4^2 - 1",
    ];
    let (ring, _) = system(&["c4", "c3", "s4", "s3"], &[]);
    let solutions = all(&["c4", "c3", "s4", "s3"], &equations);
    assert_eq!(solutions.len(), 2);
    let closed = parse("20580*c4 - 60^2 - 150^2 + 20588.41").unwrap().evaluate(&ring).unwrap();
    let knee = parse("s4").unwrap().evaluate(&ring).unwrap();
    let mut signs = Vec::new();
    for solution in &solutions {
        assert_eq!(solution.sign(&ring, &closed, &Watch::none()).unwrap(), Ordering::Equal);
        signs.push(solution.sign(&ring, &knee, &Watch::none()).unwrap());
    }
    signs.sort();
    assert_eq!(signs, [Ordering::Less, Ordering::Greater]);
}

#[test]
fn circles_touch_meet_and_miss() {
    let circles = |x: &str| all(&["x", "y"], &["x^2 + y^2 - 1", &format!("(x - {x})^2 + y^2 - 1")]);
    let touching = circles("2");
    assert_eq!((touching.len(), touching[0].multiplicity), (1, 2));
    assert_eq!(touching[0].approximate(), [1.0, 0.0]);
    let meeting = circles("1");
    assert_eq!(meeting.len(), 2);
    let height = 0.75f64.sqrt();
    let mut heights: Vec<_> = meeting.iter().map(RealSolution::approximate).collect();
    heights.sort_by(|a, b| a[1].total_cmp(&b[1]));
    assert_eq!(heights, [[0.5, -height], [0.5, height]]);
    assert!(circles("3").is_empty());
}

#[test]
fn contradictions_and_curves_are_refused() {
    assert_eq!(try_solve(&["x"], &["x^2 - 1", "x - 2"]).unwrap_err().kind(), ErrorKind::Inconsistent);
    assert_eq!(try_solve(&["x", "y"], &["x*y - 1"]).unwrap_err().kind(), ErrorKind::PositiveDimensional);
    let (ring, generators) = system(&["x"], &["x^2 - 2"]);
    let watch = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = solve(&ring, &generators, &Options::default(), &watch).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

#[test]
fn neighbours_far_below_the_precision_get_disjoint_boxes() {
    let (ring, generators) = system(&["x", "y"], &["(3*x - 1)*(3*2^90*x - 2^90 - 1)", "y^2 - x"]);
    let options = Options { precision: 8 };
    let solutions = solve(&ring, &generators, &options, &Watch::none()).unwrap();
    assert_eq!(solutions.len(), 4);
    for point in [rational(1, 3), rational(1, 3) + BigRational::new(BigInt::one(), BigInt::from(3) << 90)] {
        assert_eq!(solutions.iter().filter(|x| x.coordinates[0].contains(&point)).count(), 2);
    }
    for (i, a) in solutions.iter().enumerate() {
        for b in &solutions[..i] {
            assert!(a.coordinates.iter().zip(&b.coordinates).any(|(a, b)| a.high < b.low || b.high < a.low));
        }
    }
}

#[test]
fn coordinates_round_as_square_roots_do() {
    for (n, p) in [(2, 3), (5, 7), (10, 11)] {
        let equations = [format!("x^2 - {n}"), format!("y^2 - {p}/1000000007"), "z - x*y + x*y".to_owned()];
        let (x, y) = (f64::from(n).sqrt(), (f64::from(p) / 1_000_000_007.0).sqrt());
        let solutions = all(&["x", "y", "z"].map(str::to_owned), &equations);
        assert_eq!(solutions.len(), 4);
        for solution in solutions {
            let found = solution.approximate();
            assert_eq!((found[0].abs(), found[2]), (x, 0.0));
            assert!((found[1].abs() - y).abs() <= y * f64::EPSILON, "the root of a rounded quotient");
        }
    }
}

#[test]
fn signs_at_solutions_are_exact() {
    let (ring, generators) = system(&["x", "y"], &["x^2 - 2", "y^2 - 3"]);
    let solutions = solve(&ring, &generators, &Options { precision: 4 }, &Watch::none()).unwrap();
    let sign = |solution: &RealSolution, text: &str| {
        let polynomial = parse(text).unwrap().evaluate(&ring).unwrap();
        solution.sign(&ring, &polynomial, &Watch::none()).unwrap()
    };
    for solution in &solutions {
        let [x, y] = [sign(solution, "x"), sign(solution, "y")];
        assert_eq!(sign(solution, "x^4 - 4"), Ordering::Equal);
        assert_eq!(sign(solution, "(x + y)^2 - 5 - 2*x*y"), Ordering::Equal);
        assert_eq!(sign(solution, "x^3"), x);
        assert_eq!(sign(solution, "x*y"), if x == y { Ordering::Greater } else { Ordering::Less });
        // sqrt 6 = 2.449489742783178098197284074705891...
        assert_eq!(sign(solution, "x*y - 2.449489742783178098197284074706"), Ordering::Less);
        assert_eq!(
            sign(solution, "x*y - 2.449489742783178098197284074705"),
            if x == y { Ordering::Greater } else { Ordering::Less }
        );
    }
}
