//! From the matrix pencil to joint angles: eigenvalues, eigenvectors, back-substitution ([`Candidates`]).

use core::array::from_fn;

use super::chain::{Chain, Formulation, is_infinite};
use super::cluster::Cluster;
use super::hessenberg::Hessenberg;
use super::linear::solve;
use super::pencil::{Doubled, Matrix, NEAR, Pencil, SIZE, Wide};
use super::profile::{PRODUCTS, Products};
use super::reduce::Reduced;
use super::rigid::Rigid;
use super::rows::{COLUMNS, FAR, Rows};
use super::screw::{Axis, Figure};
use super::shifted_qr::Eigenvalue;
use super::vector::{Vector, cosines_and_sines, product, turn};
use crate::angles::angle;
use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, ROOTS};
use crate::trigonometry::{cosine, sine};

/// Origins of the hidden half angle (arc tangent of half a displacement). The first one with a well-conditioned matrix is used.
const ORIGINS: [f64; 3] = [0.4, 1.1, -0.5];

/// A candidate for a solution.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    /// The joint values. That of the joint whose line was used is not computed yet, and a displacement may be infinite.
    pub q: [f64; 6],
    /// [`Eigenvalue::depth`].
    pub depth: f64,
}

/// Candidates for solutions of one formulation.
pub(super) struct Candidates {
    /// Candidates of single eigenvalues first, and of these the real ones.
    list: [Candidate; SIZE],
    count: usize,
    /// Whether some solutions were not separated, because both the hidden joint and the doubled one have equal values in them.
    pub is_crowded: bool,
    /// The smallest pivot, relative to the largest entry of the inverted matrix.
    pub conditioning: f64,
}

/// Computes joint values from an eigenvector.
struct Reader<'a> {
    slides: &'a [bool; 6],
    formulation: Formulation,
    reduced: &'a Reduced,
    pencil: &'a Pencil,
}

/// The eigenvalue problem of one formulation at a target.
struct Problem<'a> {
    reader: Reader<'a>,
    form: Hessenberg,
    origin: f64,
    /// Eigenvalues closer than this, relative to `1 + |x|^2`, coincide.
    coinciding: f64,
}

impl Candidates {
    /// The eigenvalue problem at a displacement, for eigenvalues at most `deepest` off the real line. Each `attempt` has another origin of the half angle.
    /// `None` when the pencil is singular for this target, or not finite.
    #[inline(always)]
    pub fn new(chain: &Chain, displacement: &Rigid, attempt: usize, deepest: f64) -> Option<Self> {
        let formulation = chain.formulations.of(attempt);
        let reduced = Reduced::new(equations(chain, formulation, displacement));
        let slides = chain.slides[formulation.doubled()];
        let pencil = Pencil::new(&reduced, Doubled { second: formulation.second, slides })?;
        let Standard { origin, matrix, conditioning } = Standard::new(&pencil, attempt)?;
        let form = Hessenberg::reduce(matrix);
        let values = form.eigenvalues()?;
        let reader = Reader { slides: &chain.slides, formulation, reduced: &reduced, pencil: &pencil };
        let problem =
            Problem { reader, form, origin, coinciding: Arithmetic::sqrt(ACCEPTANCE.rounding / conditioning) };
        Some(problem.candidates(&problem.near_real(&values, deepest), conditioning))
    }

    pub fn as_slice(&self) -> &[Candidate] {
        &self.list[..self.count]
    }
}

/// The equations of a formulation.
#[inline(always)]
fn equations(chain: &Chain, formulation: Formulation, displacement: &Rigid) -> Rows {
    let place = |steps: usize, ahead: bool| chain.place(formulation, steps, ahead, displacement);
    let axis = |steps: usize, ahead: bool| {
        let Figure { direction, point, .. } = place(steps, ahead);
        Axis { direction, point, slides: chain.slides[formulation.joint(steps)] }
    };
    let frame = chain.frame(formulation);
    let near = frame.profile(&axis(1, true), &axis(2, true), &place(3, true));
    let far = frame.profile(&axis(5, false), &axis(4, false), &place(3, false));
    Rows::new(&near, &far, [frame.axis.slides, chain.slides[formulation.joint(3)]])
}

/// Eigenvalues near the real line, real ones first.
struct NearReal {
    list: [Eigenvalue; SIZE],
    count: usize,
    /// By eigenvalue, the index of the first one that coincides with it, which may be its own.
    first: [usize; SIZE],
}

impl NearReal {
    /// Number of eigenvalues that coincide with the one at an index, if none before it does.
    fn size(&self, index: usize) -> usize {
        self.first[..self.count].iter().filter(|first| **first == index).count()
    }

    /// The eigenvalues that coincide with no other one.
    fn alone(&self) -> ([Eigenvalue; SIZE], usize) {
        let (mut alone, mut count) = ([Eigenvalue { re: 0.0, im: 0.0 }; SIZE], 0);
        for index in (0..self.count).filter(|index| self.size(*index) == 1) {
            alone[count] = self.list[index];
            count += 1;
        }
        (alone, count)
    }
}

impl Problem<'_> {
    /// The eigenvalues at most `deepest` off the real line, real ones first.
    fn near_real(&self, values: &[Eigenvalue; SIZE], deepest: f64) -> NearReal {
        let mut near = NearReal { list: [Eigenvalue { re: 0.0, im: 0.0 }; SIZE], count: 0, first: from_fn(|k| k) };
        for is_real in [true, false] {
            for value in values.iter().filter(|value| (value.im == 0.0) == is_real && value.depth() <= deepest) {
                if !(self.reader.slides(0) && is_infinite(self.reader.doubled(self.half(value)))) {
                    near.list[near.count] = *value;
                    near.count += 1;
                }
            }
        }
        for index in 1..near.count {
            let coincides = |other: &usize| self.coincide(&near.list[*other], &near.list[index]);
            near.first[index] = (0..index).find(coincides).map_or(index, |other| near.first[other]);
        }
        near
    }

    /// Whether rounding may have split the two eigenvalues.
    #[inline(always)]
    fn coincide(&self, a: &Eigenvalue, b: &Eigenvalue) -> bool {
        let is_close = (a.re - b.re).abs() <= self.coinciding * (1.0 + a.re * a.re + b.re * b.re);
        is_close && a.depth() <= self.coinciding && b.depth() <= self.coinciding
    }

    /// Half the hidden angle, or the arc tangent of half the displacement.
    #[inline(always)]
    fn half(&self, value: &Eigenvalue) -> f64 {
        self.origin + angle(1.0, value.re + value.im)
    }

    #[inline(always)]
    fn candidates(&self, near: &NearReal, conditioning: f64) -> Candidates {
        let (alone, count) = near.alone();
        let vectors = self.form.eigenvectors(&alone.map(|value| value.re)[..count]);
        let list = [Candidate { q: [0.0; 6], depth: 0.0 }; SIZE];
        let mut candidates = Candidates { list, count, is_crowded: false, conditioning };
        for (candidate, (value, vector)) in candidates.list.iter_mut().zip(alone[..count].iter().zip(&vectors)) {
            *candidate = Candidate { q: self.reader.values(self.half(value), vector), depth: value.depth() };
        }
        if count < near.count {
            self.add_coinciding(near, &mut candidates);
        }
        candidates
    }

    /// Adds the candidates of coincident eigenvalues; if these are not separated, a single one.
    #[cold]
    fn add_coinciding(&self, near: &NearReal, candidates: &mut Candidates) {
        for index in (0..near.count).filter(|index| near.size(*index) > 1) {
            let (value, size) = (near.list[index], near.size(index));
            let cluster = Cluster::new(&self.form, self.reader.pencil, value.re, size);
            let (vectors, depths, size) = cluster.map_or_else(
                || (self.form.eigenvectors(&[value.re]), [value.depth(); SIZE], 1),
                |cluster| (cluster.vectors, cluster.depths, size),
            );
            candidates.is_crowded |= size == 1;
            for (vector, depth) in vectors[..size].iter().zip(depths) {
                let q = self.reader.values(self.half(&value), vector);
                candidates.list[candidates.count] = Candidate { q, depth };
                candidates.count += 1;
            }
        }
    }
}

/// `B^-1 A` for an origin of the half angle.
struct Standard {
    origin: f64,
    matrix: Matrix,
    /// Conditioning of `B`.
    conditioning: f64,
}

impl Standard {
    /// The matrix for the first origin whose `B` is well conditioned, or for the best one.
    #[inline(always)]
    fn new(pencil: &Pencil, attempt: usize) -> Option<Self> {
        let origin = |index: usize| ORIGINS[(attempt + index) % ORIGINS.len()];
        let mut best = Standard::of(pencil, origin(0));
        for index in 1..ORIGINS.len() {
            if best.conditioning >= ROOTS.pivot {
                break;
            }
            let other = Standard::of(pencil, origin(index));
            if other.conditioning > best.conditioning {
                best = other;
            }
        }
        (best.conditioning > 0.0).then_some(best)
    }

    fn of(pencil: &Pencil, origin: f64) -> Self {
        let (c, s) = (cosine(origin), sine(origin));
        let mut rows = [[0.0; 2 * SIZE]; SIZE];
        for (row, (a, b)) in rows.iter_mut().zip(pencil.constant.iter().zip(&pencil.linear)) {
            for column in 0..SIZE {
                row[column] = s * a[column] + c * b[column];
                row[SIZE + column] = c * a[column] - s * b[column];
            }
        }
        let (conditioning, mut matrix) = (solve(&mut rows), [[0.0; SIZE]; SIZE]);
        matrix.iter_mut().zip(&rows).for_each(|(entries, row)| entries.copy_from_slice(&row[SIZE..]));
        Standard { origin, matrix, conditioning }
    }
}

impl Reader<'_> {
    /// The joint values, given half the hidden angle and its eigenvector.
    fn values(&self, hidden: f64, vector: &[f64; SIZE]) -> [f64; 6] {
        let wide = self.pencil.widened(vector);
        let Halved { half, head, is_first } = Halved::of(&wide);
        let [[c], [s]] = cosines_and_sines(&[half]);
        let unit = if is_first { c } else { s };
        let [near, far] = if self.formulation.second { [2, 1] } else { [1, 2] };
        let sign = 1.0_f64.copysign(head[0]);
        let other = if self.slides(far) { head[2] / head[0] } else { turn(head[1] * sign, head[2] * sign) };
        let doubled = if self.slides(near) { s / c } else { 2.0 * half };
        let (first, second) = if self.formulation.second { (other, doubled) } else { (doubled, other) };
        let [a, b] = self.factors([first, second]);
        let products = from_fn(|product| a[product / 3] * b[product % 3]);
        let far = self.far(&wide, [c, s], head[0] / (unit * unit * unit), &products);
        let fourth = if self.slides(4) { -far[1] } else { -turn(far[0], far[1]) };
        let fifth = if self.slides(5) { -far[5] } else { -turn(far[2], far[5]) };
        let mut ordered = [0.0; 6];
        for (steps, value) in [self.doubled(hidden), first, second, 0.0, fourth, fifth].into_iter().enumerate() {
            ordered[self.formulation.joint(steps)] = value;
        }
        ordered
    }

    /// The angle or displacement of the hidden joint, given half of it.
    #[inline(always)]
    fn doubled(&self, half: f64) -> f64 {
        if !self.slides(0) {
            return 2.0 * half;
        }
        2.0 * (sine(half) / cosine(half))
    }

    /// Whether the joint `steps` after the hidden one is prismatic.
    #[inline(always)]
    fn slides(&self, steps: usize) -> bool {
        self.slides[self.formulation.joint(steps)]
    }

    /// 1, c, s of the angles, or 1, d^2, d of the displacements, of the near joints.
    #[inline(always)]
    fn factors(&self, values: [f64; 2]) -> [[f64; 3]; 2] {
        let [c, s] = cosines_and_sines(&values);
        from_fn(|k| if self.slides(k + 1) { [1.0, values[k] * values[k], values[k]] } else { [1.0, c[k], s[k]] })
    }

    /// The products of the far joints; `scale` is the factor of the eigenvector.
    #[inline(always)]
    fn far(&self, wide: &Wide, [c, s]: [f64; 2], scale: f64, near: &Products) -> [f64; FAR] {
        let scale = if self.slides[self.formulation.doubled()] { scale * (c * c) } else { scale };
        let (solved, order, left) = (self.reduced.solved, &self.reduced.order, self.reduced.left());
        let mut values = [0.0; COLUMNS];
        values[..PRODUCTS].copy_from_slice(near);
        for (k, column) in order[solved..].iter().enumerate() {
            values[*column] = (c * wide[NEAR + k] + s * wide[NEAR + left + k]) / scale;
        }
        let known = values;
        for (row, column) in self.reduced.rows.still.iter().zip(&order[..solved]) {
            values[*column] = -product(row, &known);
        }
        from_fn(|product| values[PRODUCTS + product])
    }
}

/// The doubled joint's value, computed from the near monomials.
struct Halved {
    /// Half of its angle, or the arc tangent of its displacement.
    half: f64,
    /// The products of the other near joint at the greatest monomial: multiples of 1, c, s.
    head: Vector,
    /// Whether the greatest monomial is the cube of the half angle's cosine. Otherwise it is that of its sine.
    is_first: bool,
}

impl Halved {
    #[inline(always)]
    fn of(wide: &Wide) -> Self {
        let powers = [0, 3, 6, 9].map(|first| [wide[first], wide[first + 1], wide[first + 2]]);
        let [first, last] = [0, 3].map(|power: usize| product(&powers[power], &powers[power]));
        if first >= last {
            Halved { half: turn(first, product(&powers[1], &powers[0])), head: powers[0], is_first: true }
        } else {
            Halved { half: turn(product(&powers[2], &powers[3]), last), head: powers[3], is_first: false }
        }
    }
}
