//! An arm with a spherical shoulder, an elbow and a spherical wrist (KUKA iiwa 14), solved by hand, and a scan of its elbow circle.

use std::f64::consts::PI;

use groebot_runtime::Error;
use groebot_runtime::redundant::{Arm, Given, Member, Members, Q, Redundant, Target, Task};
use groebot_runtime::six_axes::Rigid;

pub type Matrix = [[f64; 3]; 3];

/// Upper arm and forearm in metres.
pub const LINKS: [f64; 2] = [0.42, 0.40];
const SHOULDER: f64 = 0.36;
const FLANGE: f64 = 0.126;
/// Signs of the rotations about y in `Rz(q1) Ry(q2) Rz(q3) Ry(-q4) Rz(q5) Ry(q6) Rz(q7)`.
const ALONG_Y: [f64; 7] = [0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0];

pub struct Srs {
    pub arm: Arm,
}

impl Srs {
    pub fn iiwa() -> Srs {
        let degrees: [f64; 7] = [170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0];
        let mut arm = Arm {
            count: 7,
            task: Task::Pose,
            length: 0.82,
            tip: Rigid { translation: [0.0, 0.0, 1.306], ..Rigid::NONE },
            given: [Given::Solved; 7],
            scanned: 2,
            grid: 2,
            ..Arm::NONE
        };
        arm.given[3] = Given::Constant;
        let heights = [0.36, 0.36, 0.36, 0.78, 1.18, 1.18, 1.18];
        for i in 0..7 {
            arm.directions[i] = if ALONG_Y[i] == 0.0 { [0.0, 0.0, 1.0] } else { [0.0, ALONG_Y[i], 0.0] };
            arm.points[i] = [0.0, 0.0, heights[i]];
            arm.limits[i] = [-degrees[i].to_radians(), degrees[i].to_radians()];
        }
        Srs { arm }
    }
}

pub fn about(is_y: bool, angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    if is_y { [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]] } else { [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]] }
}

pub fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

pub fn image(a: &Matrix, v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| a[i][k] * v[k]).sum())
}

pub fn transposed(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

fn rotation(q: &[f64], first: usize) -> Matrix {
    let mut whole = about(false, 0.0);
    for (i, angle) in q.iter().enumerate() {
        let sign = ALONG_Y[first + i];
        whole = times(&whole, &about(sign != 0.0, if sign == 0.0 { *angle } else { sign * angle }));
    }
    whole
}

/// The pose of the flange, by multiplied rotations.
pub fn pose(q: &Q) -> Target {
    let elbow = image(&rotation(&q[..3], 0), [0.0, 0.0, LINKS[0]]);
    let wrist = image(&rotation(&q[..5], 0), [0.0, 0.0, LINKS[1]]);
    let turn = rotation(q, 0);
    let flange = image(&turn, [0.0, 0.0, FLANGE]);
    let mut target = [0.0; 12];
    for i in 0..3 {
        target[i] = elbow[i] + wrist[i] + flange[i] + if i == 2 { SHOULDER } else { 0.0 };
        target[3 + 3 * i..6 + 3 * i].copy_from_slice(&turn[i]);
    }
    target
}

/// The rotation, and the vector from shoulder to wrist.
pub fn parts(target: &Target) -> (Matrix, [f64; 3]) {
    let turn: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| target[3 + 3 * i + j]));
    let flange = image(&turn, [0.0, 0.0, FLANGE]);
    let mut wrist = [target[0] - flange[0], target[1] - flange[1], target[2] - flange[2]];
    wrist[2] -= SHOULDER;
    (turn, wrist)
}

fn root(square: f64) -> Option<f64> {
    if square < -1e-13 { None } else { Some(square.max(0.0).sqrt()) }
}

/// Both angles of the wrist, q5 to q7, after the first four joints.
pub fn wrist(turn: &Matrix, q: &[f64; 4]) -> Vec<([f64; 3], u32)> {
    let rest = times(&transposed(&rotation(q, 0)), turn);
    let sine = rest[0][2].hypot(rest[1][2]);
    if sine < 1e-9 {
        let bent = if rest[2][2] > 0.0 { 0.0 } else { PI };
        let sum = rest[1][0].atan2(rest[1][1]);
        return vec![([0.0, bent, sum], 0b101_0000)];
    }
    let one = [rest[1][2].atan2(rest[0][2]), sine.atan2(rest[2][2]), rest[2][1].atan2(-rest[2][0])];
    let wrap = |a: f64| if a > 0.0 { a - PI } else { a + PI };
    vec![(one, 0), ([wrap(one[0]), -one[1], wrap(one[2])], 0)]
}

/// The first three joints, one of them given, for each elbow angle.
fn shoulder(p: [f64; 3], links: [f64; 2], given: usize, value: f64) -> Vec<[f64; 4]> {
    let square: f64 = p.iter().map(|x| x * x).sum();
    let cosine = (square - links[0] * links[0] - links[1] * links[1]) / (2.0 * links[0] * links[1]);
    let Some(sine) = root(1.0 - cosine * cosine) else { return Vec::new() };
    let mut all = Vec::new();
    for sine in [sine, -sine] {
        let (x, z) = (-sine * links[1], links[0] + cosine * links[1]);
        let q4 = sine.atan2(cosine);
        let (s, c) = value.sin_cos();
        // The vector to the wrist is Rz(q1) (c2 c3 x + s2 z, s3 x, c2 z - s2 c3 x).
        let first = |s3: f64, c3: f64, q2: f64| {
            let (s2, c2) = q2.sin_cos();
            p[1].atan2(p[0]) - (s3 * x).atan2(c2 * c3 * x + s2 * z)
        };
        match given {
            0 => {
                let [along, across] = [c * p[0] + s * p[1], c * p[1] - s * p[0]];
                let s3 = across / x;
                let Some(c3) = root(1.0 - s3 * s3) else { continue };
                for c3 in [c3, -c3] {
                    let q2 = along.atan2(p[2]) - (c3 * x).atan2(z);
                    all.push([value, q2, s3.atan2(c3), q4]);
                }
            }
            1 => {
                let c3 = (c * z - p[2]) / (s * x);
                let Some(s3) = root(1.0 - c3 * c3) else { continue };
                for s3 in [s3, -s3] {
                    all.push([first(s3, c3, value), value, s3.atan2(c3), q4]);
                }
            }
            _ => {
                let size = (c * x).hypot(z);
                let Some(up) = root(size * size - p[2] * p[2]) else { continue };
                for up in [up, -up] {
                    // c2 z - s2 c3 x = pz.
                    let q2 = up.atan2(p[2]) - (c * x).atan2(z);
                    all.push([first(s, c, q2), q2, value, q4]);
                }
            }
        }
    }
    all
}

fn wrapped(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}

impl Redundant for Srs {
    fn arm(&self) -> &Arm {
        &self.arm
    }

    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), Error> {
        out.clear();
        let (turn, p) = parts(target);
        let is_wrist = joint > 3;
        // Seen from the wrist, with all axes reversed, the arm has the negative angles in reverse order.
        let back = transposed(&turn);
        let from_wrist = image(&back, p);
        let (turn, p, links, given, value) = if is_wrist {
            (back, from_wrist, [LINKS[1], LINKS[0]], 6 - joint, -value)
        } else {
            (turn, p, LINKS, joint, value)
        };
        for first in shoulder(p, links, given, value) {
            for (last, free) in wrist(&turn, &first) {
                let mut q = [first[0], first[1], first[2], first[3], last[0], last[1], last[2]].map(wrapped);
                q[given] = value;
                let mut free = free;
                // With a straight elbow, the axes of three joints may be one line.
                for (first, middle) in [(0, 1), (2, 5)] {
                    if q[middle].sin().abs() < 1e-7 && q[3].sin().abs() < 1e-7 {
                        free |= (0b1_0101 << first) & !(1 << given);
                    }
                }
                if is_wrist {
                    q.reverse();
                    q = q.map(|x| -x);
                    free = (0..7).filter(|i| free & 1 << i != 0).map(|i| 1 << (6 - i)).sum();
                }
                if q.iter().all(|x| x.is_finite()) {
                    out.push(Member { q, free, settled: true });
                }
            }
        }
        Ok(())
    }
}

/// One of the eight curves of solutions by the angle on the elbow circle: the signs of the sines of q2, q4 and q6.
pub struct Circle {
    turn: Matrix,
    centre: [f64; 3],
    across: [[f64; 3]; 2],
    p: [f64; 3],
    bend: f64,
}

impl Circle {
    pub fn new(target: &Target) -> Circle {
        let (turn, p) = parts(target);
        let square: f64 = p.iter().map(|x| x * x).sum();
        let along = (square + LINKS[0] * LINKS[0] - LINKS[1] * LINKS[1]) / (2.0 * square);
        let radius = (LINKS[0] * LINKS[0] - along * along * square).max(0.0).sqrt();
        let cosine = (square - LINKS[0] * LINKS[0] - LINKS[1] * LINKS[1]) / (2.0 * LINKS[0] * LINKS[1]);
        let unit = p.map(|x| x / square.sqrt());
        let aside = if unit[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let u = cross(unit, aside);
        let u = u.map(|x| x / (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt());
        let v = cross(unit, u);
        let across = [u.map(|x| radius * x), v.map(|x| radius * x)];
        Circle { turn, centre: p.map(|x| along * x), across, p, bend: cosine.clamp(-1.0, 1.0).acos() }
    }

    /// The joint values at an angle, on the curve with these signs.
    pub fn at(&self, signs: [f64; 3], phi: f64) -> Q {
        let (s, c) = phi.sin_cos();
        let elbow: [f64; 3] = std::array::from_fn(|i| self.centre[i] + c * self.across[0][i] + s * self.across[1][i]);
        let e = elbow.map(|x| x / LINKS[0]);
        let q1 = (signs[0] * e[1]).atan2(signs[0] * e[0]);
        let q2 = (signs[0] * e[0].hypot(e[1])).atan2(e[2]);
        let rest: [f64; 3] = std::array::from_fn(|i| self.p[i] - elbow[i]);
        let turned = image(&transposed(&times(&about(false, q1), &about(true, q2))), rest);
        // The forearm is Rz(q3) (-s4, 0, c4).
        let q3 = (-signs[1] * turned[1]).atan2(-signs[1] * turned[0]);
        let q4 = signs[1] * self.bend;
        let all = wrist(&self.turn, &[q1, q2, q3, q4]);
        let [q5, q6, q7] = if all.len() == 2 && all[1].0[1] * signs[2] > 0.0 { all[1].0 } else { all[0].0 };
        [q1, q2, q3, q4, q5, q6, q7]
    }
}
