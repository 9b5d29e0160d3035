//! Redundant arms with solvers written by hand, like redundant_arms.c: a planar arm with three joints, a rail with two joints, and an arm with spherical
//! shoulder and wrist. Only the run time's cosines, sines and angles are used, so that results do not depend on the C library.

use core::f64::consts::PI;
use groebot_runtime::Error;
use groebot_runtime::angles::angle;
use groebot_runtime::redundant::{Arm, Given, Member, Members, Q, Redundant, Target, Task};
use groebot_runtime::six_axes::Rigid;
use groebot_runtime::trigonometry::{cosine, sine, wrap};

pub type Matrix = [[f64; 3]; 3];

/// Random numbers in [0, 1): xorshift64 (G. Marsaglia, "Xorshift RNGs", 2003).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.next() * (high - low)
    }
}

fn atan2(y: f64, x: f64) -> f64 {
    angle(x, y)
}

fn length_of(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Adds a solution with angles in (-pi, pi], if all numbers are finite.
fn push(members: &mut Members, q: &[f64], given: usize, value: f64, free: u32) {
    let mut all = [0.0; 7];
    for (i, x) in q.iter().enumerate() {
        all[i] = if i == given { value } else { wrap(*x) };
    }
    if all.iter().all(|x| x.is_finite()) {
        members.push(Member { q: all, free, settled: true });
    }
}

/// The square root of a number that may be slightly negative; -1 if it is more.
fn root(square: f64) -> f64 {
    if square < -1e-13 { -1.0 } else { (if square > 0.0 { square } else { 0.0 }).sqrt() }
}

/// Both angles `b` and their `a` with e^ia (u + v e^ib) = p for complex `u` and a length `v`.
fn two_links(p: [f64; 2], u: [f64; 2], v: f64) -> Vec<[f64; 2]> {
    let (square, first) = (p[0] * p[0] + p[1] * p[1], length_of(u[0], u[1]));
    let across = (square - first * first - v * v) / (2.0 * first * v);
    let up = root(1.0 - across * across);
    let is_real = up >= 0.0;
    if !is_real {
        return Vec::new();
    }
    let solve = |up: f64| {
        let b = atan2(up, across) + atan2(u[1], u[0]);
        let (x, y) = (u[0] + v * cosine(b), u[1] + v * sine(b));
        [atan2(p[1], p[0]) - atan2(y, x), b]
    };
    vec![solve(up), solve(-up)]
}

/// Lengths of the planar arm's links, of the rail's links, and of upper arm, forearm, shoulder and flange (KUKA iiwa 14) in metres.
const PLANAR_LINKS: [f64; 3] = [1.0, 0.8, 0.5];
const RAIL_LINKS: [f64; 2] = [1.0, 0.8];
const SRS_LINKS: [f64; 2] = [0.42, 0.4];
const SHOULDER: f64 = 0.36;
const FLANGE: f64 = 0.126;

/// The rotation about a coordinate axis.
pub fn about(axis: usize, angle: f64) -> Matrix {
    let (i, j, c, s) = ((axis + 1) % 3, (axis + 2) % 3, cosine(angle), sine(angle));
    let mut out = [[0.0; 3]; 3];
    out[axis][axis] = 1.0;
    (out[i][i], out[j][j], out[i][j], out[j][i]) = (c, c, -s, s);
    out
}

pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    core::array::from_fn(|i| core::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

pub fn image(a: &Matrix, v: &[f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2])
}

fn transposed(a: &Matrix) -> Matrix {
    core::array::from_fn(|i| core::array::from_fn(|j| a[j][i]))
}

/// Rz(q1) Ry(q2) Rz(q3) Ry(-q4) Rz(q5) Ry(q6) Rz(q7), up to so many joints.
fn srs_rotation(q: &[f64]) -> Matrix {
    let mut whole = about(2, 0.0);
    for (i, x) in q.iter().enumerate() {
        whole = product(&whole, &about(if i % 2 == 0 { 2 } else { 1 }, if i == 3 { -x } else { *x }));
    }
    whole
}

fn srs_pose(q: &Q) -> Target {
    let (upper, lower, whole) = (srs_rotation(&q[..3]), srs_rotation(&q[..5]), srs_rotation(q));
    let mut target = [0.0; 12];
    for i in 0..3 {
        target[i] = upper[i][2] * SRS_LINKS[0];
        target[i] += lower[i][2] * SRS_LINKS[1];
        target[i] += whole[i][2] * FLANGE;
        target[3 + 3 * i..6 + 3 * i].copy_from_slice(&whole[i]);
    }
    target[2] += SHOULDER;
    target
}

/// A joint that is given at a value.
#[derive(Clone, Copy)]
struct At {
    joint: usize,
    value: f64,
}

/// Adds the solutions after the first four joints, both angles of the wrist. With `is_back` the arm is seen from its wrist.
fn push_wrist(turn: &Matrix, q: &[f64; 4], given: At, is_back: bool, members: &mut Members) {
    let before = product(&transposed(&srs_rotation(q)), turn);
    let up = length_of(before[0][2], before[1][2]);
    let is_straight = up < 1e-9;
    for sign in [1.0, -1.0] {
        let mut all = [q[0], q[1], q[2], q[3], 0.0, 0.0, 0.0];
        if is_straight {
            all[5] = if before[2][2] > 0.0 { 0.0 } else { PI };
            all[6] = atan2(before[1][0], before[1][1]);
        } else {
            all[4] = atan2(sign * before[1][2], sign * before[0][2]);
            all[5] = atan2(sign * up, before[2][2]);
            all[6] = atan2(sign * before[2][1], -sign * before[2][0]);
        }
        let free = if is_straight { if is_back { 5 } else { 80 } } else { 0 };
        let out: Q = core::array::from_fn(|i| if is_back { -all[6 - i] } else { all[i] });
        push(members, &out, given.joint, given.value, free);
        if is_straight {
            break;
        }
    }
}

/// The first three joints and the elbow, one of the first three given. The vector to the wrist is Rz(q1) (c2 c3 x + s2 z, s3 x, c2 z - s2 c3 x).
fn shoulder(p: &[f64; 3], [x, z]: [f64; 2], given: At, sign: f64) -> Option<[f64; 3]> {
    let value = given.value;
    let (c, s) = (cosine(value), sine(value));
    let is_real = |x: f64| if x < 0.0 { None } else { Some(x) };
    if given.joint == 0 {
        let along = c * p[0] + s * p[1];
        let s3 = (c * p[1] - s * p[0]) / x;
        let c3 = sign * is_real(root(1.0 - s3 * s3))?;
        return Some([value, atan2(along, p[2]) - atan2(c3 * x, z), atan2(s3, c3)]);
    }
    let (c3, s3, q2, q3) = if given.joint == 1 {
        let c3 = (c * z - p[2]) / (s * x);
        let s3 = sign * is_real(root(1.0 - c3 * c3))?;
        (c3, s3, value, atan2(s3, c3))
    } else {
        let size = length_of(c * x, z);
        let up = is_real(root(size * size - p[2] * p[2]))?;
        (c, s, atan2(sign * up, p[2]) - atan2(c * x, z), value)
    };
    Some([atan2(p[1], p[0]) - atan2(s3 * x, cosine(q2) * c3 * x + sine(q2) * z), q2, q3])
}

/// The arms.
#[derive(Clone, Copy, PartialEq)]
pub enum Kind {
    Planar,
    Rail,
    Srs,
}

pub struct Robot {
    pub kind: Kind,
    pub arm: Arm,
}

impl Robot {
    pub fn new(kind: Kind) -> Robot {
        let arm = match kind {
            Kind::Planar => planar(),
            Kind::Rail => rail(),
            Kind::Srs => srs(),
        };
        Robot { kind, arm }
    }

    /// The target that joint values reach.
    pub fn forward(&self, q: &Q) -> Target {
        let mut target = [0.0; 12];
        match self.kind {
            Kind::Srs => return srs_pose(q),
            Kind::Rail => {
                let l = RAIL_LINKS;
                target[0] = q[0] + l[0] * cosine(q[1]) + l[1] * cosine(q[1] + q[2]);
                target[1] = l[0] * sine(q[1]) + l[1] * sine(q[1] + q[2]);
            }
            Kind::Planar => {
                let (a, b, c, l) = (q[0], q[0] + q[1], q[0] + q[1] + q[2], PLANAR_LINKS);
                target[0] = l[0] * cosine(a) + l[1] * cosine(b) + l[2] * cosine(c);
                target[1] = l[0] * sine(a) + l[1] * sine(b) + l[2] * sine(c);
            }
        }
        target
    }
}

fn planar() -> Arm {
    let task = Task::PlanarPosition { coordinates: [0, 1] };
    let mut arm = Arm { count: 3, task, given: [Given::Solved; 7], ..Arm::NONE };
    arm.points[1][0] = 1.0;
    arm.points[2][0] = 1.8;
    arm.tip.translation[0] = 2.3;
    arm
}

fn rail() -> Arm {
    let task = Task::PlanarPosition { coordinates: [0, 1] };
    let mut arm = Arm { count: 3, task, length: 0.7, ..Arm::NONE };
    arm.slides[0] = true;
    arm.directions[0] = [1.0, 0.0, 0.0];
    arm.points[2][0] = 1.0;
    arm.tip.translation[0] = 1.8;
    arm.given[0] = Given::Solved;
    arm
}

fn srs() -> Arm {
    let heights = [0.36, 0.36, 0.36, 0.78, 1.18, 1.18, 1.18];
    let limits = [2.967, 2.094, 2.967, 2.094, 2.967, 2.094, 3.054];
    let tip = Rigid { translation: [0.0, 0.0, 1.306], ..Rigid::NONE };
    let mut arm = Arm { count: 7, length: 0.82, tip, scanned: 2, grid: 2, given: [Given::Solved; 7], ..Arm::NONE };
    arm.given[3] = Given::Constant;
    for i in 0..7 {
        let along_y = if i == 3 { -1.0 } else { 1.0 };
        arm.directions[i] = if i % 2 == 0 { [0.0, 0.0, 1.0] } else { [0.0, along_y, 0.0] };
        arm.points[i][2] = heights[i];
        arm.limits[i] = [-limits[i], limits[i]];
    }
    arm
}

fn solve_planar(target: &Target, given: At, out: &mut Members) {
    let (l, At { joint, value }) = (PLANAR_LINKS, given);
    let (p, c, s) = ([target[0], target[1]], cosine(value), sine(value));
    match joint {
        0 => {
            for [a, b] in two_links([p[0] - l[0] * c, p[1] - l[0] * s], [l[1], 0.0], l[2]) {
                push(out, &[value, a - value, b], joint, value, 0);
            }
        }
        1 => {
            for [a, b] in two_links(p, [l[0] + l[1] * c, l[1] * s], l[2]) {
                push(out, &[a, value, b - value], joint, value, 0);
            }
        }
        _ => {
            let (x, y) = (l[1] + l[2] * c, l[2] * s);
            for [a, b] in two_links(p, [l[0], 0.0], length_of(x, y)) {
                push(out, &[a, b - atan2(y, x), value], joint, value, 0);
            }
        }
    }
}

fn solve_srs(target: &Target, given: At, out: &mut Members) {
    let At { joint, value } = given;
    let is_back = joint > 3;
    let turn: Matrix = core::array::from_fn(|i| core::array::from_fn(|j| target[3 + 3 * i + j]));
    let (back, flange) = (transposed(&turn), image(&turn, &[0.0, 0.0, FLANGE]));
    let p: [f64; 3] = core::array::from_fn(|i| target[i] - flange[i] - if i == 2 { SHOULDER } else { 0.0 });
    // Seen from the wrist, with all axes reversed, the arm has the negative angles in reverse order.
    let [l, m] = SRS_LINKS;
    let (at, upper, lower) = if is_back { (image(&back, &p), m, l) } else { (p, l, m) };
    let inner = if is_back { At { joint: 6 - joint, value: -value } } else { given };
    let square = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    let across = (square - upper * upper - lower * lower) / (2.0 * upper * lower);
    let up = root(1.0 - across * across);
    if up < 0.0 {
        return;
    }
    for s4 in [up, -up] {
        for sign in [1.0, -1.0] {
            let links = [-s4 * lower, upper + across * lower];
            if let Some([q1, q2, q3]) = shoulder(&at, links, inner, sign) {
                let q = [q1, q2, q3, atan2(s4, across)];
                push_wrist(if is_back { &back } else { &turn }, &q, given, is_back, out);
            }
        }
    }
}

impl Redundant for Robot {
    fn arm(&self) -> &Arm {
        &self.arm
    }

    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), Error> {
        out.clear();
        match self.kind {
            Kind::Planar => solve_planar(target, At { joint, value }, out),
            Kind::Srs => solve_srs(target, At { joint, value }, out),
            Kind::Rail => {
                for [a, b] in two_links([target[0] - value, target[1]], [RAIL_LINKS[0], 0.0], RAIL_LINKS[1]) {
                    push(out, &[value, a, b], joint, value, 0);
                }
            }
        }
        Ok(())
    }
}
