//! Another formulation, measured beside ours: dual quaternions on Study's quadric.
//!
//! Both sides of `E1 E2 E3 = G E6^-1 E5^-1 E4^-1` are dual quaternions that are linear in the cosine and the sine of half of each angle: eight
//! products on either side, so that `u = M v` for the left ones `u` and the right ones `v`, up to a factor. With `x` the tangent of half the first
//! angle, `u1 - x u0 = 0` are four equations that are linear in `x` and in each of the tangents of the far three. All products of
//! these equations with `1, t5` and `1, t6, t6^2` are 24 equations in the 24 monomials of degrees 1, 2, 3: a linear eigenvalue problem. A
//! `u` that is no product of three factors is spurious: eight of the 24 are.

use std::time::Instant;

use groebot::roots::Hessenberg;
use groebot::solver::template::{Layout, Line, Rigid};

use super::Random;

type Dual = [f64; 8];
type Square<const N: usize> = [[f64; N]; N];

fn hamilton(a: &[f64], b: &[f64]) -> [f64; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

fn product(a: &Dual, b: &Dual) -> Dual {
    let real = hamilton(&a[..4], &b[..4]);
    let (left, right) = (hamilton(&a[..4], &b[4..]), hamilton(&a[4..], &b[..4]));
    std::array::from_fn(|k| if k < 4 { real[k] } else { left[k - 4] + right[k - 4] })
}

/// What half a turn about the line is, as a dual quaternion.
fn half_turn(line: &Line<f64>) -> Dual {
    let (l, p) = (line.direction, line.point);
    let m = [p[1] * l[2] - p[2] * l[1], p[2] * l[0] - p[0] * l[2], p[0] * l[1] - p[1] * l[0]];
    [0.0, l[0], l[1], l[2], 0.0, m[0], m[1], m[2]]
}

/// The turns by `q` about the lines, one after the other.
fn displacement(lines: &[Line<f64>], q: &[f64]) -> Dual {
    let mut motion = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for (line, angle) in lines.iter().zip(q) {
        let (s, c) = (0.5 * angle).sin_cos();
        let mut turn = half_turn(line).map(|entry| s * entry);
        turn[0] += c;
        motion = product(&motion, &turn);
    }
    motion
}

/// The dual quaternions that products of the three factors `1` and `half turn` (reversed in the sign of `sign`) stand for, the last factor
/// changing fastest.
fn columns(start: &Dual, lines: [&Line<f64>; 3], sign: f64) -> [Dual; 8] {
    std::array::from_fn(|index| {
        let mut motion = *start;
        for (place, line) in lines.iter().enumerate() {
            if index >> (2 - place) & 1 == 1 {
                motion = product(&motion, &half_turn(line).map(|entry| sign * entry));
            }
        }
        motion
    })
}

/// Solves `L X = R` by Gauss elimination with partial pivoting; `None` for a singular matrix.
fn solve<const N: usize>(mut left: Square<N>, mut right: Square<N>) -> Option<Square<N>> {
    for k in 0..N {
        let best = (k..N).max_by(|a, b| left[*a][k].abs().total_cmp(&left[*b][k].abs()))?;
        left.swap(k, best);
        right.swap(k, best);
        let (pivot, target) = (left[k], right[k]);
        if pivot[k] == 0.0 {
            return None;
        }
        for row in (0..N).filter(|row| *row != k) {
            let factor = left[row][k] / pivot[k];
            left[row].iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
            right[row].iter_mut().zip(&target).for_each(|(entry, over)| *entry -= factor * over);
        }
    }
    Some(std::array::from_fn(|row| right[row].map(|entry| entry / left[row][row])))
}

/// `M` with `u = M v`.
fn products(lines: &[Line<f64>; 6], target: &Dual) -> Option<Square<8>> {
    let near = columns(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [&lines[0], &lines[1], &lines[2]], 1.0);
    let far = columns(target, [&lines[5], &lines[4], &lines[3]], -1.0);
    let matrix = |columns: &[Dual; 8]| std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
    solve(matrix(&near), matrix(&far))
}

/// Where the half angle `x` is counted from.
const ORIGIN: f64 = 0.4;

/// The real values of the first angle, spurious ones among them.
pub fn first_angles(lines: &[Line<f64>; 6], target: &Dual) -> Option<Vec<f64>> {
    let m = products(lines, target)?;
    let (mut constant, mut linear) = ([[0.0; 24]; 24], [[0.0; 24]; 24]);
    for equation in 0..4 {
        for multiplier in 0..6 {
            let row = 6 * equation + multiplier;
            for (product, (under, over)) in m[equation].iter().zip(&m[4 + equation]).enumerate() {
                let (six, five, four) = (product >> 2 & 1, product >> 1 & 1, product & 1);
                let column = 12 * six + 4 * (five + multiplier / 3) + four + multiplier % 3;
                (constant[row][column], linear[row][column]) = (*over, *under);
            }
        }
    }
    let (s, c) = ORIGIN.sin_cos();
    let mix = |a: f64, b: f64| -> Square<24> {
        std::array::from_fn(|i| std::array::from_fn(|j| a * constant[i][j] + b * linear[i][j]))
    };
    let form = Hessenberg::reduce(solve(mix(s, c), mix(c, -s))?);
    let real = form.eigenvalues()?.into_iter().filter(|value| value.im == 0.0);
    let angles = real.map(|value| {
        // The eigenvector is what back-substitution would need.
        std::hint::black_box(form.eigenvector(value.re));
        2.0 * (ORIGIN + value.re.atan())
    });
    Some(angles.collect())
}

pub fn random_lines(random: &mut Random) -> [Line<f64>; 6] {
    std::array::from_fn(|_| {
        let direction: [f64; 3] = std::array::from_fn(|_| random.number());
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        Line { direction: direction.map(|x| x / length), point: std::array::from_fn(|_| random.number()) }
    })
}

/// The displacement as a motion, for our own solver.
fn rigid(d: &Dual) -> Rigid {
    let image = |v: [f64; 3]| {
        let back = [d[0], -d[1], -d[2], -d[3]];
        let turned = hamilton(&hamilton(&d[..4], &[0.0, v[0], v[1], v[2]]), &back);
        [turned[1], turned[2], turned[3]]
    };
    let columns = [image([1.0, 0.0, 0.0]), image([0.0, 1.0, 0.0]), image([0.0, 0.0, 1.0])];
    let way = hamilton(&d[4..], &[d[0], -d[1], -d[2], -d[3]]);
    Rigid {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])),
        translation: [2.0 * way[1], 2.0 * way[2], 2.0 * way[3]],
    }
}

/// How far the nearest of these angles is from `wanted`.
pub fn nearest(angles: &[f64], wanted: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angles.iter().map(|a| (a - wanted - turn * ((a - wanted) / turn).round()).abs()).fold(f64::INFINITY, f64::min)
}

pub fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list[list.len() / 2]
}

/// The same targets by both: what each misses before polishing, and its time. Ours polishes all answers and measures them too.
fn compare(chains: usize, targets: usize) {
    use groebot::derive::template::{all, survey};
    use groebot::solver::template::Template;
    let mut random = Random::new(41);
    let (mut misses, mut ours, mut off) = ([0; 2], Vec::new(), Vec::new());
    let (mut time, mut own_time) = (Vec::new(), Vec::new());
    for _ in 0..chains {
        let lines = random_lines(&mut random);
        let layout = Layout { lines, slides: [false; 6], length: 1.0 };
        let solver = Template::new(&layout, survey(&layout, &all().collect::<Vec<_>>()));
        for _ in 0..targets {
            let q = random.angles();
            let target = displacement(&lines, &q);
            let start = Instant::now();
            let angles = first_angles(&lines, &target).unwrap_or_default();
            time.push(start.elapsed().as_secs_f64() * 1e6);
            let start = Instant::now();
            let answers = solver.solve(&rigid(&target));
            own_time.push(start.elapsed().as_secs_f64() * 1e6);
            let found: Vec<f64> = answers.as_slice().iter().map(|answer| answer.q[0]).collect();
            let (a, b) = (nearest(&angles, q[0]), nearest(&found, q[0]));
            misses[0] += usize::from(a > 1e-6);
            misses[1] += usize::from(b > 1e-6);
            off.push(a);
            ours.push(answers.start);
        }
    }
    println!(
        "Study's quadric: {} of {} angles missed by more than 1e-6, half of them by less than {:.0e}, {:.1} us; ours: {} missed, {:.0e} \
         before polishing, {:.1} us",
        misses[0],
        off.len(),
        median(off.clone()),
        median(time),
        misses[1],
        median(ours),
        median(own_time)
    );
    assert!(misses[0] * 20 <= off.len() && misses[1] == 0, "{misses:?}");
}

#[test]
fn both_formulations_find_the_first_angle() {
    compare(3, 20);
}

/// The figures of docs/six_axes.md: `cargo test --release both_formulations_measured -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn both_formulations_measured() {
    compare(20, 1000);
}
