//! Solutions with one joint given, in the type of redundant arms.

use groebot_runtime as runtime;
use groebot_runtime::Solve;
use groebot_runtime::redundant::{MOST_JOINTS, Member, Members, Q};
use groebot_runtime::storage::{Array, Storage};

use super::shaped::Shaped;

impl<S: Storage + 'static> Shaped<S> {
    /// Same as [`super::Solver::add_members`].
    pub fn add_members(&self, target: &[f64], out: &mut Members) -> Result<(), runtime::Error> {
        let row = Array::by(target.len(), |i| target[i]);
        self.with_room(self.facts.capacity, |found| {
            let count = Solve::solve(self, &row, found)?;
            for solution in &found[..count] {
                let mut q: Q = [0.0; MOST_JOINTS];
                q[..solution.q.as_ref().len()].copy_from_slice(solution.q.as_ref());
                out.push(Member { q, free: solution.free, settled: solution.settled });
            }
            Ok(())
        })
    }
}
