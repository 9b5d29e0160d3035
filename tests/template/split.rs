//! A third formulation, measured beside ours: cosines and sines, the six angles split 3-3, by an elimination template.
//!
//! The fourteen functions of Raghavan and Roth are sums of 27 products of 1, c, s on the side of the first three angles and of nine on the other;
//! without the far eight products six equations in three angles are left. All their products with 1, c, s, cos 2q, sin 2q of the first
//! angle and with 1, c, s of the second are 90 equations in 105 products of multiple angles, of rank 81: they leave 24 unknown, eight of which
//! are solutions at infinity of the first angle. Solved for all products with three times that angle they leave sixteen, and the cosine and
//! the sine of the first angle multiply these by matrices of sixteen rows.

use std::time::Instant;

use groebot::roots::Hessenberg;
use groebot::solver::template::{Layout, Line, Rigid};

use super::Random;
use super::study::{median, nearest, random_lines};

/// Functions, and the products of either side.
const FUNCTIONS: usize = 14;
const NEAR: usize = 27;
const FAR: usize = 9;
/// Multiples of each angle in the template's columns: 1, c, s, cos 2q, sin 2q, ...
const WIDTHS: [usize; 3] = [7, 5, 3];
const ROWS: usize = 90;
const COLUMNS: usize = 105;
const SOLUTIONS: usize = 16;
/// A pivot that is smaller is rounding.
const NOTHING: f64 = 1e-9;

type Vector = [f64; 3];
type Square = [[f64; SOLUTIONS]; SOLUTIONS];

fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `line` turned about `axis` by the angle of a cosine and a sine.
fn turned(axis: &Line<f64>, line: &Line<f64>, [c, s]: [f64; 2]) -> Line<f64> {
    let w = axis.direction;
    let turn = |v: &Vector| {
        let (along, third) = (dot(&w, v) * (1.0 - c), cross(&w, v));
        [0, 1, 2].map(|k| c * v[k] + s * third[k] + along * w[k])
    };
    let arm = turn(&[0, 1, 2].map(|k| line.point[k] - axis.point[k]));
    Line { direction: turn(&line.direction), point: [0, 1, 2].map(|k| axis.point[k] + arm[k]) }
}

fn functions(line: &Line<f64>) -> [f64; FUNCTIONS] {
    let (p, l) = (line.point, line.direction);
    let (m, square, along) = (cross(&p, &l), dot(&p, &p), dot(&p, &l));
    let last = [0, 1, 2].map(|k| square * l[k] - 2.0 * along * p[k]);
    let mut values = [square; FUNCTIONS];
    for (k, vector) in [p, l, m, last].iter().enumerate() {
        values[3 * k..][..3].copy_from_slice(vector);
    }
    values[13] = along;
    values
}

const SAMPLES: [[f64; 2]; 3] = [[1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];

/// The coefficients of 1, c, s of what is affine in them, from the samples: along the places that are `step` apart.
fn resolve(values: &mut [f64], step: usize) {
    for first in (0..values.len()).filter(|place| (place / step).is_multiple_of(3)) {
        let [f, g, h] = [0, 1, 2].map(|k| values[first + k * step]);
        let mean = 0.5 * (g + h);
        (values[first], values[first + step], values[first + 2 * step]) = (mean, f - mean, 0.5 * (g - h));
    }
}

/// The six equations in the 27 products of the first three angles, the third changing fastest.
fn equations(lines: &[Line<f64>; 6], target: &Rigid) -> [[f64; NEAR]; 6] {
    let mut rows = [[0.0; NEAR + FAR]; FUNCTIONS];
    for (place, [a, b, c]) in (0..NEAR).map(|k| (k, [k / 9, k / 3 % 3, k % 3].map(|k| SAMPLES[k]))) {
        let line = turned(&lines[0], &turned(&lines[1], &turned(&lines[2], &lines[3], c), b), a);
        functions(&line).iter().zip(&mut rows).for_each(|(value, row)| row[place] = *value);
    }
    for (place, [a, b]) in (0..FAR).map(|k| (k, [k / 3, k % 3].map(|k| SAMPLES[k]))) {
        let line = turned(&lines[5], &turned(&lines[4], &lines[3], b), a);
        let moved = Line { direction: target.turned(&line.direction), point: target.moved(&line.point) };
        functions(&moved).iter().zip(&mut rows).for_each(|(value, row)| row[NEAR + place] = -value);
    }
    for row in &mut rows {
        [1, 3, 9].into_iter().for_each(|step| resolve(&mut row[..NEAR], step));
        [1, 3].into_iter().for_each(|step| resolve(&mut row[NEAR..], step));
        row[0] += row[NEAR];
    }
    for (index, column) in (NEAR + 1..NEAR + FAR).enumerate() {
        let best = (index..FUNCTIONS).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        rows.swap(index, best.unwrap());
        let pivot = rows[index];
        for row in &mut rows[index + 1..] {
            let factor = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
        }
    }
    std::array::from_fn(|k| std::array::from_fn(|product| rows[FAR - 1 + k][product]))
}

/// 1, c or s (`by`) times a multiple of an angle, as at most two others.
fn times(by: usize, other: usize) -> [(usize, f64); 2] {
    let (multiple, is_cosine) = (other.div_ceil(2), other % 2 == 1);
    let cosine = |k: usize| if k == 0 { 0 } else { 2 * k - 1 };
    match (by, other, is_cosine) {
        (0, ..) => [(other, 1.0), (0, 0.0)],
        (_, 0, _) => [(by, 1.0), (0, 0.0)],
        (1, _, true) => [(cosine(multiple + 1), 0.5), (cosine(multiple - 1), 0.5)],
        (1, _, false) => [(2 * multiple + 2, 0.5), (2 * multiple - 2, if multiple > 1 { 0.5 } else { 0.0 })],
        (_, _, true) => [(2 * multiple + 2, 0.5), (2 * multiple - 2, if multiple > 1 { -0.5 } else { 0.0 })],
        (_, _, false) => [(cosine(multiple + 1), -0.5), (cosine(multiple - 1), 0.5)],
    }
}

fn place([a, b, c]: [usize; 3]) -> usize {
    (a * WIDTHS[1] + b) * WIDTHS[2] + c
}

/// The equations times five multiples of the first angle and three of the second.
fn template(equations: &[[f64; NEAR]; 6]) -> Vec<[f64; COLUMNS]> {
    let mut rows = vec![[0.0; COLUMNS]; ROWS];
    for (index, row) in rows.iter_mut().enumerate() {
        for (product, value) in equations[index / 15].iter().enumerate() {
            for (a, x) in times(product / 9, index / 3 % 5) {
                for (b, y) in times(product / 3 % 3, index % 3) {
                    row[place([a, b, product % 3])] += value * x * y;
                }
            }
        }
    }
    rows
}

/// Solves the rows from `first` on for columns of this range, with complete pivoting, and takes these out of all of them; which columns.
fn eliminate(rows: &mut [[f64; COLUMNS]], first: usize, range: std::ops::Range<usize>) -> Vec<usize> {
    let mut solved = Vec::new();
    for index in first..rows.len() {
        let (mut most, mut at) = (NOTHING, None);
        for (row, values) in rows.iter().enumerate().skip(index) {
            for column in range.clone() {
                if values[column].abs() > most {
                    (most, at) = (values[column].abs(), Some((row, column)));
                }
            }
        }
        let Some((row, column)) = at else { break };
        rows.swap(index, row);
        let inverse = 1.0 / rows[index][column];
        rows[index].iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = rows[index];
        for (_, row) in rows.iter_mut().enumerate().skip(first).filter(|(other, _)| *other != index) {
            let factor = row[column];
            if factor != 0.0 {
                row.iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
            }
        }
        solved.push(column);
    }
    solved
}

/// What the products of the first angle's cosine and sine with the sixteen products that are left are made of; `None` when there are not
/// sixteen.
fn multiplication(mut rows: Vec<[f64; COLUMNS]>) -> Option<[Square; 2]> {
    let size = WIDTHS[1] * WIDTHS[2];
    let [plain, double] = [3, 5].map(|multiples| multiples * size);
    let top = eliminate(&mut rows, 0, double..COLUMNS).len();
    let mut solved = eliminate(&mut rows, top, plain..double);
    let middle = top + solved.len();
    let rest = eliminate(&mut rows, middle, 0..plain);
    // Rows for products with twice the angle still hold those that were solved for last.
    for (k, column) in rest.iter().enumerate() {
        let pivot = rows[middle + k];
        for row in &mut rows[top..middle] {
            let factor = row[*column];
            row.iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
        }
    }
    solved.extend(rest);
    let basis: Vec<usize> = (0..plain).filter(|column| !solved.contains(column)).collect();
    if basis.len() != SOLUTIONS || solved.len() + SOLUTIONS != double {
        return None;
    }
    let value = |column: usize, slot: usize| match solved.iter().position(|other| *other == column) {
        Some(index) => -rows[top + index][basis[slot]],
        None => f64::from(u8::from(basis[slot] == column)),
    };
    let matrix = |by: usize| -> Square {
        std::array::from_fn(|row| {
            let (multiple, others) = (basis[row] / size, basis[row] % size);
            let terms = times(by, multiple).map(|(a, x)| (a * size + others, x));
            std::array::from_fn(|slot| terms.iter().map(|(column, x)| x * value(*column, slot)).sum())
        })
    };
    Some([matrix(1), matrix(2)])
}

/// The real values of the first angle.
fn first_angles(lines: &[Line<f64>; 6], target: &Rigid) -> Option<Vec<f64>> {
    let [cosine, sine] = multiplication(template(&equations(lines, target)))?;
    let mixed: Square = std::array::from_fn(|i| std::array::from_fn(|j| 0.6 * cosine[i][j] + 0.8 * sine[i][j]));
    let form = Hessenberg::reduce(mixed);
    let real = form.eigenvalues()?.into_iter().filter(|value| value.im == 0.0);
    let angles = real.map(|value| {
        let vector = form.eigenvector(value.re);
        let times = |matrix: &Square| -> f64 {
            let image = matrix.map(|row| row.iter().zip(&vector).map(|(a, b)| a * b).sum::<f64>());
            image.iter().zip(&vector).map(|(a, b)| a * b).sum()
        };
        times(&sine).atan2(times(&cosine))
    });
    Some(angles.collect())
}

fn measure(chains: usize, targets: usize) {
    use groebot::derive::template::{all, survey};
    use groebot::solver::template::Template;
    let mut random = Random::new(43);
    let (mut misses, mut off, mut time, mut own_time) = (0, Vec::new(), Vec::new(), Vec::new());
    for _ in 0..chains {
        let lines = random_lines(&mut random);
        let layout = Layout { lines, slides: [false; 6], length: 1.0 };
        let solver = Template::new(&layout, survey(&layout, &all().collect::<Vec<_>>()));
        for _ in 0..targets {
            let q = random.angles();
            let target = solver.forward(&q);
            let start = Instant::now();
            let angles = first_angles(&lines, &target).unwrap_or_default();
            time.push(start.elapsed().as_secs_f64() * 1e6);
            let start = Instant::now();
            std::hint::black_box(solver.solve(&target));
            own_time.push(start.elapsed().as_secs_f64() * 1e6);
            let gap = nearest(&angles, q[0]);
            misses += usize::from(gap > 1e-6);
            off.push(gap);
        }
    }
    println!(
        "3-3 split: {misses} of {} angles missed by more than 1e-6, half of them by less than {:.0e}, {:.0} us; ours {:.1} us",
        off.len(),
        median(off.clone()),
        median(time),
        median(own_time)
    );
    assert!(misses * 20 <= off.len(), "{misses}");
}

#[test]
fn a_split_in_cosines_and_sines_finds_the_first_angle() {
    measure(2, 10);
}

/// The figures of docs/six_axes.md: `cargo test --release split_measured -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn a_split_measured() {
    measure(20, 100);
}
