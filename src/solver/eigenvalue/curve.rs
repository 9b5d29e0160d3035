//! Curves all along which the target is nearly reached, as next to a self-motion ([`Walk`]).
//!
//! Beside a self-motion the isolated answers of a target may stand anywhere on the curve that the self-motion was, and Newton's steps find none of
//! them: the Jacobian has rank five but for a trace. A walk holds the five equations that joints can change and goes along the tangent; what
//! is missed of the sixth one changes its sign at each answer. (Bordering: A. Griewank and G. W. Reddien, SIAM J. Numerical Analysis 21
//! (1984) 176-185; steps along the tangent: E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.)

use super::answers::{Answers, ROOM, distance};
use super::polish::{EXACT, LONGEST, Links, Rigid, size};

/// A fifth pivot of the Jacobian below this share of the first: there is more than a curve.
pub(super) const RANK: f64 = 1e-3;
/// The largest singular value, about, of what is taken for a curve.
pub(super) const STEEP: f64 = 1e-2;
/// Where joints change the sixth equation by more after [`EARLY`] steps across, no curve is near.
pub(super) const FLAT: f64 = 5e-2;
/// Steps behind which that is asked.
pub(super) const EARLY: usize = 2;
/// The most that may be missed on a curve, as a share of the length scale or in radians.
pub(super) const ADRIFT: f64 = 1e-3;
/// What rounding leaves of the equations on a self-motion.
pub(super) const LEVEL: f64 = 1e-13;
/// A last step across the curve.
pub(super) const SETTLED: f64 = 1e-9;
/// Steps across the curve at most, from where a walk may begin.
pub(super) const ROUNDS: usize = 12;
/// The same from the end of a step along it.
pub(super) const FEW: usize = 5;
/// The length of a step along the curve.
pub(super) const STRIDE: f64 = 0.1;
/// The least one, as a share of it.
pub(super) const SHORT: f64 = 0.015;
/// The most steps of a walk in one direction.
pub(super) const PACES: usize = 400;
/// Rounds of the false position between two steps.
pub(super) const NARROWED: usize = 16;

/// The Jacobian at a joint vector: five directions that lead to somewhere and one that hardly does.
#[derive(Clone, Copy)]
pub(super) struct Section {
    /// The shortest step behind which only `value` is missed, to first order.
    step: [f64; 6],
    /// The tangent of the curve, of length one.
    along: [f64; 6],
    /// The sum of equations that no joint changes, of length one.
    across: [f64; 6],
    /// What is missed of it.
    value: f64,
    /// By how much joints change it after all, about the least singular value.
    slope: f64,
}

/// A place on a curve.
#[derive(Clone, Copy)]
struct Place {
    q: [f64; 6],
    section: Section,
}

/// A walk along all curves that are found from some joint vectors.
pub(super) struct Walk<'a> {
    links: &'a Links,
    target: &'a Rigid,
    /// Where walks begin; those that another one has passed are left out.
    starts: [Option<Place>; ROOM],
    count: usize,
}

impl Section {
    /// The same with the directions that go on from another one's.
    fn aligned(mut self, other: &Section) -> Section {
        if product(&self.along, &other.along) < 0.0 {
            self.along = self.along.map(|entry| -entry);
        }
        if product(&self.across, &other.across) < 0.0 {
            self.across = self.across.map(|entry| -entry);
            self.value = -self.value;
        }
        self
    }

    fn is_near(&self) -> bool {
        self.slope <= STEEP && self.value.abs() <= ADRIFT
    }
}

impl Links {
    /// The section at `q`; `None` where more than one direction leads nowhere.
    fn section(&self, q: &[f64; 6], target: &Rigid) -> Option<Section> {
        let reach = self.reach(q);
        let (mut matrix, mut right) = (self.jacobian(&reach), Links::miss(&reach, target));
        let (rows, columns) = eliminate(&mut matrix, &mut right)?;
        let mut across = [0.0; 6];
        across[rows[5]] = 1.0;
        for k in (0..5).rev() {
            across[rows[k]] = -(k + 1..6).map(|i| matrix[i][columns[k]] * across[rows[i]]).sum::<f64>();
        }
        let [mut along, mut step] = [([0.0; 6], 1.0), (right, 0.0)].map(|(right, last)| {
            let mut x = [0.0; 6];
            x[columns[5]] = last;
            for k in (0..5).rev() {
                let known = (k + 1..6).map(|j| matrix[k][columns[j]] * x[columns[j]]).sum::<f64>();
                x[columns[k]] = (right[k] - known) / matrix[k][columns[k]];
            }
            x
        });
        let lengths = [&across, &along].map(|v| product(v, v).sqrt());
        across = across.map(|entry| entry / lengths[0]);
        along = along.map(|entry| entry / lengths[1]);
        let share = product(&step, &along);
        step.iter_mut().zip(&along).for_each(|(entry, over)| *entry -= share * over);
        let slope = matrix[5][columns[5]].abs() / (lengths[0] * lengths[1]);
        Some(Section { step, along, across, value: right[5] / lengths[0], slope })
    }

    /// Steps across the curve from `q`, `rounds` at most.
    fn settled(&self, mut q: [f64; 6], target: &Rigid, rounds: usize) -> Option<Place> {
        for round in 0..rounds {
            let section = self.section(&q, target)?;
            let longest = size(&section.step);
            if !longest.is_finite() || (round >= EARLY && section.slope > FLAT) {
                return None;
            }
            let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            q.iter_mut().zip(&section.step).for_each(|(value, step)| *value += share * step);
            if longest <= SETTLED {
                let section = self.section(&q, target)?;
                return section.is_near().then_some(Place { q, section });
            }
        }
        None
    }
}

impl<'a> Walk<'a> {
    /// A walk that has not begun.
    pub fn new(links: &'a Links, target: &'a Rigid) -> Self {
        Walk { links, target, starts: [None; ROOM], count: 0 }
    }

    /// Begins at `q` too if there is a curve next to it.
    pub fn begin(&mut self, q: [f64; 6]) {
        if self.count < ROOM
            && let Some(place) = self.links.settled(q, self.target, ROUNDS)
        {
            self.starts[self.count] = Some(place);
            self.count += 1;
        }
    }

    /// Whether there is a curve where `q` is, an answer.
    pub fn is_curve(&self, q: &[f64; 6]) -> bool {
        self.links.section(q, self.target).is_some_and(|section| section.is_near())
    }

    /// Walks along the curves, both ways if they do not close, and adds answers where the sixth equation changes its sign; of a curve that
    /// misses nothing, a self-motion, one member.
    pub fn run(mut self, answers: &mut Answers) {
        for index in 0..self.count {
            let Some(start) = self.starts[index].take() else { continue };
            let mut level = start.section.value.abs();
            for way in [1.0, -1.0] {
                let mut first = start;
                first.section.along = first.section.along.map(|entry| way * entry);
                if self.leads_home(first, answers, &mut level) {
                    break;
                }
            }
            if level <= LEVEL {
                answers.find(self.links, start.q, self.target);
            }
        }
    }

    /// Walks from `home` until the curve closes or ends; whether it closed. `level` becomes the most that was missed.
    fn leads_home(&mut self, home: Place, answers: &mut Answers, level: &mut f64) -> bool {
        let (mut before, mut at, mut stride, mut is_away) = (home, home, STRIDE, false);
        for _ in 0..PACES {
            let Some(next) = self.pace(&at, &mut stride) else { return false };
            *level = level.max(next.section.value.abs());
            self.change(&at, &next, answers);
            self.dip([&before, &at, &next], answers);
            for start in &mut self.starts[..self.count] {
                *start = start.filter(|start| distance(&start.q, &next.q, &self.links.slides) > STRIDE);
            }
            (before, at) = (at, next);
            let way = distance(&at.q, &home.q, &self.links.slides);
            is_away |= way > 3.0 * STRIDE;
            if is_away && way <= STRIDE && product(&at.section.along, &home.section.along) > 0.5 {
                let end =
                    Place { q: beside(&home.q, &at.q, &self.links.slides), section: home.section.aligned(&at.section) };
                self.change(&at, &end, answers);
                return true;
            }
        }
        false
    }

    /// A step along the curve, shorter where it bends; `None` where it ends.
    fn pace(&self, at: &Place, stride: &mut f64) -> Option<Place> {
        while *stride >= SHORT * STRIDE {
            let ahead = between(&at.q, &at.section.along, *stride);
            if let Some(next) = self.links.settled(ahead, self.target, FEW)
                && product(&next.section.along, &at.section.along).abs() > 0.9
                && distance(&next.q, &at.q, &self.links.slides) <= 2.0 * *stride
            {
                *stride = (2.0 * *stride).min(STRIDE);
                return Some(Place { section: next.section.aligned(&at.section), ..next });
            }
            *stride *= 0.5;
        }
        None
    }

    /// Adds the answer between two places where the sixth equation has different signs, by false position (the Illinois rule: M. Dowell
    /// and P. Jarratt, BIT 11 (1971) 168-174).
    fn change(&self, a: &Place, b: &Place, answers: &mut Answers) {
        let (mut low, mut high) = (a.section.value, b.section.value);
        if (low <= 0.0) == (high <= 0.0) || low.abs().max(high.abs()) <= LEVEL {
            return;
        }
        let (mut near, mut far, mut side) = (*a, *b, 0.0);
        for _ in 0..NARROWED {
            let way: [f64; 6] = std::array::from_fn(|joint| far.q[joint] - near.q[joint]);
            let middle = between(&near.q, &way, low / (low - high));
            let Some(place) = self.links.settled(middle, self.target, FEW) else { break };
            let section = place.section.aligned(&a.section);
            if (section.value <= 0.0) == (low <= 0.0) {
                near = Place { section, ..place };
                high = if side < 0.0 { 0.5 * high } else { far.section.value };
                (low, side) = (section.value, -1.0);
            } else {
                far = Place { section, ..place };
                low = if side > 0.0 { 0.5 * low } else { near.section.value };
                (high, side) = (section.value, 1.0);
            }
            if section.value.abs() <= EXACT {
                break;
            }
        }
        let best = if near.section.value.abs() <= far.section.value.abs() { near } else { far };
        answers.find(self.links, best.q, self.target);
    }

    /// Where the sixth equation comes near zero and goes away again, there may be two answers, or a double one.
    fn dip(&self, [a, b, c]: [&Place; 3], answers: &mut Answers) {
        let [low, least, high] = [a, b, c].map(|place| place.section.value);
        let is_dip = least.abs() < low.abs() && least.abs() < high.abs() && least.abs() > LEVEL;
        if !is_dip || (low <= 0.0) != (least <= 0.0) || (high <= 0.0) != (least <= 0.0) {
            return;
        }
        let share = 0.5 * (low - high) / (low - least - least + high);
        let end = if share < 0.0 { a } else { c };
        let way: [f64; 6] = std::array::from_fn(|joint| end.q[joint] - b.q[joint]);
        if let Some(place) = self.links.settled(between(&b.q, &way, share.abs()), self.target, FEW) {
            let vertex = Place { section: place.section.aligned(&b.section), ..place };
            self.change(b, &vertex, answers);
            self.change(&vertex, end, answers);
            answers.find(self.links, vertex.q, self.target);
        }
    }
}

/// Five steps of Gauss elimination with complete pivoting; the factors stay below the diagonal. The order of the rows, which are moved, and
/// that of the columns, which are not.
fn eliminate(matrix: &mut [[f64; 6]; 6], right: &mut [f64; 6]) -> Option<([usize; 6], [usize; 6])> {
    let (mut rows, mut columns, mut first) = ([0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 4, 5], 0.0);
    for k in 0..5 {
        let (mut most, mut row, mut place) = (0.0, k, k);
        for (i, values) in matrix.iter().enumerate().skip(k) {
            for (j, &column) in columns.iter().enumerate().skip(k) {
                let entry = values[column].abs();
                if entry > most {
                    (most, row, place) = (entry, i, j);
                }
            }
        }
        first = if k == 0 { most } else { first };
        if most <= RANK * first || !most.is_finite() {
            return None;
        }
        matrix.swap(k, row);
        right.swap(k, row);
        rows.swap(k, row);
        columns.swap(k, place);
        let (pivot, over) = (matrix[k], right[k]);
        for i in k + 1..6 {
            let factor = matrix[i][columns[k]] / pivot[columns[k]];
            for &column in &columns[k + 1..] {
                matrix[i][column] -= factor * pivot[column];
            }
            matrix[i][columns[k]] = factor;
            right[i] -= factor * over;
        }
    }
    Some((rows, columns))
}

fn product(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
}

/// `q` moved along `way` by a share of it.
fn between(q: &[f64; 6], way: &[f64; 6], share: f64) -> [f64; 6] {
    std::array::from_fn(|joint| q[joint] + share * way[joint])
}

/// `q` with the turns of its angles that are nearest to `other`.
fn beside(q: &[f64; 6], other: &[f64; 6], slides: &[bool; 6]) -> [f64; 6] {
    std::array::from_fn(|joint| {
        let way = other[joint] - q[joint];
        let turns = if slides[joint] { 0.0 } else { (way / std::f64::consts::TAU).round() };
        q[joint] + std::f64::consts::TAU * turns
    })
}
