//! Output rows for the solutions of targets. Main type: [`Sink`].

use crate::kernel::Answer;

/// Reason why a target has no solutions. The numbers are those of `groebot.Status`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// It has solutions.
    Solved = 0,
    /// It is out of reach.
    Unreachable = 1,
    /// One of its numbers is infinite or NaN.
    NotFinite = 2,
    /// Its rotation matrix, its quaternion or the last row of its matrix is invalid.
    NotRotation = 3,
    /// Its direction does not have length one.
    NotUnit = 4,
    /// It is on a stratum that could not be derived.
    Open = 5,
    /// All its solutions are beyond the limits.
    BeyondLimits = 6,
    /// The maximum number of polishing steps was reached before all work was done: other solutions may be missing.
    Unsettled = 7,
}

/// Output for solutions, one row for each.
pub struct Rows<'a> {
    /// Joint values, row by row.
    pub q: &'a mut [f64],
    pub residual: &'a mut [f64],
    pub branch: &'a mut [i32],
    /// Bit `j` is set where joint `j` is free.
    pub free: &'a mut [u32],
}

impl<'a> Rows<'a> {
    /// The first rows, and the others.
    pub fn split(self, rows: usize, joints: usize) -> (Rows<'a>, Rows<'a>) {
        let (q, later_q) = self.q.split_at_mut(rows * joints);
        let (residual, later_residual) = self.residual.split_at_mut(rows);
        let (branch, later_branch) = self.branch.split_at_mut(rows);
        let (free, later_free) = self.free.split_at_mut(rows);
        let later = Rows { q: later_q, residual: later_residual, branch: later_branch, free: later_free };
        (Rows { q, residual, branch, free }, later)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.residual.len()
    }

    pub fn copy_from(&mut self, other: &Rows<'_>, rows: usize, joints: usize) {
        self.q.copy_from_slice(&other.q[..rows * joints]);
        self.residual.copy_from_slice(&other.residual[..rows]);
        self.branch.copy_from_slice(&other.branch[..rows]);
        self.free.copy_from_slice(&other.free[..rows]);
    }
}

/// Output for the solutions of targets, in their order.
pub struct Sink<'a> {
    pub joints: usize,
    pub rows: Rows<'a>,
    /// Number of rows in use.
    pub taken: usize,
    /// Number of solutions of each target.
    pub counts: &'a mut [i64],
    pub status: &'a mut [u8],
    /// Number of targets that have ended.
    ended: usize,
    /// Whether a solution did not fit.
    pub is_full: bool,
}

impl<'a> Sink<'a> {
    pub fn new(joints: usize, rows: Rows<'a>, counts: &'a mut [i64], status: &'a mut [u8]) -> Self {
        Sink { joints, rows, taken: 0, counts, status, ended: 0, is_full: false }
    }

    /// Rows for `count` more solutions; `None` when there are not enough.
    #[inline]
    pub fn more(&mut self, count: usize) -> Option<Rows<'_>> {
        let (first, last) = (self.taken, self.taken + count);
        if last > self.rows.len() {
            self.is_full = true;
            return None;
        }
        self.taken = last;
        Some(Rows {
            q: &mut self.rows.q[first * self.joints..last * self.joints],
            residual: &mut self.rows.residual[first..last],
            branch: &mut self.rows.branch[first..last],
            free: &mut self.rows.free[first..last],
        })
    }

    /// Ends a target whose solutions begin at row `first`. `why` is the reason if it has none, or not all.
    #[inline]
    pub fn end(&mut self, first: usize, why: Status) {
        let count = self.taken - first;
        self.counts[self.ended] = count as i64;
        let is_solved = count > 0 && why != Status::Unsettled;
        self.status[self.ended] = if is_solved { Status::Solved as u8 } else { why as u8 };
        self.ended += 1;
    }

    /// The solution of a row. It is not marked as chosen.
    pub fn answer(&self, row: usize) -> Answer<'_> {
        let Rows { residual, branch, free, .. } = &self.rows;
        let (residual, branch, free) = (residual[row], branch[row] as usize, free[row]);
        Answer { q: self.row(row), residual, branch, free, chosen: false, settled: true }
    }

    pub fn row(&self, answer: usize) -> &[f64] {
        &self.rows.q[answer * self.joints..][..self.joints]
    }

    pub fn row_mut(&mut self, answer: usize) -> &mut [f64] {
        &mut self.rows.q[answer * self.joints..][..self.joints]
    }

    /// Copies the solution of row `from` to row `to`.
    pub fn put(&mut self, from: usize, to: usize) {
        let Rows { q, residual, branch, free } = &mut self.rows;
        q.copy_within(from * self.joints..(from + 1) * self.joints, to * self.joints);
        (residual[to], branch[to], free[to]) = (residual[from], branch[from], free[from]);
    }
}
