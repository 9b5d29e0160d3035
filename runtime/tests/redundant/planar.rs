//! Arcs of a planar arm with three joints and the position as task, against dense scans of each joint.

use std::f64::consts::{PI, TAU};

use groebot_runtime::Error;
use groebot_runtime::redundant::{
    Arc, Arm, Given, Limits, Member, Members, Q, Redundant, Target, Task, Within, any_within, arcs, sample,
};
use groebot_runtime::six_axes::Rigid;

use crate::random;

const LINKS: [f64; 3] = [1.0, 0.8, 0.5];

pub struct Planar(pub Arm);

impl Planar {
    pub fn new(limits: Limits) -> Planar {
        let mut arm = Arm {
            count: 3,
            task: Task::PlanarPosition { coordinates: [0, 1] },
            length: 1.0,
            tip: Rigid { translation: [2.3, 0.0, 0.0], ..Rigid::NONE },
            given: [Given::Solved; 7],
            scanned: 0,
            limits,
            ..Arm::NONE
        };
        arm.points = [0.0, 1.0, 1.8, 0.0, 0.0, 0.0, 0.0].map(|x| [x, 0.0, 0.0]);
        Planar(arm)
    }
}

pub fn tip(q: &Q) -> [f64; 2] {
    let sums = [q[0], q[0] + q[1], q[0] + q[1] + q[2]];
    let along = |f: fn(f64) -> f64| (0..3).map(|i| LINKS[i] * f(sums[i])).sum();
    [along(f64::cos), along(f64::sin)]
}

/// Both angles `b` and their `a` with `e^ia (u + v e^ib) = p` for complex `u` and a length `v`.
fn two_links(p: [f64; 2], u: [f64; 2], v: f64) -> Vec<[f64; 2]> {
    let (square, first) = (p[0] * p[0] + p[1] * p[1], u[0].hypot(u[1]));
    let cosine = (square - first * first - v * v) / (2.0 * first * v);
    if cosine.abs() > 1.0 + 1e-13 {
        return Vec::new();
    }
    let cosine = cosine.clamp(-1.0, 1.0);
    let solve = |bent: f64| {
        let b = bent + u[1].atan2(u[0]);
        let sum = [u[0] + v * b.cos(), u[1] + v * b.sin()];
        [p[1].atan2(p[0]) - sum[1].atan2(sum[0]), b]
    };
    vec![solve(cosine.acos()), solve(-cosine.acos())]
}

fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

impl Redundant for Planar {
    fn arm(&self) -> &Arm {
        &self.0
    }

    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), Error> {
        out.clear();
        let (p, (s, c)) = ([target[0], target[1]], value.sin_cos());
        let [l1, l2, l3] = LINKS;
        // With the tip on the first axis, that joint is free.
        let free = u32::from(joint == 1 && p[0].hypot(p[1]) < 1e-12);
        let mut push = |q: [f64; 3]| {
            let mut all = [0.0; 7];
            all[..3].copy_from_slice(&q.map(wrapped));
            all[joint] = value;
            out.push(Member { q: all, free, settled: true });
        };
        match joint {
            0 => {
                for [a, b] in two_links([p[0] - l1 * c, p[1] - l1 * s], [l2, 0.0], l3) {
                    push([value, a - value, b]);
                }
            }
            1 => {
                for [a, b] in two_links(p, [l1 + l2 * c, l2 * s], l3) {
                    push([a, value, b - value]);
                }
            }
            _ => {
                let (length, offset) = ((l2 + l3 * c).hypot(l3 * s), (l3 * s).atan2(l2 + l3 * c));
                for [a, b] in two_links(p, [l1, 0.0], length) {
                    push([a, b - offset, value]);
                }
            }
        }
        Ok(())
    }
}

fn distance(a: &Q, b: &Q) -> f64 {
    (0..3).map(|i| wrapped(a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Checks the arcs of a target; returns their number, the number of closed ones, and whether the outcome is unsure.
fn check(robot: &Planar, target: &Target) -> (usize, usize, bool) {
    let limits = &robot.0.limits;
    let mut out = [Arc::NONE; 64];
    let outcome = arcs(robot, target, limits, &mut out).unwrap();
    let found = &out[..outcome.count];
    let is_within = |q: &Q| (0..3).all(|i| (limits[i][0] - 1e-8..=limits[i][1] + 1e-8).contains(&q[i]));
    let mut points: Vec<Vec<Q>> = Vec::new();
    for arc in found {
        let mut list = vec![[0.0; 7]; 1 + (arc.length / 0.01) as usize + 1];
        sample(&robot.0, target, limits, arc, &mut list).unwrap();
        for q in &list {
            let [x, y] = tip(q);
            assert!((x - target[0]).abs() < 1e-9 && (y - target[1]).abs() < 1e-9, "{arc:?}");
            assert!(is_within(q), "{q:?} {limits:?}");
        }
        let polygon: f64 = list.windows(2).map(|pair| distance(&pair[0], &pair[1])).sum();
        assert!((polygon - arc.length).abs() < 1e-3 * (1.0 + arc.length), "{polygon} {arc:?}");
        points.push(list);
    }
    // Every solution within limits, from scans of each joint, is on one arc only.
    let mut members = Members::NONE;
    for joint in 0..3 {
        for k in 0..300 {
            let value = -PI + TAU * (f64::from(k) + 0.5) / 300.0;
            robot.solve_given(target, joint, value, &mut members).unwrap();
            for member in members.as_slice().iter().filter(|member| is_within(&member.q)) {
                let near = points.iter().filter(|list| list.iter().any(|q| distance(q, &member.q) < 0.0075)).count();
                assert!(near > 0, "{:?} is on no arc of {found:?}", member.q);
            }
        }
    }
    let ends: Vec<&Q> = found
        .iter()
        .filter(|arc| !arc.is_closed && arc.length > 0.0)
        .flat_map(|arc| [&arc.start.q, &arc.end.q])
        .collect();
    for (i, a) in ends.iter().enumerate() {
        let same = ends[..i].iter().filter(|b| distance(a, b) < 1e-9).count();
        assert_eq!(same, 0, "an end point of two arcs: {a:?}");
    }
    (outcome.count, outcome.closed, outcome.is_unsure)
}

#[test]
fn random_limits() {
    let mut next = random();
    let (mut all, mut closed, mut unsure) = (0, 0, 0);
    for case in 0..300 {
        let mut limits = [[f64::NEG_INFINITY, f64::INFINITY]; 7];
        for limit in &mut limits[..3] {
            let (a, b) = (PI * (2.0 * next() - 1.0), PI * (2.0 * next() - 1.0));
            *limit = if case % 3 == 0 { [-3.0 + 0.2 * a, 3.0 + 0.2 * b] } else { [a.min(b), a.max(b)] };
            if limit[1] - limit[0] >= TAU {
                *limit = [f64::NEG_INFINITY, f64::INFINITY];
            }
            *limit = if limit[0].is_finite() { [limit[0].max(-PI), limit[1].min(PI)] } else { *limit };
        }
        let robot = Planar::new(limits);
        let q: Q = std::array::from_fn(|i| {
            let [low, high] = if limits[i][0].is_finite() { limits[i] } else { [-PI, PI] };
            if i < 3 { low + next() * (high - low) } else { 0.0 }
        });
        let mut target = [0.0; 12];
        target[..2].copy_from_slice(&tip(&q));
        let (count, curves, is_unsure) = check(&robot, &target);
        assert!(count > 0);
        assert!(matches!(any_within(&robot, &target, &limits), Ok(Within::Solution(_))));
        (all, closed, unsure) = (all + count, closed + curves, unsure + usize::from(is_unsure));
    }
    println!("{all} arcs, {closed} closed, {unsure} unsure");
    assert!(closed > 0 && all > 300);
    assert_eq!(unsure, 0);
}

#[test]
fn beyond_limits_and_reach() {
    let mut limits = [[f64::NEG_INFINITY, f64::INFINITY]; 7];
    limits[1] = [2.9, 3.0];
    let robot = Planar::new(limits);
    let mut target = [0.0; 12];
    target[0] = 2.2;
    assert!(matches!(any_within(&robot, &target, &limits).unwrap(), Within::Beyond { joints: 2, .. }));
    target[0] = 2.4;
    assert!(matches!(any_within(&robot, &target, &limits).unwrap(), Within::Unreachable { .. }));
    limits[2] = [1.0, -1.0];
    assert_eq!(any_within(&robot, &target, &limits), Err(Error::Limits(2)));
    limits[2] = [f64::NAN, 1.0];
    assert_eq!(any_within(&robot, &target, &limits), Err(Error::Limits(2)));
}

/// Next to the greatest distance, the curve is narrower than the grid of values.
#[test]
fn curves_next_to_the_reach() {
    for excess in [1e-2, 1e-4, 1e-6, 1e-8] {
        for angle in [0.3_f64, 1.234, -2.0] {
            let robot = Planar::new([ANY; 7]);
            let mut target = [0.0; 12];
            let distance = LINKS.iter().sum::<f64>() - excess;
            (target[0], target[1]) = (distance * angle.cos(), distance * angle.sin());
            let mut out = [Arc::NONE; 4];
            let outcome = arcs(&robot, &target, &robot.0.limits, &mut out).unwrap();
            assert_eq!((outcome.count, outcome.closed, outcome.is_unsure), (1, 1, false), "{excess} {angle}");
            let mut list = [[0.0; 7]; 40];
            sample(&robot.0, &target, &robot.0.limits, &out[0], &mut list).unwrap();
            let Ok(Within::Solution(q)) = any_within(&robot, &target, &robot.0.limits) else {
                panic!("{excess} {angle}")
            };
            for q in list.iter().chain([&q]) {
                let [x, y] = tip(q);
                assert!((x - target[0]).hypot(y - target[1]) < 1e-9, "{q:?}");
            }
            // With the first joint beyond its limit, the target is reachable, but not within limits.
            let mut limits = [ANY; 7];
            limits[0] = [angle + 1.0, angle + 1.5];
            let beyond = any_within(&robot, &target, &limits).unwrap();
            assert!(matches!(beyond, Within::Beyond { joints: 1, .. }), "{beyond:?}");
        }
    }
}

/// The arcs at a position, with limits of the first two joints.
fn arcs_at(x: f64, first: [f64; 2], second: [f64; 2]) -> (Vec<Arc>, bool) {
    let mut limits = [[f64::NEG_INFINITY, f64::INFINITY]; 7];
    (limits[0], limits[1]) = (first, second);
    let robot = Planar::new(limits);
    let mut target = [0.0; 12];
    target[0] = x;
    let mut out = [Arc::NONE; 16];
    let outcome = arcs(&robot, &target, &limits, &mut out).unwrap();
    (out[..outcome.count].to_vec(), outcome.is_unsure)
}

pub const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The greatest angle of the second joint with the tip at a distance: the third link points outwards, so that the wrist is nearest.
fn greatest(distance: f64) -> f64 {
    let wrist = distance - LINKS[2];
    ((wrist * wrist - 1.0 - 0.64) / 1.6).acos()
}

#[test]
fn curve_that_touches_a_limit() {
    let top = greatest(1.2);
    let (all, is_unsure) = arcs_at(1.2, ANY, [0.0, top]);
    assert!(all.len() == 1 && all[0].is_closed && !is_unsure, "{all:?}");
    let (all, is_unsure) = arcs_at(1.2, ANY, [0.0, top + 1e-5]);
    assert!(all.len() == 1 && all[0].is_closed && !is_unsure, "{all:?}");
}

#[test]
fn curve_that_exceeds_a_limit_a_little() {
    let (top, whole) = (greatest(1.2), arcs_at(1.2, ANY, [0.0, PI]).0);
    for excess in [1e-2, 1e-4, 1e-6] {
        let (all, is_unsure) = arcs_at(1.2, ANY, [0.0, top - excess]);
        assert!(all.len() == 1 && !all[0].is_closed && !is_unsure, "{excess} {all:?}");
        assert!(all[0].start.joint == Some(1) && all[0].start.is_upper && all[0].end.is_upper);
        let gap = whole[0].length - all[0].length;
        assert!(gap > 0.0 && gap < 20.0 * excess.sqrt(), "{excess} {gap}");
        // What is beyond the limit is the other arc.
        let (rest, is_unsure) = arcs_at(1.2, ANY, [top - excess, PI]);
        assert!(rest.len() == 1 && !is_unsure, "{excess} {rest:?}");
        assert!((rest[0].length - gap).abs() < 1e-4, "{excess} {gap} {rest:?}");
    }
}

#[test]
fn curve_that_is_one_point_within_limits() {
    let (all, _) = arcs_at(1.2, ANY, [greatest(1.2), PI]);
    assert_eq!(all.len(), 1);
    assert!(all[0].length < 1e-6 && all[0].start.q == all[0].end.q);
    assert!((all[0].start.q[1] - greatest(1.2)).abs() < 1e-9);
}

#[test]
fn joint_that_remains_at_its_limit() {
    // The tip is on the first axis: the second and the third joint are constant, the first one is free.
    let bent = -((0.25_f64 - 1.0 - 0.64) / 1.6).acos();
    for second in [[bent, 1.0], [-3.0, bent]] {
        let (all, is_unsure) = arcs_at(0.0, [-1.0, 0.5], second);
        assert!(all.len() == 1 && !is_unsure, "{all:?}");
        assert!((all[0].length - 1.5).abs() < 1e-9);
        assert_eq!([all[0].start.joint, all[0].end.joint], [Some(0), Some(0)]);
        let (all, is_unsure) = arcs_at(0.0, ANY, second);
        assert!(all.len() == 1 && all[0].is_closed && !is_unsure, "{all:?}");
        assert!((all[0].length - TAU).abs() < 1e-9);
    }
}

#[test]
fn two_joints_at_limits_at_once() {
    // From a solution, one limit each way of the curve: the arc is on one side, on the other, or only the point.
    let robot = Planar::new([ANY; 7]);
    let mut members = Members::NONE;
    let mut target = [0.0; 12];
    target[0] = 1.2;
    robot.solve_given(&target, 0, 0.9, &mut members).unwrap();
    let q = members.as_slice()[0].q;
    robot.solve_given(&target, 0, 0.9001, &mut members).unwrap();
    let near = members.as_slice().iter().min_by(|a, b| distance(&a.q, &q).total_cmp(&distance(&b.q, &q))).unwrap().q;
    let rises = near[1] > q[1];
    let below = |i: usize| [q[i] - 2.0, q[i]];
    let above = |i: usize| [q[i], q[i] + 2.0];
    // Both joints move inwards along the same direction of the curve.
    let (all, is_unsure) = arcs_at(1.2, above(0), if rises { above(1) } else { below(1) });
    assert!(
        !is_unsure
            && all
                .iter()
                .any(|arc| arc.length > 0.05 && distance(&arc.start.q, &q).min(distance(&arc.end.q, &q)) < 1e-9),
        "{q:?} {near:?} {all:?}"
    );
    // They move inwards along opposite directions.
    let (all, is_unsure) = arcs_at(1.2, above(0), if rises { below(1) } else { above(1) });
    assert!(!is_unsure && all.iter().any(|arc| arc.length == 0.0 && distance(&arc.start.q, &q) < 1e-9), "{all:?}");
}
