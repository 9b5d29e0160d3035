//! Solutions with one joint given, in the type of redundant arms.

use groebot_runtime as runtime;
use groebot_runtime::Solve;
use groebot_runtime::redundant::{MOST_JOINTS, Member, Members, Q};
use groebot_runtime::storage::{Array, Storage};

use super::shaped::Shaped;

impl<S: Storage + 'static> Shaped<S> {
    /// Same as [`super::Solver::add_members`].
    pub fn add_members(&self, target: &[f64], joints: &[usize], out: &mut Members) -> Result<(), runtime::Error> {
        let row = Array::by(target.len(), |i| target[i]);
        self.with_room(self.facts.capacity, |found| {
            let count = Solve::solve(self, &row, found)?;
            for solution in &found[..count] {
                let mut q: Q = [0.0; MOST_JOINTS];
                let mut free = 0;
                for (own, &joint) in joints.iter().enumerate() {
                    q[own] = solution.q.as_ref()[joint];
                    free |= (solution.free >> joint & 1) << own;
                }
                out.push(Member { q, free, settled: solution.settled });
            }
            Ok(())
        })
    }
}
