//! Arcs of a KUKA iiwa 14 against a scan of its elbow circle.

use std::f64::consts::{PI, TAU};

use groebot_runtime::redundant::{Arc, Criterion, Q, Redundant, Within, any_within, arcs, at, best};

use super::srs::{Circle, Srs, pose};
use crate::random;

const SIGNS: [[f64; 3]; 8] = [
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, 1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [-1.0, -1.0, -1.0],
];

fn turn(a: f64) -> f64 {
    a - TAU * (a / TAU).round()
}

fn distance(a: &Q, b: &Q) -> f64 {
    (0..7).map(|i| turn(a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// The least distance to a limit. The elbow's angle is constant, and may be at its limit.
fn margin(q: &Q, limits: &[[f64; 2]; 7]) -> f64 {
    let of = |i: usize| (q[i] - limits[i][0]).min(limits[i][1] - q[i]) + if i == 3 { 1e-9 } else { 0.0 };
    (0..7).map(of).fold(f64::INFINITY, f64::min)
}

/// Points of a curve, dense where it moves fast or is near a limit.
struct Scan<'a> {
    circle: &'a Circle,
    signs: [f64; 3],
    limits: &'a [[f64; 2]; 7],
    points: Vec<(f64, Q)>,
}

impl Scan<'_> {
    fn refine(&mut self, [a, b]: [f64; 2], [qa, qb]: [&Q; 2], depth: usize) {
        let step = distance(qa, qb);
        let (ma, mb) = (margin(qa, self.limits), margin(qb, self.limits));
        let is_crossing = (ma > 0.0) != (mb > 0.0);
        let is_near = ma.abs().min(mb.abs()) < step;
        let is_fine = step < 5e-3 && (!is_near || step < 1e-4) && (!is_crossing || step < 1e-7);
        if is_fine || depth == 0 {
            self.points.push((b, *qb));
            return;
        }
        let c = 0.5 * (a + b);
        let qc = self.circle.at(self.signs, c);
        self.refine([a, c], [qa, &qc], depth - 1);
        self.refine([c, b], [&qc, qb], depth - 1);
    }
}

/// The lengths of the arcs of one curve.
fn lengths(circle: &Circle, signs: [f64; 3], limits: &[[f64; 2]; 7], count: usize) -> Vec<f64> {
    let mut scan = Scan { circle, signs, limits, points: Vec::new() };
    let mut last = (-PI, circle.at(signs, -PI));
    let home = last;
    for k in 1..=count {
        let phi = -PI + TAU * k as f64 / count as f64;
        let q = if k == count { home.1 } else { circle.at(signs, phi) };
        scan.refine([last.0, phi], [&last.1, &q], 30);
        last = (phi, q);
    }
    let mut all = Vec::new();
    let mut open: Option<f64> = None;
    let mut is_first_open = margin(&home.1, limits) > 0.0;
    let is_home_inside = is_first_open;
    let mut first_length = 0.0;
    let mut before = home.1;
    if is_home_inside {
        open = Some(0.0);
    }
    for (_, q) in &scan.points {
        let is_inside = margin(q, limits) > 0.0;
        match (open, is_inside) {
            (Some(length), true) => open = Some(length + distance(&before, q)),
            (Some(length), false) => {
                if is_first_open {
                    first_length = length;
                    is_first_open = false;
                } else {
                    all.push(length);
                }
                open = None;
            }
            (None, true) => open = Some(0.0),
            (None, false) => {}
        }
        before = *q;
    }
    if let Some(length) = open {
        all.push(length + first_length);
    }
    all
}

/// The lengths of the arcs of all curves.
fn scanned(circle: &Circle, limits: &[[f64; 2]; 7]) -> Vec<f64> {
    let mut all: Vec<f64> = SIGNS.iter().flat_map(|signs| lengths(circle, *signs, limits, 500)).collect();
    all.retain(|x| *x > 1e-4);
    all.sort_by(f64::total_cmp);
    all
}

fn are_equal(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
}

/// The least magnitude of the sines of q2 and q6 on the curves, and that of q4.
fn regularity(circle: &Circle) -> f64 {
    let mut least = f64::INFINITY;
    for signs in [SIGNS[0], SIGNS[2]] {
        for k in 0..2000 {
            let q = circle.at(signs, TAU * f64::from(k) / 2000.0);
            least = least.min(q[1].sin().abs()).min(q[5].sin().abs()).min(q[3].sin().abs());
        }
    }
    least
}

/// The number of vectors: `GROEBOT_VECTORS` for long runs.
fn count(usual: usize) -> usize {
    std::env::var("GROEBOT_VECTORS").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

struct Counts {
    poses: usize,
    /// Those whose curves are regular.
    compared: usize,
    unsure: usize,
    wrong: usize,
    lost: usize,
    /// Those lost although the outcome is not unsure.
    silent: usize,
    /// Those lost where the solutions are reported to be a surface.
    surfaces: usize,
    ends: usize,
    arcs: usize,
}

/// Compares arcs with the scan at the poses of joint vectors.
fn compare(vectors: &[Q]) -> Counts {
    let robot = Srs::iiwa();
    let limits = robot.arm().limits;
    let mut counts =
        Counts { poses: 0, compared: 0, unsure: 0, wrong: 0, lost: 0, silent: 0, surfaces: 0, ends: 0, arcs: 0 };
    for q in vectors {
        let target = pose(q);
        let mut out = [Arc::NONE; 256];
        let outcome = arcs(&robot, &target, &limits, &mut out).unwrap();
        let found = &out[..outcome.count];
        counts.poses += 1;
        counts.unsure += usize::from(outcome.is_unsure);
        counts.ends += outcome.ends;
        counts.arcs += outcome.count;
        // Joint values at a known solution differ from the nearest ones on an arc by less than 1e-6.
        let nearest = Criterion::Nearest { q0: *q, weights: [1.0; 7] };
        let nearest = best(&robot.arm, &target, &limits, found, &nearest).unwrap();
        let is_held = nearest.is_some_and(|best| {
            let again = at(&robot.arm, &target, &limits, &found[best.arc], best.s).unwrap();
            best.value > -1e-6 && distance(&again, &best.q) < 1e-6
        });
        counts.lost += usize::from(!is_held);
        counts.silent += usize::from(!is_held && !outcome.is_unsure);
        counts.surfaces += usize::from(!is_held && outcome.is_surface);
        match any_within(&robot, &target, &limits).unwrap() {
            Within::Solution(found) => {
                let reached = pose(&found);
                assert!(margin(&found, &limits) > -1.1e-9);
                assert!((0..12).all(|i| (reached[i] - target[i]).abs() < 1e-7), "{q:?}");
            }
            other => panic!("{other:?} at {q:?}"),
        }
        let circle = Circle::new(&target);
        if regularity(&circle) < 3e-3 {
            continue;
        }
        counts.compared += 1;
        let mut lengths: Vec<f64> = found.iter().map(|arc| arc.length).collect();
        lengths.retain(|x| *x > 1e-4);
        lengths.sort_by(f64::total_cmp);
        // Where a curve touches a limit, rounding splits the scanned one. With wider limits, single points become short arcs.
        let wider = limits.map(|[low, high]| [low - 1e-9, high + 1e-9]);
        let mut expected = scanned(&circle, &limits);
        let mut is_equal = are_equal(&expected, &lengths);
        if !is_equal {
            expected = scanned(&circle, &wider);
            expected.retain(|x| *x > 2e-3);
            is_equal = are_equal(&expected, &lengths);
        }
        if !is_equal {
            counts.wrong += 1;
            if counts.wrong < 5 {
                println!(
                    "{q:?} unsure {} surface {}\n  {expected:.5?}\n  {lengths:.5?}",
                    outcome.is_unsure, outcome.is_surface
                );
            }
        }
    }
    counts
}

fn report(name: &str, c: &Counts) {
    println!(
        "{name}: {} poses, {} compared, {} wrong, {} lost ({} silent, {} on surfaces), {} unsure, {:.1} ends, {:.1} arcs",
        c.poses,
        c.compared,
        c.wrong,
        c.lost,
        c.silent,
        c.surfaces,
        c.unsure,
        c.ends as f64 / c.poses as f64,
        c.arcs as f64 / c.poses as f64
    );
}

#[test]
fn random_vectors() {
    let limits = Srs::iiwa().arm.limits;
    let mut next = random();
    let vectors: Vec<Q> = (0..count(60))
        .map(|_| std::array::from_fn(|i| limits[i][0] + next() * (limits[i][1] - limits[i][0])))
        .collect();
    let counts = compare(&vectors);
    report("random", &counts);
    assert_eq!(counts.wrong, 0, "arcs that differ from the scan");
    assert_eq!(counts.lost, 0, "vectors on no arc");
    assert_eq!(counts.unsure, 0, "unsure outcomes");
}

#[test]
fn round_vectors() {
    let limits = Srs::iiwa().arm.limits;
    let mut next = random();
    let step = 15.0_f64.to_radians();
    let vectors: Vec<Q> = (0..count(60))
        .map(|_| {
            std::array::from_fn(|i| {
                let most = (limits[i][1] / step + 1e-9).floor();
                step * (next() * (2.0 * most + 1.0) - most - 0.5).round()
            })
        })
        .collect();
    let counts = compare(&vectors);
    report("round", &counts);
    assert_eq!(counts.wrong, 0, "arcs that differ from the scan");
    assert_eq!(counts.silent, 0, "vectors on no arc although the outcome is not unsure");
    // Vectors with a straight elbow and another singular joint, where the solutions are not regular curves.
    assert!(50 * counts.lost <= counts.poses, "vectors on no arc");
}

#[test]
#[ignore = "measures time"]
fn times() {
    let robot = Srs::iiwa();
    let limits = robot.arm.limits;
    let mut next = random();
    let targets: Vec<_> = (0..200)
        .map(|_| pose(&std::array::from_fn(|i| limits[i][0] + next() * (limits[i][1] - limits[i][0]))))
        .collect();
    let mut out = [Arc::NONE; 256];
    let (mut all, mut solving) = (Vec::new(), Vec::new());
    let mut members = groebot_runtime::redundant::Members::NONE;
    for target in &targets {
        // The machine may be busy: the least of some times.
        let mut least = [f64::INFINITY; 2];
        for _ in 0..20 {
            let start = std::time::Instant::now();
            let outcome = arcs(&robot, target, &limits, &mut out).unwrap();
            least[0] = least[0].min(start.elapsed().as_secs_f64() * 1e6);
            assert!(outcome.count > 0);
            let start = std::time::Instant::now();
            for k in 0..28 {
                robot.solve_given(target, [0, 1, 2, 4, 5, 6, 2][k % 7], limits[k % 7][k / 14], &mut members).unwrap();
            }
            least[1] = least[1].min(start.elapsed().as_secs_f64() * 1e6);
        }
        all.push(least[0]);
        solving.push(least[1]);
    }
    all.sort_by(f64::total_cmp);
    solving.sort_by(f64::total_cmp);
    println!("arcs: median {:.1} us, of which about {:.1} us are 28 given problems", all[100], solving[100]);
}
