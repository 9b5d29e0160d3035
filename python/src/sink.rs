//! Where the answers of a chunk of targets go, in flat rows. Main type: [`Sink`].

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
}

/// The answers of some targets, one row an answer, in the order of the targets.
#[derive(Default)]
pub struct Sink {
    pub joints: usize,
    /// Row by row.
    pub q: Vec<f64>,
    pub residual: Vec<f64>,
    pub branch: Vec<i32>,
    /// Bit `j` is set where joint `j` is free.
    pub free: Vec<u32>,
    /// By target.
    pub counts: Vec<u32>,
    pub status: Vec<u8>,
}

impl Sink {
    pub fn new(joints: usize) -> Self {
        Sink { joints, ..Sink::default() }
    }

    pub fn clear(&mut self) {
        self.q.clear();
        self.residual.clear();
        self.branch.clear();
        self.free.clear();
        self.counts.clear();
        self.status.clear();
    }

    pub fn answers(&self) -> usize {
        self.residual.len()
    }

    pub fn answer(&mut self, q: &[f64], residual: f64, branch: usize, free: u32) {
        self.q.extend_from_slice(q);
        self.told(residual, branch, free);
    }

    /// The same, the joints one by one.
    pub fn answer_by(&mut self, q: impl Iterator<Item = f64>, residual: f64, branch: usize, free: u32) {
        self.q.extend(q);
        self.told(residual, branch, free);
    }

    fn told(&mut self, residual: f64, branch: usize, free: u32) {
        self.residual.push(residual);
        self.branch.push(branch as i32);
        self.free.push(free);
    }

    /// Ends a target whose answers begin at `first`; where it has none, `why`.
    pub fn end(&mut self, first: usize, why: Status) {
        let count = self.answers() - first;
        self.counts.push(count as u32);
        self.status.push(if count > 0 { Status::Solved as u8 } else { why as u8 });
    }

    /// Forgets the answers from `count` on.
    pub fn truncate(&mut self, count: usize) {
        self.q.truncate(count * self.joints);
        self.residual.truncate(count);
        self.branch.truncate(count);
        self.free.truncate(count);
    }

    pub fn row(&self, answer: usize) -> &[f64] {
        &self.q[answer * self.joints..][..self.joints]
    }

    pub fn row_mut(&mut self, answer: usize) -> &mut [f64] {
        &mut self.q[answer * self.joints..][..self.joints]
    }

    /// Puts a later answer in the place of an earlier one.
    pub fn put(&mut self, from: usize, to: usize) {
        self.q.copy_within(from * self.joints..(from + 1) * self.joints, to * self.joints);
        self.residual[to] = self.residual[from];
        self.branch[to] = self.branch[from];
        self.free[to] = self.free[from];
    }
}
