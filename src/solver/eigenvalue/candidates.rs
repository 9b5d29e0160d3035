//! From the pencil to joint angles: eigenvalues, eigenvectors, back-substitution ([`Candidates`]).

use crate::roots::{Eigenvalue, Hessenberg};

use super::formulation::{Equations, Formulation};
use super::linear::solve;
use super::pencil::{ALL, Matrix, NEAR, Pencil, SIZE, Wide, monomials};
use super::profile::PRODUCTS;
use super::reduce::Reduced;
use super::rows::{COLUMNS, Doubled, FAR, Rows};
use groebot_runtime::trigonometry::angle;

/// Half angles (arc tangents of half a way) from which the hidden one is counted: the first whose matrix can be inverted well is taken.
pub(super) const ORIGINS: [f64; 3] = [0.4, 1.1, -0.5];
/// The smallest share of a pivot in the largest entry of its matrix at which an origin is taken at once.
pub(super) const SOUND: f64 = 1e-9;
/// A complex pair with a smaller imaginary part, as a share of `1 + |x|^2`, may be a double root that rounding has parted.
pub(super) const BLURRED: f64 = 1e-2;
/// More than the depth of any eigenvalue.
pub(super) const DEEPEST: f64 = 1.0;
/// Two real eigenvalues closer than this share of `1 + |x|^2` have eigenvectors that rounding mixes.
pub(super) const CROWDED: f64 = 1e-8;

/// Five joint values; the one whose line was used is still missing.
pub(super) type Values = [f64; 6];

/// A candidate for a solution.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Candidate {
    /// The values; a way may be infinite.
    pub q: Values,
    /// The size of the eigenvalue's imaginary part as a share of `1 + |x|^2`: half the way off the real line of the hidden angle.
    pub depth: f64,
}

/// Candidates for solutions of one formulation.
#[derive(Clone, Debug)]
pub(super) struct Candidates {
    /// The values, those of real eigenvalues first.
    pub list: [Candidate; SIZE],
    /// How many there are.
    pub count: usize,
    /// Whether two real eigenvalues are so close that their eigenvectors are not known.
    pub is_crowded: bool,
    /// The smallest share of a pivot in the largest entry of the matrix that was inverted.
    pub conditioning: f64,
}

/// What an eigenvector means.
struct Reader<'a> {
    formulation: Formulation,
    /// By joint: whether it slides.
    slides: &'a [bool; 6],
    reduced: &'a Reduced,
    pencil: &'a Pencil,
}

impl Candidates {
    /// The candidates, of eigenvalues no farther off the real line than `deepest`; each `attempt` begins with another origin of the half
    /// angle. `None` when the pencil is singular for this target,
    /// or not finite.
    pub fn new(
        equations: &Equations<f64>,
        formulation: Formulation,
        slides: &[bool; 6],
        attempt: usize,
        deepest: f64,
    ) -> Option<Self> {
        let reduced = Reduced::new(&Rows::new(equations));
        let doubled = Doubled { second: formulation.second, slides: slides[formulation.doubled()], square: 1.0 };
        let pencil = Pencil::new(&reduced, doubled)?;
        let (origin, matrix, conditioning) = standard(&pencil, attempt)?;
        let form = Hessenberg::reduce(matrix);
        let values = form.eigenvalues()?;
        let reader = Reader { formulation, slides, reduced: &reduced, pencil: &pencil };
        let mut found = Candidates { list: [Candidate::default(); SIZE], count: 0, is_crowded: false, conditioning };
        found.is_crowded = is_crowded(&values);
        let depth = |value: &Eigenvalue| value.im.abs() / (1.0 + value.re * value.re + value.im * value.im);
        let (real, near) =
            (values.iter().filter(|value| value.im == 0.0), values.iter().filter(|value| value.im != 0.0));
        for value in real.chain(near.filter(|value| depth(value) <= deepest)) {
            let half = origin + angle(1.0, value.re + value.im);
            let hidden = if slides[formulation.hidden] { 2.0 * (half.sin() / half.cos()) } else { 2.0 * half };
            let q = reader.values(hidden, &form.eigenvector(value.re));
            found.list[found.count] = Candidate { q, depth: depth(value) };
            found.count += 1;
        }
        Some(found)
    }
}

fn is_crowded(values: &[Eigenvalue; SIZE]) -> bool {
    let is_close = |a: &Eigenvalue, b: &Eigenvalue| {
        a.im == 0.0 && b.im == 0.0 && (a.re - b.re).abs() <= CROWDED * (1.0 + a.re * a.re + b.re * b.re)
    };
    (1..SIZE).any(|k| values[..k].iter().any(|other| is_close(other, &values[k])))
}

/// The origin of the half angle, `B'^-1 A'` for it, and how well `B'` was inverted.
fn standard(pencil: &Pencil, attempt: usize) -> Option<(f64, Matrix, f64)> {
    let mut best: Option<(f64, Matrix, f64)> = None;
    for index in 0..ORIGINS.len() {
        let origin = ORIGINS[(attempt + index) % ORIGINS.len()];
        let (s, c) = (origin.sin(), origin.cos());
        let mix = |a: f64, b: f64| -> Matrix {
            std::array::from_fn(|row| {
                std::array::from_fn(|column| a * pencil.constant[row][column] + b * pencil.linear[row][column])
            })
        };
        let (mut right, mut left) = (mix(c, -s), mix(s, c));
        let conditioning = solve(&mut left, &mut right);
        if best.as_ref().is_none_or(|(_, _, known)| conditioning > *known) {
            best = Some((origin, right, conditioning));
        }
        if conditioning >= SOUND {
            break;
        }
    }
    best.filter(|(_, _, conditioning)| *conditioning > 0.0)
}

impl Reader<'_> {
    /// The values, given that of the hidden joint and its eigenvector.
    fn values(&self, hidden: f64, vector: &[f64; SIZE]) -> Values {
        let wide = self.pencil.widened(vector);
        let (half, head) = half_angle(&wide);
        let (s, c) = (half.sin(), half.cos());
        let [near, far] = if self.formulation.second { [2, 1] } else { [1, 2] };
        let (is_way, sign) = (self.slides(far), 1.0_f64.copysign(head[0]));
        let other = if is_way { head[2] / head[0] } else { turn(head[1] * sign, head[2] * sign) };
        let doubled = if self.slides(near) { s / c } else { 2.0 * half };
        let (first, second) = if self.formulation.second { (other, doubled) } else { (doubled, other) };
        let near = products(self.factors(1, first), self.factors(2, second));
        let far = self.far(&wide, [c, s], head[0], &near);
        let fourth = if self.slides(4) { -far[1] } else { -turn(far[0], far[1]) };
        let fifth = if self.slides(5) { -far[5] } else { -turn(far[2], far[5]) };
        let mut ordered = [0.0; 6];
        for (steps, value) in [hidden, first, second, 0.0, fourth, fifth].into_iter().enumerate() {
            ordered[self.formulation.joint(steps)] = value;
        }
        ordered
    }

    /// Whether the joint `steps` behind the hidden one slides.
    fn slides(&self, steps: usize) -> bool {
        self.slides[self.formulation.joint(steps)]
    }

    /// 1, c, s of an angle, or 1, d^2, d of a way.
    fn factors(&self, steps: usize, value: f64) -> [f64; 3] {
        if self.slides(steps) { [1.0, value * value, value] } else { [1.0, value.cos(), value.sin()] }
    }

    /// The products of the far joints.
    fn far(&self, wide: &Wide, [c, s]: [f64; 2], head: f64, near: &[f64; PRODUCTS]) -> [f64; FAR] {
        let scale = if c.abs() >= s.abs() { head / (c * c * c) } else { head / (s * s * s) };
        let doubled = self.slides[self.formulation.doubled()];
        let scale = if doubled { scale * (c * c) } else { scale };
        let (solved, order) = (self.reduced.solved, &self.reduced.order);
        let left = FAR - solved;
        let mut values = [0.0; COLUMNS];
        values[..PRODUCTS].copy_from_slice(near);
        for (k, column) in order[solved..].iter().enumerate() {
            values[*column] = (c * wide[NEAR + k] + s * wide[NEAR + left + k]) / scale;
        }
        let known = values;
        for (row, column) in self.reduced.still.iter().zip(&order[..solved]) {
            values[*column] = -row.iter().zip(&known).map(|(a, b)| a * b).sum::<f64>();
        }
        std::array::from_fn(|product| values[PRODUCTS + product])
    }
}

/// Half of the doubled angle, and the products of the other near joint at the greatest monomial: multiples of 1, c, s.
fn half_angle(wide: &Wide) -> (f64, [f64; 3]) {
    let powers = [0, 1, 2, 3].map(|power| monomials(wide, power));
    let product = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let [first, last] = [0, 3].map(|power| product(&powers[power], &powers[power]));
    if first >= last {
        (turn(first, product(&powers[1], &powers[0])), powers[0])
    } else {
        (turn(product(&powers[2], &powers[3]), last), powers[3])
    }
}

/// The angle of a cosine and a sine; nought where both are zero.
pub(super) fn turn(cosine: f64, sine: f64) -> f64 {
    if cosine == 0.0 && sine == 0.0 { 0.0 } else { angle(cosine, sine) }
}

/// The products of one of 1, c, s of two joints, the second changing fastest.
fn products(a: [f64; 3], b: [f64; 3]) -> [f64; PRODUCTS] {
    std::array::from_fn(|product| a[product / 3] * b[product % 3])
}

const _: () = assert!(ALL == NEAR + 2 * FAR);
