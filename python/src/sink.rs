//! Where the answers of targets go, in flat rows. Main type: [`Sink`].

/// Why a target has no answers; the numbers are those of `groebot.Status`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// It has some.
    Solved = 0,
    /// It is out of reach.
    Unreachable = 1,
    /// A number of it is infinite or none.
    NotFinite = 2,
    /// Its rotation, its quaternion or the last row of its matrix is none.
    NotRotation = 3,
    /// Its direction is not of length one.
    NotUnit = 4,
    /// It lies on a stratum that could not be derived.
    Open = 5,
    /// All its solutions are beyond the limits.
    BeyondLimits = 6,
    /// The steps that it may take were spent before all work was done: it may have other answers than those that are there.
    Unsettled = 7,
}

/// Room for answers, one row an answer.
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

    /// How many rows there are.
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

/// The answers of some targets, in their order.
pub struct Sink<'a> {
    pub joints: usize,
    pub rows: Rows<'a>,
    /// How many rows are taken.
    pub taken: usize,
    /// By target, the number of its answers.
    pub counts: &'a mut [i64],
    pub status: &'a mut [u8],
    /// How many targets are ended.
    ended: usize,
    /// Whether there was no room for an answer.
    pub is_full: bool,
}

impl<'a> Sink<'a> {
    pub fn new(joints: usize, rows: Rows<'a>, counts: &'a mut [i64], status: &'a mut [u8]) -> Self {
        Sink { joints, rows, taken: 0, counts, status, ended: 0, is_full: false }
    }

    /// Room for so many more answers; none where it is full.
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

    /// Ends a target whose answers begin at `first`; where it has none, or not all, `why`.
    #[inline]
    pub fn end(&mut self, first: usize, why: Status) {
        let count = self.taken - first;
        self.counts[self.ended] = count as i64;
        let is_solved = count > 0 && why != Status::Unsettled;
        self.status[self.ended] = if is_solved { Status::Solved as u8 } else { why as u8 };
        self.ended += 1;
    }

    pub fn row(&self, answer: usize) -> &[f64] {
        &self.rows.q[answer * self.joints..][..self.joints]
    }

    pub fn row_mut(&mut self, answer: usize) -> &mut [f64] {
        &mut self.rows.q[answer * self.joints..][..self.joints]
    }

    /// Puts a later answer in the place of an earlier one.
    pub fn put(&mut self, from: usize, to: usize) {
        let Rows { q, residual, branch, free } = &mut self.rows;
        q.copy_within(from * self.joints..(from + 1) * self.joints, to * self.joints);
        (residual[to], branch[to], free[to]) = (residual[from], branch[from], free[from]);
    }
}
