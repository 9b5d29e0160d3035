//! The Jacobian next to a curve on which the target is nearly reached ([`Section`]).
//!
//! Bordering: A. Griewank and G. W. Reddien, SIAM J. Numerical Analysis 21 (1984) 176-185.

use super::chain::Chain;
use super::polish::LONGEST;
use super::rigid::Rigid;
use super::vector::{norm, product, size};
use crate::tolerances::{PIVOTS, POLISHING, SELF_MOTIONS, STRATA};

/// Number of steps before `SELF_MOTIONS.flat` is tested.
const EARLY: usize = 2;

/// The Jacobian at a joint vector, split into five directions that change the pose and one that changes it very little.
#[derive(Clone, Copy)]
pub(super) struct Section {
    /// The shortest step after which only `value` remains of the residual, to first order.
    step: [f64; 6],
    /// The unit tangent of the curve.
    pub along: [f64; 6],
    /// The unit combination of equations that no joint changes.
    across: [f64; 6],
    /// The residual of that combination.
    pub value: f64,
    /// The derivative of that combination along the tangent, approximately the least singular value.
    slope: f64,
}

/// A place on a curve.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub q: [f64; 6],
    pub section: Section,
}

impl Section {
    /// This section with the signs of its directions consistent with another one's.
    pub fn aligned(mut self, other: &Section) -> Section {
        if product(&self.along, &other.along) < 0.0 {
            self.along = self.along.map(|entry| -entry);
        }
        if product(&self.across, &other.across) < 0.0 {
            self.across = self.across.map(|entry| -entry);
            self.value = -self.value;
        }
        self
    }

    /// Whether a curve is here.
    pub fn is_near(&self) -> bool {
        self.slope <= SELF_MOTIONS.flat && self.value.abs() <= STRATA.near
    }
}

/// The Jacobian after five steps of elimination, with the factors below its diagonal, and the residual.
struct Cut {
    matrix: [[f64; 6]; 6],
    right: [f64; 6],
    /// The order of the rows, which were exchanged.
    rows: [usize; 6],
    /// The order of the columns, which were not moved.
    columns: [usize; 6],
}

impl Chain {
    /// The section at `q`. `None` where more than one direction changes the pose very little.
    pub(super) fn section(&self, q: &[f64; 6], target: &Rigid) -> Option<Section> {
        let reach = self.reach(q);
        let cut = Cut::new(self.jacobian(&reach), reach.miss(target))?;
        let (mut across, mut along) = (cut.across(), cut.solved(&[0.0; 6], 1.0));
        let lengths = [norm(&across), norm(&along)];
        across = across.map(|entry| entry / lengths[0]);
        along = along.map(|entry| entry / lengths[1]);
        let mut step = cut.solved(&cut.right, 0.0);
        let share = product(&step, &along);
        step.iter_mut().zip(&along).for_each(|(entry, over)| *entry -= share * over);
        let slope = cut.matrix[5][cut.columns[5]].abs() / (lengths[0] * lengths[1]);
        Some(Section { step, along, across, value: cut.right[5] / lengths[0], slope })
    }

    /// Takes at most `rounds` steps across the curve from `q`.
    pub(super) fn settled(&self, mut q: [f64; 6], target: &Rigid, rounds: usize) -> Option<Place> {
        for round in 0..rounds {
            let section = self.section(&q, target)?;
            let longest = size(&section.step);
            if !longest.is_finite() || (round >= EARLY && section.slope > SELF_MOTIONS.flat) {
                return None;
            }
            let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            q.iter_mut().zip(&section.step).for_each(|(value, step)| *value += share * step);
            if longest <= POLISHING.step {
                let section = self.section(&q, target)?;
                return section.is_near().then_some(Place { q, section });
            }
        }
        None
    }
}

impl Cut {
    /// Gauss elimination with complete pivoting.
    fn new(matrix: [[f64; 6]; 6], right: [f64; 6]) -> Option<Self> {
        let mut cut = Cut { matrix, right, rows: [0, 1, 2, 3, 4, 5], columns: [0, 1, 2, 3, 4, 5] };
        let mut first = 0.0;
        for k in 0..5 {
            let most = cut.pivot(k);
            first = if k == 0 { most } else { first };
            if most <= PIVOTS.weak * first || !most.is_finite() {
                return None;
            }
            cut.eliminate(k);
        }
        Some(cut)
    }

    /// Exchanges rows and columns so that the largest entry is at `k`. Returns its magnitude.
    fn pivot(&mut self, k: usize) -> f64 {
        let (mut most, mut row, mut place) = (0.0, k, k);
        for i in k..6 {
            for j in k..6 {
                let entry = self.matrix[i][self.columns[j]].abs();
                if entry > most {
                    (most, row, place) = (entry, i, j);
                }
            }
        }
        self.matrix.swap(k, row);
        self.right.swap(k, row);
        self.rows.swap(k, row);
        self.columns.swap(k, place);
        most
    }

    fn eliminate(&mut self, k: usize) {
        let (pivot, over) = (self.matrix[k], self.right[k]);
        for i in k + 1..6 {
            let factor = self.matrix[i][self.columns[k]] / pivot[self.columns[k]];
            for &column in &self.columns[k + 1..] {
                self.matrix[i][column] -= factor * pivot[column];
            }
            self.matrix[i][self.columns[k]] = factor;
            self.right[i] -= factor * over;
        }
    }

    /// The combination of equations that contains no joint; the coefficient of the last one is one.
    fn across(&self) -> [f64; 6] {
        let mut across = [0.0; 6];
        across[self.rows[5]] = 1.0;
        for k in (0..5).rev() {
            let share = |i: usize| self.matrix[i][self.columns[k]] * across[self.rows[i]];
            across[self.rows[k]] = -(k + 1..6).map(share).sum::<f64>();
        }
        across
    }

    /// The joint values that solve five equations, given the last joint.
    fn solved(&self, right: &[f64; 6], last: f64) -> [f64; 6] {
        let mut x = [0.0; 6];
        x[self.columns[5]] = last;
        for k in (0..5).rev() {
            let known = (k + 1..6).map(|j| self.matrix[k][self.columns[j]] * x[self.columns[j]]).sum::<f64>();
            x[self.columns[k]] = (right[k] - known) / self.matrix[k][self.columns[k]];
        }
        x
    }
}
